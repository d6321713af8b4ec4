/*
 * flash_file: images from UF2 or BIN files. Nothing in a file is trusted: every block of a UF2 must be there once,
 * whole, for one chip, inside the flash, and without overlap. An image with bytes in the first sector of the flash must
 * have what its chip starts there: an RP2040 a boot2 with the right checksum, an RP2350 an image definition.
 *
 * Sources: RP2040 datasheet, sections 2.8.1.3.1 (checksum of boot2), 2.8.4.2 (UF2 blocks of 256 bytes); RP2350
 * datasheet, section 5.9.5 (image definition).
 */
#ifndef FLASH_FILE_H
#define FLASH_FILE_H

#include "flash_image.h"

/* Reads the file. 0, or a status with a line in error (FLASH_ERROR_SIZE bytes); the image is empty then. */
int flash_file_read(struct flash_image *image, const char *path, char *error);

/* Reads all bytes of a file, which are the caller's to free(). NULL with a line in error. */
uint8_t *flash_file_load(const char *path, size_t *n, char *error);

/* Reads a file that lies in memory. Returns as flash_file_read does. */
int flash_file_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error);

#endif
