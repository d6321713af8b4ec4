/*
 * The tables of boards, wiring and panels in boards/README.md say the same as the tables in the code: each expected row
 * must stand there as it is. A row that is missing is printed, ready to be put there.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "board.h"
#include "panel.h"

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
static unsigned missing(const struct row *row)
{
    char line[ROW_SIZE + 2];
    snprintf(line, sizeof line, "\n%s\n", row->text);
    if (strstr(readme, line) != NULL) {
        return 0;
    }
    fprintf(stderr, "%s\n", row->text);
    return 1;
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

static void boards_are_all_there(void **state)
{
    (void)state;
    unsigned count = 0;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *board = board_list[i];
        const uint32_t frame_us = panel_frame_us(board->panel, board->format, board->rotation, board->spi_hz);
        struct row row = {{0}, 0};
        add(&row, "| `%s` | %s | `%s` | %g%s | %u | %s |", board->name, board->title, board->panel->name,
            board->spi_hz / 1e6, board->over_limit ? " (!)" : "", (unsigned)(1000000 / frame_us),
            board->pins.dc.line != NULL ? "simulator, virtual kit"
            : board->pins.dc.wired      ? "simulator, emulated chip"
                                        : "simulator");
        count += missing(&row);
    }
    assert_int_equal(count, 0);
}

static void panels_are_all_there(void **state)
{
    (void)state;
    static const char *const formats[] = {"RGB565", "RGB666", "RGB444", "16 greys"};
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
        cmocka_unit_test(panels_are_all_there),
    };
    return cmocka_run_group_tests(tests, read_readme, free_readme);
}
