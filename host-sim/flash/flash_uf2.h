/* flash_uf2: UF2 files. Source: the UF2 specification (https://github.com/microsoft/uf2). */
#ifndef FLASH_UF2_H
#define FLASH_UF2_H

#include "flash_image.h"

enum { FLASH_UF2_BLOCK = 512, FLASH_UF2_HEADER = 32 }; /* bytes of a block, and of what is before its payload */

/* Whether these n bytes look like blocks of UF2. */
int flash_uf2_is(const uint8_t *bytes, size_t n);

/* Returns where the image's first block is: files for an RP2350 begin with a block against its erratum E10, which is
 * not of the image (picotool writes it). */
size_t flash_uf2_first(const uint8_t *bytes, size_t n);

/* Returns where the last block for the flash is, in a file that flash_uf2_parse takes. Other blocks may follow it. */
size_t flash_uf2_last(const uint8_t *bytes, size_t n);

/* Parses a UF2 file. 0, or a status with a line in error. */
int flash_uf2_parse(struct flash_image *image, const uint8_t *bytes, size_t n, char *error);

#endif
