/* wire_colour: a colour in wire order (RGB565, its high byte first) as 8 bits a channel, 0 .. 255. */
#ifndef WIRE_COLOUR_H
#define WIRE_COLOUR_H

#include <stdint.h>
#include <string.h>

static inline void wire_colour(uint16_t colour, uint8_t rgb[3])
{
    uint8_t bytes[2];
    memcpy(bytes, &colour, sizeof bytes);
    const unsigned c = (unsigned)bytes[0] << 8 | bytes[1];
    rgb[0] = (uint8_t)((c >> 11) * 255 / 31);
    rgb[1] = (uint8_t)((c >> 5 & 63) * 255 / 63);
    rgb[2] = (uint8_t)((c & 31) * 255 / 31);
}

#endif
