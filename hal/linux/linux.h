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
 * bus_write copies. A thread of the kit sends the copies and moves D/C, while the caller goes on; it joins and divides
 * what has the same D/C, so that transfers are as long as spidev takes (bufsiz). The next bus_write or bus_wait returns
 * the error of a write, once. One thread at a time may call the functions of a kit. Kits do not know of each other.
 *
 * Without libgpiod (its folder is chosen when Pinhole is built) a board with lines cannot be opened, and says so.
 */
#ifndef HAL_LINUX_H
#define HAL_LINUX_H

#include "board.h"
#include "hal.h"

#include <pthread.h>

#define LINUX_ERROR_SIZE 384
#define LINUX_PATH_SIZE  64

/* One line that was taken. Private; gpio_lines.h. */
struct linux_line {
    void *chip, *request, *events; /* libgpiod's; request NULL: not wired */
    unsigned offset;
    bool active_low;
};

/* One button's contacts, debounced. Private; debounce.h. */
struct linux_button {
    struct linux_line line;
    bool raw;         /* level at its last edge */
    bool held;        /* debounced */
    bool was_held;    /* pressed since the last look */
    uint64_t edge_ns; /* time of the last edge */
    uint64_t held_ns; /* time of the last change of held */
};

#define LINUX_RUNS 64

/* Bytes in a row with the same D/C. Private; sender.c. */
struct linux_run {
    enum hal_dc dc;
    uint64_t end; /* position */
};

/* All members are private but spi_path. */
struct linux_hal {
    const char *spi_path; /* set before open; NULL: /dev/spidevBUS.SELECT of the board */

    const struct board *board;
    char spi_name[LINUX_PATH_SIZE]; /* the path that was opened */
    int spi;                        /* descriptor */
    uint32_t clock_hz;
    size_t bufsiz;
    struct linux_line dc, reset, backlight, tearing;
    struct linux_button buttons[BOARD_BUTTONS_MAX];
    int dc_now; /* enum hal_dc on the line; -1: not known */

    bool opened, threaded;
    pthread_t thread;
    pthread_mutex_t mutex; /* of the members below */
    pthread_cond_t changed;
    bool quit;
    int status; /* first error since it was last returned */
    struct linux_run runs[LINUX_RUNS];
    uint32_t run_got, run_put;       /* the run that is sent; one past the last */
    uint64_t sent, flushed, written; /* positions, sender.c */
    uint8_t *ring;
    size_t ring_bytes, most;      /* most: the longest message */
    uint64_t best_bytes, best_ns; /* the fastest large write at this clock */
    uint32_t write_ns;            /* what a short write and its D/C take beside its bits, a mean; 0: none yet */

    char error[LINUX_ERROR_SIZE];
};

/* bus_read and te_wait return HAL_ENOSYS where data_in or tearing is not wired. */
extern const struct hal_ops linux_ops;

/* One line on the last error: what happened, where, what to do. "" if there was none. */
const char *linux_hal_error(const struct linux_hal *h);

#define LINUX_MEASURED_BYTES 2048

/*
 * The bits per second of the fastest large write since bus_clock, with the kernel's time for it. The clock on the wire,
 * which spidev does not tell, is at least this, and at most what was asked for. 0: none was sent, or no clock is set.
 * Call it while the bus is idle (after bus_wait).
 */
uint32_t linux_hal_bits_per_second(const struct linux_hal *h);

/* ---- for `pinhole-panel doctor`: looks, takes nothing -------------------------------------------- */

/* spidev's limit on one message, bytes; 0: there is no spidev. */
size_t linux_spi_bufsiz(void);

struct linux_spi_look {
    char path[LINUX_PATH_SIZE];
    uint32_t asked_hz, got_hz; /* got: what spidev keeps, as asked; the controller's clock may be less */
};

/*
 * Opens the board's SPI device (or path, if not NULL), sets mode and clock as linux_ops would, and closes it. Returns
 * 0, or the error that open would return, with its line in error.
 */
int linux_spi_look(const struct board *board, const char *path, struct linux_spi_look *look,
                   char error[LINUX_ERROR_SIZE]);

struct linux_line_look {
    char chip[LINUX_PATH_SIZE]; /* "/dev/gpiochip0" */
    char label[32], name[32];   /* as the kernel says */
    unsigned offset;
    bool taken;
    char holder[32]; /* if taken: the consumer's name, "" if it gave none */
};

/* Finds the line of a wired pin of the board. Returns 0, or the error that open would return, with its line in error.
 */
int linux_line_look(const struct board *board, const struct board_pin *pin, struct linux_line_look *look,
                    char error[LINUX_ERROR_SIZE]);

/* "1.6.3"; NULL: built without libgpiod. */
const char *linux_gpiod_version(void);

#endif
