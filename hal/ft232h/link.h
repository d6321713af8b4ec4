/*
 * link: the USB side of an FT232H. It carries bytes to its engine in order, and bytes from it. usb/ does so with
 * libusb, nousb/ refuses. Private to hal/ft232h. Results: 0 or a status of hal.h, with its line in the error of
 * ft232h_link_open. Nothing waits for ever.
 */
#ifndef HAL_FT232H_LINK_H
#define HAL_FT232H_LINK_H

#include "fail.h"
#include "hal.h"

struct ft232h_usb; /* one link; usb/link.c */

/*
 * Finds the FT232H (serial: NULL for the only one), takes it from the kernel's serial driver and starts its MPSSE.
 * error must stay until ft232h_link_close.
 */
int ft232h_link_open(struct ft232h_usb **link, const char *serial, char *error);

/* Tells the clock from here on, for the time-outs. All answers asked for before must have been read. */
void ft232h_link_pace(struct ft232h_usb *link, uint32_t hz);

/* Copies bytes into the stream. Waits while two transfers are under way and a third is full. */
int ft232h_link_put(struct ft232h_usb *link, const uint8_t *bytes, size_t n);

/* Starts the transfer of the bytes that are left in the stream. */
int ft232h_link_flush(struct ft232h_usb *link);

/* Reads exactly n bytes of answers. */
int ft232h_link_get(struct ft232h_usb *link, uint8_t *bytes, size_t n);

/* Lets the pins float and gives the device back to the serial driver. NULL is allowed. */
void ft232h_link_close(struct ft232h_usb *link);

#endif
