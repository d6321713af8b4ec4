/* colour: wire order (16-bit pixels in memory with their high byte first, on every machine). */
#ifndef PH_COLOUR_H
#define PH_COLOUR_H

#include "fx.h"

/* Converts a colour between a number and wire order, in either direction: it swaps the bytes, or nothing on a CPU of
 * big endian. */
static inline uint16_t ph_wire16(uint16_t v)
{
    const union {
        uint8_t bytes[2];
        uint16_t value;
    } wire = {{(uint8_t)(v >> 8), (uint8_t)v}};
    return wire.value;
}

#define PH_RAMP_NEAREST ((uint32_t)255 << 15)

/* One channel, 0 .. top. With the intensity, Q16.16, it fades from black to its colour at 1, then to white. up: what is
 * added before it is rounded down, in 2^-16 / 255. */
static inline uint32_t ph_ramp_channel(uint32_t channel, uint32_t intensity, uint32_t top, uint32_t up)
{
    const uint32_t white = intensity <= FX_ONE ? 0 : intensity - FX_ONE;
    const uint32_t lit = intensity <= FX_ONE ? channel * intensity : (channel << 16) + (255 - channel) * white;
    return ((lit * top + up) >> 16) * 32897 >> 23; /* n / 255 of 16 bits: no CPU needs to divide */
}

/* The colour, 0 .. 255 a channel, at an intensity, in wire order. up: as for a channel. */
static inline uint16_t ph_ramp_colour(const uint32_t colour[3], uint32_t intensity, uint32_t up)
{
    return ph_wire16((uint16_t)(ph_ramp_channel(colour[0], intensity, 31, up) << 11 |
                                ph_ramp_channel(colour[1], intensity, 63, up) << 5 |
                                ph_ramp_channel(colour[2], intensity, 31, up)));
}

/* The entries of a ramp one after the other, each with its intensity, without a division for each. */
struct ph_ramp_walk {
    uint32_t entry, intensity; /* (full * step + 59) / 119, step = 0 .. 119; full: that of entry 123 */
    uint32_t rest;             /* what the division leaves */
    uint32_t whole, part;      /* full / 119, and what that leaves */
};

static inline struct ph_ramp_walk ph_ramp_begin(fx_t specular)
{
    const uint32_t full = FX_ONE + (uint32_t)(specular < 0 ? 0 : specular > FX_ONE ? FX_ONE : specular);
    const uint32_t whole = (uint32_t)fx_quotient_u64(full, 119);
    return (struct ph_ramp_walk){0, 0, 59, whole, full - 119 * whole};
}

static inline void ph_ramp_next(struct ph_ramp_walk *at)
{
    at->entry++;
    if (at->entry > 4 && at->entry <= 123) {
        at->rest += at->part;
        at->intensity += at->whole + (at->rest >= 119);
        at->rest -= at->rest >= 119 ? 119 : 0;
    }
}

#endif
