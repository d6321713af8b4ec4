/* colour: wire order (16-bit pixels in memory with their high byte first, on every machine). */
#ifndef PH_COLOUR_H
#define PH_COLOUR_H

#include <stdint.h>

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

#endif
