/*
 * board: a kit as const data, each in a folder of boards/: its panel, its wiring, and how users hold it.
 *
 * Pins have the names of the kit's own documents. If the chip numbers its pins, that is a number: GP17 is 17, and a pin
 * of STM32 and the like is port * 32 + pin with port A = 0. If an operating system or a header names them, it is the
 * line's name: "GPIO25", "AD3".
 */
#ifndef BOARD_H
#define BOARD_H

#include "panel.h"

/* A pin of a board, by its number or by the name of its line. */
struct board_pin {
    bool wired;
    bool active_low;
    uint16_t number;
    const char *line; /* NULL: number counts */
};

/* clang-format off */
/* A struct board_pin: GPIO n of a chip, a line of Linux by its name; _LOW: active low. */
#define BOARD_PIN(n)      { true, false, (n), NULL }
#define BOARD_PIN_LOW(n)  { true, true, (n), NULL } /* active low */
#define BOARD_LINE(s)     { true, false, 0, (s) }
#define BOARD_LINE_LOW(s) { true, true, 0, (s) }
/* clang-format on */
/* The number of pin n of a port: BOARD_PORT('B', 5) is PB5 of an STM32. */
#define BOARD_PORT(port, n) ((uint16_t)(((port) - 'A') * 32 + (n)))

/* A button and the pin that it is on. */
struct board_button {
    uint8_t button; /* enum hal_button */
    struct board_pin pin;
};

#define BOARD_BUTTONS_MAX 6 /* of one board */

/* What makes the bus clock, see chips/spi_clock.h. ANY: unknown, or every clock that is asked for. */
enum board_spi_unit { BOARD_SPI_ANY, BOARD_SPI_RP2, BOARD_SPI_LM3S6965, BOARD_SPI_STM32F4 };

/*
 * How the flash is read that an RP2040 or RP2350 runs from. AUTOMATIC: the fastest read that the flash tells of. HALF:
 * at half that clock, for a board whose wires or flash do not take it (pico-sdk's PICO_FLASH_SPI_CLKDIV 4). SERIAL:
 * command 03h on one line, for a flash that is not what it tells.
 */
enum board_flash { BOARD_FLASH_AUTOMATIC, BOARD_FLASH_HALF, BOARD_FLASH_SERIAL };

/*
 * An unwired pin is all zeros: leave it out. active_low inverts what hal.h calls true. A chip select is active low. A
 * reset line is not marked so: the panel runs while it is high, and hal.h calls that true.
 */
struct board_pins {
    struct board_pin clock, data, data_in, select, dc, reset, backlight, tearing;
};

/* A kit as data: display, wires, memory. */
struct board {
    const char *name;   /* what --board takes */
    const char *title;  /* one line for people */
    const char *pinout; /* address of the public page with the wiring */
    const struct panel *panel;
    uint8_t rotation;    /* enum panel_rotation: as users hold the kit */
    uint8_t format;      /* enum panel_format on the wire */
    uint8_t spi_unit;    /* enum board_spi_unit */
    uint8_t spi_mode;    /* 0; 3 for modules without chip select */
    uint8_t spi_bus;     /* number of the SPI unit, or of /dev/spidevN; of /dev/i2c-N */
    uint8_t i2c_address; /* not 0: the bus is I2C, and the panel has this address, of 7 bits. There is no D/C line: a
                            control byte at the start of each message tells it. spi_hz is the clock */
    uint8_t spi_select;  /* /dev/spidev.N */
    const char *gpio_labels; /* Linux: labels of the chips, separated by spaces, whose line n is "GPIOn" where lines
                                have no names; or NULL */
    uint32_t spi_hz;         /* full speed: what the kit's maker or its usual driver sets */
    bool over_limit;         /* spi_hz is above the datasheet's write limit (panel->controller->write_hz) on purpose */
    struct board_pins pins;
    uint8_t flash;            /* enum board_flash */
    uint8_t crystal_start_ms; /* RP2040, RP2350: how long the crystal takes to start; 0: 1, as on Raspberry Pi's boards.
                                 It is pico-sdk's PICO_XOSC_STARTUP_DELAY_MULTIPLIER, 64 for many boards */
    struct board_button buttons[BOARD_BUTTONS_MAX];
    uint8_t button_count;
    uint16_t band_height;  /* lines, default */
    uint8_t band_buffers;  /* bands in memory at a time, as a rule; 0: 2, for backends without a queue (bus_queue) */
    uint32_t scene_bytes;  /* memory for scenes: models, lists, depth and bands. Images and pinhole-sim give as much, so
                              that they draw the same; a microcontroller kit's stands in boards/budgets.h */
    uint32_t image_ram[2]; /* RAM that an image with one core may take, and one with two, scene and stack included;
                              0: all that the chip has */
};

/* The boards, by name. */
extern const struct board *const board_list[];
extern const uint32_t board_count;

/* Finds a board by its name. NULL: there is none. */
const struct board *board_find(const char *name);

#endif
