/*
 * hal: what a display kit must be able to do: one SPI bus with its D/C line, a few pins, a clock, buttons.
 *
 * A backend is one const struct hal_ops and a context of its own; a kit is opened with a struct board (board.h).
 * Everything above (panel.h) talks to the kit only through the functions below.
 *
 * Status: 0 done, negative an error (Linux errno values), positive a count.
 */
#ifndef HAL_H
#define HAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum hal_status {
    HAL_OK = 0,
    HAL_EIO = -5,
    HAL_EACCES = -13,
    HAL_EBUSY = -16,
    HAL_ENODEV = -19,
    HAL_EINVAL = -22,
    HAL_ENOSYS = -38,
    HAL_ETIMEDOUT = -110,
};

struct board;

enum hal_dc { HAL_COMMAND, HAL_DATA };
enum hal_pin { HAL_PIN_RESET, HAL_PIN_BACKLIGHT };

/* Buttons, as bits of hal_buttons(). */
enum hal_button {
    HAL_BUTTON_UP = 1,
    HAL_BUTTON_DOWN = 2,
    HAL_BUTTON_LEFT = 4,
    HAL_BUTTON_RIGHT = 8,
    HAL_BUTTON_SELECT = 16,
};

#define HAL_COPIED 8 /* bytes, see bus_write */

struct hal_ops {
    const char *name;

    /*
     * Takes the kit's bus and pins: reset released, backlight off, bus idle. Chip select may rise between two
     * bus_write: every controller in panel.h goes on with the same transfer after it.
     */
    int (*open)(void *context, const struct board *board);

    /* Sets the bus clock to at most hz (> 0); returns the clock really set, in Hz, or HAL_EINVAL if none is that slow.
     */
    int32_t (*bus_clock)(void *context, uint32_t hz);

    /*
     * Starts to send n bytes with the D/C line at dc. Returns when it can; the buffer belongs to the backend until
     * bus_wait returns or the next bus_write has started (returned); see bus_queue. Order is kept; n = 0 does nothing.
     * D/C and CS do not move before the last bit is out.
     */
    int (*bus_write)(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n);

    /* Data only, as bus_write: `rows` times n bytes, each `stride` bytes further on. NULL: row by row with bus_write.
     */
    int (*bus_write_rows)(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows);

    /*
     * A queue; NULL, all three: it keeps none. bus_queue, only after bus_wait, turns it on or off (off after open).
     * While it is on a buffer belongs to the backend until bus_wait has returned, or bus_until with what bus_written
     * said after its bus_write; up to HAL_COPIED bytes are copied.
     */
    void (*bus_queue)(void *context, bool on);
    uint32_t (*bus_written)(void *context);            /* how far bus_write has come; wraps */
    int (*bus_until)(void *context, uint32_t written); /* waits until the bus has come so far */

    /* Waits until the last bit is out. */
    int (*bus_wait)(void *context);

    /* What a short bus_write takes besides its bits, ns, as far as is known yet; NULL: nothing to speak of. */
    uint32_t (*write_ns)(void *context);

    /* Sends one command byte and reads n bytes; HAL_ENOSYS where the kit has no MISO. NULL: this backend never asks. */
    int (*bus_read)(void *context, uint8_t command, uint8_t *bytes, size_t n);

    /* RESET true: high, the panel runs. BACKLIGHT true: lit. 0 also where the pin is not wired. */
    int (*pin_set)(void *context, enum hal_pin pin, bool level);

    /*
     * Waits for the next tearing-effect edge, at most timeout_us (then HAL_ETIMEDOUT); NULL, or HAL_ENOSYS, where no TE
     * line is wired.
     */
    int (*te_wait)(void *context, uint32_t timeout_us);

    uint32_t (*time_us)(void *context); /* wraps after 71 minutes */
    void (*delay_us)(void *context, uint32_t us);

    uint32_t (*buttons)(void *context); /* pressed now, enum hal_button */

    /* Panel is off already: backlight off, pins and bus released. */
    void (*close)(void *context);
};

/* An open kit. */
struct hal {
    const struct hal_ops *ops;
    void *context;
};

#endif
