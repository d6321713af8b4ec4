/*
 * ft232h: display kits on an FT232H. This USB chip has a serial engine (MPSSE) that shifts bytes and moves pins in the
 * order of one command stream, so changes of D/C travel with the pixels.
 *
 *   static struct ft232h context;                     all zeros; .serial may be set
 *   struct hal hal = {&ft232h_ops, &context};
 *   if (hal.ops->open(&context, board) < 0) { puts(ft232h_error(&context)); }
 *
 * Pins are named as on the chip: clock, data and data_in must be "AD0", "AD1" and "AD2" (or not be wired); all others
 * are any of "AD3" to "AD7" and "AC0" to "AC7", each once. Select falls before each write and rises after it. SPI modes
 * 0 and 3. The clock is 30 MHz / (1 + n), n = 0 .. 65535. No TE line: te_wait is NULL.
 *
 * bus_write copies bytes into USB transfers, two of which are under way at a time, and waits only while both are full.
 * Bytes may stay in the computer's memory until the next long write, bus_wait, pin_set, bus_read, delay_us or close.
 * The time-outs of all waits follow from the bytes and the clock, and are at least FT232H_WAIT_MS. After an error every
 * operation returns that error until the kit is closed.
 *
 * Without libusb (its folder is chosen when Pinhole is built) open returns HAL_ENOSYS.
 * Sources: FTDI AN_108 (MPSSE commands), AN_135 (MPSSE basics), DS_FT232H.
 */
#ifndef HAL_FT232H_H
#define HAL_FT232H_H

#include "board.h"
#include "fail.h"
#include "hal.h"

#define FT232H_SERIAL_SIZE 32
#define FT232H_WAIT_MS     1000
#define FT232H_FLUSH_BYTES 512 /* a shorter write waits for the next one, or for bus_wait */

struct ft232h_usb;

/* All members are private but serial. */
struct ft232h {
    const char *serial; /* set before open; NULL: the only FT232H on USB */

    const struct board *board;
    struct ft232h_usb *usb; /* NULL: not open */
    uint16_t levels;        /* of the pins: bits 0 .. 7 are AD0 .. AD7, bits 8 .. 15 are AC0 .. AC7 */
    uint16_t outputs;
    bool unfinished; /* something went into the stream since the last wait for its end */
    char error[FT232H_ERROR_SIZE];
};

/* bus_read returns HAL_ENOSYS where data_in is not wired. */
extern const struct hal_ops ft232h_ops;

/* One line on the last error: what happened, where, what to do. "" if there was none. */
const char *ft232h_error(const struct ft232h *h);

/* ---- for `pinhole-panel doctor` ------------------------------------------------------------------ */

struct ft232h_look {
    unsigned bus, address; /* as lsusb numbers them */
    char serial[FT232H_SERIAL_SIZE];
    int status; /* 0: may be opened; HAL_EACCES, .. */
};

/* Writes the FT232Hs of this computer, at most `max`; returns how many there are, or an error. */
int ft232h_list(struct ft232h_look *looks, int max);

/* Writes "1.0.26" to text and returns it; NULL: built without libusb. */
#define FT232H_VERSION_SIZE 24
const char *ft232h_libusb_version(char text[FT232H_VERSION_SIZE]);

#endif
