/* flash_program: where the program in a board's flash ends, as it says in its binary information (`picotool info`
 * shows it, too; hal/rp2040/binary_info.c writes it). Format: pico-sdk, pico_binary_info/structure.h. */
#ifndef FLASH_PROGRAM_H
#define FLASH_PROGRAM_H

#include "flash_boot.h"

/* Reads the address behind the program; 0: none that says so. A status as in flash_boot.h. */
int flash_program_end(struct flash_boot *boot, uint32_t *end);

#endif
