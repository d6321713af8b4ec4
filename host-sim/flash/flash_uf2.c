/* See flash_uf2.h. */
#include "flash_uf2.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = FLASH_UF2_BLOCK, MAGIC_END_AT = BLOCK - 4 };
enum { NOT_FOR_FLASH = 0x1, FILE_CONTAINER = 0x1000, HAS_FAMILY = 0x2000 };

#define MAGIC_0   0x0A324655u
#define MAGIC_1   0x9E5D5157u
#define MAGIC_END 0x0AB16F30u
#define RP2040    0xE48BFF56u
#define ABSOLUTE  0xE48BFF57u
#define RP2350    0xE48BFF59u
#define RISCV     0xE48BFF5Au
#define LAST_PAGE (FLASH_BASE + FLASH_SPAN - FLASH_PAGE)
#define PAGES     (FLASH_SPAN / FLASH_PAGE)

struct block {
    uint32_t index; /* in the file */
    uint32_t flags, address, size, number, total, family;
    const uint8_t *payload;
};

/* What was seen of the file so far. */
struct uf2 {
    uint32_t blocks;
    uint8_t *numbers; /* by block number */
    uint8_t *pages;   /* by page of the flash */
    uint32_t end;     /* of the last page, from FLASH_BASE */
    uint32_t family;  /* of the blocks so far; 0: none */
};

static uint32_t u32(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

int flash_uf2_is(const uint8_t *bytes, size_t n)
{
    return (n >= 4 && u32(bytes) == MAGIC_0) || (n >= 8 && u32(bytes + 4) == MAGIC_1) ||
           (n >= BLOCK && u32(bytes + MAGIC_END_AT) == MAGIC_END);
}

static const char *family_name(uint32_t family)
{
    static const struct {
        uint32_t family;
        const char *name;
    } known[] = {{RP2040, "RP2040"},           {RP2350, "RP2350"},
                 {RISCV, "RP2350, RISC-V"},    {ABSOLUTE, "RP2350, absolute"},
                 {0xE48BFF58, "RP2350, data"}, {0xE48BFF5B, "RP2350, non-secure"},
                 {0x57755A57, "STM32F4"},      {0x68ED2B88, "SAMD21"},
                 {0x55114460, "SAMD51"},       {0xADA52840, "nRF52840"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (known[i].family == family) {
            return known[i].name;
        }
    }
    return "another chip";
}

static struct block read_block(const uint8_t *at, uint32_t index)
{
    return (struct block){.index = index,
                          .flags = u32(at + 8),
                          .address = u32(at + 12),
                          .size = u32(at + 16),
                          .number = u32(at + 20),
                          .total = u32(at + 24),
                          .family = u32(at + 28),
                          .payload = at + FLASH_UF2_HEADER};
}

static bool has_magic(const uint8_t *at)
{
    return u32(at) == MAGIC_0 && u32(at + 4) == MAGIC_1 && u32(at + MAGIC_END_AT) == MAGIC_END;
}

/* Checks that the block is the only one of its number, and that there are as many as it says. */
static int check_number(struct uf2 *uf2, const struct block *b, char *error)
{
    if (b->total > uf2->blocks) {
        return flash_image_wrong(error, "truncated: block %u says that there are %u blocks, the file has %u", b->index,
                                 b->total, uf2->blocks);
    }
    if (b->total < uf2->blocks) {
        return flash_image_wrong(error, "damaged: block %u says that there are %u blocks, the file has %u", b->index,
                                 b->total, uf2->blocks);
    }
    if (b->number >= uf2->blocks) {
        return flash_image_wrong(error, "damaged: block %u has the number %u of %u", b->index, b->number, uf2->blocks);
    }
    if (uf2->numbers[b->number]) {
        return flash_image_wrong(error, "damaged: block %u has the number %u, which another one has", b->index,
                                 b->number);
    }
    uf2->numbers[b->number] = 1;
    return 0;
}

static int check_place(struct uf2 *uf2, const struct block *b, char *error)
{
    const uint32_t offset = b->address - FLASH_BASE;
    if (b->size != FLASH_PAGE) {
        return flash_image_wrong(error, "damaged: block %u has %u bytes, the chip takes 256 a block", b->index,
                                 b->size);
    }
    if (b->address < FLASH_BASE || offset >= FLASH_SPAN) {
        return flash_image_wrong(error, "block %u is for address 0x%08x, outside of the flash (0x%08x to 0x%08x)",
                                 b->index, b->address, FLASH_BASE, FLASH_BASE + FLASH_SPAN - 1);
    }
    if (offset % FLASH_PAGE != 0) {
        return flash_image_wrong(error, "damaged: block %u is for address 0x%08x, no multiple of 256", b->index,
                                 b->address);
    }
    if (uf2->pages[offset / FLASH_PAGE]) {
        return flash_image_wrong(error, "damaged: block %u overlaps another one at address 0x%08x", b->index,
                                 b->address);
    }
    uf2->pages[offset / FLASH_PAGE] = 1;
    uf2->end = offset + FLASH_PAGE > uf2->end ? offset + FLASH_PAGE : uf2->end;
    return 0;
}

static int check_family(struct uf2 *uf2, const struct block *b, char *error)
{
    if ((b->flags & HAS_FAMILY) == 0) {
        return flash_image_wrong(error, "block %u does not say for which chip it is; the board would ignore it",
                                 b->index);
    }
    if (b->family != RP2040 && b->family != RP2350 && b->family != RISCV && b->family != ABSOLUTE) {
        return flash_image_wrong(error, "for %s (family 0x%08x), not a program for an RP2040 or RP2350",
                                 family_name(b->family), b->family);
    }
    if (uf2->family != 0 && b->family != uf2->family) {
        return flash_image_wrong(error, "block %u is for %s, those before it for %s: no image has blocks for two chips",
                                 b->index, family_name(b->family), family_name(uf2->family));
    }
    uf2->family = b->family;
    return 0;
}

static int check_block(struct uf2 *uf2, const struct block *b, char *error)
{
    int status = check_number(uf2, b, error);
    if (status != 0 || (b->flags & NOT_FOR_FLASH) != 0) {
        return status;
    }
    if ((b->flags & FILE_CONTAINER) != 0) {
        return flash_image_wrong(error, "block %u is of a file container, not of a flash image", b->index);
    }
    status = check_family(uf2, b, error);
    return status != 0 ? status : check_place(uf2, b, error);
}

static int check_blocks(struct uf2 *uf2, const uint8_t *bytes, size_t n, char *error)
{
    if (n % BLOCK != 0) {
        return flash_image_wrong(error, "truncated: %zu bytes are no multiple of 512", n);
    }
    for (uint32_t i = 0; i < uf2->blocks; i++) {
        const uint8_t *at = bytes + (size_t)i * BLOCK;
        if (!has_magic(at)) {
            return flash_image_wrong(error, "damaged: block %u has wrong magic numbers", i);
        }
        const struct block b = read_block(at, i);
        const int status = check_block(uf2, &b, error);
        if (status != 0) {
            return status;
        }
    }
    return uf2->end > 0 ? 0 : flash_image_wrong(error, "no block is for the flash");
}

static int take_blocks(struct flash_image *image, const struct uf2 *uf2, const uint8_t *bytes, char *error)
{
    const int status = flash_image_make(image, uf2->end, error);
    image->chip = uf2->family == RP2040 ? FLASH_RP2040 : FLASH_RP2350;
    for (uint32_t i = 0; i < uf2->blocks && status == 0; i++) {
        const struct block b = read_block(bytes + (size_t)i * BLOCK, i);
        if ((b.flags & NOT_FOR_FLASH) == 0) {
            flash_image_put(image, b.address - FLASH_BASE, b.payload, FLASH_PAGE);
        }
    }
    return status;
}

size_t flash_uf2_first(const uint8_t *bytes, size_t n)
{
    if (n < 2 * (size_t)BLOCK || !has_magic(bytes)) {
        return 0;
    }
    const struct block b = read_block(bytes, 0);
    const bool is_against_e10 =
        (b.flags & HAS_FAMILY) != 0 && b.family == ABSOLUTE && b.address == LAST_PAGE && b.number == 0 && b.total == 2;
    return is_against_e10 ? BLOCK : 0;
}

size_t flash_uf2_last(const uint8_t *bytes, size_t n)
{
    size_t at = n - BLOCK;
    while ((read_block(bytes + at, 0).flags & NOT_FOR_FLASH) != 0) {
        at -= BLOCK;
    }
    return at;
}

int flash_uf2_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error)
{
    const size_t first = flash_uf2_first(bytes, n);
    bytes += first;
    n -= first;
    struct uf2 uf2 = {.blocks = (uint32_t)(n / BLOCK)};
    int status = 0;
    uf2.numbers = calloc((size_t)uf2.blocks + 1, 1);
    uf2.pages = calloc(PAGES, 1);
    if (uf2.numbers == NULL || uf2.pages == NULL) {
        status = flash_image_wrong(error, "not enough memory");
    } else {
        status = check_blocks(&uf2, bytes, n, error);
    }
    if (status == 0) {
        status = take_blocks(image, &uf2, bytes, error);
    }
    free(uf2.numbers);
    free(uf2.pages);
    return status;
}
