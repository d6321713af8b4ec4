/*
 * flash_image: what an RP2040's flash shall hold, from a UF2 or BIN file. Nothing of a file is believed: every block of
 * a UF2 is there once, whole, for this chip, inside of the flash, and on bytes of its own; and an image that reaches
 * the flash's first page has a boot2 there with the right checksum, without which the chip would not start it.
 *
 * Sources: the UF2 specification (https://github.com/microsoft/uf2); RP2040 datasheet, sections 2.6.3 (flash at
 * 10000000h, 16 MB), 2.8.1.3.1 (checksum of boot2), 2.8.4.2 (UF2 blocks of 256 bytes).
 */
#ifndef FLASH_IMAGE_H
#define FLASH_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#define FLASH_BASE       0x10000000u
#define FLASH_SPAN       0x01000000u /* bytes that the chip can address */
#define FLASH_SECTOR     4096u       /* is erased as a whole */
#define FLASH_PAGE       256u        /* is written as a whole */
#define FLASH_ERROR_SIZE 256

struct flash_image {
    uint32_t sectors; /* from FLASH_BASE up to the last one that the image uses */
    uint8_t *bytes;   /* of all these sectors; FFh where the image has none */
    uint8_t *used;    /* a sector each: 1 if the image has bytes in it */
    uint32_t size;    /* bytes of the image itself */
};

/* Reads the file. 0, or -1: error (FLASH_ERROR_SIZE bytes) says what is wrong with it, and the image is empty. */
int flash_image_read(struct flash_image *image, const char *path, char *error);

/* The same from memory. */
int flash_image_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error);

void flash_image_free(struct flash_image *image);

/* ---- private: flash_image.c, flash_uf2.c -------------------------------------------------------- */

/* Memory for `end` bytes from FLASH_BASE, erased. -1: there is not so much. */
int flash_image_make(struct flash_image *image, uint32_t end, char *error);

/* Puts n bytes at an offset from FLASH_BASE. */
void flash_image_put(struct flash_image *image, uint32_t offset, const uint8_t *bytes, uint32_t n);

/* Are these n bytes more likely blocks of UF2 than anything else? */
int flash_uf2_is(const uint8_t *bytes, size_t n);

int flash_uf2_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error);

/* Writes the line and returns -1. */
int flash_image_wrong(char *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
