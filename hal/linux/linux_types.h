/*
 * linux_types: an open kit, and what it holds of the bus, the lines and the buttons. Private to hal/linux but
 * for spi_path of struct linux_hal.
 */
#ifndef HAL_LINUX_TYPES_H
#define HAL_LINUX_TYPES_H

#include "hal.h"
#include "linux_look.h"

#include <pthread.h>

/* The bus; spi.h. */
struct linux_spi {
    char name[LINUX_PATH_SIZE]; /* the path that was opened */
    int descriptor;
    uint32_t clock_hz;
};

/* One line that was taken; gpio_lines.h. */
struct linux_line {
    void *chip, *request, *events; /* libgpiod's; request NULL: not wired */
    unsigned offset;
    bool active_low;
};

/* One button's contacts, debounced; debounce.h. */
struct linux_button {
    struct linux_line line;
    bool raw;         /* level at its last edge */
    bool held;        /* debounced */
    bool was_held;    /* pressed since the last look */
    uint64_t edge_ns; /* time of the last edge */
    uint64_t held_ns; /* time of the last change of held */
};

#define LINUX_MEASURED_BYTES 2048 /* a write of so many or more tells the clock */
#define LINUX_RUNS           64

/* Bytes in a row with the same D/C. Private; sender.c. */
struct linux_run {
    enum hal_dc dc;
    uint64_t end; /* position */
};

/* All members are private but spi_path. */
struct linux_hal {
    const char *spi_path; /* set before open; NULL: /dev/spidevBUS.SELECT of the board */

    const struct board *board;
    struct linux_spi spi;
    size_t bufsiz; /* spidev's limit on one message, bytes */
    struct linux_line dc, reset, backlight, tearing;
    struct linux_button buttons[BOARD_BUTTONS_MAX];
    int dc_now; /* enum hal_dc on the line; -1: not known */

    bool i2c; /* the bus is I2C, see i2c.h */
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

#endif
