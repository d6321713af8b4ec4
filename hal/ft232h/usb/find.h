/* find: the FT232Hs on USB, and what libusb's errors mean. Private to hal/ft232h/usb. */
#ifndef HAL_FT232H_FIND_H
#define HAL_FT232H_FIND_H

#include "ft232h/ft232h.h"

#include <libusb-1.0/libusb.h>

/* Converts libusb's error (< 0) to a status of hal.h. */
int ft232h_usb_status(int error);

/* Opens the FT232H of this serial number (NULL: the only one). */
int ft232h_usb_find(libusb_context *usb, const char *serial, libusb_device_handle **handle, char *error);

#endif
