/*
 * Plugs a USB device into this machine (the guest: vhci-hcd must be loaded) and is that device until it is killed.
 *
 *   usb ft232h  [--serial TEXT] [--events FILE] [--flash FILE] [--wire-time] [FAULT]
 *   usb bootsel [--serial TEXT] --flash FILE [--flash-bytes N] [--product HEX] [--stall-once] [FAULT]
 *
 * --events FILE  what the FT232H's pins do (host-sim/wire/wire_events.h); --flash FILE: a W25X10 of 131072 bytes at
 * AD3, or the RP2040's flash, kept in that file (2 MB by default). --wire-time: transfers take the time of their bits.
 * --product: 3 by default; f is an RP2350. --stall-once: each command is refused when it comes for the first time (to
 * that sector of the flash). --ready FILE is made as soon as the kernel has configured the device.
 * FAULT, when so many bytes of bulk data have come from the host: --unplug-after N, --stall-after N (every transfer
 * stalls), --hang-after N (no transfer ends), --short-after N (half of each transfer is taken).
 */
#include "usb.h"

#include <stdlib.h>
#include <string.h>

struct request {
    bool bootsel;
    const char *ready;
    struct usb_fault fault;
    struct ft232h_options ft232h;
    struct bootsel_options boot;
};

static bool set_fault(struct request *r, const char *option, const char *value)
{
    static const char *const names[] = {"", "--unplug-after", "--stall-after", "--hang-after", "--short-after"};
    for (unsigned i = 1; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(option, names[i]) == 0) {
            r->fault = (struct usb_fault){(enum usb_fault_kind)i, strtoull(value, NULL, 10)};
            return true;
        }
    }
    return false;
}

static bool set_events(struct request *r, const char *path)
{
    r->ft232h.events = fopen(path, "w");
    return r->ft232h.events != NULL;
}

static bool set_option(struct request *r, const char *option, const char *value)
{
    if (strcmp(option, "--serial") == 0) {
        r->ft232h.serial = r->boot.serial = value;
    } else if (strcmp(option, "--flash") == 0) {
        r->ft232h.flash = r->boot.flash = value;
    } else if (strcmp(option, "--flash-bytes") == 0) {
        r->boot.flash_bytes = (uint32_t)strtoul(value, NULL, 10);
    } else if (strcmp(option, "--product") == 0) {
        r->boot.product = (uint16_t)strtoul(value, NULL, 16);
    } else if (strcmp(option, "--ready") == 0) {
        r->ready = value;
    } else if (strcmp(option, "--events") == 0) {
        return set_events(r, value);
    } else {
        return set_fault(r, option, value);
    }
    return true;
}

static bool read_arguments(struct request *r, int argc, char *argv[])
{
    if (argc < 2 || (strcmp(argv[1], "ft232h") != 0 && strcmp(argv[1], "bootsel") != 0)) {
        return false;
    }
    r->bootsel = strcmp(argv[1], "bootsel") == 0;
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--wire-time") == 0) {
            r->ft232h.wire_time = true;
        } else if (strcmp(argv[i], "--stall-once") == 0) {
            r->boot.stall_once = true;
        } else if (i + 1 == argc || !set_option(r, argv[i], argv[i + 1])) {
            return false;
        } else {
            i++;
        }
    }
    return !r->bootsel || r->boot.flash != NULL;
}

int main(int argc, char *argv[])
{
    struct request r = {.ft232h = {.serial = "FT000001"},
                        .boot = {.flash_bytes = 2u << 20, .product = 3, .serial = "E0C9125B0D9B"}};
    if (!read_arguments(&r, argc, argv)) {
        fprintf(stderr, "usb: wrong arguments; usage is in the head of tests/guest/usb_main.c\n");
        return 2;
    }
    struct usb_device *device = r.bootsel ? bootsel_new(&r.boot) : ft232h_new(&r.ft232h);
    const int status = device == NULL ? -1 : usb_run(device, r.fault, r.ready);
    if (r.ft232h.events != NULL) {
        fclose(r.ft232h.events);
    }
    return status == 0 ? 0 : 1;
}
