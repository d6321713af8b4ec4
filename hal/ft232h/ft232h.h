/*
 * ft232h: display kits on an FT232H, a USB chip with a serial engine (MPSSE) that shifts bytes and moves pins in the
 * order of one command stream: D/C changes travel with the pixels.
 *
 *   static struct ft232h context;                     all zeros; .serial may be set
 *   struct hal hal = {&ft232h_ops, &context};
 *   if (hal.ops->open(&context, board) < 0) { puts(ft232h_error(&context)); }
 *
 * Pins are named as on the chip: clock, data and data_in must be "AD0", "AD1" and "AD2" (or not be wired); all others
 * are any of "AD3" to "AD7" and "AC0" to "AC7". Select falls before each write and rises after it. SPI modes 0 and 3.
 * The clock is 30 MHz / (1 + n), n = 0 .. 65535. No TE line: te_wait is NULL.
 *
 * Bytes are copied into USB transfers, two of which are under way at a time; bus_write waits only while both are full.
 * What was written may stay in the machine's memory until the next long write, bus_wait, pin_set, bus_read, delay_us
 * or close; the time-outs of all waits follow from the bytes and the clock, at least FT232H_WAIT_MS. After an error the
 * kit answers it again until it is closed.
 *
 * Without libusb (its folder is chosen when Pinhole is built) open returns HAL_ENOSYS.
 * Sources: FTDI AN_108 (MPSSE commands), AN_135 (MPSSE basics), DS_FT232H.
 */
#ifndef HAL_FT232H_H
#define HAL_FT232H_H

#include "board.h"
#include "hal.h"

#define FT232H_ERROR_SIZE  384
#define FT232H_SERIAL_SIZE 32
#define FT232H_WAIT_MS     1000
#define FT232H_FLUSH_BYTES 512 /* shorter writes wait for the next, or for bus_wait */

struct ft232h_usb;

/* Private but serial. */
struct ft232h {
    const char *serial; /* set before open; NULL: the only one there is */

    const struct board *board;
    struct ft232h_usb *usb; /* NULL: not open */
    uint16_t levels;        /* of the pins: bits 0 .. 7 are AD0 .. AD7, 8 .. 15 AC0 .. AC7 */
    uint16_t outputs;
    bool unfinished; /* something went into the stream since its end was last waited for */
    char error[FT232H_ERROR_SIZE];
};

/* bus_read returns HAL_ENOSYS where data_in is not wired. */
extern const struct hal_ops ft232h_ops;

/* One line on the last error: what, where, what to do. "" if there was none. */
const char *ft232h_error(const struct ft232h *h);

/* ---- for `pinhole-panel doctor` ------------------------------------------------------------------ */

struct ft232h_look {
    unsigned bus, address; /* as lsusb numbers them */
    char serial[FT232H_SERIAL_SIZE];
    int status; /* 0: may be opened; HAL_EACCES, .. */
};

/* The FT232Hs of this machine, at most `max` of them are written; returns how many there are, or an error. */
int ft232h_list(struct ft232h_look *looks, int max);

/* "1.0.26", written to text; NULL: built without libusb. */
#define FT232H_VERSION_SIZE 24
const char *ft232h_libusb_version(char text[FT232H_VERSION_SIZE]);

#endif
