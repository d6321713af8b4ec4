/*
 * self_test: the text of the report on a display whose every line takes 100 us to send, so that the rates are sums by
 * hand; with a panel's identification and tearing-effect edges that are there, missing, or wrong.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "self_test.h"
#include "sim.h"
#include "status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BEGIN_US 50000
#define LINE_US  100
#define EDGE_US  16000

static struct kit {
    struct sim *sim;
    struct hal below, hal;
    struct hal_ops ops;
    struct board board;
    struct runner runner;
    struct runner_config config;
    uint32_t now_us, begin_us, begins, lines, ends, forgotten;
    uint32_t edges_left, clock_hz, id_hz;
    int id_status, rows_status;
    char text[4096];
} kit;

static void put(const char *text)
{
    assert_true(strlen(kit.text) + strlen(text) < sizeof kit.text);
    assert_true(strcmp(text, "\n") == 0 || strchr(text, '\n') == NULL);
    strcat(kit.text, text);
}

static int timed_begin(void *context, struct panel_driver *d)
{
    (void)context, (void)d;
    kit.begins++;
    kit.lines = 0;
    kit.now_us += kit.begin_us;
    return HAL_OK;
}

static int timed_rows(void *context, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    (void)context, (void)d, (void)pixels;
    kit.lines += lines;
    kit.now_us += LINE_US * lines;
    return kit.rows_status;
}

static int timed_end(void *context, struct panel_driver *d)
{
    (void)context, (void)d;
    kit.ends++;
    assert_int_equal(kit.lines, kit.runner.context.height);
    return HAL_OK;
}

static void timed_forget(void *context)
{
    (void)context;
    kit.forgotten++;
}

static const struct panel_sender_ops timed_ops = {
    .begin = timed_begin, .rows = timed_rows, .end = timed_end, .forget = timed_forget};

static uint32_t kit_time(void *context)
{
    (void)context;
    return kit.now_us;
}

static int32_t kit_clock(void *context, uint32_t hz)
{
    kit.clock_hz = hz;
    return kit.below.ops->bus_clock(context, hz);
}

static int kit_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    static const uint8_t id[] = {0x00, 0x85, 0x0A, 0x52, 0xFF};
    (void)context;
    assert_int_equal(command, 0x04); /* RDDID */
    assert_int_equal(n, sizeof id);
    memcpy(bytes, id, n);
    kit.id_hz = kit.clock_hz;
    return kit.id_status;
}

static int kit_edge(void *context, uint32_t timeout_us)
{
    (void)context;
    assert_int_equal(timeout_us, 50000); /* as the report says */
    const bool comes = kit.edges_left > 0;
    kit.edges_left -= comes;
    kit.now_us += comes ? EDGE_US : timeout_us;
    return comes ? HAL_OK : HAL_ETIMEDOUT;
}

static void facts(const void *context, self_test_put *to)
{
    to(context);
    to("\n");
}

static const char *why(const void *context)
{
    (void)context;
    return "the plug is out";
}

static const struct self_test_machine machine = {"demos for a kit", 77, facts, why, "a machine of brass"};

static void open_on(const struct board *board)
{
    kit = (struct kit){.board = *board, .begin_us = BEGIN_US, .edges_left = UINT32_MAX};
    kit.board.pins.data_in = kit.board.pins.tearing = (struct board_pin){0};
    kit.sim = sim_open(board, &kit.below);
    kit.ops = *kit.below.ops;
    kit.ops.time_us = kit_time;
    kit.ops.bus_clock = kit_clock;
    kit.ops.bus_read = kit_read;
    kit.ops.te_wait = kit_edge;
    kit.hal = (struct hal){&kit.ops, kit.below.context};
    kit.config = (struct runner_config){.board = &kit.board,
                                        .depth_format = PH_DEPTH_AUTO,
                                        .rotation = board->rotation,
                                        .band_height = 16,
                                        .budget_bytes = 200000,
                                        .demo = demo_find("cube"),
                                        .sender = {.ops = &timed_ops}};
    kit.config.memory_bytes = runner_bytes(&kit.config);
    kit.config.memory = malloc(kit.config.memory_bytes);
    assert_non_null(kit.config.memory);
}

static int report(void)
{
    kit.text[0] = '\0';
    assert_int_equal(runner_open(&kit.runner, &kit.hal, &kit.config), 0);
    kit.forgotten = 0;
    return self_test_report(&kit.runner, &machine, put);
}

static void close_kit(void)
{
    sim_close(kit.sim);
    free(kit.config.memory);
}

static void assert_says(const char *line)
{
    if (strstr(kit.text, line) == NULL) {
        fail_msg("no '%s' in:\n%s", line, kit.text);
    }
}

/* 135 lines of 100 us and 50 ms are 63.5 ms a frame: the 16th ends after 1,016 ms, 15.748 a second. */
static void a_right_kit_passes_with_its_rates(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    assert_int_equal(report(), 0);
    static const char head[] =
        "---- Pinhole report: copy from here ----\nPinhole " PH_VERSION ", demos for a kit\ncompiler ";
    assert_memory_equal(kit.text, head, sizeof head - 1);
    char title[128];
    snprintf(title, sizeof title, "\nkit %s\na machine of brass\ndisplay ", kit.board.title);
    assert_says(title);
    assert_says("display st7789");
    assert_says(", 240x135, turned ");
    snprintf(title, sizeof title, "turned %d, bus %d Hz\n", 90 * kit.board.rotation, (int)kit.runner.driver.clock_hz);
    assert_says(title);
    assert_says("\nturntable, 1 core: 16 frames in 1016 ms, 15.7 frames/s\n");
    assert_says("\nleft out: 0 triangles 0 vertices; sent before the report: 77 frames\n");
    assert_says("\nwhole frame: 63500 us on the bus, ");
    snprintf(
        title, sizeof title, "on the bus, %u by its clock and bits\n",
        panel_frame_us(kit.board.panel, kit.board.format, kit.board.rotation, (uint32_t)kit.runner.driver.clock_hz));
    assert_says(title);
    assert_says("\ncube 240x135 crc32 E7B4F73C, as known\ntestcard 240x135 crc32 99FF17F2, as known\n");
    assert_says("\nself-test: passed\nwhat the glass shows");
    assert_says("---- Pinhole report: to here ----\n");
    assert_null(strstr(kit.text, "error"));
    assert_int_equal(kit.begins, 1 + 16 + 1 + 1); /* one lights it up, and the test card stays */
    assert_int_equal(kit.ends, kit.begins);
    assert_int_equal(kit.forgotten, 4); /* three demos, and before the bus is measured */
    assert_string_equal(kit.runner.demo->name, "testcard");
    for (const char *line = kit.text, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        assert_true(strncmp(line, "compiler", 8) == 0 || end - line < 80);
    }
    close_kit();
}

/* After a second no other frame is begun: 7 frames of 150 ms and 13.5 ms are 1,144.5 ms, 6.116 a second. */
static void a_slow_kit_is_measured_for_a_second(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    kit.begin_us = 150000;
    assert_int_equal(report(), 0);
    assert_says("turntable, 1 core: 7 frames in 1144 ms, 6.1 frames/s\n");
    close_kit();
}

static void pins_that_are_not_wired_are_told(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    report();
    assert_says("\ndisplay id: MISO is not wired\n");
    assert_says("\nTE: not wired\n");
    kit.board.pins.data_in = kit.board.pins.tearing = (struct board_pin)BOARD_PIN(7);
    kit.ops.bus_read = NULL;
    report();
    assert_says("\ndisplay id: this port cannot read it\n");
    close_kit();
}

static void the_id_is_read_at_the_speed_of_the_initialisation(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    kit.board.pins.data_in = (struct board_pin)BOARD_PIN(7);
    report();
    assert_says("\ndisplay id: 04h gives 00 85 0A 52 FF\n");
    assert_int_equal(kit.id_hz, kit.board.panel->controller->init_hz);
    assert_int_equal(kit.clock_hz, kit.board.spi_hz);
    kit.id_status = -5;
    report();
    assert_says("\ndisplay id: cannot be read, error 5\n");
    close_kit();
}

/* Edges 16 ms apart are 62.5 a second. The rate takes 14 frames, each of which waits for an edge: the first, and 13
 * of 63.5 and 16 ms. Then comes one edge to begin with, and eight that are timed. */
static void edges_are_timed(void **state)
{
    static const struct {
        uint32_t edges;
        const char *line;
    } cases[] = {{0, "\nTE: no edge in 50 ms\n"},
                 {14 + 1, "\nTE: no edge in 50 ms\n"},
                 {14 + 2, "\nTE: edges come, but not always\n"},
                 {14 + 8, "\nTE: edges come, but not always\n"},
                 {14 + 9, "\nTE: 62.5 edges/s, missed before 0\n"}};
    (void)state;
    open_on(board_find("pico-display"));
    kit.board.pins.tearing = (struct board_pin)BOARD_PIN(7);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        kit.edges_left = cases[i].edges;
        report();
        assert_says(cases[i].line);
    }
    close_kit();
}

static void another_picture_fails_and_says_what_is_known(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    kit.config.camera.view_set = true;
    kit.config.camera.view = ph_xform_identity;
    kit.config.camera.view.t.z = -9 * FX_ONE;
    const int bad = report();
    assert_in_range(bad, 1, 2);
    assert_says("\ncube 240x135 crc32 ");
    assert_says(", but known is E7B4F73C\n");
    assert_int_equal(bad == 2, strstr(kit.text, ", but known is 99FF17F2\n") != NULL);
    assert_says("\nself-test: FAILED\n");
    close_kit();
}

/* A size has to be known in both directions: others are 240 high or 240 wide. */
static void a_size_that_is_not_known_passes(void **state)
{
    static const uint16_t sizes[2][2] = {{240, 136}, {136, 240}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct sim_virtual other;
        char line[96];
        assert_int_equal(sim_virtual(&other, sizes[i][0], sizes[i][1]), 0);
        open_on(&other.board);
        assert_int_equal(report(), 0);
        snprintf(line, sizeof line, ", none is known for this size\ntestcard %ux%u crc32 ", sizes[i][0], sizes[i][1]);
        assert_says(line);
        close_kit();
    }
}

static void an_error_ends_the_test_and_is_told(void **state)
{
    (void)state;
    open_on(board_find("pico-display"));
    kit.rows_status = -5;
    assert_int_equal(report(), -5);
    assert_says("\nself-test: did not end, error 5\nerror: the plug is out\n");
    assert_null(strstr(kit.text, "crc32"));
    close_kit();
}

static void numbers_have_the_digits_asked_for(void **state)
{
    static const struct {
        uint32_t value, digits;
        bool hex;
        const char *text;
    } cases[] = {{0, 1, false, "0"},   {7, 2, false, "07"},         {4294967295, 1, false, "4294967295"},
                 {0, 0, false, ""},    {0xAB, 8, true, "000000AB"}, {0xFFFFFFFF, 2, true, "FFFFFFFF"},
                 {10, 1, false, "10"}, {1234, 4, false, "1234"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        kit.text[0] = '\0';
        self_test_number(put, cases[i].value, cases[i].hex, cases[i].digits);
        assert_string_equal(kit.text, cases[i].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_right_kit_passes_with_its_rates),
        cmocka_unit_test(a_slow_kit_is_measured_for_a_second),
        cmocka_unit_test(pins_that_are_not_wired_are_told),
        cmocka_unit_test(the_id_is_read_at_the_speed_of_the_initialisation),
        cmocka_unit_test(edges_are_timed),
        cmocka_unit_test(another_picture_fails_and_says_what_is_known),
        cmocka_unit_test(a_size_that_is_not_known_passes),
        cmocka_unit_test(an_error_ends_the_test_and_is_told),
        cmocka_unit_test(numbers_have_the_digits_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
