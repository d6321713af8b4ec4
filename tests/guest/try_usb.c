/*
 * Talks to a USB device through libusb, a line an action, so that a script can try the devices of usb_main.c:
 *
 *   try_usb VID:PID list                       serial numbers of those that are there
 *   try_usb VID:PID SERIAL ACTION...           opens it, detaches a kernel driver, claims interface 0 (and 1), then
 *     in:EP:N                                  bulk in, prints the bytes in hexadecimal
 *     out:EP:HEX | fill:EP:N                   bulk out of these bytes, of N zeros; prints how many were taken
 *     ask:TYPE:REQUEST:VALUE:INDEX:N           control in
 *     tell:TYPE:REQUEST:VALUE:INDEX            control out without data
 *     clear:EP                                 clears a halted endpoint
 * Numbers as in C (0x84, 64). An error is printed by its name and is the end (exit 1).
 */
#include <libusb-1.0/libusb.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TIMEOUT_MS 3000

static uint8_t bytes[1 << 20];

static int report(const char *what, int status)
{
    printf("%s %s\n", what, libusb_error_name(status));
    return status;
}

static int print_bytes(const char *what, int n)
{
    printf("%s ", what);
    for (int i = 0; i < n; i++) {
        printf("%02x", bytes[i]);
    }
    printf("\n");
    return 0;
}

static int read_hex(const char *text)
{
    int n = 0;
    for (; text[0] != '\0' && text[1] != '\0' && n < (int)sizeof bytes; text += 2) {
        const char pair[3] = {text[0], text[1], '\0'};
        bytes[n++] = (uint8_t)strtoul(pair, NULL, 16);
    }
    return n;
}

/* The numbers between colons; how many there are. *rest: what follows the first. */
static int read_numbers(const char *text, unsigned number[5], const char **rest)
{
    int n = 0;
    for (; text != NULL && n < 5; n++) {
        number[n] = (unsigned)strtoul(text, NULL, 0);
        text = strchr(text, ':');
        text = text != NULL ? text + 1 : NULL;
        *rest = n == 0 ? text : *rest;
    }
    return n;
}

static int bulk(libusb_device_handle *device, const char *what, unsigned endpoint, int n)
{
    int done = 0;
    const int status = libusb_bulk_transfer(device, (unsigned char)endpoint, bytes, n, &done, TIMEOUT_MS);
    if (status != 0) {
        return report(what, status);
    }
    if ((endpoint & 0x80) != 0) {
        return print_bytes(what, done);
    }
    printf("%s %d\n", what, done);
    return 0;
}

static int control(libusb_device_handle *device, const char *what, const unsigned number[5])
{
    const int n = libusb_control_transfer(device, (uint8_t)number[0], (uint8_t)number[1], (uint16_t)number[2],
                                          (uint16_t)number[3], bytes, (uint16_t)number[4], TIMEOUT_MS);
    return n < 0 ? report(what, n) : print_bytes(what, (number[0] & 0x80) != 0 ? n : 0);
}

static int act(libusb_device_handle *device, const char *action)
{
    unsigned number[5] = {0};
    const char *colon = strchr(action, ':'), *rest = NULL;
    const int words = colon == NULL ? 0 : read_numbers(colon + 1, number, &rest);
    if (strncmp(action, "in:", 3) == 0 && words == 2 && number[1] <= sizeof bytes) {
        return bulk(device, "in", number[0], (int)number[1]);
    }
    if (strncmp(action, "fill:", 5) == 0 && words == 2 && number[1] <= sizeof bytes) {
        memset(bytes, 0, number[1]);
        return bulk(device, "fill", number[0], (int)number[1]);
    }
    if (strncmp(action, "out:", 4) == 0 && words == 2) {
        return bulk(device, "out", number[0], read_hex(rest));
    }
    if (strncmp(action, "clear:", 6) == 0) {
        const int status = libusb_clear_halt(device, (unsigned char)number[0]);
        return status == 0 ? 0 : report("clear", status);
    }
    if (words >= 4) {
        return control(device, strncmp(action, "ask:", 4) == 0 ? "ask" : "tell", number);
    }
    return report(action, LIBUSB_ERROR_INVALID_PARAM);
}

static int run(libusb_device_handle *device, char *actions[])
{
    libusb_set_auto_detach_kernel_driver(device, 1);
    int status = libusb_claim_interface(device, 0);
    libusb_claim_interface(device, 1); /* where there is one */
    for (; status == 0 && *actions != NULL; actions++) {
        status = act(device, *actions);
    }
    return status;
}

/* The serial number of a device, if it is one of those that are looked for. */
static bool is_one(libusb_device *device, unsigned vendor, unsigned product, libusb_device_handle **open,
                   char serial[64])
{
    struct libusb_device_descriptor d;
    if (libusb_get_device_descriptor(device, &d) != 0 || d.idVendor != vendor || d.idProduct != product ||
        libusb_open(device, open) != 0) {
        return false;
    }
    libusb_get_string_descriptor_ascii(*open, d.iSerialNumber, (unsigned char *)serial, 64);
    return true;
}

int main(int argc, char *argv[])
{
    libusb_device **list = NULL;
    if (argc < 3 || strlen(argv[1]) != 9 || libusb_init(NULL) != 0) {
        return 2;
    }
    const unsigned vendor = (unsigned)strtoul(argv[1], NULL, 16), product = (unsigned)strtoul(argv[1] + 5, NULL, 16);
    int status = LIBUSB_ERROR_NOT_FOUND;
    const ssize_t count = libusb_get_device_list(NULL, &list);
    for (ssize_t i = 0; i < count; i++) {
        char serial[64] = "";
        libusb_device_handle *device = NULL;
        if (!is_one(list[i], vendor, product, &device, serial)) {
            continue;
        }
        if (strcmp(argv[2], "list") == 0) {
            puts(serial);
            status = 0;
        } else if (strcmp(argv[2], serial) == 0) {
            status = run(device, argv + 3);
        }
        libusb_close(device);
    }
    libusb_free_device_list(list, 1);
    libusb_exit(NULL);
    return status == 0 ? 0 : 1;
}
