/* The boot ROM of the emulated RP2350: the loop of blocks (datasheet 5.1.5, 5.9.1), and which of its image definitions
 * the ROM takes (5.2.7). */
#include "rom.h"

#include <stddef.h>

enum { SEARCHED = 4096, WORDS_MOST = 160, IMAGE_WORDS_MOST = 96 };
#define LOOP_MOST (FLASH_BYTES / 16)                   /* no loop of flash has more blocks */
#define AT_MOST   (FLASH_BYTES - 4 * (WORDS_MOST + 2)) /* where a block may begin */

struct choice {
    struct rom_block image, table;
    const char *image_malformed, *table_malformed;
};

/* Follows the items to the last one, which says how many words there are before it. If there is no last item, the
 * block's `last` is 0: the ROM has not found a block there. */
static const char *read_block(const uint8_t *flash, uint32_t at, struct rom_block *block)
{
    *block = (struct rom_block){.at = at};
    for (uint32_t i = 1; i < WORDS_MOST;) {
        const uint8_t *item = flash + at + 4 * (size_t)i;
        const uint32_t words = rom_item_words(rom_word(item));
        if (words == 0) {
            return "an item of a block has no size";
        }
        if (item[0] == ITEM_LAST) {
            block->last = i;
            block->link = rom_word(item + 4);
            return words != i - 1                    ? "the last item of a block has a wrong size"
                   : rom_word(item + 8) != BLOCK_END ? "a block does not end with the end mark"
                                                     : NULL;
        }
        i += words;
    }
    return NULL;
}

static const char *find_first(const uint8_t *flash, struct rom_block *block)
{
    for (uint32_t at = 0; at < SEARCHED; at += 4) {
        if (rom_word(flash + at) == BLOCK_START) {
            const char *wrong = read_block(flash, at, block);
            if (wrong != NULL) {
                return wrong;
            }
            if (block->last != 0) {
                return at + 4 * (block->last + 3) <= SEARCHED ? NULL : "the first block ends beyond the first 4 KB";
            }
        }
    }
    return "there is no block in the first 4 KB";
}

static const char *follow_link(const uint8_t *flash, uint32_t first, struct rom_block *block)
{
    const int64_t to = (int64_t)block->at + (int32_t)block->link;
    if (block->link == 0) {
        return "a block that is not the first links to itself";
    }
    if (to % 4 != 0) {
        return "the link of a block is no multiple of 4";
    }
    if (to < first) {
        return "a block links to an address before the first block";
    }
    if (to > AT_MOST) {
        return "a block links to an address outside of the flash";
    }
    if (rom_word(flash + to) != BLOCK_START) {
        return "a block links to an address where no block is";
    }
    const char *wrong = read_block(flash, (uint32_t)to, block);
    return wrong == NULL && block->last == 0 ? "a block has no last item" : wrong;
}

static uint32_t type_of(const uint8_t *flash, const struct rom_block *block)
{
    return rom_word(flash + block->at + 4);
}

static uint32_t cpu_of(uint32_t type)
{
    return chip_bits(type, 24, 3);
}

/* The ROM begins on the Arm cores. It takes the last definition, but rather one for the CPU on which it runs. A
 * malformed one is kept, and what follows is ignored (erratum RP2350-E13). Definitions of what is no program are
 * ignored. */
static void consider_image(const uint8_t *flash, const struct rom_block *block, struct choice *choice)
{
    const uint32_t type = type_of(flash, block);
    if (block->last + 3 > IMAGE_WORDS_MOST || chip_bits(type, 16, 4) != TYPE_EXE) {
        return;
    }
    if (choice->image.last != 0 && (choice->image_malformed != NULL ||
                                    (cpu_of(type) != CPU_ARM && cpu_of(type_of(flash, &choice->image)) == CPU_ARM))) {
        return;
    }
    choice->image = *block;
    choice->image_malformed = rom_image_malformed(flash, block);
}

static void consider(const uint8_t *flash, const struct rom_block *block, struct choice *choice)
{
    const uint32_t type = type_of(flash, block);
    if ((type & 0x7f) == ITEM_PARTITION_TABLE) {
        if (choice->table_malformed == NULL) {
            choice->table = *block;
            choice->table_malformed = rom_table_malformed(flash, block);
        }
    } else if ((type & 0xffff) == (1 << 8 | ITEM_IMAGE_TYPE)) {
        consider_image(flash, block, choice);
    }
}

/* The last link leads back to the first block. */
static const char *read_loop(const uint8_t *flash, struct choice *choice)
{
    struct rom_block block = {.at = 0};
    const char *wrong = find_first(flash, &block);
    const uint32_t first = block.at;
    for (uint32_t count = 0; wrong == NULL; count++) {
        consider(flash, &block, choice);
        if (block.at + block.link == first) {
            return NULL;
        }
        wrong = count < LOOP_MOST ? follow_link(flash, first, &block)
                                  : "the blocks never lead back to the first one (erratum RP2350-E22: the ROM hangs)";
    }
    return wrong;
}

const char *rom_refuses(struct chip *chip, const uint8_t *flash, uint32_t bytes)
{
    struct choice choice = {.image_malformed = NULL};
    const char *wrong = read_loop(flash, &choice);
    if (wrong != NULL) {
        return wrong;
    }
    if (choice.table_malformed != NULL) {
        return choice.table_malformed;
    }
    if (choice.image.last == 0) {
        return choice.table.last != 0
                   ? "a partition table has no image definition beside it, and partitions are not modelled"
                   : "no block defines a program";
    }
    return choice.image_malformed != NULL ? choice.image_malformed
                                          : rom_image_refused(chip, flash, bytes, &choice.image);
}
