/* panel_show, the loop of pinhole-panel, on simulated kits: what is seen, how it ends, what it says; panel_probe. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "stderr_capture.h"
#include "complain.h"
#include "panel_probe.h"
#include "panel_show.h"
#include "self_test.h"
#include "sim.h"
#include "status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *no_words(const void *context)
{
    return context;
}

static void plug(struct panel_display *d, const struct board *board, struct sim **sim)
{
    memset(d, 0, sizeof *d);
    d->board = board;
    *sim = sim_open(board, &d->hal);
    assert_non_null(*sim);
    d->why = no_words;
    d->why_context = "";
}

static struct panel_scene scene_of(uint32_t frames, const volatile sig_atomic_t *stop)
{
    return (struct panel_scene){.demo = demo_find("torus"), .frames = frames, .stop = stop};
}

static bool is_dark(const struct sim *sim, const struct board *board)
{
    static uint8_t rgb[3 * 240 * 320], black[sizeof rgb];
    sim_pixels(sim, board->rotation, rgb);
    return memcmp(rgb, black, 3U * board->panel->width * board->panel->height) == 0;
}

static void a_run_shows_its_frames_and_ends_dark(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    static struct panel_display d;
    struct sim *sim;
    const struct board *board = &board_rpi_waveshare_1in44;
    plug(&d, board, &sim);
    struct panel_scene scene = scene_of(3, &stop);
    assert_int_equal(panel_show_run(&d, 1, &scene), 0);
    assert_in_range(sim_counters(sim).pixels, 3 * 128 * 128, 3 * 128 * 128);
    assert_int_equal(sim_complaint_count(sim), 0);
    assert_true(is_dark(sim, board));
    sim_close(sim);
}

struct stopper {
    volatile sig_atomic_t stop;
    uint32_t at, seen;
};

static int stop_at(void *context, struct panel_display *display, uint32_t frame)
{
    struct stopper *s = context;
    (void)display;
    s->seen++;
    s->stop = frame >= s->at;
    return 0;
}

static void a_signal_ends_it_after_the_frame(void **state)
{
    (void)state;
    static struct panel_display d[2];
    struct sim *sim[2];
    struct stopper stopper = {.at = 4};
    plug(&d[0], &board_rpi_waveshare_1in44, &sim[0]);
    plug(&d[1], &board_rpi_mini_pitft_1in14, &sim[1]);
    struct panel_scene scene = scene_of(0, &stopper.stop);
    scene.before = stop_at;
    scene.before_context = &stopper;
    scene.fps = 1000;
    scene.diff = true;
    assert_int_equal(panel_show_run(d, 2, &scene), 0);
    assert_int_equal(stopper.seen, 2 * 5);
    for (int i = 0; i < 2; i++) {
        assert_true(is_dark(sim[i], d[i].board));
        assert_int_equal(sim_complaint_count(sim[i]), 0);
        sim_close(sim[i]);
    }
}

/* What the time of clips is in each frame, and when each began. */
struct timer {
    volatile sig_atomic_t stop;
    uint64_t start_ns, began_ns[6];
    bool by_clock;
};

static int tell_time(void *context, struct panel_display *display, uint32_t frame)
{
    struct timer *t = context;
    const struct demo_clock clock = display->runner.clock;
    const double us = 1e6 * (clock.seconds + clock.part / 65536.), rounding = 30;
    t->began_ns[frame] = panel_show_now_ns();
    t->by_clock = display->runner.context.clip_fps == DEMO_CLIPS_BY_CLOCK;
    if (frame > 0) { /* it was read between this call and the one before */
        assert_true(us >= (double)(t->began_ns[frame - 1] - t->began_ns[0]) / 1000 - rounding);
    }
    assert_true(us <= (double)(t->began_ns[frame] - t->start_ns) / 1000 + rounding);
    t->stop = frame == 5;
    return 0;
}

static void clips_run_by_the_clock_unless_frames_are_counted(void **state)
{
    (void)state;
    for (uint32_t frames = 0; frames <= 6; frames += 6) {
        static struct panel_display d[2];
        struct sim *sim[2];
        struct timer timer = {.start_ns = panel_show_now_ns()};
        plug(&d[0], &board_rpi_waveshare_1in44, &sim[0]);
        plug(&d[1], &board_rpi_waveshare_1in44, &sim[1]);
        struct panel_scene scene = scene_of(frames, &timer.stop);
        scene.before = tell_time;
        scene.before_context = &timer;
        scene.fps = 100;
        assert_int_equal(panel_show_run(d, 2, &scene), 0);
        assert_int_equal(timer.by_clock, frames == 0);
        assert_true(timer.began_ns[5] - timer.began_ns[0] >= 40000000);
        assert_int_equal(d[0].runner.clock.part, d[1].runner.clock.part); /* what they show goes together */
        sim_close(sim[0]);
        sim_close(sim[1]);
    }
}

/* Wherever the wire fails: one line, and the panel is dark if its last commands get through. */
static void an_error_ends_it_dark(void **state)
{
    (void)state;
    static struct panel_display d;
    volatile sig_atomic_t stop = 0;
    for (uint32_t n = 1; n < 200; n += 13) {
        struct sim *sim;
        plug(&d, &board_rpi_waveshare_1in44, &sim);
        sim_fault(sim, SIM_FAULT_WRITE, n);
        struct panel_scene scene = scene_of(100, &stop);
        scene.diff = n % 2 == 0;
        struct stderr_capture c;
        stderr_capture_begin(&c);
        const int status = panel_show_run(&d, 1, &scene);
        stderr_capture_end(&c);
        assert_int_equal(status, COMPLAINED);
        assert_int_equal(stderr_capture_lines(&c), 1);
        assert_true(is_dark(sim, d.board));
        sim_close(sim);
    }
}

static struct sim_counters counters_of(const struct panel_scene *scene, struct panel_display *d)
{
    struct sim *sim;
    plug(d, &board_rpi_waveshare_1in44, &sim);
    assert_int_equal(panel_show_run(d, 1, scene), 0);
    const struct sim_counters counters = sim_counters(sim);
    sim_close(sim);
    return counters;
}

static void each_setting_has_its_effect(void **state)
{
    (void)state;
    static struct panel_display d;
    const uint64_t pixels = 128 * 128;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(2, &stop);
    scene.band = 128;
    scene.depth = (struct option_depth){PH_DEPTH_FLOAT24, 5};
    const uint32_t writes = counters_of(&scene, &d).writes;
    assert_ptr_equal(d.runner.renderer.stats.depth_format, PH_DEPTH_FLOAT24);
    assert_int_equal(d.runner.renderer.stats.depth_exponent, 5);
    scene.band = 8;
    scene.depth = (struct option_depth){PH_DEPTH_FIXED16, 0};
    assert_int_equal(counters_of(&scene, &d).writes, writes + 2 * 15); /* 16 bands a frame for one */
    assert_ptr_equal(d.runner.renderer.stats.depth_format, PH_DEPTH_FIXED16);
    scene.demo = demo_find("testcard"); /* nothing moves */
    assert_int_equal(counters_of(&scene, &d).pixels, 2 * pixels);
    scene.diff = true;
    assert_int_equal(counters_of(&scene, &d).pixels, pixels);
    scene.refresh = 1;
    assert_int_equal(counters_of(&scene, &d).pixels, 2 * pixels);
    scene.fps = 20;
    const uint64_t start_ns = panel_show_now_ns();
    counters_of(&scene, &d);
    assert_true(panel_show_now_ns() - start_ns >= 50000000); /* between the two frames */
}

/* Behind each frame of one a second a memory LCD's VCOM is toggled once more: mode, trailer, and the byte behind. */
static void a_still_picture_is_held(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    static struct panel_display d;
    struct panel_scene scene = scene_of(2, &stop);
    uint64_t bytes[2];
    for (uint32_t i = 0; i < 2; i++) {
        struct sim *sim;
        plug(&d, &board_sim_ls013b7dh03_128x128, &sim);
        scene.fps = 2 - i;
        assert_int_equal(panel_show_run(&d, 1, &scene), 0);
        assert_int_equal(sim_complaint_count(sim), 0);
        bytes[i] = sim_counters(sim).bytes;
        sim_close(sim);
    }
    assert_int_equal(bytes[1] - bytes[0], 2 * 3);
}

static void controllers_are_named_by_their_bytes(void **state)
{
    (void)state;
    /* As the datasheets say: a dummy clock, then 24 bits; and as some drivers found: a dummy byte. */
    const struct panel_answers st7789 = {{0x42, 0xC2, 0xA9, 0x00, 0x00}, {0}};
    const struct panel_answers st7789_byte = {{0x00, 0x85, 0x85, 0x52, 0x00}, {0}};
    const struct panel_answers ili9341 = {{0}, {0x00, 0x00, 0x93, 0x41, 0x00}};
    const struct panel_answers ili9488 = {{0}, {0x00, 0x4A, 0x44, 0x00, 0x00}};
    const struct panel_answers st7735s = {{0x7C, 0x89, 0xF0, 0x00, 0x00}, {0}};
    const struct panel_answers gc9a01 = {{0x00, 0x00, 0x9A, 0x01, 0x00}, {0}};
    const struct panel_answers silent = {{0}, {0}}, floating = {{255, 255, 255, 255, 255}, {255, 255, 255, 255, 255}};
    const struct panel_answers other = {{0x12, 0x34, 0x56, 0x78, 0x9A}, {0}};
    assert_string_equal(panel_probe_name(&st7789), "ST7789");
    assert_string_equal(panel_probe_name(&st7789_byte), "ST7789");
    assert_string_equal(panel_probe_name(&ili9341), "ILI9341");
    assert_string_equal(panel_probe_name(&ili9488), "ILI9488");
    assert_string_equal(panel_probe_name(&st7735s), "ST7735S");
    assert_string_equal(panel_probe_name(&gc9a01), "GC9A01");
    assert_null(panel_probe_name(&silent));
    assert_null(panel_probe_name(&floating));
    assert_null(panel_probe_name(&other));
    assert_false(panel_probe_answered(&silent));
    assert_false(panel_probe_answered(&floating));
    assert_true(panel_probe_answered(&other));
}

/* ---- report ------------------------------------------------------------------------------------- */

static char report_text[2000];
static const struct sim *looked_at;
static uint8_t card[3 * 128 * 128];

static void put_text(const char *text)
{
    strncat(report_text, text, sizeof report_text - strlen(report_text) - 1);
}

static void look(struct panel_driver *driver)
{
    assert_string_equal(driver->config.panel->name, "st7735s-128x128");
    sim_pixels(looked_at, board_rpi_waveshare_1in44.rotation, card);
}

/* A kit whose clock and lines are this test's. */
static struct {
    const struct hal_ops *real;
    struct hal_ops ops;
    struct board board;
    uint32_t us, edge_us, missing; /* time; between two edges of TE; the edge of that number does not come */
    uint32_t write_us, clock_hz, read_hz;
    int read_status;
    bool breaks, broken; /* the bus, once the facts are told */
} kit;

static void facts(const void *context, self_test_put *put)
{
    put(context);
    kit.broken = kit.breaks;
    put("\n");
}

static const struct self_test_machine machine = {
    .build = "a test", .frames = 1234, .facts = facts, .why = no_words, .context = "chip of this test"};

static uint32_t kit_time(void *context)
{
    (void)context;
    return kit.us;
}

static int kit_edge(void *context, uint32_t timeout_us)
{
    (void)context;
    const bool comes = kit.edge_us <= timeout_us && --kit.missing != 0;
    kit.us += comes ? kit.edge_us : timeout_us;
    return comes ? HAL_OK : HAL_ETIMEDOUT;
}

static int kit_read(void *context, uint8_t command, uint8_t *bytes, size_t n)
{
    static const uint8_t answer[] = {0x00, 0x7C, 0x89, 0xF0, 0xFF};
    (void)context;
    assert_int_equal(command, 0x04);
    assert_int_equal(n, sizeof answer);
    memcpy(bytes, answer, n);
    kit.read_hz = kit.clock_hz;
    return kit.read_status;
}

static int32_t kit_clock(void *context, uint32_t hz)
{
    kit.clock_hz = hz;
    return kit.real->bus_clock(context, hz);
}

static int kit_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    kit.us += kit.write_us;
    if (kit.broken) {
        return HAL_EIO;
    }
    return kit.real->bus_write(context, dc, bytes, n);
}

static int report(struct panel_scene *scene, bool own)
{
    static struct panel_display d;
    struct sim *sim;
    plug(&d, &board_rpi_waveshare_1in44, &sim);
    if (own) {
        kit.real = d.hal.ops;
        kit.ops = *d.hal.ops;
        kit.ops.te_wait = kit_edge;
        kit.ops.bus_read = kit_read;
        kit.ops.time_us = kit_time;
        kit.ops.bus_clock = kit_clock;
        kit.ops.bus_write = kit_write;
        d.hal.ops = &kit.ops;
        d.board = &kit.board;
    }
    looked_at = sim;
    report_text[0] = '\0';
    const int status = panel_show_report(&d, scene, &machine, put_text, look);
    assert_true(is_dark(sim, &board_rpi_waveshare_1in44));
    sim_close(sim);
    return status;
}

static void assert_line(const char *line)
{
    char text[200];
    snprintf(text, sizeof text, "\n%s\n", line);
    if (strstr(report_text, text) == NULL) {
        fail_msg("no '%s' in:\n%s", line, report_text);
    }
}

static void a_report_has_known_frames_and_shows_the_card(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    assert_int_equal(report(&scene, false), 0);
    assert_line("Pinhole " PH_VERSION ", a test");
    assert_line("kit Raspberry Pi with Waveshare 1.44inch LCD HAT, 128x128");
    assert_line("chip of this test");
    assert_line("display st7735s-128x128, 128x128, turned 90, bus 9000000 Hz");
    assert_line("display id: MISO is not wired");
    assert_line("TE: not wired");
    assert_line("left out: 0 triangles 0 vertices; sent before the report: 1234 frames");
    assert_line("cube 128x128 crc32 E6A27136, as known");
    assert_line("testcard 128x128 crc32 50FC6910, as known\nself-test: passed");
    assert_non_null(strstr(report_text, "\ncompiler gcc "));
    uint32_t lit = 0;
    for (size_t i = 0; i < sizeof card; i += 3) {
        lit += card[i] != 0 || card[i + 1] != 0 || card[i + 2] != 0;
    }
    assert_in_range(lit, 1000, 128 * 128);
}

static void a_report_can_be_pasted(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    assert_int_equal(report(&scene, false), 0);
    size_t width = 0;
    for (const char *c = report_text; *c != '\0'; c++) {
        assert_true(*c == '\n' || (*c >= ' ' && *c <= '~'));
        width = *c == '\n' ? 0 : width + 1;
        assert_true(width < 80);
    }
    assert_int_equal(strncmp(report_text, "---- Pinhole report: copy from here ----\n", 41), 0);
    assert_string_equal(strrchr(report_text, 'P'), "Pinhole report: to here ----\n");
}

/* 128 lines in bands of 16 are 8 writes, and the window takes some more: all take 1 ms here. */
static void a_report_tells_what_lines_and_bus_do(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    memset(&kit, 0, sizeof kit);
    kit.board = board_rpi_waveshare_1in44;
    kit.board.pins.tearing.wired = kit.board.pins.data_in.wired = true;
    kit.edge_us = 16400;
    kit.write_us = 1000;
    assert_int_equal(report(&scene, true), 0);
    assert_line("display id: 04h gives 00 7C 89 F0 FF");
    assert_int_equal(kit.read_hz, board_rpi_waveshare_1in44.panel->controller->init_hz);
    assert_int_equal(kit.clock_hz, board_rpi_waveshare_1in44.spi_hz);
    assert_line("TE: 60.9 edges/s, missed before 0");
    const char *frame = strstr(report_text, "\nwhole frame: ");
    assert_non_null(frame);
    const unsigned long us = strtoul(frame + 14, NULL, 10);
    assert_true(us % 1000 == 0 && us >= 8000 && us <= 20000);
}

static void a_report_tells_of_a_silent_or_unsteady_te(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    memset(&kit, 0, sizeof kit);
    kit.board = board_rpi_waveshare_1in44;
    kit.board.pins.tearing.wired = true;
    kit.edge_us = 60000;
    kit.write_us = 100000;
    assert_int_equal(report(&scene, true), 0);
    assert_line("TE: no edge in 50 ms");
    kit.edge_us = 20000;
    const uint32_t waits = 2 * 17 + 30; /* more than the frames before it wait for */
    bool unsteady = false;
    for (uint32_t n = 1; n < waits && !unsteady; n++) {
        kit.missing = n;
        assert_int_equal(report(&scene, true), 0);
        unsteady = strstr(report_text, "\nTE: edges come, but not always\n") != NULL;
    }
    assert_true(unsteady);
}

static void a_report_tells_why_it_did_not_end(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    static struct stderr_capture said;
    memset(&kit, 0, sizeof kit);
    kit.board = board_rpi_waveshare_1in44;
    kit.board.pins.data_in.wired = true;
    kit.write_us = 100000;
    kit.read_status = HAL_EIO;
    assert_int_equal(report(&scene, true), 0);
    assert_line("display id: cannot be read, error 5");
    kit.breaks = true;
    stderr_capture_begin(&said);
    const int status = report(&scene, true);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_line("self-test: did not end, error 5\nerror: chip of this test");
    assert_non_null(strstr(report_text, "---- Pinhole report: to here ----\n"));
}

static void a_report_says_that_a_picture_is_not_the_known_one(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 0;
    struct panel_scene scene = scene_of(1, &stop);
    scene.overlay = true; /* other pixels */
    static struct stderr_capture said;
    stderr_capture_begin(&said);
    const int status = report(&scene, false);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_non_null(strstr(said.text, "rpi-waveshare-1in44: the picture is not the known one"));
    assert_non_null(strstr(report_text, ", but known is E6A27136\n"));
    assert_non_null(strstr(report_text, "\nself-test: FAILED\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_report_has_known_frames_and_shows_the_card),
        cmocka_unit_test(a_report_can_be_pasted),
        cmocka_unit_test(a_report_tells_what_lines_and_bus_do),
        cmocka_unit_test(a_report_tells_of_a_silent_or_unsteady_te),
        cmocka_unit_test(a_report_tells_why_it_did_not_end),
        cmocka_unit_test(a_report_says_that_a_picture_is_not_the_known_one),
        cmocka_unit_test(a_run_shows_its_frames_and_ends_dark),
        cmocka_unit_test(a_signal_ends_it_after_the_frame),
        cmocka_unit_test(clips_run_by_the_clock_unless_frames_are_counted),
        cmocka_unit_test(a_still_picture_is_held),
        cmocka_unit_test(controllers_are_named_by_their_bytes),
        cmocka_unit_test(an_error_ends_it_dark),
        cmocka_unit_test(each_setting_has_its_effect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
