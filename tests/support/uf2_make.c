/* See uf2_make.h. The CRC of a boot page is computed here as the chip's ROM does it. */
#include "uf2_make.h"

#include "crc32.h"

#include <string.h>

uint32_t uf2_get(const uint8_t *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

void uf2_put(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

static uint32_t turn(uint32_t value, int bits)
{
    uint32_t turned = 0;
    for (int i = 0; i < bits; i++) {
        turned |= (value >> i & 1) << (bits - 1 - i);
    }
    return turned;
}

/* The ROM's CRC is the usual CRC-32 with the bits of everything the other way round, and not inverted in the end. */
void uf2_seal_boot2(uint8_t page[256])
{
    uint8_t turned[252];
    for (int i = 0; i < 252; i++) {
        turned[i] = (uint8_t)turn(page[i], 8);
    }
    uf2_put(page + 252, turn(~crc32_update(0, turned, sizeof turned), 32));
}

void uf2_make_bin(uint8_t *bytes, uint32_t n, uint32_t seed)
{
    uint32_t state = seed * 2654435761u + 1;
    for (uint32_t i = 0; i < n; i++) {
        state = state * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(state >> 24);
    }
    if (n >= 256) {
        uf2_seal_boot2(bytes);
    }
}

void uf2_make(uint8_t *blocks, const uint8_t *bytes, uint32_t n)
{
    memset(blocks, 0, (size_t)n / 256 * UF2_BLOCK);
    for (uint32_t i = 0; i < n / 256; i++) {
        uint8_t *b = blocks + (size_t)i * UF2_BLOCK;
        uf2_put(b + UF2_MAGIC_0, 0x0A324655);
        uf2_put(b + UF2_MAGIC_1, 0x9E5D5157);
        uf2_put(b + UF2_FLAGS, 0x2000);
        uf2_put(b + UF2_ADDRESS, 0x10000000 + 256 * i);
        uf2_put(b + UF2_SIZE, 256);
        uf2_put(b + UF2_NUMBER, i);
        uf2_put(b + UF2_TOTAL, n / 256);
        uf2_put(b + UF2_FAMILY, 0xE48BFF56);
        memcpy(b + UF2_DATA, bytes + 256 * i, 256);
        uf2_put(b + UF2_MAGIC_END, 0x0AB16F30);
    }
}

void uf2_for_rp2350(uint8_t *blocks, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uf2_put(blocks + (size_t)i * UF2_BLOCK + UF2_FAMILY, 0xE48BFF59);
    }
    uf2_put(blocks + UF2_DATA, 0xFFFFDED3);
}

void uf2_make_e10(uint8_t block[UF2_BLOCK])
{
    const uint8_t page[256] = {0xEF};
    uf2_make(block, page, sizeof page);
    uf2_put(block + UF2_FLAGS, 0xA000);
    uf2_put(block + UF2_ADDRESS, 0x10FFFF00);
    uf2_put(block + UF2_TOTAL, 2);
    uf2_put(block + UF2_FAMILY, 0xE48BFF57);
    uf2_put(block + UF2_DATA + 256, 0x9957E304);
}
