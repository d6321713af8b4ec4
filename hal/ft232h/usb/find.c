/* See find.h. */
#include "find.h"

#include "ft232h/link.h"

#include <stdio.h>
#include <string.h>

enum { VENDOR = 0x0403, PRODUCT = 0x6014, MOST = 16 };

int ft232h_usb_status(int error)
{
    switch (error) {
    case LIBUSB_ERROR_ACCESS:
        return HAL_EACCES;
    case LIBUSB_ERROR_BUSY:
        return HAL_EBUSY;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
        return HAL_ENODEV;
    case LIBUSB_ERROR_TIMEOUT:
        return HAL_ETIMEDOUT;
    default:
        return HAL_EIO;
    }
}

static bool is_ft232h(libusb_device *device)
{
    struct libusb_device_descriptor descriptor;
    return libusb_get_device_descriptor(device, &descriptor) == 0 && descriptor.idVendor == VENDOR &&
           descriptor.idProduct == PRODUCT;
}

/* Reads numbers and serial of a device; returns its handle, or NULL when the status says why. */
static libusb_device_handle *look_at(libusb_device *device, struct ft232h_look *look)
{
    struct libusb_device_descriptor descriptor;
    libusb_device_handle *handle = NULL;
    memset(look, 0, sizeof *look);
    look->bus = libusb_get_bus_number(device);
    look->address = libusb_get_device_address(device);
    const int error = libusb_open(device, &handle);
    if (error < 0) {
        look->status = ft232h_usb_status(error);
        return NULL;
    }
    if (libusb_get_device_descriptor(device, &descriptor) == 0 && descriptor.iSerialNumber != 0) {
        libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber, (unsigned char *)look->serial,
                                           sizeof look->serial);
    }
    return handle;
}

/* All FT232Hs that were found. */
struct survey {
    int count;
    struct ft232h_look looks[MOST];
    libusb_device_handle *handle; /* of the first whose serial number matches */
};

static void survey(struct survey *all, libusb_device **devices, ssize_t n, const char *serial)
{
    memset(all, 0, sizeof *all);
    for (ssize_t i = 0; i < n && all->count < MOST; i++) {
        if (!is_ft232h(devices[i])) {
            continue;
        }
        struct ft232h_look *look = &all->looks[all->count++];
        libusb_device_handle *handle = look_at(devices[i], look);
        const bool matches = serial == NULL || strcmp(serial, look->serial) == 0;
        if (handle != NULL && matches && all->handle == NULL) {
            all->handle = handle;
        } else if (handle != NULL) {
            libusb_close(handle);
        }
    }
}

/* Writes the serial numbers for people: "A1, B2, no permission to read". */
static void name_all(const struct survey *all, char *text, size_t size)
{
    size_t n = 0;
    text[0] = 0;
    for (int i = 0; i < all->count && n < size; i++) {
        const struct ft232h_look *look = &all->looks[i];
        const char *serial = look->serial[0] != 0 ? look->serial : "no serial number";
        const int more = snprintf(text + n, size - n, "%s%s", i == 0 ? "" : ", ",
                                  look->status == HAL_EACCES ? "no permission to read" : serial);
        n += more > 0 ? (size_t)more : 0;
    }
}

static int refused(const struct ft232h_look *look, char *error)
{
    if (look->status == HAL_EACCES) {
        return ft232h_fail(error, look->status,
                           "FT232H (bus %u, address %u): no permission; copy boards/udev/60-pinhole.rules to "
                           "/etc/udev/rules.d and plug it in again",
                           look->bus, look->address);
    }
    return ft232h_fail(error, look->status, "FT232H (bus %u, address %u) cannot be opened; plug it in again", look->bus,
                       look->address);
}

static int choose(struct survey *all, const char *serial, char *error)
{
    char names[200];
    name_all(all, names, sizeof names);
    if (all->count == 0) {
        return ft232h_fail(error, HAL_ENODEV, "no FT232H (0403:6014) on USB; plug it in, lsusb lists what is there");
    }
    if (serial == NULL && all->count > 1) {
        return ft232h_fail(error, HAL_EINVAL, "%d FT232Hs on USB; say which by its serial number: %s", all->count,
                           names);
    }
    if (all->handle != NULL) {
        return HAL_OK;
    }
    for (int i = 0; i < all->count; i++) {
        if (all->looks[i].status < 0) { /* this may be the wanted one */
            return refused(&all->looks[i], error);
        }
    }
    return ft232h_fail(error, HAL_ENODEV, "no FT232H has the serial number %s; on USB: %s", serial, names);
}

int ft232h_usb_find(libusb_context *usb, const char *serial, libusb_device_handle **handle, char *error)
{
    struct survey all;
    libusb_device **devices = NULL;
    const ssize_t n = libusb_get_device_list(usb, &devices);
    if (n < 0) {
        return ft232h_fail(error, ft232h_usb_status((int)n), "USB devices cannot be listed: %s",
                           libusb_strerror((int)n));
    }
    survey(&all, devices, n, serial);
    libusb_free_device_list(devices, 1);
    const int status = choose(&all, serial, error);
    if (status < 0 && all.handle != NULL) {
        libusb_close(all.handle);
    }
    *handle = status < 0 ? NULL : all.handle;
    return status;
}

int ft232h_list(struct ft232h_look *looks, int max)
{
    struct survey all;
    libusb_context *usb = NULL;
    libusb_device **devices = NULL;
    int error = libusb_init(&usb);
    if (error < 0) {
        return ft232h_usb_status(error);
    }
    const ssize_t n = libusb_get_device_list(usb, &devices);
    survey(&all, devices, n, NULL);
    if (n >= 0) {
        libusb_free_device_list(devices, 1);
    }
    if (all.handle != NULL) {
        libusb_close(all.handle);
    }
    libusb_exit(usb);
    for (int i = 0; i < all.count && i < max; i++) {
        looks[i] = all.looks[i];
    }
    return n < 0 ? ft232h_usb_status((int)n) : all.count;
}
