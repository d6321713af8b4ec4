/*
 * sim_model: the inside of the simulator, for this folder only. A model takes bytes with their D/C line, the reset line
 * and the clock, and says what a place of the glass shows.
 */
#ifndef SIM_MODEL_H
#define SIM_MODEL_H

#include "board.h"
#include "hal.h"
#include "sim_types.h"

struct sim;
struct sim_command;

struct sim_model {
    const char *controller;
    bool pages;                     /* a frame consists of several memory writes, with commands between them */
    uint32_t write_hz;              /* datasheet's limit */
    uint32_t i2c_hz;                /* ... on an I2C bus; 0: it has none */
    bool mode_0;                    /* it takes SPI mode 0 alone; others take 0 and 3 */
    uint32_t select_lead_ns;        /* memory LCD: tsSCS, from the rise of SCS to the clock's first edge */
    uint32_t select_lag_ns;         /* ... thSCS, from the clock's last edge to the fall of SCS */
    uint32_t reset_pulse_ns;        /* shortest */
    uint32_t reset_wait_ns;         /* from its end to the first byte */
    void (*reset)(struct sim *sim); /* registers as after power-on */
    void (*byte)(struct sim *sim, enum hal_dc dc, uint8_t byte);
    void (*rest)(struct sim *sim); /* is told that time has passed without a byte; NULL: that makes no difference */
    bool (*shows)(const struct sim *sim);                                        /* is anything to be seen? */
    void (*look)(const struct sim *sim, uint32_t x, uint32_t y, uint8_t rgb[3]); /* glass, upright */
    bool (*written)(const struct sim *sim, uint32_t x, uint32_t y);              /* since the last reset? */
};

extern const struct sim_model sim_model_st7789, sim_model_gc9a01, sim_model_ili9341, sim_model_ili9488,
    sim_model_st7796, sim_model_hx8357d, sim_model_ili9486, sim_model_st7735s, sim_model_ssd1351, sim_model_ssd0323,
    sim_model_ssd1306, sim_model_ssd1309, sim_model_sh1106, sim_model_sh1107, sim_model_ls013b7dh03,
    sim_model_ls027b7dh01;

/* A glass: how it is bonded to its controller and which way its colours are. */
struct sim_glass {
    const char *panel; /* name in the board's panel */
    const struct sim_model *model;
    uint16_t width, height;
    uint16_t ram_width, ram_height;
    uint16_t left, top; /* memory address of the first column and row that are bonded */
    bool mirrored;      /* first column at the right */
    bool bgr;           /* colour filter starts with blue */
    bool complement;    /* IPS: shows a stored value's complement until it is inverted */
    bool round;
    bool backlit;
    bool in_order; /* one bit: COM lines are bonded in their order, not at alternating sides */
};

/* Finds the glass of a panel. NULL: there is none. */
const struct sim_glass *sim_glass_find(const struct panel *panel, struct sim_glass *made);

struct sim_cell {
    uint8_t r, g, b;
    uint8_t written;
};

/* The state of a MIPI DBI controller. */
struct sim_dbi {
    const struct sim_command *command; /* being received; NULL: none */
    uint8_t code;
    bool refused; /* a parameter of it; then it has no effect */
    uint32_t parameter_count;
    uint8_t parameters[SIM_PARAMETERS_MAX];
    bool sleeping, on, inverted;
    uint8_t madctl, format;
    bool low_byte_first; /* ST7789 RAMCTRL */
    uint8_t epf;         /* ST7789 RAMCTRL, ST7796S EM: where the lowest bit of red and blue comes from */
    uint8_t lcm;         /* ST7789 LCMCTRL, HX8357D SETPANEL: what it turns over against the way a glass is bonded */
    uint8_t scan;        /* GS 40h, SS 20h of the display function control; ST7789: GS of GATECTRL; HX8357D: SETPANEL */
    bool black;          /* ILI9341 DISCTRL: driven as if the liquid crystal were normally black */
    uint16_t lines;      /* that are driven */
    uint8_t unlock;      /* GC9A01: bit 0 after FEh, both after FEh EFh. ST7796S: parts I and II of command table 2;
                            HX8357D: both after B9h */
    bool half_word;      /* ILI9486: the shift register has 8 of its 16 bits */
    uint8_t high_byte;   /* ... these */
    enum hal_dc high_dc; /* ... with this D/C */
    uint16_t x0, x1, y0, y1;
    uint16_t x, y;
    uint32_t left;   /* pixels until the window is full */
    bool complained; /* in this memory write */
    uint32_t bits;   /* of a pixel that is not complete */
    uint32_t bit_count;
    uint64_t ready_ns; /* earliest next command */
    uint64_t wake_ns;  /* earliest SLPOUT */
    uint64_t nap_ns;   /* earliest SLPIN and SWRESET */
};

/* The state of a controller of Solomon Systech. */
struct sim_ssd {
    const struct sim_command *command; /* being received, or taking pixels; NULL: none */
    bool refused;                      /* it has no effect */
    uint32_t parameter_count;
    uint8_t parameters[8];
    bool on, locked, extra_unlocked;
    uint8_t mode; /* A4h .. A7h */
    uint8_t remap, start, offset, mux;
    uint8_t contrast[3]; /* red, green, blue */
    uint8_t x0, x1, y0, y1, x, y;
    uint32_t left;
    bool complained;
    uint32_t bits, bit_count;
};

/* The state of a controller of one bit a pixel, whose memory consists of pages. */
struct sim_page {
    const struct sim_command *command; /* the last one */
    bool parameter_wanted;
    bool refused; /* it is locked, and its parameter has no effect */
    bool on, powered, locked;
    bool remap, from_last; /* columns, COM lines from the last one */
    bool inverse;
    uint8_t mode; /* A4h, A5h */
    uint8_t com_pins, mux, start, offset;
    uint8_t page, column; /* of the next byte */
};

#define SIM_LINE_BYTES_MAX 50 /* of a line's pixels */

/* The state of a memory LCD. */
struct sim_line {
    bool listening; /* SCS is high */
    bool refused;   /* the rest of the message has no effect */
    bool ended;     /* both bytes behind the last line have come */
    bool vcom;      /* the polarity that the last message told */
    bool still;     /* it was complained of */
    uint8_t mode;
    uint8_t line;                       /* being received, or waiting for its trailer; 0: none */
    uint32_t taken;                     /* bytes of the line: address, pixels, trailer */
    uint8_t pixels[SIM_LINE_BYTES_MAX]; /* the latch */
    uint64_t toggled_ns;
    uint64_t last_ns; /* end of the message's last byte */
};

enum sim_i2c_byte { SIM_I2C_ADDRESS, SIM_I2C_CONTROL, SIM_I2C_BYTE, SIM_I2C_STOP };

/* A message on an I2C bus. */
struct sim_i2c {
    enum sim_i2c_byte expects;
    enum hal_dc dc;
    bool continued; /* another control byte follows the next byte */
};

struct sim {
    const struct board *board;
    struct sim_glass glass;
    struct sim_cell *memory;
    union {
        struct sim_dbi dbi;
        struct sim_ssd ssd;
        struct sim_page page;
        struct sim_line line;
    } u;

    uint64_t time_ns;
    uint64_t bus_rest; /* of a ns, in units of 1 / clock */
    struct sim_counters counters;
    bool reset_low, backlight, reset_done;
    uint64_t reset_fell_ns, reset_ready_ns;
    uint32_t buttons;

    struct sim_i2c i2c;
    uint8_t shift; /* bits of a byte that is not complete */
    uint8_t shift_count;
    enum hal_dc shift_dc;
    bool clock_checked;

    enum sim_fault fault;
    uint32_t fault_n;

    uint32_t complaint_count;
    uint32_t complaint_count_of[SIM_COMPLAINT_KINDS];
    char complaints[SIM_COMPLAINTS_KEPT][160];
    char note[120];
};

__attribute__((format(printf, 3, 4))) void sim_complain(struct sim *sim, enum sim_complaint_kind kind,
                                                        const char *format, ...);

/* Gives the controller a byte, after the checks of clock and reset. */
void sim_take_byte(struct sim *sim, enum hal_dc dc, uint8_t byte);

/* A message begins; one of its bytes arrives. Returns whether the controller acknowledges it. */
void sim_i2c_start(struct sim *sim);
bool sim_i2c_byte(struct sim *sim, uint8_t byte);

/* Has every place of the glass been written to since the last reset? */
bool sim_frame_complete(const struct sim *sim);

#endif
