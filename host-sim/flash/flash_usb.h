/*
 * flash_usb: RP2040s and RP2350s in their boot loader, on USB. usb/ uses libusb; nousb/ refuses. Results are 0 or more,
 * or a status as in flash_boot.h.
 */
#ifndef FLASH_USB_H
#define FLASH_USB_H

#include "flash_boot.h"
#include "flash_image.h"

#include <stdint.h>

#define FLASH_BOARDS_MAX 32

struct flash_board {
    uint8_t bus, address; /* as lsusb shows them */
    enum flash_chip chip;
    int status;      /* 0, or why it cannot be opened; there is no serial number then */
    char serial[64]; /* without control characters */
};

/* Lists the boards; returns how many, at most FLASH_BOARDS_MAX. */
int flash_usb_list(struct flash_board boards[FLASH_BOARDS_MAX]);

/* Claims the board's PICOBOOT interface. */
struct flash_usb;
int flash_usb_open(struct flash_usb **usb, const struct flash_board *board);

/* Closes a device; NULL is fine. */
void flash_usb_close(struct flash_usb *usb);

/* Operations on a link by USB; their context is a struct flash_usb. */
extern const struct flash_link_ops flash_usb_ops;

#endif
