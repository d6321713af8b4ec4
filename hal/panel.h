/*
 * panel: display controllers as data, and the one driver for all of them.
 *
 *   panel_open(d, hal, config)      reset, slow initialisation, full speed; the display is still dark
 *   panel_frame_begin(d)            window and memory write, once a frame
 *   panel_rows(d, pixels, lines)    the picture from its top, any number of lines at a time
 *   panel_frame_end(d)              waits for the last bit; after the FIRST frame display and backlight go on
 *   panel_window(d, x, y, w, h)     a part of the picture, where panel_frame_begin takes all of it; see panel_diff.h
 *   panel_close(d)                  display and backlight off, sleep
 *
 * Pixels come in as RGB565 in wire order: the byte with red is first in memory, and rows have d->width pixels. RGB565
 * is sent straight from there. Other formats are converted piece by piece in the caller's scratch memory. The picture
 * does not depend on how many lines come at a time.
 *
 *   RGB565   2 bytes a pixel    RRRRRGGG GGGBBBBB
 *   RGB666   3 bytes a pixel    RRRRRR00 GGGGGG00 BBBBBB00   5 bits r become 6 as (r << 1) | (r >> 4)
 *   RGB444   3 bytes 2 pixels   RRRRGGGG BBBBrrrr ggggbbbb   the highest 4 bits; a pair may lie in two lines
 *   GREY4    1 byte 2 pixels    the left pixel is in the high bits; each line starts a byte. See panel_grey4().
 *   MONO_..  1 byte 8 pixels    one above the other on the glass, the highest in bit 0; a memory LCD: side by side, the
 *                               left one in bit 7. See panel_mono().
 *
 * Rotation is the number of degrees (0, 90, 180, 270) by which the picture is turned clockwise on the glass, against
 * the controller's own upright. With 90 the top of the picture lies along the right edge of the glass, and the user
 * turns the kit a quarter counter-clockwise.
 *
 * All state is in the caller's struct, so any number of panels can be open at a time.
 */
#ifndef PANEL_H
#define PANEL_H

#include "hal.h"

/* What a pixel is on the wire: see above. */
enum panel_format {
    PANEL_RGB565,
    PANEL_RGB666,
    PANEL_RGB444,
    PANEL_GREY4,
    PANEL_MONO_DITHER,    /* one bit a pixel: greys are patterns of dots */
    PANEL_MONO_THRESHOLD, /* one bit a pixel: what is brighter than half is lit */
    PANEL_FORMATS
};
/* By how much the picture is turned. */
enum panel_rotation { PANEL_R0, PANEL_R90, PANEL_R180, PANEL_R270 }; /* degrees / 90 */

#define PANEL_FORMAT_BIT(format) (1U << (format)) /* for `formats` of struct panel */

struct panel_driver;

/* What the driver calls where a panel is a memory LCD: see panel/panel_line.h. Status: 0, or an error. */
struct panel_line_ops {
    /* Divides the scratch memory. HAL_EINVAL: it is too small. */
    int (*line_init)(struct panel_driver *d);

    /* Makes all pixels white. */
    int (*line_clear)(struct panel_driver *d);

    /* Converts line d->row of the window, whose first pixel is *pixels. What is complete is sent. */
    int (*line_pack)(struct panel_driver *d, const uint8_t *pixels);

    /* Ends the message, or sends one that only toggles VCOM; then the bus is idle. */
    int (*line_end)(struct panel_driver *d);
};

/* A controller's command set, with the names and numbers of its datasheet. */
struct panel_controller {
    const char *name;       /* as printed on the datasheet: "ST7789" */
    uint32_t init_hz;       /* clock for reset and initialisation */
    uint32_t write_hz;      /* datasheet's limit for writes, from its serial timing table */
    uint32_t reset_low_us;  /* reset pulse */
    uint32_t reset_high_us; /* from the end of the pulse to the first command */

    uint8_t set_column, set_row; /* window commands */
    uint8_t memory_write;        /* 0: pixels need no command before them */
    uint8_t address_bytes;       /* of one window border: 2, or 1 */
    uint8_t
        column_pixels; /* pixels of a row of the glass in one column address, which is one byte: 1, or 2 (SSD0323) */
    bool parameters_are_commands; /* parameters go out with D/C low */

    /* Between bus and controller is a shift register of 16 bits: each byte of a command or of its parameters goes out
     * behind a byte 00h, and a pixel has 16 bits. */
    bool words;

    /*
     * Not 0: the memory consists of pages, which are 8 rows of the glass. A page is addressed by set_page | page and by
     * the column's low and high four bits in commands 00h and 10h. There are no windows. set_rotation | MX and
     * set_scan | MY mirror columns and rows; the bits are rotation_bit_mx and rotation_bit_my.
     */
    uint8_t set_page, set_scan;

    /* Not NULL, &panel_line_ops: a memory LCD. It has neither commands nor windows, but messages; see panel_line.h. */
    const struct panel_line_ops *lines;

    bool window_turns; /* the window's axes turn with the picture (MADCTL MV); else they stay those of the glass */

    uint8_t set_rotation;         /* MADCTL or the remap command */
    uint8_t rotation_bit_mx;      /* the bit in it that mirrors columns */
    uint8_t rotation_bit_my;      /* ... that mirrors rows */
    uint8_t rotation_bit_mv;      /* ... that makes the address run along columns first */
    uint8_t rotation_bit_mx_pair; /* further bits to set together with mx (SSD0323: nibbles) */
    uint8_t rotation_bit_bgr;     /* ... that makes red and blue change places; 0: there is one colour */
    uint8_t invert[2];            /* commands without parameters: not inverted, inverted */

    uint8_t set_format;      /* COLMOD; 0: there is one format only */
    uint8_t format_value[3]; /* its parameter by enum panel_format; only colours have a choice */

    const uint8_t *on, *off; /* sequences as panel.init: display on; display off and sleep */
    uint16_t on_bytes, off_bytes;
};

/*
 * A glass with its controller. x0, y0: the glass's place in the controller's memory when no axis is mirrored. Where the
 * memory consists of pages, width, height and y0 are multiples of 8.
 * Sequences are the bytes of Linux' panel-mipi-dbi firmware: command, count, parameters; 00h 01h n waits n ms.
 */
struct panel {
    const char *name; /* "st7789-240x240" */
    const struct panel_controller *controller;
    uint16_t width, height; /* glass, upright, pixels */
    uint16_t ram_width, ram_height;
    uint16_t x0, y0;
    uint8_t rotation_base; /* rotation byte of PANEL_R0: mirrored glasses and BGR; the rotation's bits are XORed in */
    uint8_t formats;       /* the PANEL_FORMAT_BIT()s of what this glass accepts over SPI */
    bool round;            /* the glass is the inscribed circle */
    const uint8_t *init;
    uint16_t init_bytes;
};

/* The panels of panels.h. */
extern const struct panel *const panel_list[];
extern const uint32_t panel_count;

/* Finds a panel by its name. NULL: there is none. */
const struct panel *panel_find(const char *name);

/* The start of the window for a rotation, in the controller's addresses, and the rotation byte. */
struct panel_place {
    uint16_t column, row;
    uint8_t rotation_byte; /* without format bits */
};

/*
 * Finds where a panel lies in its controller's memory: cx = MX ? ram_width - width - x0 : x0, and cy with MY in the
 * same way, swapped where the window turns (MV). rotation: enum panel_rotation.
 */
struct panel_place panel_place(const struct panel *panel, unsigned rotation);

/* Whether the picture can be turned so. A memory LCD takes whole lines of its glass: by 0 and 180 degrees only. */
bool panel_can_turn(const struct panel *panel, unsigned rotation);

/* Size of the picture. */
uint16_t panel_width(const struct panel *panel, unsigned rotation);
uint16_t panel_height(const struct panel *panel, unsigned rotation);

/* Bytes of one whole frame on the wire, commands included. */
uint32_t panel_frame_bytes(const struct panel *panel, unsigned format, unsigned rotation);

/* The time that these bytes take at hz (> 0), in us, rounded up; UINT32_MAX if it is longer. */
uint32_t panel_frame_us(const struct panel *panel, unsigned format, unsigned rotation, uint32_t hz);

/* The luma 0 .. 255 of a colour that is two bytes, high first: (77 R + 150 G + 29 B) / 256, with channels of 8 bits
 * that repeat their highest ones. */
uint32_t panel_luma(uint8_t high, uint8_t low);

/*
 * The grey level 0 .. 15 of the picture's pixel (x, y), whose colour is two bytes, high first. Its luma is dithered
 * with the 4x4 Bayer matrix. Black is 0, white 15.
 */
uint8_t panel_grey4(uint8_t high, uint8_t low, uint32_t x, uint32_t y);

/*
 * Whether the picture's pixel (x, y) is lit on a glass of one bit. MONO_DITHER compares the square of its luma, which
 * is the share of lit dots that looks as bright, with a matrix of 8x8 blue noise. The matrix is tied to the picture, so
 * a still picture stays still. MONO_THRESHOLD compares the luma with a half. Black is never lit, white always.
 */
bool panel_mono(unsigned format, uint8_t high, uint8_t low, uint32_t x, uint32_t y);

#define PANEL_SCRATCH_MIN 256 /* bytes; more makes fewer, longer writes. Pages: also 2 * the picture's width */

/* What panel_open() is told. */
struct panel_config {
    const struct panel *panel;
    uint8_t rotation;  /* enum panel_rotation */
    uint8_t format;    /* enum panel_format */
    uint32_t clock_hz; /* full speed, as asked for */
    uint8_t *scratch;  /* PANEL_SCRATCH_MIN or more; may be NULL for PANEL_RGB565. The driver's until panel_close */
    size_t scratch_bytes;
};

/* The driver's state. Read-only for the caller: width, height, clock_hz. Holds no pointer into itself. */
struct panel_driver {
    struct hal hal;
    struct panel_config config;
    uint16_t width, height; /* of the picture */
    int32_t clock_hz;       /* full speed, as the backend set it */
    uint16_t x, span;       /* first column and width of the window */
    uint16_t row, bottom;   /* next line; the line below the window */
    bool in_frame;          /* a window is open */
    uint8_t commands[3][2]; /* of a window, behind a 00h each: set_column, set_row, memory_write */
    uint8_t column_sent[8]; /* parameters that were sent last, or are still on the wire */
    uint8_t row_sent[8];
    uint32_t frame_bytes; /* on the wire since panel_frame_begin, or since the caller set it to 0 */
    bool lit;             /* display and backlight are on */
    uint8_t share_x;      /* log2 of the pixels that share a byte: side by side in the picture; one above the other */
    uint8_t share_y;
    uint8_t lead;        /* GREY4: 1 if the first four bits of the first byte lie beside the glass */
    uint8_t half;        /* the half of scratch that is filled next */
    uint32_t half_bytes; /* size of each half */
    uint32_t filled;     /* bytes in it */
    uint8_t carry;       /* 4 bits that wait for the other half of their byte */
    bool carry_full;
    bool in_message; /* memory LCD: a message has begun and has no end yet */
    uint8_t vcom;    /* ... the polarity that the last message told */
};

/*
 * Wakes the panel of an open kit: hardware reset, initialisation at the controller's slow clock, then config->clock_hz.
 * The display stays dark until the first frame is complete.
 * Errors: HAL_EINVAL (the panel lacks the format or the turn, scratch is missing or too small, no clock), or the
 * backend's.
 */
int panel_open(struct panel_driver *d, const struct hal *hal, const struct panel_config *config);

/* Sets another full speed of at most hz between two frames; d->clock_hz is the real one. 0, or the backend's error. */
int panel_clock(struct panel_driver *d, uint32_t hz);

/* Begins a frame: see above. 0, or the backend's error. */
int panel_frame_begin(struct panel_driver *d);

/*
 * Sends the next `lines` lines. The pixels belong to the driver until the next panel_rows, panel_wait or
 * panel_frame_end returns (longer if the backend keeps a queue, see hal.h). So one of two bands can be drawn while the
 * other is sent. Errors: HAL_EINVAL outside of a frame or for more lines than the frame has; then nothing is sent.
 */
int panel_rows(struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

/* Begins a frame that consists of windows. The borders of the first one are always sent. End it with panel_wait(). */
void panel_windows_begin(struct panel_driver *d);

/*
 * Opens a window in the picture, given in its pixels; the lines that follow belong to the window. Borders that the
 * controller still has from the last window are not sent again.
 * Pixels that share a byte (GREY4: columns 2n and 2n + 1 of the glass; one bit: the rows of a page, and all of a memory
 * LCD's line) must all be inside or all be outside. Errors: HAL_EINVAL outside of the picture, empty, or in the middle
 * of a byte; or the backend's.
 */
int panel_window(struct panel_driver *d, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/*
 * Sends the window's next lines out of a picture in memory, from its pixel *pixels on. `stride` is the pixels from a
 * line to the next (>= the window's width). The pixels belong to the driver as with panel_rows.
 */
int panel_window_rows(struct panel_driver *d, const uint16_t *pixels, uint32_t stride, uint32_t lines);

#define PANEL_PAGE_BYTES    3 /* of the commands that address a page */
#define PANEL_LINE_BYTES    2 /* memory LCD: of a line's address and trailer */
#define PANEL_MESSAGE_BYTES 3 /* ... of a message's mode, of the trailer at its end, and of the byte behind it */

/* Bytes of a border (command and parameters); bytes of the memory write command, 0 if there is none. */
uint32_t panel_border_bytes(const struct panel_controller *c);
uint32_t panel_start_bytes(const struct panel_controller *c);

/* Waits until the bus is idle; then every buffer belongs to the caller again. A memory LCD's message ends with it. */
int panel_wait(struct panel_driver *d);

/*
 * Keeps a picture that stands still. Who sends no frame for a second calls it twice a second: a memory LCD whose VCOM
 * is not toggled that often is spoilt. Other panels need nothing.
 */
int panel_hold(struct panel_driver *d);

/* Ends the frame. HAL_EINVAL: lines are missing, and the display is not turned on. */
int panel_frame_end(struct panel_driver *d);

/* Turns backlight and display off and puts the panel to sleep. The kit stays open until its backend's close. */
int panel_close(struct panel_driver *d);

/* ---- how frames are sent ---------------------------------------------------------------------------
 * Chosen once when a panel is opened: whole (panel_sender_whole), as differences from a copy of the last picture
 * (panel_diff_sender), or as tiles that changed (panel_tiles_sender).
 */

/* Status: 0, or an error as of the driver's functions. The next frame may begin after an error. */
struct panel_sender_ops {
    bool copies; /* the pixels are the caller's again when rows returns; else as with panel_rows */
    bool skips;  /* rows may send nothing: only a backend's queue (hal.h) then says when a buffer is free */

    /* begin, rows and end replace panel_frame_begin, panel_rows and panel_frame_end. */
    int (*begin)(void *context, struct panel_driver *d);
    int (*rows)(void *context, struct panel_driver *d, const uint16_t *pixels, uint32_t lines);
    int (*end)(void *context, struct panel_driver *d);

    /* Tells that another scene begins: the next frame is better sent whole. NULL: that makes no difference. */
    void (*forget)(void *context);
};

/* How frames are sent, and its state. */
struct panel_sender {
    const struct panel_sender_ops *ops;
    void *context;
};

/* Sends each frame whole. */
extern const struct panel_sender panel_sender_whole;

#endif
