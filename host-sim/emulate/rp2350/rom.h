/*
 * rom: what the boot ROM of revision A2 reads of the flash, before it starts an image.
 *
 * Blocks lie in flash as a loop (5.9.1): each has a header, items, a link to the next block and an end mark. Where the
 * datasheet and the ROM's source differ, the source holds: the type of HASH_VALUE is 4Bh and that of SIGNATURE 09h, and
 * HASH_DEF has two words. Nothing is read but a flash of FLASH_BYTES, which is FFh where the image does not reach.
 */
#ifndef ROM_H
#define ROM_H

#include "chip.h"

#define BLOCK_START 0xffffded3
#define BLOCK_END   0xab123579

enum { ITEM_IMAGE_TYPE = 0x42, ITEM_PARTITION_TABLE = 0x0a, ITEM_LAST = 0xff };
enum { TYPE_EXE = 1, CPU_ARM = 0, CPU_RISCV = 1, SECURITY_NON_SECURE = 1, SECURITY_RESERVED = 3, CHIP_RP2350 = 1 };

struct rom_block {
    uint32_t at;   /* its header, in flash */
    uint32_t last; /* the word with the last item, counted from the header; 0: there is no block */
    uint32_t link; /* from its header to the next one, in bytes, signed */
};

struct rom_uf2 {
    uint32_t bytes; /* of the image */
    uint32_t family;
};

/* rom_items.c: what keeps the ROM from reading such a block, or NULL. */
const char *rom_image_malformed(const uint8_t *flash, const struct rom_block *block);
const char *rom_table_malformed(const uint8_t *flash, const struct rom_block *block);
/* Sets how core 0 starts; NULL, or why the image of this definition is not started. The image has so many bytes. */
const char *rom_image_refused(struct chip *chip, const uint8_t *flash, uint32_t bytes, const struct rom_block *block);

/* rom_uf2.c: puts the image of a UF2 file into flash; NULL, or why the boot loader does not take the file. */
const char *rom_uf2_refused(const uint8_t *file, uint32_t bytes, uint8_t *flash, struct rom_uf2 *uf2);

static inline uint32_t rom_word(const uint8_t *from)
{
    return from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

/* Words of an item, by its first word: bit 7 says that the size has two bytes. */
static inline uint32_t rom_item_words(uint32_t item)
{
    return chip_bits(item, 8, (item & 0x80) != 0 ? 16 : 8);
}

#endif
