/*
 * The tables in boards/README.md say what the code and the simulated kits do: each expected row must stand there as it
 * is. A row that is missing is printed, ready to be put there.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "sim_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROW_SIZE 512

struct row {
    char text[ROW_SIZE];
    size_t length;
};

static char *readme;

__attribute__((format(printf, 2, 3))) static void add(struct row *row, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(row->text + row->length, ROW_SIZE - row->length, format, arguments);
    va_end(arguments);
    assert_in_range(n, 0, ROW_SIZE - row->length - 1);
    row->length += (size_t)n;
}

/* STM32 and Stellaris name a pin by its port. */
static bool has_ports(const struct board *board)
{
    return strstr(board->name, "stm32") != NULL || strstr(board->name, "lm3s") != NULL;
}

static void add_pin(struct row *row, const struct board *board, const struct board_pin *pin)
{
    if (!pin->wired) {
        add(row, "  |");
    } else if (pin->line != NULL) {
        add(row, " %s |", pin->line);
    } else if (has_ports(board)) {
        add(row, " P%c%u |", 'A' + pin->number / 32, pin->number % 32U);
    } else {
        add(row, " GP%u |", pin->number);
    }
}

static bool is_kit(const struct board *board)
{
    return strncmp(board->name, "sim-", 4) != 0;
}

/* Whether the row stands in the README as a line of its own. */
static unsigned missing_with(const struct row *row, const char *end)
{
    char line[ROW_SIZE + 8];
    snprintf(line, sizeof line, "\n%s%s", row->text, end);
    if (strstr(readme, line) != NULL) {
        return 0;
    }
    fprintf(stderr, "%s\n", row->text);
    return 1;
}

static unsigned missing(const struct row *row)
{
    return missing_with(row, "\n");
}

enum { COLUMNS = 7 };

static void wiring_is_that_of_the_boards(void **state)
{
    (void)state;
    unsigned count = 0;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *board = board_list[i];
        const struct board_pins *pins = &board->pins;
        const struct board_pin *const columns[COLUMNS] = {&pins->clock, &pins->data,  &pins->data_in,  &pins->select,
                                                          &pins->dc,    &pins->reset, &pins->backlight};
        struct row row = {{0}, 0};
        if (is_kit(board)) {
            add(&row, "| [`%s`](%s) |", board->name, board->pinout);
            for (size_t k = 0; k < COLUMNS; k++) {
                add_pin(&row, board, columns[k]);
            }
            count += missing(&row);
        }
    }
    assert_int_equal(count, 0);
}

struct measured {
    uint32_t clock_hz, frame_us;
    uint8_t rotation_byte;
};

/* What the simulated kit does with a frame that is not its first. */
static struct measured measure(const struct board *board)
{
    static uint16_t picture[PICTURE_PIXELS];
    static uint8_t scratch[1024];
    struct hal hal;
    struct sim *sim = sim_open(board, &hal);
    assert_non_null(sim);
    const struct panel_config config = {board->panel,  board->rotation, board->format,
                                        board->spi_hz, scratch,         sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    assert_int_equal(picture_draw(&d, picture, board->band_height), 0);
    const uint64_t before = sim_counters(sim).bus_ns;
    assert_int_equal(picture_draw(&d, picture, board->band_height), 0);
    const uint64_t ns = sim_counters(sim).bus_ns - before;
    const bool ssd = strncmp(board->panel->name, "ssd", 3) == 0, pages = sim->glass.model->pages;
    const uint8_t mirrors = (uint8_t)(sim->u.page.remap | sim->u.page.from_last << 3);
    const struct measured m = {(uint32_t)d.clock_hz, (uint32_t)((ns + 999) / 1000),
                               sim->glass.model->mode_0 ? 0 /* a memory LCD has none */
                               : pages                  ? mirrors
                               : ssd                    ? sim->u.ssd.remap
                                                        : sim->u.dbi.madctl};
    sim_close(sim);
    return m;
}

static void boards_are_all_there(void **state)
{
    (void)state;
    unsigned count = 0;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *board = board_list[i];
        const struct measured m = measure(board);
        struct row row = {{0}, 0};
        add(&row, "| `%s` | %s | `%s` | %.4g%s | %u | %s |", board->name, board->title, board->panel->name,
            m.clock_hz / 1e6, board->over_limit ? " (!)" : "", (unsigned)(1000000 / m.frame_us),
            board->pins.data.line != NULL ? "simulator, Linux guest"
            : board->pins.data.wired      ? "simulator, emulated chip"
                                          : "simulator");
        count += missing_with(&row, " "); /* one more column is for people */
    }
    assert_int_equal(count, 0);
}

/*
 * The rotation byte that each kit starts with (MADCTL, or the remap command of SSD controllers; one bit: 01h for A1h,
 * 08h for C8h), and the maker's program from which the orientation is taken. A picture that a program turns by PIL's
 * rotation=90 or numpy's rot90 is turned counter-clockwise: the byte here has the same effect on the picture without
 * that.
 */
#define OWN_TOP "the controller's own top: a bare module has no other"
static const struct {
    const char *board;
    uint8_t byte;
    const char *source;
} orientations[] = {
    {"pico-display", 0x60, "70h by Pimoroni's pimoroni-pico, `st7789.cpp` at `ROTATE_0`"},
    {"pico-display-2", 0x60, "70h by Pimoroni's pimoroni-pico, `st7789.cpp` at `ROTATE_0`"},
    {"waveshare-pico-lcd-1in3", 0x60, "70h by Waveshare's `LCD_1in3.c` at `HORIZONTAL`"},
    {"waveshare-pico-lcd-0in96", 0xA8, "A8h by Waveshare's `Pico-LCD-0.96.py`"},
    {"waveshare-rp2040-lcd-1in28", 0x48, "08h by Waveshare's `LCD_1in28.c`, which also reverses the columns (B6h 20h)"},
    {"pico2-display", 0x60, "70h by Pimoroni's pimoroni-pico, `st7789.cpp` at `ROTATE_0`"},
    {"pico2-display-2", 0x60, "70h by Pimoroni's pimoroni-pico, `st7789.cpp` at `ROTATE_0`"},
    {"pico2-display-2in8", 0x60, "70h by Pimoroni's pimoroni-pico, `st7789.cpp` at `ROTATE_0`"},
    {"waveshare-pico2-lcd-1in3", 0x60, "70h by Waveshare's `LCD_1in3.c` at `HORIZONTAL`"},
    {"waveshare-pico2-lcd-0in96", 0xA8, "A8h by Waveshare's `Pico-LCD-0.96.py`"},
    {"waveshare-rp2350-lcd-1in28", 0x48, "08h by Waveshare's `LCD_1in28.c`, which also reverses the columns (B6h 20h)"},
    {"waveshare-rp2350-lcd-0in96", 0xA8, "A8h by Waveshare's `Pico-LCD-0.96.py`, unconfirmed"},
    {"waveshare-pico-oled-1in3", 0x08,
     "C0h, A0h by Waveshare's `Pico-OLED-1.3.py`, which writes the first line to the last column"},
    {"lm3s6965evb", 0x52, "52h by Luminary's `osram128x64x4.c`"},
    {"feather-stm32f405", 0x28, "38h by Adafruit's `adafruit_ili9341.py`"},
    {"rpi-waveshare-1in3", 0x60, "70h by Waveshare's `ST7789.py`"},
    {"rpi-waveshare-1in44", 0x68, "68h by Waveshare's `LCD_1in44.py` at `U2D_R2L`"},
    {"rpi-pirate-audio", 0x00, "70h by Pimoroni's st7789-python; the examples turn the picture by 90"},
    {"rpi-display-hat-mini", 0xA0, "70h by Pimoroni's st7789-python; displayhatmini turns the picture by 180"},
    {"rpi-pitft-2in8", 0xE8,
     "48h by Adafruit's `ili9341.py`; the example turns the picture by 90. Linux' fb_ili9341: E8h"},
    {"rpi-mini-pitft-1in14", 0x60, "C0h by Adafruit's `st7789.py`; the example turns the picture by 90"},
    {"rpi-mini-pitft-1in3", 0x00, "C0h by Adafruit's `st7789.py`; the example turns the picture by 180"},
    {"sbc-generic", 0x00, OWN_TOP},
    {"ft232h-st7789", 0x00, OWN_TOP},
    {"ft232h-ili9341", 0x48, OWN_TOP},
    {"sim-ili9488", 0x28, "no kit"},
    {"sim-ssd1351", 0x74, "no kit"},
    {"sim-st7789-170x320", 0x60, "no kit"},
    {"sim-st7789-240x280", 0x00, "no kit"},
    {"sim-st7735s-128x160", 0x08, "no kit"},
};

static void orientations_are_those_of_the_makers(void **state)
{
    (void)state;
    unsigned count = 0, known = 0;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *board = board_list[i];
        const struct measured m = measure(board);
        struct row row = {{0}, 0};
        const char *source = NULL; /* a board that is newer than this table says its own in its README's row */
        for (size_t k = 0; k < sizeof orientations / sizeof orientations[0]; k++) {
            if (strcmp(board->name, orientations[k].board) == 0) {
                source = orientations[k].source;
                known++;
                if (m.rotation_byte != orientations[k].byte) {
                    fail_msg("%s starts with %02Xh, not %02Xh", board->name, m.rotation_byte, orientations[k].byte);
                }
            }
        }
        if (is_kit(board)) {
            add(&row, "| `%s` | %02Xh | %s", board->name, m.rotation_byte, source != NULL ? source : "");
            count += missing_with(&row, source != NULL ? " |\n" : "");
        }
    }
    assert_int_equal(known, sizeof orientations / sizeof orientations[0]);
    assert_int_equal(count, 0);
}

static void panels_are_all_there(void **state)
{
    (void)state;
    static const char *const formats[] = {"RGB565", "RGB666", "RGB444", "16 greys", "1 bit"};
    unsigned count = 0;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *panel = panel_list[i];
        struct row row = {{0}, 0};
        add(&row, "| `%s` | %s | %ux%u%s |", panel->name, panel->controller->name, panel->width, panel->height,
            panel->round ? ", round" : "");
        const char *separator = " ";
        for (unsigned f = 0; f < sizeof formats / sizeof formats[0]; f++) {
            if (panel->formats & PANEL_FORMAT_BIT(f)) {
                add(&row, "%s%s", separator, formats[f]);
                separator = ", ";
            }
        }
        add(&row, " | %.1f | simulator |", panel->controller->write_hz / 1e6);
        count += missing(&row);
    }
    assert_int_equal(count, 0);
}

static int read_readme(void **state)
{
    (void)state;
    FILE *file = fopen("boards/README.md", "rb");
    readme = calloc(1, 1 << 20);
    if (file == NULL || readme == NULL) {
        return -1;
    }
    const size_t n = fread(readme, 1, (1 << 20) - 1, file);
    return fclose(file) == 0 && n > 0 ? 0 : -1;
}

static int free_readme(void **state)
{
    (void)state;
    free(readme);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wiring_is_that_of_the_boards),
        cmocka_unit_test(boards_are_all_there),
        cmocka_unit_test(orientations_are_those_of_the_makers),
        cmocka_unit_test(panels_are_all_there),
    };
    return cmocka_run_group_tests(tests, read_readme, free_readme);
}
