/* See link.h. Built without libusb. */
#include "ft232h/ft232h.h"
#include "ft232h/link.h"

int ft232h_link_open(struct ft232h_usb **link, const char *serial, char *error)
{
    (void)serial;
    *link = NULL;
    return ft232h_fail(error, HAL_ENOSYS, "FT232H: built without libusb; install libusb-1.0-0-dev and make again");
}

void ft232h_link_pace(struct ft232h_usb *link, uint32_t hz)
{
    (void)link;
    (void)hz;
}

int ft232h_link_put(struct ft232h_usb *link, const uint8_t *bytes, size_t n)
{
    (void)link;
    (void)bytes;
    (void)n;
    return HAL_ENOSYS;
}

int ft232h_link_flush(struct ft232h_usb *link)
{
    (void)link;
    return HAL_ENOSYS;
}

int ft232h_link_get(struct ft232h_usb *link, uint8_t *bytes, size_t n)
{
    (void)link;
    if (n > 0) {
        bytes[0] = 0;
    }
    return HAL_ENOSYS;
}

void ft232h_link_close(struct ft232h_usb *link)
{
    (void)link;
}

int ft232h_list(struct ft232h_look *looks, int max)
{
    if (max > 0) {
        looks[0] = (struct ft232h_look){.status = HAL_ENOSYS};
    }
    return HAL_ENOSYS;
}

const char *ft232h_libusb_version(char text[FT232H_VERSION_SIZE])
{
    text[0] = 0;
    return NULL;
}
