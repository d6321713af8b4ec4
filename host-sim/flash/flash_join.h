/* flash_join: an image and a binary scene (scene_file.h) as one UF2 file, for the drive of the boot loader, or to be
 * written by flash_job. */
#ifndef FLASH_JOIN_H
#define FLASH_JOIN_H

#include "flash_image.h"

/* Returns the bytes of a UF2 file: the image's blocks, then those of the scene at FLASH_SCENE, where the image must
 * look for one. The scene is to lie 4-byte aligned in memory, and must end within flash_bytes from FLASH_BASE.
 * *joined_n: how many bytes; they are the caller's to free(). NULL with a line in error (FLASH_ERROR_SIZE bytes) if the
 * image or the scene is wrong, or does not fit. */
uint8_t *flash_join(const uint8_t *uf2, size_t n, const uint8_t *scene, size_t scene_n, uint32_t flash_bytes,
                    size_t *joined_n, char *error);

#endif
