/*
 * usb: USB devices that are programs. The kernel's vhci_hcd (USB/IP) takes one end of a socket for a device on a port;
 * whatever is at the other end is the device: every descriptor and every byte its own. See usb_main.c.
 */
#ifndef USB_H
#define USB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* What in() and out() may return besides a count and a negative errno (-EPIPE: stall). */
enum { USB_WAIT = -1000, USB_UNPLUG = -1001 };

struct usb_device {
    unsigned speed;                 /* as vhci counts: 2 full, 3 high */
    const uint8_t *device, *config; /* descriptors; config's own length is in it */
    const char *strings[4];         /* 1 .. 3 */
    bool leaves;                    /* set by the device: it unplugs itself */
    void *context;
    /* Class and vendor requests. n: bytes of data that came, or room for the answer. Bytes of the answer, or -EPIPE. */
    int (*control)(void *context, const uint8_t setup[8], uint8_t *data, int n);
    /* Bulk data from the host: bytes taken (fewer is a short transfer). USB_WAIT: never answered, until it is
     * cancelled. */
    int (*out)(void *context, unsigned endpoint, const uint8_t *data, int n);
    /* Gives bytes to the host, who has waited so long; returns their count. USB_WAIT: nothing yet. */
    int (*in)(void *context, unsigned endpoint, uint8_t *data, int room, unsigned waited_ms);
    /* CLEAR_FEATURE(ENDPOINT_HALT), address with direction; may be NULL. */
    void (*unhalt)(void *context, unsigned endpoint);
};

/* ---- faults, the same for all devices ----------------------------------------------------------- */

enum usb_fault_kind { USB_FAULT_NONE, USB_FAULT_UNPLUG, USB_FAULT_STALL, USB_FAULT_HANG, USB_FAULT_SHORT };

struct usb_fault {
    enum usb_fault_kind kind;
    uint64_t after; /* bytes of bulk data from the host */
};

/* Plugs the device in and serves it until it is unplugged or SIGTERM comes. ready: a file to make once the kernel has
 * configured it, or NULL. 0, or -1 when a line has said why not. */
int usb_run(struct usb_device *device, struct usb_fault fault, const char *ready);

uint64_t usb_now_ns(void);

/* ---- the devices -------------------------------------------------------------------------------- */

struct ft232h_options {
    FILE *events;      /* NULL: none */
    const char *flash; /* picture of a flash chip at AD3, or NULL */
    bool wire_time;    /* take the time that the bits take */
    const char *serial;
};

struct usb_device *ft232h_new(const struct ft232h_options *options);

struct bootsel_options {
    const char *flash; /* file that holds the flash; made (erased) when missing */
    uint32_t flash_bytes;
    uint16_t product; /* 0003: RP2040 */
    const char *serial;
    bool stall_once; /* each command, when it comes for the first time (to that sector) */
};

struct usb_device *bootsel_new(const struct bootsel_options *options);

#endif
