/* See flash_usb.h. Sources: libusb 1.0 (synchronous transfers); the datasheets, see flash_boot.h. */
#define _POSIX_C_SOURCE 200809L
#include "flash_usb.h"

#include "complain.h"

#include <libusb-1.0/libusb.h>

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { VENDOR = 0x2E8A, RP2040 = 0x0003, RP2350 = 0x000F };
enum { INTERFACE_RESET = 0x41, COMMAND_STATUS = 0x42, TYPE_OUT = 0x41, TYPE_IN = 0xC1 };
enum { PACKET = 64, STATUS_BYTES = 16, LEAVES_MS = 1000, TICK_MS = 50 };

struct flash_usb {
    libusb_context *usb;
    libusb_device_handle *handle;
    uint8_t interface, in, out;
};

static int status_of(int error)
{
    switch (error) {
    case LIBUSB_ERROR_PIPE:
        return FLASH_STALL;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
        return HAL_ENODEV;
    case LIBUSB_ERROR_TIMEOUT:
        return HAL_ETIMEDOUT;
    case LIBUSB_ERROR_ACCESS:
        return HAL_EACCES;
    case LIBUSB_ERROR_BUSY:
        return HAL_EBUSY;
    default:
        return HAL_EIO;
    }
}

/* ---- who is there ------------------------------------------------------------------------------- */

static void read_serial(libusb_device *device, uint8_t index, struct flash_board *board)
{
    libusb_device_handle *handle = NULL;
    const int error = libusb_open(device, &handle);
    if (error < 0) {
        board->status = status_of(error);
        return;
    }
    const int n = libusb_get_string_descriptor_ascii(handle, index, (unsigned char *)board->serial,
                                                     (int)sizeof board->serial - 1);
    board->serial[n > 0 ? n : 0] = '\0';
    complain_clean(board->serial);
    libusb_close(handle);
}

static bool look_at(libusb_device *device, struct flash_board *board)
{
    struct libusb_device_descriptor d;
    if (libusb_get_device_descriptor(device, &d) < 0 || d.idVendor != VENDOR ||
        (d.idProduct != RP2040 && d.idProduct != RP2350)) {
        return false;
    }
    *board = (struct flash_board){.bus = libusb_get_bus_number(device),
                                  .address = libusb_get_device_address(device),
                                  .chip = d.idProduct == RP2350 ? FLASH_RP2350 : FLASH_RP2040};
    read_serial(device, d.iSerialNumber, board);
    return true;
}

int flash_usb_list(struct flash_board boards[FLASH_BOARDS_MAX])
{
    libusb_context *usb = NULL;
    libusb_device **devices = NULL;
    int count = 0;
    if (libusb_init(&usb) < 0) {
        return HAL_EIO;
    }
    const ssize_t n = libusb_get_device_list(usb, &devices);
    for (ssize_t i = 0; i < n && count < FLASH_BOARDS_MAX; i++) {
        count += look_at(devices[i], &boards[count]);
    }
    if (n >= 0) {
        libusb_free_device_list(devices, 1);
    }
    libusb_exit(usb);
    return n < 0 ? HAL_EIO : count;
}

/* ---- opening ------------------------------------------------------------------------------------ */

/* Finds the interface and its endpoints by class and direction, not by number. */
static bool find_endpoints(struct flash_usb *u, const struct libusb_config_descriptor *config)
{
    for (int i = 0; i < config->bNumInterfaces; i++) {
        const struct libusb_interface_descriptor *d = config->interface[i].altsetting;
        if (config->interface[i].num_altsetting < 1 || d->bInterfaceClass != LIBUSB_CLASS_VENDOR_SPEC ||
            d->bInterfaceSubClass != 0 || d->bInterfaceProtocol != 0) {
            continue;
        }
        u->interface = d->bInterfaceNumber;
        for (int j = 0; j < d->bNumEndpoints; j++) {
            const uint8_t endpoint = d->endpoint[j].bEndpointAddress;
            *((endpoint & LIBUSB_ENDPOINT_IN) != 0 ? &u->in : &u->out) = endpoint;
        }
        return u->in != 0 && u->out != 0;
    }
    return false;
}

static int claim(struct flash_usb *u, libusb_device *device)
{
    struct libusb_config_descriptor *config = NULL;
    int error = libusb_open(device, &u->handle);
    if (error == 0) {
        error = libusb_get_active_config_descriptor(device, &config);
    }
    if (error != 0) {
        return status_of(error);
    }
    const bool found = find_endpoints(u, config);
    libusb_free_config_descriptor(config);
    if (!found) {
        return HAL_EIO;
    }
    error = libusb_claim_interface(u->handle, u->interface);
    return error < 0 ? status_of(error) : 0;
}

static int open_board(struct flash_usb *u, const struct flash_board *board)
{
    libusb_device **devices = NULL;
    int status = HAL_ENODEV;
    if (libusb_init(&u->usb) < 0) {
        u->usb = NULL;
        return HAL_EIO;
    }
    const ssize_t n = libusb_get_device_list(u->usb, &devices);
    for (ssize_t i = 0; i < n; i++) {
        if (libusb_get_bus_number(devices[i]) == board->bus &&
            libusb_get_device_address(devices[i]) == board->address) {
            status = claim(u, devices[i]);
        }
    }
    if (n >= 0) {
        libusb_free_device_list(devices, 1);
    }
    return status;
}

int flash_usb_open(struct flash_usb **usb, const struct flash_board *board)
{
    *usb = calloc(1, sizeof **usb);
    if (*usb == NULL) {
        return HAL_EIO;
    }
    const int status = open_board(*usb, board);
    if (status < 0) {
        flash_usb_close(*usb);
        *usb = NULL;
    }
    return status;
}

void flash_usb_close(struct flash_usb *usb)
{
    if (usb == NULL) {
        return;
    }
    if (usb->handle != NULL) {
        libusb_close(usb->handle); /* this releases the interface, too */
    }
    if (usb->usb != NULL) {
        libusb_exit(usb->usb);
    }
    free(usb);
}

/* ---- transfers ---------------------------------------------------------------------------------- */

/* A board that was unplugged gives errors of all kinds until the kernel notices. */
static int fail(struct flash_usb *u, int error)
{
    uint8_t halted[2];
    if (error != LIBUSB_ERROR_IO && error != LIBUSB_ERROR_OTHER) {
        return status_of(error);
    }
    for (int ms = 0; ms < LEAVES_MS; ms += TICK_MS) {
        const struct timespec tick = {.tv_nsec = TICK_MS * 1000000L};
        if (libusb_control_transfer(u->handle, LIBUSB_ENDPOINT_IN | LIBUSB_RECIPIENT_ENDPOINT,
                                    LIBUSB_REQUEST_GET_STATUS, 0, u->out, halted, sizeof halted,
                                    TICK_MS) == LIBUSB_ERROR_NO_DEVICE) {
            return HAL_ENODEV;
        }
        nanosleep(&tick, NULL);
    }
    return HAL_EIO;
}

static int bulk(struct flash_usb *u, uint8_t endpoint, void *bytes, size_t n)
{
    int done = 0;
    const int error = libusb_bulk_transfer(u->handle, endpoint, bytes, (int)n, &done, FLASH_WAIT_MS);
    return error < 0 ? fail(u, error) : done;
}

static int send_bytes(void *context, const void *bytes, size_t n)
{
    struct flash_usb *u = context;
    uint8_t *copy = malloc(n + 1); /* libusb's buffers are not const */
    if (copy == NULL) {
        return HAL_EIO;
    }
    memcpy(copy, bytes, n);
    const int done = bulk(u, u->out, copy, n);
    free(copy);
    return done < 0 || (size_t)done == n ? done : HAL_EIO;
}

static int receive_bytes(void *context, void *bytes, size_t n)
{
    struct flash_usb *u = context;
    uint8_t packet[PACKET];
    const int done = n > 0 ? bulk(u, u->in, bytes, n) : bulk(u, u->in, packet, sizeof packet);
    return done < 0 || (size_t)done == n ? done : HAL_EIO;
}

static int command_status(void *context, uint8_t answer[STATUS_BYTES])
{
    struct flash_usb *u = context;
    const int done = libusb_control_transfer(u->handle, TYPE_IN, COMMAND_STATUS, 0, u->interface, answer, STATUS_BYTES,
                                             FLASH_WAIT_MS);
    return done < 0 ? fail(u, done) : 0;
}

/* Clears the endpoint on both sides, if it is halted. */
static void unhalt(struct flash_usb *u, uint8_t endpoint)
{
    uint8_t halted[2] = {0};
    const int done =
        libusb_control_transfer(u->handle, LIBUSB_ENDPOINT_IN | LIBUSB_RECIPIENT_ENDPOINT, LIBUSB_REQUEST_GET_STATUS, 0,
                                endpoint, halted, sizeof halted, FLASH_WAIT_MS);
    if (done == (int)sizeof halted && halted[0] != 0) {
        libusb_clear_halt(u->handle, endpoint);
    }
}

static int reset(void *context)
{
    struct flash_usb *u = context;
    unhalt(u, u->in);
    unhalt(u, u->out);
    const int done =
        libusb_control_transfer(u->handle, TYPE_OUT, INTERFACE_RESET, 0, u->interface, NULL, 0, FLASH_WAIT_MS);
    return done < 0 ? fail(u, done) : 0;
}

const struct flash_link_ops flash_usb_ops = {
    .out = send_bytes, .in = receive_bytes, .status = command_status, .reset = reset};
