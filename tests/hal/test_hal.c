/*
 * The conformance test of hal.h, for every backend. A new backend is one line in `backends` and a function that
 * prepares its kit. hal/template is a port, but its operations run here, too. Backends that need hardware are tested in
 * the guest: long_guest_backends.sh starts this program in it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "hal_conformance.h"
#include "null/null.h"
#include "port.h"
#include "sim.h"

#include <string.h>

struct backend {
    const char *name;
    const struct board *board;
    void (*prepare)(struct hal *hal, const struct board *board); /* the kit is open already, or not yet */
    void (*release)(struct hal *hal);
    bool keeps_time;
};

static void prepare_null(struct hal *hal, const struct board *board)
{
    (void)board;
    *hal = (struct hal){&null_ops, NULL};
}

static void release_nothing(struct hal *hal)
{
    (void)hal;
}

static void prepare_template(struct hal *hal, const struct board *board)
{
    (void)board;
    *hal = port_hal();
}

static void prepare_sim(struct hal *hal, const struct board *board)
{
    assert_non_null(sim_open(board, hal));
}

static void release_sim(struct hal *hal)
{
    sim_close(hal->context);
}

static const struct backend backends[] = {
    {"null", &board_pico_display, prepare_null, release_nothing, false},
    {"template", &board_pico_display, prepare_template, release_nothing, false},
    {"sim", &board_pico_display, prepare_sim, release_sim, true},
    {"sim", &board_lm3s6965evb, prepare_sim, release_sim, true},
    {"sim", &board_sim_ili9488, prepare_sim, release_sim, true},
};

static void every_backend_keeps_the_contract(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof backends / sizeof backends[0]; i++) {
        const struct backend *b = &backends[i];
        struct hal hal;
        b->prepare(&hal, b->board);
        hal_conforms(&hal, b->board, b->name, b->keeps_time);
        b->release(&hal);
    }
}

static void two_kits_of_one_backend_do_not_meet(void **state)
{
    (void)state;
    struct hal one;
    struct hal other;
    struct sim *first = sim_open(&board_pico_display, &one);
    struct sim *second = sim_open(&board_pico_display, &other);
    one.ops->delay_us(one.context, 5000);
    sim_buttons_set(first, HAL_BUTTON_UP);
    assert_int_equal(one.ops->time_us(one.context), 5000);
    assert_int_equal(other.ops->time_us(other.context), 0);
    assert_int_equal(one.ops->buttons(one.context), HAL_BUTTON_UP);
    assert_int_equal(other.ops->buttons(other.context), 0);
    sim_close(first);
    sim_close(second);
}

static void a_refused_open_is_reported(void **state)
{
    (void)state;
    struct hal hal;
    struct sim *sim = sim_open(&board_pico_display, &hal);
    sim_fault(sim, SIM_FAULT_OPEN, 1);
    assert_int_equal(hal.ops->open(hal.context, &board_pico_display), HAL_EACCES);
    assert_int_equal(hal.ops->open(hal.context, &board_pico_display), 0);
    sim_close(sim);
    struct panel unknown = panel_st7789_240x240;
    unknown.name = "no such glass";
    struct board board = board_pico_display;
    board.panel = &unknown;
    assert_null(sim_open(&board, &hal));
}

/*
 * In the virtual board: `test_hal usb` is for hal/ft232h, `test_hal usb-send [SERIAL]` for its faults; `test_hal stays`
 * leaves the board plugged in, which otherwise does not come back in this guest.
 */
int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "usb-send") == 0) {
        return ft232h_guest_send(argc > 2 ? argv[2] : NULL);
    }
    if (argc > 1 && strcmp(argv[1], "usb") == 0) {
        return ft232h_guest_tests();
    }
    if (argc > 1 && strcmp(argv[1], "stays") == 0) {
        cmocka_set_skip_filter("an_unplugged_board_ends_it");
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_backend_keeps_the_contract),
        cmocka_unit_test(two_kits_of_one_backend_do_not_meet),
        cmocka_unit_test(a_refused_open_is_reported),
    };
    return virtual_board_is_here() ? linux_guest_tests() : cmocka_run_group_tests(tests, NULL, NULL);
}
