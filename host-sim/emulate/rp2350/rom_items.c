/* The boot ROM of the emulated RP2350: the items of a block (datasheet 5.9.2 .. 5.9.4), and what they say about the
 * start of an image. */
#include "rom.h"

#include <stddef.h>

enum item { VECTOR_TABLE, ENTRY_POINT, WINDOW_DELTA, LOAD_MAP, HASH_DEF, HASH_VALUE, SIGNATURE, VERSION, ITEMS };

static const struct {
    uint8_t type, least, most; /* words; 0: they depend on the first word */
    const char *malformed;
} kinds[ITEMS] = {[VECTOR_TABLE] = {0x03, 2, 2, "the VECTOR_TABLE item has a wrong size"},
                  [ENTRY_POINT] = {0x44, 3, 4, "the ENTRY_POINT item has a wrong size"},
                  [WINDOW_DELTA] = {0x05, 2, 2, "the ROLLING_WINDOW_DELTA item has a wrong size"},
                  [LOAD_MAP] = {0x06, 0, 0, "the LOAD_MAP item has a wrong size"},
                  [HASH_DEF] = {0x47, 2, 2, "the HASH_DEF item has a wrong size"},
                  [HASH_VALUE] = {0x4b, 2, 9, "the HASH_VALUE item has a wrong size"},
                  [SIGNATURE] = {0x09, 33, 33, "the SIGNATURE item has a wrong size"},
                  [VERSION] = {0x48, 0, 0, "the VERSION item has a wrong size"}};

enum { HASH_SHA256 = 1, ROW_BITS = 24, PARTITIONS_MOST = 16, TABLE_BYTES = 512, RISCV_STACK = 16, ARM_STACK = 8 };
#define NO_STACK 0xf0000000 /* what the ROM gives to a RISC-V image that names no entry point */

static bool has_wrong_size(uint32_t kind, uint32_t first)
{
    const uint32_t words = rom_item_words(first), count = first >> 24;
    switch (kind) {
    case LOAD_MAP:
        return words != 1 + 3 * (count & 0x7f);
    case VERSION:
        return words != 2 + ((count != 0) + count + 1) / 2;
    default:
        return words < kinds[kind].least || words > kinds[kind].most;
    }
}

/* Finds the items from word `from` on. `items` tells where in flash the last of each kind is; 0: there is none. A hash
 * of an unknown type is ignored. */
static const char *read_items(const uint8_t *flash, const struct rom_block *block, uint32_t from, uint32_t items[ITEMS])
{
    for (uint32_t at = block->at + 4 * from; at < block->at + 4 * block->last;) {
        const uint32_t first = rom_word(flash + at);
        for (uint32_t kind = 0; kind < ITEMS; kind++) {
            if ((first & 0x7f) != kinds[kind].type) {
                continue;
            }
            if (has_wrong_size(kind, first)) {
                return kinds[kind].malformed;
            }
            if (kind != HASH_DEF || first >> 24 == HASH_SHA256) {
                items[kind] = at;
            }
        }
        at += 4 * rom_item_words(first);
    }
    const uint8_t *version = flash + items[VERSION];
    return items[VERSION] != 0 && version[3] != 0 && chip_bits(rom_word(version + 8), 0, 16) >= ROW_BITS * version[3]
               ? "the rollback version has no room in its rows"
               : NULL;
}

const char *rom_image_malformed(const uint8_t *flash, const struct rom_block *block)
{
    uint32_t items[ITEMS] = {0};
    const uint32_t type = rom_word(flash + block->at + 4);
    return chip_bits(type, 28, 3) != CHIP_RP2350 ? "the image definition is for another chip"
                                                 : read_items(flash, block, 2, items);
}

const char *rom_table_malformed(const uint8_t *flash, const struct rom_block *block)
{
    uint32_t items[ITEMS] = {0};
    const uint32_t table = rom_word(flash + block->at + 4), words = rom_item_words(table);
    const uint32_t partitions = chip_bits(table, 24, 7);
    if (words < 2 + 2 * partitions || partitions > PARTITIONS_MOST) {
        return "the partition table has a wrong size";
    }
    const char *wrong = read_items(flash, block, 1 + words, items);
    return wrong == NULL && items[HASH_VALUE] != 0 ? "the partition table has a hash, which is not modelled" : wrong;
}

/* The ROM of a chip without secure boot checks a hash if its value is there, and no signature. That a hash or a
 * signature has its other half is a check of this model. */
static const char *hash_is_wrong(const uint8_t *flash, const uint32_t items[ITEMS], uint32_t words)
{
    if (items[HASH_DEF] == 0) {
        return items[HASH_VALUE] != 0 || items[SIGNATURE] != 0 ? "a hash or a signature has no HASH_DEF item" : NULL;
    }
    if (chip_bits(rom_word(flash + items[HASH_DEF] + 4), 0, 16) > words) {
        return "the hash covers more words than the block has";
    }
    return items[HASH_VALUE] != 0  ? "the image has a hash, which is not modelled"
           : items[SIGNATURE] == 0 ? "a HASH_DEF item has neither a HASH_VALUE nor a SIGNATURE"
                                   : NULL;
}

/* Three words an entry: stored at, address when it runs, size or end. */
static const char *load_map_is_wrong(const uint8_t *map)
{
    for (uint32_t i = 1; i < rom_item_words(rom_word(map)); i++) {
        if (rom_word(map + 4 * (size_t)i) % 4 != 0) {
            return "an address or a size of the load map is no multiple of 4";
        }
    }
    return "the image has a load map, which is not modelled";
}

/* A positive delta skips flash in steps of 4 KB, a negative one moves the image up in steps of 4 MB (5.9.3.5). */
static const char *delta_is_wrong(uint32_t delta)
{
    return delta % ((int32_t)delta < 0 ? 4U << 20 : 4U << 10) != 0 ? "the rolling window delta has a wrong alignment"
           : delta != 0 ? "the image has a rolling window, which is not modelled"
                        : NULL;
}

static const char *type_is_wrong(uint32_t type)
{
    const uint32_t cpu = chip_bits(type, 24, 3), security = chip_bits(type, 20, 2);
    if (chip_bits(type, 31, 1) != 0) {
        return "the image is one to try before it is bought (TBYB), which a normal boot ignores";
    }
    if (cpu != CPU_ARM && cpu != CPU_RISCV) {
        return "the image definition is for no CPU of this chip";
    }
    if (security == SECURITY_RESERVED) {
        return "the image definition has a reserved security";
    }
    return cpu == CPU_ARM && security == SECURITY_NON_SECURE ? "the image definition is for Non-secure mode" : NULL;
}

static bool in_image(uint32_t address, uint32_t bytes, uint32_t size)
{
    return address >= FLASH_BASE && address - FLASH_BASE <= bytes && bytes - (address - FLASH_BASE) >= size;
}

/* The ROM does not check this. It would jump to where no code is, or give a stack to which nothing can be pushed. */
static const char *start_is_wrong(const struct chip *chip, const uint8_t *flash, uint32_t bytes)
{
    const uint32_t first = rom_word(flash);
    if ((chip->entry & 1) != (chip->riscv ? 0 : 1)) {
        return chip->riscv ? "the entry point is odd" : "the entry point is no Thumb code";
    }
    if (!in_image(chip->entry, bytes, 2)) {
        return "the entry point lies outside of the image";
    }
    if (chip->stack == NO_STACK && (first == BLOCK_START || first >> 28 == RAM_BASE >> 28)) {
        return "without an entry point a RISC-V image starts at its first byte, and no code is there";
    }
    if (chip->stack != NO_STACK && (chip->stack <= RAM_BASE || chip->stack > RAM_BASE + RAM_BYTES)) {
        return "the stack pointer lies outside of RAM";
    }
    if (chip->stack % (chip->riscv ? RISCV_STACK : ARM_STACK) != 0) {
        return "the stack pointer has a wrong alignment";
    }
    return chip->stack_limit > chip->stack ? "the limit of the stack lies above the stack pointer" : NULL;
}

/* Where no item says otherwise, an image starts with the Arm vectors, or with RISC-V code (5.9.5). VTOR wants a table
 * of 68 vectors aligned to 512 bytes: 4 bytes a vector, up to the next power of two (Armv8-M Architecture Reference
 * Manual). */
static const char *find_start(struct chip *chip, const uint8_t *flash, uint32_t bytes, const uint32_t items[ITEMS])
{
    const uint32_t entry = items[ENTRY_POINT], table = chip->riscv ? 0 : items[VECTOR_TABLE];
    chip->vectors = table != 0 ? rom_word(flash + table + 4) : FLASH_BASE;
    if (chip->vectors % TABLE_BYTES != 0) {
        return "the vector table has a wrong alignment";
    }
    if (!in_image(chip->vectors, bytes, 8)) {
        return "the vector table lies outside of the image";
    }
    const uint32_t vectors = chip->vectors - FLASH_BASE;
    chip->stack = chip->riscv ? NO_STACK : rom_word(flash + vectors);
    chip->entry = chip->riscv ? FLASH_BASE : rom_word(flash + vectors + 4);
    chip->stack_limit = 0;
    if (entry != 0) {
        chip->entry = rom_word(flash + entry + 4);
        chip->stack = rom_word(flash + entry + 8);
        chip->stack_limit = flash[entry + 1] == 4 ? rom_word(flash + entry + 12) : 0;
    }
    return start_is_wrong(chip, flash, bytes);
}

const char *rom_image_refused(struct chip *chip, const uint8_t *flash, uint32_t bytes, const struct rom_block *block)
{
    uint32_t items[ITEMS] = {0};
    const uint32_t type = rom_word(flash + block->at + 4);
    const char *wrong = read_items(flash, block, 2, items);
    if (wrong == NULL) {
        wrong = type_is_wrong(type);
    }
    if (wrong == NULL) {
        wrong = hash_is_wrong(flash, items, block->last - 1);
    }
    if (wrong == NULL && items[LOAD_MAP] != 0) {
        wrong = load_map_is_wrong(flash + items[LOAD_MAP]);
    }
    if (wrong == NULL && items[WINDOW_DELTA] != 0) {
        wrong = delta_is_wrong(rom_word(flash + items[WINDOW_DELTA] + 4));
    }
    chip->riscv = chip_bits(type, 24, 3) == CPU_RISCV;
    return wrong != NULL ? wrong : find_start(chip, flash, bytes, items);
}
