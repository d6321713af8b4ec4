/* player: what the simulated kit resents or refuses reaches the user, and the exit status. */
#define _XOPEN_SOURCE 700 /* dup2, pread */

#include "player.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <setjmp.h>
#include <cmocka.h>

struct caught {
    int before;
    FILE *file;
    char text[2048];
};

static void catch_begin(struct caught *c)
{
    c->file = tmpfile();
    c->before = dup(STDERR_FILENO);
    assert_non_null(c->file);
    dup2(fileno(c->file), STDERR_FILENO);
}

static void catch_end(struct caught *c)
{
    dup2(c->before, STDERR_FILENO);
    const ssize_t n = pread(fileno(c->file), c->text, sizeof c->text - 1, 0);
    c->text[n < 0 ? 0 : n] = '\0';
    close(c->before);
    fclose(c->file);
}

static unsigned lines_of(const char *text)
{
    unsigned lines = 0;
    for (; *text != '\0'; text++) {
        lines += *text == '\n';
    }
    return lines;
}

static struct player_setup setup_of(const struct board *board)
{
    return (struct player_setup){.board = board, .band_height = 8, .demo = demo_find("cube")};
}

static void a_kit_that_is_used_well_is_silent(void **state)
{
    struct sim_virtual v;
    struct player player;
    struct caught c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    const struct player_setup setup = setup_of(&v.board);
    catch_begin(&c);
    const int opened = player_open(&player, &setup), drawn = player_frame(&player, 0), closed = player_close(&player);
    catch_end(&c);
    assert_int_equal(opened, 0);
    assert_int_equal(drawn, 0);
    assert_int_equal(closed, 0);
    assert_string_equal(c.text, "");
}

static void a_complaint_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct player player;
    struct caught c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    v.board.spi_hz = 200000000; /* far above what an ST7789 takes */
    v.board.over_limit = false;
    const struct player_setup setup = setup_of(&v.board);
    catch_begin(&c);
    const int opened = player_open(&player, &setup), drawn = player_frame(&player, 0), closed = player_close(&player);
    catch_end(&c);
    assert_int_equal(opened, 0);
    assert_int_equal(drawn, 0);
    assert_int_equal(closed, 1);
    assert_non_null(strstr(c.text, "display controller: "));
    assert_int_equal(lines_of(c.text), 1);
}

static void a_bus_that_fails_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct player player;
    struct caught c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    const struct player_setup setup = setup_of(&v.board);
    assert_int_equal(player_open(&player, &setup), 0);
    sim_fault(player.sim, SIM_FAULT_WRITE, 5);
    catch_begin(&c);
    const int drawn = player_frame(&player, 3);
    catch_end(&c);
    player_close(&player);
    assert_int_equal(drawn, 1);
    assert_non_null(strstr(c.text, "frame 3"));
    assert_int_equal(lines_of(c.text), 1);
}

static void a_camera_without_a_volume_is_one_line_and_a_failure(void **state)
{
    struct sim_virtual v;
    struct player player;
    struct caught c;
    (void)state;
    assert_int_equal(sim_virtual(&v, 32, 24), 0);
    struct player_setup setup = setup_of(&v.board);
    setup.camera.projection_set = true; /* and all zeros */
    assert_int_equal(player_open(&player, &setup), 0);
    catch_begin(&c);
    const int drawn = player_frame(&player, 0);
    catch_end(&c);
    player_close(&player);
    assert_int_equal(drawn, 1);
    assert_int_equal(lines_of(c.text), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_kit_that_is_used_well_is_silent),
        cmocka_unit_test(a_complaint_is_one_line_and_a_failure),
        cmocka_unit_test(a_bus_that_fails_is_one_line_and_a_failure),
        cmocka_unit_test(a_camera_without_a_volume_is_one_line_and_a_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
