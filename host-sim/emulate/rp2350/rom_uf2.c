/* What the USB boot loader does with a UF2 file that is dropped on its drive, while flash has no partition table
 * (5.5.2, 5.5.3). It ignores a block that it does not want and then waits for ever, so here such a block is a reason to
 * refuse. */
#include "rom.h"

#include <stddef.h>
#include <string.h>

enum { BLOCK = 512, PAYLOAD = 256, DATA = 32, MAGIC_END = 508, BLOCKS_MOST = 32 << 20 >> 8 };
enum { NOT_MAIN_FLASH = 0x1, HAS_FAMILY = 0x2000, HAS_EXTENSIONS = 0x8000 };
enum { ABSOLUTE = 0x57, RISCV = 0x5a }; /* with data and Arm between them; Non-secure, 5Bh, is not taken */
#define FAMILY     0xe48bff00U
#define LAST_PAGE  (FLASH_BASE + FLASH_BYTES - PAYLOAD)
#define TAG_IGNORE 0x9957e304U

struct block {
    uint32_t flags, address, size, number, count, family;
};

static bool read_block(const uint8_t *from, struct block *block)
{
    *block = (struct block){rom_word(from + 8),  rom_word(from + 12), rom_word(from + 16),
                            rom_word(from + 20), rom_word(from + 24), rom_word(from + 28)};
    return rom_word(from) == 0x0a324655 && rom_word(from + 4) == 0x9e5d5157 && rom_word(from + MAGIC_END) == 0x0ab16f30;
}

/* Erratum RP2350-E10: revision A2 looks for a partition table before it has set up the flash. A first block of the
 * family "absolute", the first of two, makes it set up the flash and wait for more. Later revisions ignore it for its
 * tag. */
static bool is_against_e10(const uint8_t *from)
{
    struct block block;
    return read_block(from, &block) && block.flags == (HAS_FAMILY | HAS_EXTENSIONS) && block.address == LAST_PAGE &&
           block.size == PAYLOAD && block.number == 0 && block.count == 2 && block.family == (FAMILY | ABSOLUTE) &&
           rom_word(from + DATA + PAYLOAD) == TAG_IGNORE;
}

/* Whether the boot loader ignores the block, whatever came before it. */
static const char *block_is_ignored(const struct block *block)
{
    if ((block->flags & HAS_FAMILY) == 0) {
        return "a block of the UF2 file has no family";
    }
    if ((block->flags & NOT_MAIN_FLASH) != 0) {
        return "a block of the UF2 file is not for the main flash";
    }
    if (block->size != PAYLOAD) {
        return "a block of the UF2 file has no 256 bytes";
    }
    return block->family < (FAMILY | ABSOLUTE) || block->family > (FAMILY | RISCV)
               ? "a block of the UF2 file has a family that an RP2350 ignores"
               : NULL;
}

static const char *block_is_wrong(const struct block *block, const struct block *first, const bool *seen)
{
    const char *ignored = block_is_ignored(block);
    if (ignored != NULL) {
        return ignored;
    }
    if (block->count != first->count || block->family != first->family) {
        return "a block of the UF2 file has another count or family than those before: what was sent is discarded";
    }
    if (block->number >= block->count || block->count > BLOCKS_MOST) {
        return "the number of a block of the UF2 file is not below their count";
    }
    if (seen[block->number]) {
        return "two blocks of the UF2 file have the same number";
    }
    return block->address < FLASH_BASE || block->address >= FLASH_BASE + FLASH_BYTES || block->address % PAYLOAD != 0
               ? "the address of a block of the UF2 file is none of a page of flash"
               : NULL;
}

const char *rom_uf2_refused(const uint8_t *file, uint32_t bytes, uint8_t *flash, struct rom_uf2 *uf2)
{
    static bool seen[BLOCKS_MOST];
    struct block first = {.count = 0};
    uint32_t taken = 0;
    memset(seen, 0, sizeof seen);
    uf2->bytes = 0;
    if (bytes < 2 * BLOCK || !is_against_e10(file)) {
        return "the UF2 file does not begin with the block against erratum RP2350-E10";
    }
    for (uint32_t at = BLOCK; at + BLOCK <= bytes; at += BLOCK, taken++) {
        struct block block;
        if (!read_block(file + at, &block)) {
            return "a block of the UF2 file has wrong magic numbers";
        }
        first = taken == 0 ? block : first;
        const char *wrong = block_is_wrong(&block, &first, seen);
        if (wrong != NULL) {
            return wrong;
        }
        const uint32_t offset = block.address - FLASH_BASE;
        seen[block.number] = true;
        memcpy(flash + offset, file + at + DATA, PAYLOAD);
        uf2->bytes = offset + PAYLOAD > uf2->bytes ? offset + PAYLOAD : uf2->bytes;
    }
    uf2->family = first.family;
    return taken < first.count ? "blocks of the UF2 file are missing" : NULL;
}
