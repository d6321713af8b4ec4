/*
 * hal/ft232h without USB. This file decodes its command stream by the text of FTDI's AN_108, not by the encoder's
 * tables, down to single bits with the level of D/C at each. The bits end in the simulator's panel.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "ft232h/ft232h.h"
#include "ft232h/link.h"
#include "ft232h/mpsse.h"
#include "hal_conformance.h"
#include "panel_picture.h"
#include "sim.h"

#include <stdio.h>
#include <string.h>

/* ---- the chip, in place of hal/ft232h/usb/link.c -------------------------------------------------- */

enum { LOW, HIGH };

struct ft232h_usb {
    uint8_t command[3]; /* the one that is being received */
    unsigned have;
    uint32_t left; /* bytes of a block that are still to come */
    uint8_t levels[2], outputs[2];
    uint32_t divisor;
    bool by_five; /* divides the clock by five, as after a reset */
    bool open;
    uint8_t answers[70000];
    size_t answers_at, answers_end;
    uint8_t buttons[2];   /* levels from outside, of inputs */
    uint8_t panel_answer; /* of each byte read */
    unsigned mistakes, flushes;
    uint64_t bytes_shifted;
    struct sim *sim;
    struct hal sim_hal;
    uint16_t dc, select, reset, backlight; /* bits; 0: not wired */
};

static struct ft232h_usb chip;

static void answer(uint8_t byte)
{
    assert_true(chip.answers_end < sizeof chip.answers);
    chip.answers[chip.answers_end++] = byte;
}

static uint16_t all_levels(void)
{
    return (uint16_t)(chip.levels[LOW] | chip.levels[HIGH] << 8);
}

static void mistake(const char *what)
{
    print_error("%s\n", what);
    chip.mistakes++;
}

/* Pins move between bits only; select must be low while bits go out, and D/C must not move then. */
static void set_pins(int port, uint8_t levels, uint8_t outputs)
{
    const uint16_t before = all_levels();
    chip.levels[port] = levels;
    chip.outputs[port] = outputs;
    const uint16_t changed = before ^ all_levels();
    if ((changed & chip.dc) != 0 && chip.select != 0 && (before & chip.select) == 0) {
        mistake("D/C moves while the panel is selected");
    }
    if ((changed & chip.reset) != 0) {
        chip.sim_hal.ops->pin_set(chip.sim, HAL_PIN_RESET, (all_levels() & chip.reset) != 0);
    }
    if ((changed & chip.backlight) != 0) {
        chip.sim_hal.ops->pin_set(chip.sim, HAL_PIN_BACKLIGHT, (all_levels() & chip.backlight) != 0);
    }
}

static void shift_out(uint8_t byte)
{
    if (chip.select != 0 && (all_levels() & chip.select) != 0) {
        mistake("bits without chip select");
    }
    if ((chip.levels[LOW] & 1) != 0 || (chip.outputs[LOW] & 7) != 3) {
        mistake("clock does not rest low, or AD0 to AD2 have wrong directions");
    }
    for (int bit = 7; bit >= 0; bit--) {
        sim_bit(chip.sim, (all_levels() & chip.dc) != 0 ? HAL_DATA : HAL_COMMAND, (byte >> bit) & 1U);
    }
    chip.bytes_shifted++;
}

/* The bytes that a command takes after its first. */
static unsigned parameters_of(uint8_t command)
{
    switch (command) {
    case 0x11:
    case 0x20:
    case 0x80:
    case 0x82:
    case 0x86:
        return 2;
    default:
        return 0;
    }
}

static void carry_out(void)
{
    const uint32_t word = chip.command[1] + 256U * chip.command[2];
    switch (chip.command[0]) {
    case 0x11:
        chip.left = word + 1;
        break;
    case 0x20:
        for (uint32_t i = 0; i <= word; i++) {
            answer(chip.panel_answer++);
        }
        break;
    case 0x80:
        set_pins(LOW, chip.command[1], chip.command[2]);
        break;
    case 0x82:
        set_pins(HIGH, chip.command[1], chip.command[2]);
        break;
    case 0x81:
        answer((chip.levels[LOW] & chip.outputs[LOW]) | (chip.buttons[LOW] & ~chip.outputs[LOW]));
        break;
    case 0x83:
        answer((chip.levels[HIGH] & chip.outputs[HIGH]) | (chip.buttons[HIGH] & ~chip.outputs[HIGH]));
        break;
    case 0x86:
        chip.divisor = word;
        chip.sim_hal.ops->bus_clock(chip.sim, (chip.by_five ? 6000000 : 30000000) / (word + 1));
        break;
    case 0x8A:
        chip.by_five = false;
        break;
    case 0x85:
    case 0x87:
    case 0x97:
        break;
    default:
        mistake("no such command");
        answer(0xFA);
        answer(chip.command[0]);
    }
}

static void receive(uint8_t byte)
{
    if (chip.left > 0) {
        chip.left--;
        shift_out(byte);
        return;
    }
    chip.command[chip.have++] = byte;
    if (chip.have == 1 + parameters_of(chip.command[0])) {
        chip.have = 0;
        carry_out();
    }
}

int ft232h_link_open(struct ft232h_usb **link, const char *serial, char *error)
{
    (void)serial;
    error[0] = 0;
    chip.by_five = true;
    chip.have = 0;
    chip.left = 0;
    chip.open = true;
    *link = &chip;
    return HAL_OK;
}

void ft232h_link_pace(struct ft232h_usb *link, uint32_t hz)
{
    (void)link;
    assert_true(hz > 0);
}

int ft232h_link_put(struct ft232h_usb *link, const uint8_t *bytes, size_t n)
{
    assert_ptr_equal(link, &chip);
    for (size_t i = 0; i < n; i++) {
        receive(bytes[i]);
    }
    return HAL_OK;
}

int ft232h_link_flush(struct ft232h_usb *link)
{
    assert_ptr_equal(link, &chip);
    link->flushes++;
    return HAL_OK;
}

int ft232h_link_get(struct ft232h_usb *link, uint8_t *bytes, size_t n)
{
    assert_ptr_equal(link, &chip);
    assert_true(link->answers_end - link->answers_at >= n); /* the real one would time out */
    memcpy(bytes, link->answers + link->answers_at, n);
    link->answers_at += n;
    if (link->answers_at == link->answers_end) {
        link->answers_at = link->answers_end = 0;
    }
    return HAL_OK;
}

void ft232h_link_close(struct ft232h_usb *link)
{
    if (link != NULL) {
        assert_true(link->open);
        link->open = false;
    }
}

/* ---- tests --------------------------------------------------------------------------------------- */

static struct ft232h kit;
static uint16_t picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

static uint16_t bit_named(const struct board_pin *pin) /* "AC1" -> 1 << 9 */
{
    return (uint16_t)(pin->wired ? 1U << (pin->line[2] - '0' + (pin->line[1] == 'C' ? 8 : 0)) : 0U);
}

static void plug_in(const struct board *board)
{
    memset(&chip, 0, sizeof chip);
    memset(&kit, 0, sizeof kit);
    chip.sim = sim_open(board, &chip.sim_hal);
    assert_non_null(chip.sim);
    chip.dc = bit_named(&board->pins.dc);
    chip.select = bit_named(&board->pins.select);
    chip.reset = bit_named(&board->pins.reset);
    chip.backlight = bit_named(&board->pins.backlight);
    chip.levels[HIGH] = (uint8_t)(chip.reset >> 8); /* the panel runs */
}

static void unplug(void)
{
    assert_int_equal(chip.mistakes, 0);
    assert_int_equal(chip.left, 0);
    assert_false(chip.open);
    assert_int_equal(chip.have, 0);
    sim_close(chip.sim);
}

/* A board with other lines for select and D/C, and with a backlight. */
static struct board wired_otherwise(const char *select, const char *dc)
{
    struct board board = board_ft232h_ili9341;
    board.pins.select.line = select;
    board.pins.dc.line = dc;
    board.pins.backlight = (struct board_pin)BOARD_LINE("AC7");
    return board;
}

static void every_wiring_shows_the_picture(void **state)
{
    (void)state;
    const struct board boards[] = {board_ft232h_st7789, board_ft232h_ili9341, wired_otherwise("AD3", "AD7"),
                                   wired_otherwise("AC0", "AC6"), wired_otherwise("AC0", "AD4")};
    for (size_t i = 0; i < sizeof boards / sizeof boards[0]; i++) {
        const struct board *b = &boards[i];
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            plug_in(b);
            const struct hal hal = {&ft232h_ops, &kit};
            struct panel_config config = {b->panel, (uint8_t)rotation, b->format, b->spi_hz, NULL, 0};
            struct panel_driver d;
            assert_int_equal(hal.ops->open(&kit, b), 0);
            assert_int_equal(panel_open(&d, &hal, &config), 0);
            picture_fill(picture, d.width, d.height, rotation);
            assert_int_equal(picture_draw(&d, picture, b->band_height), 0);
            sim_pixels(chip.sim, rotation, seen);
            picture_expect(picture, d.width, d.height, b->format, b->panel->round, expected);
            picture_compare(seen, expected, d.width, d.height, b->name);
            hal.ops->close(&kit);
            unplug();
        }
    }
}

static void the_backend_keeps_the_contract(void **state)
{
    (void)state;
    const struct hal hal = {&ft232h_ops, &kit};
    plug_in(&board_ft232h_st7789);
    hal_conforms(&hal, &board_ft232h_st7789, "ft232h", true);
    unplug();
}

/* The clock is the fastest 30 MHz / (1 + n) of at most the one asked for. */
static void the_clock_is_the_next_below(void **state)
{
    (void)state;
    static const struct {
        uint32_t asked, got, divisor;
    } clocks[] = {{4000000000U, 30000000, 0}, {30000000, 30000000, 0}, {29999999, 15000000, 1}, {15000000, 15000000, 1},
                  {10000000, 10000000, 2},    {8000000, 7500000, 3},   {1000000, 1000000, 29},  {458, 457, 65502}};
    plug_in(&board_ft232h_st7789);
    assert_int_equal(ft232h_ops.open(&kit, &board_ft232h_st7789), 0);
    for (size_t i = 0; i < sizeof clocks / sizeof clocks[0]; i++) {
        assert_int_equal(ft232h_ops.bus_clock(&kit, clocks[i].asked), clocks[i].got);
        assert_int_equal(chip.divisor, clocks[i].divisor);
        assert_false(chip.by_five);
    }
    assert_int_equal(ft232h_ops.bus_clock(&kit, 457), HAL_EINVAL);
    assert_int_equal(ft232h_ops.bus_clock(&kit, 0), HAL_EINVAL);
    ft232h_ops.close(&kit);
    unplug();
}

static void long_writes_are_divided(void **state)
{
    (void)state;
    static uint8_t nops[200001];
    plug_in(&board_ft232h_st7789);
    assert_int_equal(ft232h_ops.open(&kit, &board_ft232h_st7789), 0);
    static const size_t sizes[] = {1, 65535, 65536, 65537, 200001};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const uint64_t before = chip.bytes_shifted;
        assert_int_equal(ft232h_ops.bus_write(&kit, HAL_COMMAND, nops, sizes[i]), 0);
        assert_int_equal(ft232h_ops.bus_wait(&kit), 0);
        assert_int_equal(chip.bytes_shifted - before, sizes[i]);
        assert_true(chip.flushes > i);
    }
    ft232h_ops.close(&kit);
    unplug();
}

static void the_panel_answers(void **state)
{
    (void)state;
    uint8_t id[4];
    plug_in(&board_ft232h_st7789);
    assert_int_equal(ft232h_ops.open(&kit, &board_ft232h_st7789), 0);
    chip.panel_answer = 0x85;
    assert_int_equal(ft232h_ops.bus_read(&kit, 0x00, id, sizeof id), 0);
    assert_memory_equal(id, "\x85\x86\x87\x88", 4);
    assert_int_equal(ft232h_ops.bus_wait(&kit), 0);
    assert_int_equal(ft232h_ops.bus_read(&kit, 0x00, id, 0), HAL_EINVAL);
    ft232h_ops.close(&kit);
    unplug();
}

static void buttons_are_read(void **state)
{
    (void)state;
    struct board board = board_ft232h_st7789;
    board.buttons[0] = (struct board_button){HAL_BUTTON_UP, BOARD_LINE_LOW("AD5")};
    board.buttons[1] = (struct board_button){HAL_BUTTON_LEFT, BOARD_LINE("AC3")};
    board.button_count = 2;
    plug_in(&board);
    assert_int_equal(ft232h_ops.open(&kit, &board), 0);
    chip.buttons[LOW] = 0xFF;
    assert_int_equal(ft232h_ops.buttons(&kit), 0);
    chip.buttons[LOW] = 0xDF;
    assert_int_equal(ft232h_ops.buttons(&kit), HAL_BUTTON_UP);
    chip.buttons[HIGH] = 0x08;
    assert_int_equal(ft232h_ops.buttons(&kit), HAL_BUTTON_UP | HAL_BUTTON_LEFT);
    ft232h_ops.close(&kit);
    unplug();
}

static void wirings_that_cannot_be_are_refused(void **state)
{
    (void)state;
    struct board board = board_ft232h_st7789;
    board.pins.dc.line = "AD1";
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    assert_non_null(
        strstr(ft232h_error(&kit), "D/C cannot be pin AD1 of an FT232H; it is one of AD3 to AD7, AC0 to AC7"));
    board.pins.dc.line = "AC1"; /* reset's */
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    assert_string_equal(ft232h_error(&kit),
                        "board ft232h-st7789: reset cannot be pin AC1 of an FT232H: another line has it");
    board.pins.dc.line = "AD3"; /* select's */
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    board = board_ft232h_st7789;
    board.buttons[0] = (struct board_button){HAL_BUTTON_UP, BOARD_LINE_LOW("AC0")}; /* D/C's */
    board.button_count = 1;
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    assert_non_null(strstr(ft232h_error(&kit), "a button cannot be pin AC0 of an FT232H: another line has it"));
    board = board_ft232h_st7789;
    board.pins.dc.line = "AC8";
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    board = board_ft232h_st7789;
    board.pins.clock.line = "AD3";
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
    assert_non_null(strstr(ft232h_error(&kit), "clock cannot be pin AD3 of an FT232H; it is AD0"));
    assert_int_equal(ft232h_ops.open(&kit, &board_pico_display), HAL_EINVAL);
    board = board_ft232h_st7789;
    board.spi_mode = 1;
    assert_int_equal(ft232h_ops.open(&kit, &board), HAL_EINVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_wiring_shows_the_picture),
        cmocka_unit_test(the_backend_keeps_the_contract),
        cmocka_unit_test(the_clock_is_the_next_below),
        cmocka_unit_test(long_writes_are_divided),
        cmocka_unit_test(the_panel_answers),
        cmocka_unit_test(buttons_are_read),
        cmocka_unit_test(wirings_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
