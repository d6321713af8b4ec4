/* See flash_file.h. */
#include "flash_file.h"

#include "flash_uf2.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_MOST   (64u << 20) /* larger files are not even read */
#define BOOT2_BYTES 252u        /* its checksum follows */

/* Has the image a boot2 with the right checksum? CRC-32, highest bit first, from FFFFFFFFh, nothing inverted; stored
 * little-endian. */
static int has_boot2(const uint8_t *bytes)
{
    uint32_t crc = 0xFFFFFFFF, stored = 0;
    for (uint32_t i = 0; i < BOOT2_BYTES; i++) {
        crc ^= (uint32_t)bytes[i] << 24;
        for (int bit = 0; bit < 8; bit++) {
            crc = crc << 1 ^ (crc >> 31 != 0 ? 0x04C11DB7u : 0);
        }
    }
    for (int i = 3; i >= 0; i--) {
        stored = stored << 8 | bytes[BOOT2_BYTES + i];
    }
    return crc == stored;
}

/* Has the image a block that an RP2350 looks for in its first 4 KB? */
static bool has_definition(const struct flash_image *image)
{
    static const uint8_t begin[4] = {0xD3, 0xDE, 0xFF, 0xFF};
    for (uint32_t at = 0; at < FLASH_SECTOR; at += sizeof begin) {
        if (memcmp(image->bytes + at, begin, sizeof begin) == 0) {
            return true;
        }
    }
    return false;
}

/* Would its chip start the image? A BIN file does not say for which chip it is: what it begins with does. */
static int check_start(struct flash_image *image, char *error)
{
    if (memcmp(image->bytes, "PHHS", 4) == 0) { /* SCENE_FILE_MAGIC */
        return flash_image_wrong(error, "a binary scene: add --at-scene");
    }
    if (image->chip == FLASH_ANY) {
        image->chip = has_boot2(image->bytes) || !has_definition(image) ? FLASH_RP2040 : FLASH_RP2350;
    }
    if (image->chip == FLASH_RP2040 && !has_boot2(image->bytes)) {
        return flash_image_wrong(error, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
    }
    if (image->chip == FLASH_RP2350 && !has_definition(image)) {
        return flash_image_wrong(error, "no image for an RP2350: its first 4096 bytes have no image definition");
    }
    return 0;
}

static int parse_bin(struct flash_image *image, const uint8_t *bytes, size_t n, char *error)
{
    if (n > FLASH_SPAN) {
        return flash_image_wrong(error, "%zu bytes do not fit into the flash: the chip addresses %u", n, FLASH_SPAN);
    }
    if (n < FLASH_PAGE) {
        return flash_image_wrong(error, "%zu bytes are no image: not even boot2, its first 256, is whole", n);
    }
    const int status = flash_image_make(image, (uint32_t)n, error);
    if (status == 0) {
        flash_image_put(image, 0, bytes, (uint32_t)n);
    }
    return status;
}

int flash_file_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error)
{
    memset(image, 0, sizeof *image);
    if (n == 0) {
        return flash_image_wrong(error, "the file is empty");
    }
    if (n >= 4 && memcmp(bytes, "\177ELF", 4) == 0) {
        return flash_image_wrong(error, "an ELF file, which is for debuggers; give the .uf2 or .bin beside it");
    }
    if (bytes[0] == ':') {
        return flash_image_wrong(error, "looks like Intel HEX; give a UF2 or BIN file");
    }
    int status = flash_uf2_is(bytes, n) ? flash_uf2_parse(image, bytes, n, error) : parse_bin(image, bytes, n, error);
    if (status == 0 && image->used[0] && check_start(image, error) != 0) {
        flash_image_free(image);
        status = PH_ERR_INVAL;
    }
    return status;
}

/* Reads the whole file; NULL with a line in error. */
static uint8_t *load(FILE *file, size_t *n, char *error)
{
    size_t room = 1u << 20;
    uint8_t *bytes = NULL;
    for (*n = 0;;) {
        uint8_t *more = realloc(bytes, room);
        if (more == NULL) {
            break;
        }
        bytes = more;
        *n += fread(bytes + *n, 1, room - *n, file);
        if (ferror(file)) {
            flash_image_wrong(error, "cannot be read: %s", strerror(errno));
            free(bytes);
            return NULL;
        }
        if (*n < room) {
            return bytes;
        }
        room *= 2;
        if (room > FILE_MOST) {
            break;
        }
    }
    flash_image_wrong(error, "too large for an image: more than %u bytes", FILE_MOST);
    free(bytes);
    return NULL;
}

uint8_t *flash_file_load(const char *path, size_t *n, char *error)
{
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        flash_image_wrong(error, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    uint8_t *const bytes = load(file, n, error);
    fclose(file);
    return bytes;
}

int flash_file_read(struct flash_image *image, const char *path, char *error)
{
    size_t n = 0;
    memset(image, 0, sizeof *image);
    uint8_t *bytes = flash_file_load(path, &n, error);
    if (bytes == NULL) {
        return PH_ERR_INVAL;
    }
    const int status = flash_file_parse(image, bytes, n, error);
    free(bytes);
    return status;
}
