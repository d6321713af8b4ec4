/* See flash_image.h. */
#include "flash_image.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int flash_image_wrong(char *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, FLASH_ERROR_SIZE, format, arguments);
    va_end(arguments);
    return PH_ERR_INVAL;
}

int flash_image_make(struct flash_image *image, uint32_t end, char *error)
{
    memset(image, 0, sizeof *image);
    image->sectors = (end + FLASH_SECTOR - 1) / FLASH_SECTOR;
    image->bytes = malloc((size_t)image->sectors * FLASH_SECTOR);
    image->used = calloc(image->sectors, 1);
    if (image->bytes == NULL || image->used == NULL) {
        flash_image_free(image);
        return flash_image_wrong(error, "not enough memory");
    }
    memset(image->bytes, 0xFF, (size_t)image->sectors * FLASH_SECTOR);
    return 0;
}

const char *flash_chip_name(enum flash_chip chip)
{
    static const char *const names[] = {[FLASH_ANY] = "RP2040 or RP2350", [FLASH_RP2040] = "RP2040", "RP2350"};
    return names[chip];
}

void flash_image_put(struct flash_image *image, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    memcpy(image->bytes + offset, bytes, n);
    memset(image->used + offset / FLASH_SECTOR, 1, (offset + n - 1) / FLASH_SECTOR - offset / FLASH_SECTOR + 1);
    image->size += n;
}

void flash_image_free(struct flash_image *image)
{
    free(image->bytes);
    free(image->used);
    memset(image, 0, sizeof *image);
}
