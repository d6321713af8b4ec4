/*
 * blend: two RGB565 colours become one. Private to firmware/core.
 *
 * The channels of a colour are spread over a word, so that one product scales all three: blue from bit 0, red from bit
 * 11, green from bit 21. There each has room for a product with 0 .. 32.
 */
#ifndef PH_BLEND_H
#define PH_BLEND_H

#include "colour.h"

#define PH_SPREAD      0x07e0f81fu
#define PH_SPREAD_HALF (16u << 21 | 16u << 11 | 16u) /* half of 32 in each channel: it rounds a product to nearest */

/* Spreads a colour in wire order so that its channels have room between them. */
static inline uint32_t ph_spread(uint16_t wire)
{
    const uint32_t v = ph_wire16(wire);
    return (v | v << 16) & PH_SPREAD;
}

/* Makes a colour in wire order of a spread one. The bits between its channels need not be clear. */
static inline uint16_t ph_fold(uint32_t spread)
{
    return ph_wire16((uint16_t)(spread | spread >> 16));
}

/* to * share / 32 + from * (1 - share / 32), each channel rounded to nearest; share: 0 .. 32. Colours are spread. */
static inline uint32_t ph_spread_mix(uint32_t from, uint32_t to, uint32_t share)
{
    return (from * (32 - share) + to * share + PH_SPREAD_HALF) >> 5 & PH_SPREAD;
}

/* Mixes two colours in wire order as ph_spread_mix does spread ones. */
static inline uint16_t ph_mix(uint16_t from, uint16_t to, uint32_t share)
{
    return ph_fold(ph_spread_mix(ph_spread(from), ph_spread(to), share));
}

/* The mean of four colours in wire order, each channel rounded to nearest. */
static inline uint16_t ph_mean(uint16_t a, uint16_t b, uint16_t c, uint16_t d)
{
    const uint32_t sum = ph_spread(a) + ph_spread(b) + ph_spread(c) + ph_spread(d);
    return ph_fold((sum + (2u << 21 | 2u << 11 | 2u)) >> 2 & PH_SPREAD);
}

/* to + colour * share / 32, at most full; colours are spread. */
static inline uint32_t ph_spread_add(uint32_t to, uint32_t colour, uint32_t share)
{
    const uint32_t sum = to + ((colour * share + PH_SPREAD_HALF) >> 5 & PH_SPREAD);
    const uint32_t red_blue = sum & (1u << 16 | 1u << 5), green = sum & 1u << 27; /* the carries */
    return (sum | (red_blue - (red_blue >> 5)) | (green - (green >> 6))) & PH_SPREAD;
}

/* a times b, two channels of so many bits each, rounded to nearest; what stands above them does not count. */
static inline uint32_t ph_channel_times(uint32_t a, uint32_t b, uint32_t bits)
{
    const uint32_t top = (1u << bits) - 1, sum = (a & top) * (b & top) + (1u << (bits - 1));
    return (sum + (sum >> bits)) >> bits;
}

/* Multiplies two colours in wire order, channel by channel; full channels leave the other colour as it is. */
static inline uint16_t ph_times(uint16_t wire, uint16_t colour)
{
    const uint32_t a = ph_wire16(wire), b = ph_wire16(colour);
    return ph_wire16((uint16_t)(ph_channel_times(a >> 11, b >> 11, 5) << 11 | ph_channel_times(a >> 5, b >> 5, 6) << 5 |
                                ph_channel_times(a, b, 5)));
}

#endif
