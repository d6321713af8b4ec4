/* flash_scene: a binary scene (scene_file.h) as an image for the place where images for an RP2040 look for it. */
#ifndef FLASH_SCENE_H
#define FLASH_SCENE_H

#include "flash_image.h"

#define FLASH_SCENE 0x80000u /* from FLASH_BASE; PORT_SCENE of hal/rp2040/port.mk */

/* How an image says in its binary information that it looks for a scene at an address (hal/chips/rp2/binary_info.c). */
#define FLASH_SCENE_FEATURE "takes a scene at 0x%08x"

/* Reads the file, which must be right. 0, or a status with a line in error (FLASH_ERROR_SIZE bytes). */
int flash_scene_read(struct flash_image *image, const char *path, char *error);

#endif
