/* uf2_make: images for an RP2040 or RP2350 as tests want them, made without the code under test. */
#ifndef UF2_MAKE_H
#define UF2_MAKE_H

#include <stdint.h>

#define UF2_BLOCK 512u

/* Offsets of a block's fields. */
enum {
    UF2_MAGIC_0 = 0,
    UF2_MAGIC_1 = 4,
    UF2_FLAGS = 8,
    UF2_ADDRESS = 12,
    UF2_SIZE = 16,
    UF2_NUMBER = 20,
    UF2_TOTAL = 24,
    UF2_FAMILY = 28,
    UF2_DATA = 32,
    UF2_MAGIC_END = 508,
};

uint32_t uf2_get(const uint8_t *at);
void uf2_put(uint8_t *at, uint32_t value);

/* Gives the first 256 bytes of an image the checksum that the boot ROM wants. */
void uf2_seal_boot2(uint8_t page[256]);

/* Bytes of an image, boot2 and all; others for another seed. */
void uf2_make_bin(uint8_t *bytes, uint32_t n, uint32_t seed);

/* A right UF2 of n bytes (a multiple of 256) at address 10000000h: n * 2 bytes. */
void uf2_make(uint8_t *blocks, const uint8_t *bytes, uint32_t n);

/* Turns n blocks into a file for an RP2350: its family, and in the first one what an image definition begins with. */
void uf2_for_rp2350(uint8_t *blocks, uint32_t n);

/* A block against erratum E10, as picotool puts it before the others. */
void uf2_make_e10(uint8_t block[UF2_BLOCK]);

#endif
