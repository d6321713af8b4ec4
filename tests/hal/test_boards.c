/* The kits' data are complete and consistent, and each kit shows an upright picture without a complaint of its model.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "chips/spi_clock.h"
#include "panel_picture.h"

#include <stdio.h>
#include <string.h>

static uint16_t picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

static void kits_are_found_by_name(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < board_count; i++) {
        char path[80];
        snprintf(path, sizeof path, "boards/%s/board.c", board_list[i]->name);
        FILE *const file = fopen(path, "rb");
        assert_non_null(file);
        fclose(file);
        assert_ptr_equal(board_find(board_list[i]->name), board_list[i]);
    }
    assert_ptr_equal(board_find("pico-display"), &board_pico_display);
    assert_ptr_equal(board_find("sim-st7735s-128x160"), &board_sim_st7735s_128x160);
    assert_null(board_find("pico"));
}

static bool is_kit(const struct board *board)
{
    return strncmp(board->name, "sim-", 4) != 0;
}

static void kits_are_complete(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *b = board_list[i];
        assert_true(strlen(b->title) > 0 && strlen(b->title) < 80);
        assert_true(b->panel->formats & PANEL_FORMAT_BIT(b->format));
        assert_true(b->rotation <= PANEL_R270);
        assert_true(b->spi_mode == 0 || b->spi_mode == 3);
        assert_true(b->flash <= BOARD_FLASH_SERIAL);
        assert_true(b->band_height >= 1 && b->band_height <= panel_height(b->panel, b->rotation));
        assert_true(b->scene_bytes >= 4U * b->band_height * panel_width(b->panel, b->rotation)); /* colour and depth */
        assert_int_equal(b->over_limit, b->spi_hz > b->panel->controller->write_hz);
        if (is_kit(b)) {
            assert_memory_equal(b->pinout, "https://", 8);
            assert_true(b->pins.clock.wired && b->pins.data.wired);
            assert_int_equal(b->pins.dc.wired, b->i2c_address == 0);
        }
    }
}

/* The kit has another panel from revision C on. */
static void the_stellaris_names_its_revision(void **state)
{
    (void)state;
    assert_non_null(strstr(board_lm3s6965evb.title, "before revision C"));
}

/* A board's SPI unit is that of the port in its board.mk. */
static void units_are_those_of_the_ports(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        enum board_spi_unit unit;
    } ports[] = {{"pico.mk", BOARD_SPI_RP2},
                 {"pico2.mk", BOARD_SPI_RP2},
                 {"lm3s6965", BOARD_SPI_LM3S6965},
                 {"stm32f4", BOARD_SPI_STM32F4}};
    for (uint32_t i = 0; i < board_count; i++) {
        char path[80], text[512] = "";
        snprintf(path, sizeof path, "boards/%s/board.mk", board_list[i]->name);
        FILE *file = fopen(path, "rb");
        enum board_spi_unit unit = BOARD_SPI_ANY;
        if (file != NULL) {
            assert_true(fread(text, 1, sizeof text - 1, file) > 0);
            fclose(file);
        }
        for (size_t k = 0; k < sizeof ports / sizeof ports[0]; k++) {
            unit = strstr(text, ports[k].text) != NULL ? ports[k].unit : unit;
        }
        assert_true(file == NULL || unit != BOARD_SPI_ANY);
        assert_int_equal(board_list[i]->spi_unit, unit);
        assert_true(file == NULL || (strstr(text, "PORT_BUS = i2c\n") != NULL) == (board_list[i]->i2c_address != 0));
    }
}

static const struct board_pin *pin_of(const struct board *board, uint32_t i)
{
    const struct board_pins *p = &board->pins;
    const struct board_pin *wires[] = {&p->clock, &p->data,  &p->data_in,   &p->select,
                                       &p->dc,    &p->reset, &p->backlight, &p->tearing};
    if (i < 8) {
        return wires[i];
    }
    return i - 8 < board->button_count ? &board->buttons[i - 8].pin : NULL;
}

static bool same_pin(const struct board_pin *a, const struct board_pin *b)
{
    if (a->line == NULL || b->line == NULL) {
        return a->line == b->line && a->number == b->number;
    }
    return strcmp(a->line, b->line) == 0;
}

/* Fails if wire i uses the pin of an earlier one. */
static void check_wire(const struct board *board, uint32_t i)
{
    const struct board_pin *a = pin_of(board, i);
    for (uint32_t j = 0; j < i; j++) {
        const struct board_pin *b = pin_of(board, j);
        if (a->wired && b->wired && same_pin(a, b)) {
            fail_msg("%s: wires %u and %u share a pin", board->name, j, i);
        }
    }
}

/* The Pirate Audio and the Display HAT Mini use MISO's line for D/C, so MISO is not wired there. */
static void no_pin_is_used_twice(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < board_count; k++) {
        for (uint32_t i = 0; pin_of(board_list[k], i) != NULL; i++) {
            check_wire(board_list[k], i);
        }
    }
}

static void buttons_differ(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < board_count; k++) {
        uint32_t all = 0;
        for (uint32_t i = 0; i < board_list[k]->button_count; i++) {
            const struct board_button *button = &board_list[k]->buttons[i];
            assert_true(button->pin.wired);
            assert_int_equal(all & button->button, 0);
            all |= button->button;
        }
        assert_int_equal(all & ~31U, 0);
    }
}

/*
 * The time of a frame, us. In mode 0 a PL022 pauses for 1.5 clocks after each word. On an RP2040 a word of the picture
 * has 16 bits; commands and the LM3S6965's words have 8. On an I2C bus a byte has 9 clocks, and a message two more
 * bytes, a start and a stop; each page has two messages. A memory LCD's mode has a clock of its own; two more bytes, of
 * its message's end, are short writes.
 */
static double frame_us(const struct board *b, uint32_t hz)
{
    const double bytes = panel_frame_bytes(b->panel, b->format, b->rotation);
    const double pixels = panel_width(b->panel, b->rotation) * panel_height(b->panel, b->rotation);
    const double words = b->spi_mode != 0                    ? 0
                         : b->spi_unit == BOARD_SPI_RP2      ? bytes - pixels
                         : b->spi_unit == BOARD_SPI_LM3S6965 ? bytes
                                                             : 0;
    if (b->panel->controller->lines != NULL) {
        const bool rests = b->spi_unit == BOARD_SPI_RP2;
        const double mode_us = (rests ? 9.5e6 : 8e6) / spi_clock_of(b, b->panel->controller->init_hz);
        return mode_us + (8 * (bytes - 1) + (rests ? 1.5 * ((bytes - 3) / 2 + 2) : 0)) * 1e6 / hz;
    }
    if (b->i2c_address != 0) {
        const double messages = 2 * panel_height(b->panel, b->rotation) / 8.0;
        return (9 * (bytes + 2 * messages) + 2 * messages) * 1e6 / hz;
    }
    return (8 * bytes + 1.5 * words) * 1e6 / hz;
}

/* Opens each kit from its board alone, as a program does. A frame takes the time of the formula. */
static void every_kit_shows_a_picture(void **state)
{
    (void)state;
    static uint8_t scratch[1024];
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *b = board_list[i];
        struct hal hal;
        struct sim *sim = sim_open(b, &hal);
        assert_non_null(sim);
        struct panel_config config = {b->panel, b->rotation, b->format, b->spi_hz, scratch, sizeof scratch};
        struct panel_driver d;
        assert_int_equal(panel_open(&d, &hal, &config), 0);
        picture_fill(picture, d.width, d.height, i);
        assert_int_equal(picture_draw(&d, picture, b->band_height), 0);
        uint64_t before = sim_counters(sim).bus_ns;
        assert_int_equal(picture_draw(&d, picture, b->band_height), 0);
        uint64_t us = (sim_counters(sim).bus_ns - before) / 1000;
        const double formula = frame_us(b, (uint32_t)d.clock_hz);
        assert_true((double)us <= formula && (double)us + 8 >= formula); /* each write's time is cut off to a ns */
        sim_pixels(sim, b->rotation, seen);
        picture_expect(picture, d.width, d.height, b->format, b->panel->round, expected);
        picture_compare(seen, expected, d.width, d.height, b->name);
        picture_no_complaint(sim, b->name);
        assert_int_equal(sim_note(sim) != NULL, b->over_limit);
        sim_close(sim);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kits_are_found_by_name),
        cmocka_unit_test(kits_are_complete),
        cmocka_unit_test(the_stellaris_names_its_revision),
        cmocka_unit_test(units_are_those_of_the_ports),
        cmocka_unit_test(no_pin_is_used_twice),
        cmocka_unit_test(buttons_differ),
        cmocka_unit_test(every_kit_shows_a_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
