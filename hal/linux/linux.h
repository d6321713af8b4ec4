/*
 * linux: display kits on single-board computers: pixels through spidev, all other lines through libgpiod.
 *
 *   static struct linux_hal context;                  all zeros; .spi_path may be set
 *   struct hal hal = {&linux_ops, &context};
 *   if (hal.ops->open(&context, board) < 0) { puts(linux_hal_error(&context)); }
 *
 * The board is one of boards/, or one that the caller makes at run time; it must stay while the kit is open. The
 * kernel's SPI driver moves clock, data and select. D/C, reset, backlight, TE and buttons are lines with names such as
 *
 *   "GPIO25"            a line that the kernel calls so, on any chip
 *   "gpiochip0:25"      line 25 of /dev/gpiochip0 (or "/dev/gpiochip0:25")
 *   "pinctrl-rp1:25"    line 25 of the chip with this label
 *
 * Where the kernel gives lines no names, "GPIOn" is line n of the first chip with a label in board->gpio_labels.
 * A pin without a name (BOARD_PIN) is refused: chips are numbered differently from one kernel to the next.
 *
 * A thread of the kit sends writes of more than LINUX_INLINE_BYTES while the caller goes on; the sender also moves D/C.
 * The next bus_write or bus_wait returns the error of such a write, once. One thread at a time may call the functions
 * of a kit. Kits do not know of each other.
 *
 * Without libgpiod (its folder is chosen when Pinhole is built) a board with lines cannot be opened, and says so.
 * linux_look.h looks at SPI and lines without taking them.
 */
#ifndef HAL_LINUX_H
#define HAL_LINUX_H

#include "hal.h"
#include "linux_look.h"
#include "linux_types.h"

#include <pthread.h>

#define LINUX_INLINE_BYTES 64 /* they are sent sooner than a thread wakes up */

/* All members are private but spi_path. */
struct linux_hal {
    const char *spi_path; /* set before open; NULL: /dev/spidevBUS.SELECT of the board */

    const struct board *board;
    struct linux_spi spi;
    size_t bufsiz; /* spidev's limit on one message, bytes */
    struct linux_line dc, reset, backlight, tearing;
    struct linux_button buttons[BOARD_BUTTONS_MAX];
    int dc_now; /* enum hal_dc on the line; -1: not known */

    bool opened, threaded;
    pthread_t thread;
    pthread_mutex_t mutex; /* of the members below */
    pthread_cond_t changed;
    bool quit, busy;
    enum hal_dc job_dc;
    const uint8_t *job_bytes;
    size_t job_size;
    int job_status;      /* first error since it was last returned */
    uint64_t sent_bytes; /* in writes of LINUX_MEASURED_BYTES or more */
    uint64_t sent_ns;    /* the time that these took */
    uint64_t write_ns;   /* the least that a short write and its D/C took beside its bits; UINT64_MAX: none yet */

    char error[LINUX_ERROR_SIZE];
};

/* bus_read and te_wait return HAL_ENOSYS where data_in or tearing is not wired. */
extern const struct hal_ops linux_ops;

/* One line on the last error: what happened, where, what to do. "" if there was none. */
const char *linux_hal_error(const struct linux_hal *h);

#define LINUX_MEASURED_BYTES 2048

/*
 * The bits per second of all large writes so far, with the kernel's pauses. This is a lower bound of the clock on the
 * wire, which spidev does not tell. 0: none were sent. Call it while no write is under way (after bus_wait).
 */
uint32_t linux_hal_bits_per_second(const struct linux_hal *h);

#endif
