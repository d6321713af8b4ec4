/* flash_program: which program is in a board's flash, as it says in its binary information (`picotool info` shows it,
 * too; hal/chips/rp2/binary_info.c writes it). Format: pico-sdk, pico_binary_info/structure.h. */
#ifndef FLASH_PROGRAM_H
#define FLASH_PROGRAM_H

#include "flash_boot.h"
#include "flash_image.h"

#define FLASH_PROGRAM_NAME 40

struct flash_program {
    bool is_erased;                /* there is none: the flash begins with erased bytes */
    bool takes_scene;              /* at FLASH_SCENE */
    uint32_t end;                  /* the address behind it; 0: it does not say */
    char name[FLASH_PROGRAM_NAME]; /* printable, shortened if need be; "": it does not say */
};

/* Reads which program is in the flash. Returns a status as in flash_boot.h. */
int flash_program_read(struct flash_boot *boot, struct flash_program *program);

/* Finds which program an image has. */
void flash_program_find(const struct flash_image *image, struct flash_program *program);

#endif
