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

#endif
