/*
 * hal: what a display kit must be able to do: one SPI bus with its D/C line, a few pins, a clock, buttons. In the place
 * of SPI there may be I2C (board->i2c_address): each bus_write is then one or more messages, whose control byte, 00h
 * for commands and 40h for data, tells what D/C would.
 *
 * A backend is a const struct hal_ops and a context of its own. A kit is opened with a struct board (board.h).
 * Everything above (panel.h) uses the kit only through the functions below.
 *
 * Status: 0 done, negative an error (Linux errno values), positive a count.
 */
#ifndef HAL_H
#define HAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Errors of operations, with the numbers of errno on Linux. */
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

/*
 * Where a function runs from. An image with tiers (-DCODE_TIERS) finds it in a section .tier.TIER.*, of which the
 * port's linker script gathers what the image has RAM for. Elsewhere the macro is nothing. Tiers of hal: interrupt what
 * an interrupt runs while flash may be late or busy: RAM in every image loop       for each word, tile or piece of work
 *   bus        for each write to the bus
 */
#ifdef CODE_TIERS
#define HAL_TIER(tier)            HAL_TIER_SECTION(tier, __COUNTER__)
#define HAL_TIER_SECTION(tier, n) HAL_TIER_NAMED(tier, n)
#define HAL_TIER_NAMED(tier, n)   __attribute__((section(".tier." #tier "." #n)))
#else
#define HAL_TIER(tier)
#endif

struct board;

/* The D/C line: low for a command, high for data; while the bus rests it stays as it is. A memory LCD has SCS there. */
enum hal_dc { HAL_COMMAND, HAL_DATA };
/* Pins that pin_set() drives. */
enum hal_pin { HAL_PIN_RESET, HAL_PIN_BACKLIGHT };

/* Buttons, as bits of what buttons() below returns. */
enum hal_button {
    HAL_BUTTON_UP = 1,
    HAL_BUTTON_DOWN = 2,
    HAL_BUTTON_LEFT = 4,
    HAL_BUTTON_RIGHT = 8,
    HAL_BUTTON_SELECT = 16,
};

#define HAL_COPIED 8 /* bytes that bus_write copies, see bus_queue */

/* The operations of a kit. */
struct hal_ops {
    const char *name;

    /*
     * Takes the kit's bus and pins: reset released, backlight off, bus idle. Chip select may rise between two calls of
     * bus_write, because every controller in panel.h continues the same transfer after that.
     */
    int (*open)(void *context, const struct board *board);

    /* Sets the bus clock to at most hz (> 0). Returns the clock really set, Hz, or HAL_EINVAL if none is that slow. */
    int32_t (*bus_clock)(void *context, uint32_t hz);

    /*
     * Starts to send n bytes with the D/C line at dc, and need not wait for the end. The buffer belongs to the backend
     * until bus_wait or the next bus_write has returned; see also bus_queue. Order is kept; n = 0 does nothing. D/C and
     * CS do not move before the last bit is out.
     */
    int (*bus_write)(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n);

    /* Writes data as bus_write does: `rows` times n bytes, each `stride` bytes after the last. NULL: use bus_write for
     * each. */
    int (*bus_write_rows)(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows);

    /*
     * A queue of writes. NULL, all three: the backend keeps none. bus_queue turns it on or off, only after bus_wait; it
     * is off after open. While it is on, a buffer belongs to the backend until bus_wait has returned, or bus_until with
     * the value of bus_written after its bus_write. Up to HAL_COPIED bytes are copied instead.
     */
    void (*bus_queue)(void *context, bool on);
    uint32_t (*bus_written)(void *context);            /* how far bus_write has come; wraps */
    int (*bus_until)(void *context, uint32_t written); /* waits until the bus has come so far */

    /*
     * Sends what bus_write keeps back, and does not wait; so do bus_wait and a write with another D/C. With it
     * bus_write copies, and may keep bytes back to make its transfers as long as it can. NULL: bus_write keeps nothing
     * back.
     */
    void (*bus_flush)(void *context);

    /* Waits until the last bit is out. */
    int (*bus_wait)(void *context);

    /* The time that a short bus_write takes besides its bits, ns, by the last ones; 0: not known yet. NULL: next to
     * none. */
    uint32_t (*write_ns)(void *context);

    /* Sends a command byte and reads n bytes; HAL_ENOSYS if the kit has no MISO. NULL: this backend cannot read. */
    int (*bus_read)(void *context, uint8_t command, uint8_t *bytes, size_t n);

    /* RESET true: high, the panel runs. BACKLIGHT true: lit. 0 also if the pin is not wired. */
    int (*pin_set)(void *context, enum hal_pin pin, bool level);

    /* Waits for the next tearing-effect edge, up to timeout_us (then HAL_ETIMEDOUT). NULL, HAL_ENOSYS: no TE line. */
    int (*te_wait)(void *context, uint32_t timeout_us);

    uint32_t (*time_us)(void *context); /* wraps after 71 minutes */
    void (*delay_us)(void *context, uint32_t us);

    uint32_t (*buttons)(void *context); /* pressed now, enum hal_button */

    /* Turns the backlight off and releases pins and bus. The panel is off already. */
    void (*close)(void *context);
};

/* An open kit. */
struct hal {
    const struct hal_ops *ops;
    void *context;
};

#endif
