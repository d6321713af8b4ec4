/* See flash_usb.h. Built without libusb. */
#include "flash_usb.h"

#include <stddef.h>

const struct flash_link_ops flash_usb_ops = {NULL, NULL, NULL, NULL};

int flash_usb_list(struct flash_board boards[FLASH_BOARDS_MAX])
{
    boards[0] = (struct flash_board){.status = HAL_ENOSYS};
    return HAL_ENOSYS;
}

int flash_usb_open(struct flash_usb **usb, const struct flash_board *board)
{
    (void)board;
    *usb = NULL;
    return HAL_ENOSYS;
}

void flash_usb_close(struct flash_usb *usb)
{
    (void)usb;
}
