#include "flash_program.h"

#include "flash_image.h"

#define HEAD_BYTES   1024 /* in which the header begins; an RP2040's in bytes 256 to 511 */
#define BEGIN        0x7188ebf2u
#define FINISH       0xe71aa390u
#define BINARY_END   0x68f465deu
#define ENTRIES_MOST 128u

static uint32_t word_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static bool is_in_flash(uint32_t address)
{
    return address >= FLASH_BASE && address - FLASH_BASE < FLASH_SPAN - 4 * ENTRIES_MOST;
}

/* Finds the header's table of entries; count is 0 where there is none. */
static int find_table(struct flash_boot *boot, uint32_t *first, uint32_t *count)
{
    uint8_t head[HEAD_BYTES + 16];
    const int status = flash_boot_read(boot, FLASH_BASE, head, sizeof head);
    *count = 0;
    for (uint32_t at = 0; status == 0 && at < HEAD_BYTES; at += 4) {
        const uint32_t from = word_at(head + at + 4), end = word_at(head + at + 8);
        if (word_at(head + at) == BEGIN && word_at(head + at + 16) == FINISH && is_in_flash(from) && end > from &&
            end - from <= 4 * ENTRIES_MOST) {
            *first = from;
            *count = (end - from) / 4;
        }
    }
    return status;
}

int flash_program_end(struct flash_boot *boot, uint32_t *end)
{
    uint32_t first = 0, count = 0;
    int status = find_table(boot, &first, &count);
    *end = 0;
    for (uint32_t i = 0; status == 0 && i < count; i++) {
        uint8_t bytes[12]; /* of an entry: type and tag, identity, value */
        status = flash_boot_read(boot, first + 4 * i, bytes, 4);
        const uint32_t entry = word_at(bytes);
        if (status == 0 && is_in_flash(entry)) {
            status = flash_boot_read(boot, entry, bytes, sizeof bytes);
            *end = status == 0 && word_at(bytes + 4) == BINARY_END ? word_at(bytes + 8) : *end;
        }
    }
    return status;
}
