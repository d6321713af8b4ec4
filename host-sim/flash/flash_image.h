/*
 * flash_image: the content of the flash of an RP2040 or RP2350. Sources: RP2040 datasheet, section 2.6.3, RP2350
 * datasheet, section 4.4 (flash at 10000000h; here the first 16 MB of it).
 */
#ifndef FLASH_IMAGE_H
#define FLASH_IMAGE_H

#include "status.h"

#include <stddef.h>
#include <stdint.h>

#define FLASH_BASE       0x10000000u
#define FLASH_SPAN       0x01000000u /* bytes that the chip can address */
#define FLASH_SECTOR     4096u       /* is erased as a whole */
#define FLASH_PAGE       256u        /* is written as a whole */
#define FLASH_ERROR_SIZE 256

enum flash_chip { FLASH_ANY, FLASH_RP2040, FLASH_RP2350 };

struct flash_image {
    enum flash_chip chip; /* FLASH_ANY: data without a program */
    uint32_t sectors;     /* from FLASH_BASE up to the last one that the image uses */
    uint8_t *bytes;       /* of all these sectors; FFh where the image has none */
    uint8_t *used;        /* a sector each: 1 if the image has bytes in it */
    uint32_t size;        /* bytes of the image itself */
};

/* Returns "RP2040", "RP2350", or "RP2040 or RP2350". */
const char *flash_chip_name(enum flash_chip chip);

/* Makes an erased image of `end` bytes from FLASH_BASE. 0, or a status with a line in error. */
int flash_image_make(struct flash_image *image, uint32_t end, char *error);

/* Puts n bytes at an offset from FLASH_BASE. */
void flash_image_put(struct flash_image *image, uint32_t offset, const uint8_t *bytes, uint32_t n);

void flash_image_free(struct flash_image *image);

/* Writes the line (FLASH_ERROR_SIZE bytes) and returns PH_ERR_INVAL. */
int flash_image_wrong(char *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
