/*
 * flash_file: images from UF2 or BIN files. Nothing in a file is trusted: every block of a UF2 must be there once,
 * whole, for this chip, inside the flash, and without overlap. An image with bytes in the first page of the flash must
 * have a boot2 there with the right checksum, or the chip would not start it.
 *
 * Source: RP2040 datasheet, sections 2.8.1.3.1 (checksum of boot2), 2.8.4.2 (UF2 blocks of 256 bytes).
 */
#ifndef FLASH_FILE_H
#define FLASH_FILE_H

#include "flash_image.h"

/* Reads the file. 0, or a status with a line in error (FLASH_ERROR_SIZE bytes); the image is empty then. */
int flash_file_read(struct flash_image *image, const char *path, char *error);

/* The same from memory. */
int flash_file_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error);

#endif
