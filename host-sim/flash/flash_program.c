/* See flash_program.h. Addresses in the binary come from a stranger's image, so each is checked before it is
 * followed. */
#include "flash_program.h"

#include "flash_scene.h"

#include <stdio.h>
#include <string.h>

#define HEAD_BYTES   1024 /* in which the header begins; an RP2040's in bytes 256 to 511 */
#define BEGIN        0x7188ebf2u
#define FINISH       0xe71aa390u
#define ENTRIES_MOST 128u
#define TEXT_BYTES   64 /* that are read of a text */

#define PROGRAM_NAME    0x02031c86u
#define PROGRAM_FEATURE 0xa1f4b453u
#define BINARY_END      0x68f465deu

static uint32_t word_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static bool is_in_flash(uint32_t address)
{
    return address >= FLASH_BASE && address - FLASH_BASE < FLASH_SPAN - 4 * ENTRIES_MOST;
}

/* Where the bytes are: on a board, or in an image. */
struct source {
    struct flash_boot *boot; /* NULL: in the image */
    const struct flash_image *image;
};

/* What is behind an image is erased. */
static int read_bytes(const struct source *source, uint32_t address, uint8_t *bytes, uint32_t n)
{
    if (source->boot != NULL) {
        return flash_boot_read(source->boot, address, bytes, n);
    }
    const uint32_t size = source->image->sectors * FLASH_SECTOR;
    for (uint32_t i = 0, at = address - FLASH_BASE; i < n; i++, at++) {
        bytes[i] = at < size ? source->image->bytes[at] : 0xFF;
    }
    return 0;
}

/* Finds the header's table of entries; count is 0 where there is none. */
static int find_table(const struct source *from, struct flash_program *program, uint32_t *first, uint32_t *count)
{
    uint8_t head[HEAD_BYTES + 16];
    const int status = read_bytes(from, FLASH_BASE, head, sizeof head);
    *count = 0;
    program->is_erased = status == 0;
    for (uint32_t at = 0; status == 0 && at < HEAD_BYTES; at += 4) {
        const uint32_t begin = word_at(head + at + 4), end = word_at(head + at + 8);
        program->is_erased = program->is_erased && word_at(head + at) == UINT32_MAX;
        if (word_at(head + at) == BEGIN && word_at(head + at + 16) == FINISH && is_in_flash(begin) && end > begin &&
            end - begin <= 4 * ENTRIES_MOST) {
            *first = begin;
            *count = (end - begin) / 4;
        }
    }
    return status;
}

/* What is at no address in flash is an empty text. */
static int read_text(const struct source *from, uint32_t address, char text[TEXT_BYTES + 1])
{
    memset(text, 0, TEXT_BYTES + 1);
    const int status = is_in_flash(address) ? read_bytes(from, address, (uint8_t *)text, TEXT_BYTES) : 0;
    for (uint32_t i = 0; text[i] != '\0'; i++) {
        text[i] = text[i] >= ' ' && text[i] <= '~' ? text[i] : '?';
    }
    return status;
}

static int take_entry(const struct source *from, struct flash_program *program, uint32_t id, uint32_t value)
{
    char text[TEXT_BYTES + 1], feature[TEXT_BYTES];
    int status = 0;
    if (id == BINARY_END) {
        program->end = value;
    } else if (id == PROGRAM_NAME) {
        status = read_text(from, value, text);
        snprintf(program->name, sizeof program->name, "%.*s", FLASH_PROGRAM_NAME - 1, text);
    } else if (id == PROGRAM_FEATURE) {
        status = read_text(from, value, text);
        snprintf(feature, sizeof feature, FLASH_SCENE_FEATURE, FLASH_BASE + FLASH_SCENE);
        program->takes_scene = program->takes_scene || strcmp(text, feature) == 0;
    }
    return status;
}

static int read_program(const struct source *from, struct flash_program *program)
{
    uint32_t first = 0, count = 0;
    *program = (struct flash_program){.end = 0};
    int status = find_table(from, program, &first, &count);
    for (uint32_t i = 0; status == 0 && i < count; i++) {
        uint8_t bytes[12]; /* of an entry: type and tag, identity, value */
        status = read_bytes(from, first + 4 * i, bytes, 4);
        const uint32_t entry = word_at(bytes);
        if (status == 0 && is_in_flash(entry)) {
            status = read_bytes(from, entry, bytes, sizeof bytes);
            status = status < 0 ? status : take_entry(from, program, word_at(bytes + 4), word_at(bytes + 8));
        }
    }
    return status;
}

int flash_program_read(struct flash_boot *boot, struct flash_program *program)
{
    const struct source from = {.boot = boot};
    return read_program(&from, program);
}

void flash_program_find(const struct flash_image *image, struct flash_program *program)
{
    const struct source from = {.image = image};
    read_program(&from, program);
}
