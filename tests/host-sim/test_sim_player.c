/* player: what the simulated controller rejects or refuses reaches the user, and the exit status. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "stderr_capture.h"
#include "complain.h"
#include "sim_player.h"

#include <string.h>

static struct sim_player_setup setup_of(const struct board *board)
{
    return (struct sim_player_setup){.board = board, .band_height = 8, .demo = demo_find("cube")};
}

static void a_kit_that_is_used_well_is_silent(void **state)
{
    struct sim_virtual v;
    struct sim_player player;
    struct stderr_capture c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    const struct sim_player_setup setup = setup_of(&v.board);
    stderr_capture_begin(&c);
    const int opened = sim_player_open(&player, &setup), drawn = sim_player_frame(&player, 0),
              closed = sim_player_close(&player);
    stderr_capture_end(&c);
    assert_int_equal(opened, 0);
    assert_int_equal(drawn, 0);
    assert_int_equal(closed, 0);
    assert_string_equal(c.text, "");
}

static void a_complaint_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct sim_player player;
    struct stderr_capture c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    v.board.spi_hz = 200000000; /* far above what an ST7789 takes */
    v.board.over_limit = false;
    const struct sim_player_setup setup = setup_of(&v.board);
    stderr_capture_begin(&c);
    const int opened = sim_player_open(&player, &setup), drawn = sim_player_frame(&player, 0),
              closed = sim_player_close(&player);
    stderr_capture_end(&c);
    assert_int_equal(opened, 0);
    assert_int_equal(drawn, 0);
    assert_int_equal(closed, COMPLAINED);
    assert_non_null(strstr(c.text, "display controller: "));
    assert_int_equal(stderr_capture_lines(&c), 1);
}

static void a_bus_that_fails_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct sim_player player;
    struct stderr_capture c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    const struct sim_player_setup setup = setup_of(&v.board);
    assert_int_equal(sim_player_open(&player, &setup), 0);
    sim_fault(player.sim, SIM_FAULT_WRITE, 5);
    stderr_capture_begin(&c);
    const int drawn = sim_player_frame(&player, 3);
    stderr_capture_end(&c);
    sim_player_close(&player);
    assert_int_equal(drawn, COMPLAINED);
    assert_non_null(strstr(c.text, "frame 3"));
    assert_int_equal(stderr_capture_lines(&c), 1);
}

static void a_camera_without_a_volume_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct sim_player player;
    struct stderr_capture c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    struct sim_player_setup setup = setup_of(&v.board);
    setup.camera.projection_set = true; /* and all zeros */
    assert_int_equal(sim_player_open(&player, &setup), 0);
    stderr_capture_begin(&c);
    const int drawn = sim_player_frame(&player, 0);
    stderr_capture_end(&c);
    sim_player_close(&player);
    assert_int_equal(drawn, COMPLAINED);
    assert_int_equal(stderr_capture_lines(&c), 1);
}

static void a_drag_turns_against_the_pointer_and_stops_above_the_scene(void **state)
{
    struct sim_player player = {.sim = NULL};
    const struct demo_context *const camera = &player.runner.context;
    (void)state;
    sim_player_drag(&player, 64, 0, 0);
    assert_true(camera->orbit == 0xC0000000u); /* a quarter turn clockwise: 256 pixels are a turn */
    sim_player_drag(&player, -64, 16, 0);
    assert_true(camera->orbit == 0);
    assert_int_equal(camera->tilt, 1 << 28);
    sim_player_drag(&player, 0, 1000, 0);
    assert_int_equal(camera->tilt, 1 << 30);
    sim_player_drag(&player, 0, -2000, 0); /* at most a quarter turn a call */
    assert_int_equal(camera->tilt, 0);
    sim_player_drag(&player, 0, 0, 2);
    assert_int_equal(camera->dolly, -FX_ONE / 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_kit_that_is_used_well_is_silent),
        cmocka_unit_test(a_complaint_is_one_line_and_a_failure),
        cmocka_unit_test(a_bus_that_fails_is_one_line_and_a_failure),
        cmocka_unit_test(a_camera_without_a_volume_is_one_line_and_a_failure),
        cmocka_unit_test(a_drag_turns_against_the_pointer_and_stops_above_the_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
