/* flash_pick: which of the boards on USB is meant. */
#ifndef FLASH_PICK_H
#define FLASH_PICK_H

#include "flash_usb.h"

/* Index of the board of this chip (FLASH_ANY: of any) with this serial number or BUS:ADDRESS (NULL: of the only one),
 * or a status with a line in error (FLASH_ERROR_SIZE). */
int flash_pick(const struct flash_board *boards, int count, enum flash_chip chip, const char *serial, char *error);

/* Why a board cannot be opened, and what to do. */
const char *flash_pick_why(int status);

#endif
