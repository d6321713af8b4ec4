/* colour: wire order (16-bit pixels in memory with their high byte first, on every machine), and materials. */
#ifndef PH_COLOUR_H
#define PH_COLOUR_H

#include <stdint.h>

/* From a number to wire order, and back: both are the same swap, or none. */
static inline uint16_t ph_wire16(uint16_t v)
{
    const union {
        uint8_t bytes[2];
        uint16_t value;
    } wire = {{(uint8_t)(v >> 8), (uint8_t)v}};
    return wire.value;
}

struct ph_material;

/* A sum over all that a material says: another one after almost any change (one of 2^32 is missed). */
uint32_t ph_material_sum(const struct ph_material *material);

#endif
