/* torus_crc: the CRC-32 of bytes, bit by bit. */
#ifndef TORUS_CRC_H
#define TORUS_CRC_H

#include <stddef.h>
#include <stdint.h>

static inline uint32_t torus_crc(uint32_t crc, const uint8_t *bytes, size_t n)
{
    while (n-- > 0) {
        crc ^= *bytes++;
        for (int bit = 0; bit < 8; bit++) {
            crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1)));
        }
    }
    return crc;
}

#endif
