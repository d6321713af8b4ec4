/*
 * panel_diff on every panel, rotation and format: the model's glass shows the same picture as after a whole frame. The
 * bytes on the wire are the predicted ones, and few more than an exhaustive search finds.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "cover_search.h"
#include "panel_diff.h"
#include "panel_picture.h"
#include "panels.h"
#include "sim_player.h"
#include "spy_hal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint16_t picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

/* A panel on the simulator, on request with the spy between. */
struct rig {
    struct board board;
    struct sim *sim;
    struct hal hal;
    struct spy spy;
    struct panel_driver d;
    struct panel_diff diff;
    void *memory;
    uint8_t scratch[512];
};

static void rig_open(struct rig *rig, const struct panel *panel, unsigned rotation, unsigned format, bool spied)
{
    rig->board = (struct board){.name = "test",
                                .panel = panel,
                                .spi_hz = panel->controller->write_hz,
                                .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}};
    rig->sim = sim_open(&rig->board, &rig->hal);
    assert_non_null(rig->sim);
    if (spied) {
        rig->spy = (struct spy){.sim = rig->hal};
        rig->hal = (struct hal){&spy_ops, &rig->spy};
    }
    const struct panel_config config = {panel,        (uint8_t)rotation,  (uint8_t)format, rig->board.spi_hz,
                                        rig->scratch, sizeof rig->scratch};
    assert_int_equal(panel_open(&rig->d, &rig->hal, &config), 0);
    const size_t bytes = panel_diff_bytes(rig->d.width, rig->d.height);
    rig->memory = malloc(bytes);
    assert_int_equal(panel_diff_init(&rig->diff, &rig->d, 0, rig->memory, bytes - 1), HAL_EINVAL);
    assert_int_equal(panel_diff_init(&rig->diff, &rig->d, 0, rig->memory, bytes), 0);
}

#define WRITE_BYTES 50 /* what slow_write_ns are on a bus of 62.5 MHz */

static uint32_t slow_write_ns(void *context)
{
    (void)context;
    return 8 * WRITE_BYTES * 16;
}

/* From now on each write counts as WRITE_BYTES. */
static void make_writes_slow(struct rig *rig, struct hal_ops *ops)
{
    *ops = *rig->d.hal.ops;
    ops->write_ns = slow_write_ns;
    rig->d.hal.ops = ops;
    assert_int_equal(
        panel_diff_init(&rig->diff, &rig->d, 0, rig->memory, panel_diff_bytes(rig->d.width, rig->d.height)), 0);
}

static void rig_close(struct rig *rig, const char *what)
{
    assert_int_equal(panel_close(&rig->d), 0);
    picture_no_complaint(rig->sim, what);
    sim_close(rig->sim);
    free(rig->memory);
}

/* Sends the picture `lines` lines at a time, from a buffer that is spoilt as soon as it is the caller's again. */
static int show(struct rig *rig, uint32_t lines)
{
    static uint16_t band[PICTURE_PIXELS];
    int status = panel_diff_begin(&rig->diff, &rig->d);
    for (uint32_t y = 0; y < rig->d.height && status >= 0; y += lines) {
        const uint32_t n = rig->d.height - y < lines ? rig->d.height - y : lines;
        memcpy(band, picture + y * rig->d.width, sizeof *band * n * rig->d.width);
        status = panel_diff_rows(&rig->diff, &rig->d, band, n);
        memset(band, 0x5A, sizeof *band * n * rig->d.width);
    }
    const int ended = panel_diff_end(&rig->diff, &rig->d);
    return status < 0 ? status : ended;
}

static void check_seen(struct rig *rig, const char *what)
{
    const struct panel_config *c = &rig->d.config;
    sim_pixels(rig->sim, c->rotation, seen);
    picture_expect(picture, rig->d.width, rig->d.height, c->format, c->panel->round, expected);
    picture_compare(seen, expected, rig->d.width, rig->d.height, what);
}

static uint32_t random_state;

static uint32_t draw(uint32_t below)
{
    random_state = random_state * 1664525U + 1013904223U;
    return (uint32_t)((uint64_t)random_state * below >> 32);
}

/* Boxes, lines and dots of noise, some of them only in the lowest bits; at step 3 nothing, at step 5 everything. */
static void change(uint32_t width, uint32_t height, uint32_t step)
{
    if (step == 0 || step == 5) {
        picture_fill(picture, width, height, step);
        return;
    }
    for (uint32_t i = 0; i < 12 && step != 3; i++) {
        const uint32_t w = 1 + draw(i % 3 == 0 ? width : 3), h = 1 + draw(i % 3 == 1 ? height : 3);
        const uint32_t x0 = draw(width), y0 = draw(height);
        for (uint32_t y = y0; y < y0 + h && y < height; y++) {
            for (uint32_t x = x0; x < x0 + w && x < width; x++) {
                picture[y * width + x] ^= (uint16_t)(i == 11 ? 0x0100 : draw(0x10000));
            }
        }
    }
}

enum bus { PLAIN, SPIED, SLOW };

static void show_sequence(const struct panel *panel, unsigned rotation, unsigned format, uint32_t lines, enum bus bus)
{
    static struct rig rig;
    struct hal_ops slow_ops;
    char what[100];
    random_state = lines + 10 * rotation;
    rig_open(&rig, panel, rotation, format, bus == SPIED);
    if (bus == SLOW) {
        make_writes_slow(&rig, &slow_ops);
    }
    for (uint32_t step = 0; step < 8; step++) {
        snprintf(what, sizeof what, "%s, rotation %u, format %u, %u lines, step %u", panel->name, rotation * 90, format,
                 lines, step);
        change(rig.d.width, rig.d.height, step);
        rig.spy.count = 0;
        const uint64_t before = sim_counters(rig.sim).bytes;
        assert_int_equal(show(&rig, lines), 0);
        const uint64_t bytes = sim_counters(rig.sim).bytes - before;
        check_seen(&rig, what);
        if (step > 0) { /* the first frame also turns the display on */
            assert_int_equal(bytes, rig.diff.bytes);
        }
        assert_int_equal(rig.d.frame_bytes, rig.diff.bytes);
        if (step == 3) {
            assert_int_equal(bytes, panel->controller->lines != NULL ? 3 : 0); /* a memory LCD's VCOM is toggled */
        }
    }
    rig_close(&rig, what);
}

static void every_panel_shows_the_exact_picture_in_every_rotation_and_format(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            for (unsigned format = PANEL_RGB565; format < PANEL_FORMATS; format++) {
                if (panel_can_turn(panel_list[i], rotation) && panel_list[i]->formats & PANEL_FORMAT_BIT(format)) {
                    show_sequence(panel_list[i], rotation, format, 60, PLAIN);
                }
            }
        }
    }
}

static void the_picture_is_exact_where_writes_cost_time(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const unsigned format = (unsigned)__builtin_ctz(panel_list[i]->formats);
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            if (panel_can_turn(panel_list[i], rotation)) {
                show_sequence(panel_list[i], rotation, format, 60, SLOW);
            }
        }
    }
}

static void any_number_of_lines_at_a_time_will_do(void **state)
{
    (void)state;
    static const uint32_t lines[] = {1, 7, 32, 33, 240};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            show_sequence(&panel_ssd0323_128x64, rotation, PANEL_GREY4, lines[i], PLAIN);
            show_sequence(&panel_sh1106_128x64, rotation, PANEL_MONO_DITHER, lines[i], PLAIN);
            show_sequence(&panel_sh1107_64x128, rotation, PANEL_MONO_DITHER, lines[i], PLAIN);
        }
        show_sequence(&panel_st7789_135x240, PANEL_R90, PANEL_RGB565, lines[i], PLAIN);
        show_sequence(&panel_st7735s_80x160, PANEL_R0, PANEL_RGB444, lines[i], PLAIN);
        show_sequence(&panel_ls013b7dh03_128x128, PANEL_R180, PANEL_MONO_DITHER, lines[i], PLAIN);
    }
}

/* Pixels that share a byte with one beside the glass. */
static void odd_greys_are_exact_too(void **state)
{
    (void)state;
    struct panel panel = panel_ssd0323_128x64;
    panel.width = 127;
    for (unsigned rotation = 0; rotation < 4; rotation++) {
        static struct rig rig;
        static uint8_t whole[3 * 128 * 64];
        rig_open(&rig, &panel, rotation, PANEL_GREY4, false);
        random_state = rotation;
        for (uint32_t step = 0; step < 8; step++) {
            change(rig.d.width, rig.d.height, step);
            assert_int_equal(show(&rig, 10), 0);
            sim_pixels(rig.sim, rotation, seen);
            assert_int_equal(picture_draw(&rig.d, picture, 9), 0); /* all of it, as without panel_diff */
            sim_pixels(rig.sim, rotation, whole);
            assert_memory_equal(seen, whole, sizeof whole);
        }
        rig_close(&rig, "odd greys");
    }
}

/* RGB444 keeps the highest four bits of each colour, of five, six and five. */
static void what_the_glass_does_not_show_is_not_sent(void **state)
{
    static const unsigned formats[] = {PANEL_RGB565, PANEL_RGB444};
    (void)state;
    for (int i = 0; i < 2; i++) {
        static struct rig rig;
        rig_open(&rig, &panel_st7735s_80x160, PANEL_R0, formats[i], false);
        memset(picture, 0, sizeof picture);
        assert_int_equal(show(&rig, 160), 0);
        for (int bit = 0; bit < 16; bit++) { /* of a pixel as it is on the wire: red, green, blue */
            const bool dropped = bit == 11 || bit == 6 || bit == 5 || bit == 0;
            ((uint8_t *)&picture[80 * bit + bit])[bit < 8] ^= (uint8_t)(1 << bit % 8);
            assert_int_equal(show(&rig, 160), 0);
            assert_int_equal(rig.diff.windows, formats[i] == PANEL_RGB565 || !dropped);
        }
        rig_close(&rig, "dropped bits");
    }
}

static void no_buffer_is_touched_before_it_is_sent(void **state)
{
    (void)state;
    for (unsigned rotation = 0; rotation < 4; rotation++) {
        show_sequence(&panel_st7735s_80x160, rotation, PANEL_RGB565, 20, SPIED);
        show_sequence(&panel_st7735s_80x160, rotation, PANEL_RGB666, 20, SPIED);
        show_sequence(&panel_ssd1351_128x128, rotation, PANEL_RGB565, 16, SPIED);
        show_sequence(&panel_ssd0323_128x64, rotation, PANEL_GREY4, 5, SPIED);
        show_sequence(&panel_ssd1306_128x64, rotation, PANEL_MONO_DITHER, 5, SPIED);
    }
    show_sequence(&panel_ls027b7dh01_400x240, PANEL_R0, PANEL_MONO_DITHER, 20, SPIED);
}

static void a_frame_in_which_all_changes_costs_at_most_one_percent_more(void **state)
{
    (void)state;
    static struct rig rig;
    for (uint32_t lines = 1; lines <= 240; lines = 3 * lines + 1) {
        rig_open(&rig, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565, false);
        for (uint32_t step = 0; step < 3; step++) {
            picture_fill(picture, 240, 240, step);
            for (uint32_t i = 0; i < 240 * 240; i++) { /* no pixel stays by chance */
                picture[i] = (uint16_t)((picture[i] & 0xFFFC) | step);
            }
            assert_int_equal(show(&rig, lines), 0);
            assert_in_range(rig.diff.bytes, 2 * 240 * 240, 2 * 240 * 240 * 101 / 100);
        }
        rig_close(&rig, "all changes");
    }
}

static void all_is_sent_again_every_so_many_frames(void **state)
{
    (void)state;
    static struct rig rig;
    rig_open(&rig, &panel_st7735s_80x160, PANEL_R0, PANEL_RGB565, false);
    rig.diff.refresh_frames = 4;
    picture_fill(picture, 80, 160, 1);
    for (uint32_t frame = 0; frame < 12; frame++) {
        assert_int_equal(show(&rig, 16), 0);
        assert_int_equal(rig.diff.bytes, frame % 4 == 0 ? panel_frame_bytes(&panel_st7735s_80x160, 0, 0) : 0);
    }
    rig_close(&rig, "refresh");
}

/* Wherever the wire fails, the next frame is right. */
static void after_an_error_the_next_frame_is_whole(void **state)
{
    (void)state;
    static struct rig rig;
    for (uint32_t n = 1; n < 30; n++) {
        rig_open(&rig, &panel_st7735s_80x160, PANEL_R90, PANEL_RGB565, false);
        random_state = n;
        change(160, 80, 0);
        assert_int_equal(show(&rig, 16), 0);
        change(160, 80, 1);
        sim_fault(rig.sim, SIM_FAULT_WRITE, n);
        const int status = show(&rig, 16);
        sim_fault(rig.sim, SIM_FAULT_NONE, 0);
        change(160, 80, 2);
        assert_int_equal(show(&rig, 16), 0);
        assert_int_equal(status, HAL_EIO);
        assert_int_equal(rig.diff.bytes, panel_frame_bytes(&panel_st7735s_80x160, 0, 1));
        check_seen(&rig, "after an error");
        panel_close(&rig.d);
        sim_close(rig.sim);
        free(rig.memory);
    }
}

static void wrong_use_is_refused(void **state)
{
    (void)state;
    static struct rig rig;
    rig_open(&rig, &panel_st7735s_80x160, PANEL_R0, PANEL_RGB565, false);
    assert_int_equal(panel_diff_begin(&rig.diff, &rig.d), 0);
    assert_int_equal(panel_diff_rows(&rig.diff, &rig.d, picture, 161), HAL_EINVAL);
    assert_int_equal(panel_diff_end(&rig.diff, &rig.d), HAL_EINVAL); /* lines are missing */
    assert_int_equal(panel_window(&rig.d, 0, 0, 81, 1), HAL_EINVAL);
    assert_int_equal(panel_window(&rig.d, 80, 0, 1, 1), HAL_EINVAL);
    assert_int_equal(panel_window(&rig.d, 0, 159, 1, 2), HAL_EINVAL);
    assert_int_equal(panel_window(&rig.d, 0, 0, 0, 1), HAL_EINVAL);
    assert_int_equal(panel_window_rows(&rig.d, picture, 80, 1), HAL_EINVAL);
    rig_close(&rig, "wrong use");
    rig_open(&rig, &panel_ssd0323_128x64, PANEL_R0, PANEL_GREY4, false);
    assert_int_equal(panel_window(&rig.d, 1, 0, 3, 1), HAL_EINVAL); /* in the middle of a byte */
    assert_int_equal(panel_window(&rig.d, 2, 1, 2, 1), 0);
    panel_close(&rig.d);
    sim_close(rig.sim);
    free(rig.memory);
}

static uint32_t flushes;

static void count_flush(void *context)
{
    (void)context;
    flushes++;
}

/* A backend that keeps bytes back (hal.h) is told when a frame or a window is complete. */
static void the_end_of_each_window_is_flushed(void **state)
{
    (void)state;
    static struct rig rig;
    rig_open(&rig, &panel_st7735s_80x160, PANEL_R0, PANEL_RGB666, false);
    struct hal_ops ops = *rig.d.hal.ops;
    const struct hal_ops *plain = rig.d.hal.ops;
    ops.bus_flush = count_flush;
    rig.d.hal.ops = &ops;
    for (uint32_t step = 0; step < 8; step++) {
        change(80, 160, step);
        flushes = 0;
        assert_int_equal(show(&rig, 20), 0);
        assert_int_equal(flushes, rig.diff.windows); /* a whole frame is one */
    }
    rig.d.hal.ops = plain;
    rig_close(&rig, "flushes");
}

/* ---- how few bytes -------------------------------------------------------------------------------- */

#define SIDE 40

static void take_picture(const struct sim_player *p)
{
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint8_t *rgb = p->picture.rgb + 3 * i;
        const uint8_t bytes[2] = {(uint8_t)((rgb[0] & 0xF8) | rgb[1] >> 5),
                                  (uint8_t)((rgb[1] << 3 & 0xE0) | rgb[2] >> 3)};
        memcpy(&picture[i], bytes, 2);
    }
}

/* The cost on the wire since `before`: its bytes, and WRITE_BYTES for each command and for the write after it. */
static uint64_t cost_since(const struct rig *rig, const struct sim_counters *before, bool slow)
{
    const struct sim_counters now = sim_counters(rig->sim);
    const uint64_t writes = 2 * (now.command_bytes - before->command_bytes);
    return now.bytes - before->bytes + (slow ? WRITE_BYTES * writes : 0);
}

/* Adds the bytes of eight frames `step` apart on a small panel, and those of the best covers that the search finds. */
static void compare_with_search(const char *name, uint32_t step, bool slow, uint64_t bytes[2])
{
    struct hal_ops slow_ops;
    static struct rig rig;
    struct sim_virtual small;
    struct sim_player player;
    uint16_t before[SIDE * SIDE];
    uint8_t changed[SIDE * SIDE];
    assert_int_equal(sim_virtual(&small, SIDE, SIDE), 0);
    const struct sim_player_setup setup = {.board = &small.board, .band_height = SIDE, .demo = demo_find(name)};
    assert_int_equal(sim_player_open(&player, &setup), 0);
    rig_open(&rig, &small.panel, PANEL_R0, PANEL_RGB565, false);
    if (slow) {
        assert_int_equal(rig.d.clock_hz, 62500000);
        make_writes_slow(&rig, &slow_ops);
    }
    const uint32_t write = slow ? 2 * WRITE_BYTES : 0; /* of a command and the write after it */
    const struct cover_costs costs = {5 + write, 1 + write, 2};
    bytes[0] = bytes[1] = 0;
    for (uint32_t frame = 0; frame < 9; frame++) {
        memcpy(before, picture, sizeof before);
        assert_int_equal(sim_player_frame(&player, frame * step), 0);
        take_picture(&player);
        const struct sim_counters start = sim_counters(rig.sim);
        assert_int_equal(show(&rig, SIDE), 0);
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            changed[i] = before[i] != picture[i];
        }
        if (frame > 0) {
            bytes[0] += cost_since(&rig, &start, slow);
            bytes[1] += cover_search(changed, SIDE, SIDE, &costs, 20000);
        }
    }
    rig_close(&rig, name);
    sim_player_close(&player);
}

static void expect_near_the_search(bool slow)
{
    static const struct {
        const char *name;
        uint32_t step;
    } sequences[] = {{"turntable", 1}, {"turntable", 4}, {"wireframe", 1}, {"solar", 1},
                     {"snake", 2},     {"ball", 3},      {"shadow", 1},    {"fisheye", 1}};
    for (size_t i = 0; i < sizeof sequences / sizeof sequences[0]; i++) {
        uint64_t bytes[2];
        compare_with_search(sequences[i].name, sequences[i].step, slow, bytes);
        print_message("%s, every %u.: %llu bytes, search %llu: %.1f %% more\n", sequences[i].name, sequences[i].step,
                      (unsigned long long)bytes[0], (unsigned long long)bytes[1],
                      100.0 * (double)bytes[0] / (double)bytes[1] - 100);
        assert_true(bytes[1] > 0);
        assert_true(bytes[0] * 100 <= bytes[1] * 110);
    }
}

static void bytes_are_within_ten_percent_of_the_best_cover_found(void **state)
{
    (void)state;
    expect_near_the_search(false);
}

static void where_writes_cost_time_bytes_and_time_are_within_ten_percent_of_the_best(void **state)
{
    (void)state;
    expect_near_the_search(true);
}

/* ---- how much time -------------------------------------------------------------------------------- */

#define DRAW_NS 3000000 /* a frame's drawing */

/* A bus whose writes take time besides their bits. A paced one sleeps until its bits are out, and oversleeps.
 * Data in a row is one write, as hal/linux makes it. */
static struct {
    const struct hal_ops *plain;
    uint64_t now_ns;
    uint32_t least_ns, mean_ns;
    uint32_t windows; /* most of a frame, when the costs are known */
    bool paced, tells_least;
    enum hal_dc dc;
} timed;

static int timed_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    const uint32_t late_ns = dc == timed.dc  ? 0
                             : !timed.paced  ? 15000 + draw(10000)
                             : draw(50) == 0 ? draw(15000000)
                                             : draw(1500000);
    timed.now_ns += 8000000000U * n / 31250000 + late_ns;
    if (n <= 8 && dc != timed.dc) {
        timed.least_ns = timed.least_ns == 0 || late_ns < timed.least_ns ? late_ns : timed.least_ns;
        timed.mean_ns = timed.mean_ns - timed.mean_ns / 16 + late_ns / 16;
    }
    timed.dc = dc;
    return timed.plain->bus_write(context, dc, bytes, n);
}

static uint32_t timed_write_ns(void *context)
{
    (void)context;
    return timed.tells_least ? timed.least_ns : timed.mean_ns;
}

static uint32_t timed_us(void *context)
{
    (void)context;
    return (uint32_t)(timed.now_ns / 1000);
}

/* Boxes that walk, as the links of a chain do. */
static void walk(uint32_t frame)
{
    memset(picture, 0, sizeof picture);
    for (uint32_t i = 0; i < 14; i++) {
        const uint32_t x0 = (i * 53 + frame * (1 + i % 3)) % 220, y0 = (i * 97 + frame * (2 - i % 3)) % 220;
        for (uint32_t y = y0; y < y0 + 12; y++) {
            for (uint32_t x = x0; x < x0 + 12; x++) {
                picture[y * 240 + x] = (uint16_t)(1 + i);
            }
        }
    }
}

/* Milliseconds of so many frames in bands of 60 lines. */
static uint32_t time_frames(uint32_t frames, bool whole)
{
    static struct rig rig;
    struct hal_ops ops;
    random_state = frames;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565, false);
    ops = *rig.d.hal.ops;
    timed.plain = rig.d.hal.ops;
    timed.now_ns = timed.least_ns = timed.mean_ns = timed.windows = 0;
    ops.bus_write = timed_write;
    ops.write_ns = timed_write_ns;
    ops.time_us = timed_us;
    rig.d.hal.ops = &ops;
    for (uint32_t frame = 0; frame < frames; frame++) {
        walk(frame);
        timed.now_ns += DRAW_NS;
        if (whole) {
            assert_int_equal(panel_frame_begin(&rig.d), 0);
            for (uint32_t y = 0; y < 240; y += 60) {
                assert_int_equal(panel_rows(&rig.d, picture + y * 240, 60), 0);
            }
            assert_int_equal(panel_frame_end(&rig.d), 0);
        } else {
            assert_int_equal(show(&rig, 60), 0);
        }
        check_seen(&rig, "a timed frame");
        timed.windows = frame > 20 && rig.diff.windows > timed.windows ? rig.diff.windows : timed.windows;
    }
    rig.d.hal.ops = timed.plain;
    rig_close(&rig, "timed frames");
    return (uint32_t)(timed.now_ns / 1000000);
}

static void compare_times(const char *bus, uint32_t most_percent)
{
    const uint32_t frames = 300, whole_ms = time_frames(frames, true), diff_ms = time_frames(frames, false);
    print_message("%s: whole %.1f frames/s, differences %.1f frames/s\n", bus, frames * 1000.0 / whole_ms,
                  frames * 1000.0 / diff_ms);
    assert_true(diff_ms * 100 <= whole_ms * most_percent);
}

static void differences_are_hardly_slower_on_a_jittery_bus(void **state)
{
    (void)state;
    timed.paced = true;
    timed.tells_least = true; /* a wrong estimate: the measured frames have to do it */
    compare_times("paced and jittery, least time told", 105);
    timed.tells_least = false;
    compare_times("paced and jittery, mean time told", 105);
    assert_in_range(timed.windows, 1, 8); /* one or two for each band */
}

static void differences_are_much_faster_on_a_quiet_bus(void **state)
{
    (void)state;
    timed.paced = timed.tells_least = false;
    compare_times("quiet", 40);
    assert_in_range(timed.windows, 9, 100);
}

/* Each frame takes the time that the test says. */
static uint32_t told_now_us;

static uint32_t told_us(void *context)
{
    (void)context;
    return told_now_us;
}

static uint32_t no_write_ns(void *context)
{
    (void)context;
    return 0;
}

/* How frames are sent, a letter each: `w` whole, `d` as differences. Whole frames take whole_us; those of differences
 * take diff_us one after the other, the last of them from then on. */
static void ways_of_frames(uint32_t whole_us, const uint32_t *diff_us, uint32_t diffs, char *ways, uint32_t frames)
{
    static struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565, false);
    const struct hal_ops *plain = rig.d.hal.ops;
    struct hal_ops ops = *plain;
    ops.write_ns = no_write_ns;
    ops.time_us = told_us;
    rig.d.hal.ops = &ops;
    for (uint32_t frame = 0, i = 0; frame < frames; frame++) {
        picture[frame]++;
        assert_int_equal(show(&rig, 60), 0);
        ways[frame] = rig.diff.whole ? 'w' : 'd';
        told_now_us += rig.diff.whole ? whole_us : diff_us[i];
        i += !rig.diff.whole && i + 1 < diffs;
    }
    ways[frames] = '\0';
    rig.d.hal.ops = plain;
    rig_close(&rig, "frames whose time is told");
}

/* Frame 0 must be whole. Then each way is measured once, and the slower one is tried again at once: its first frame may
 * have been slow by chance. */
static void a_whole_frame_must_be_faster_by_a_sixteenth(void **state)
{
    (void)state;
    char ways[21];
    ways_of_frames(160000, (const uint32_t[]){170000}, 1, ways, 20);
    assert_string_equal(ways, "wdwwdddddddddddddddd");
    ways_of_frames(160000, (const uint32_t[]){170001}, 1, ways, 20);
    assert_string_equal(ways, "wdwdwwwwwwwwwwwwwwww");
}

/* The first one counts three times: 100, 100, 100; then 200, 100, 100; then 100 again; then 200, 100, 200. */
static void the_median_of_the_last_three_frames_decides(void **state)
{
    (void)state;
    char ways[13];
    ways_of_frames(160000, (const uint32_t[]){100000, 200000, 100000, 200000}, 4, ways, 12);
    assert_string_equal(ways, "wdwwdddwwwww");
    ways_of_frames(160000, (const uint32_t[]){100000, 200000, 200000}, 3, ways, 12);
    assert_string_equal(ways, "wdwwddwwwwww");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_panel_shows_the_exact_picture_in_every_rotation_and_format),
        cmocka_unit_test(the_picture_is_exact_where_writes_cost_time),
        cmocka_unit_test(any_number_of_lines_at_a_time_will_do),
        cmocka_unit_test(odd_greys_are_exact_too),
        cmocka_unit_test(what_the_glass_does_not_show_is_not_sent),
        cmocka_unit_test(no_buffer_is_touched_before_it_is_sent),
        cmocka_unit_test(a_frame_in_which_all_changes_costs_at_most_one_percent_more),
        cmocka_unit_test(all_is_sent_again_every_so_many_frames),
        cmocka_unit_test(after_an_error_the_next_frame_is_whole),
        cmocka_unit_test(wrong_use_is_refused),
        cmocka_unit_test(the_end_of_each_window_is_flushed),
        cmocka_unit_test(bytes_are_within_ten_percent_of_the_best_cover_found),
        cmocka_unit_test(differences_are_hardly_slower_on_a_jittery_bus),
        cmocka_unit_test(differences_are_much_faster_on_a_quiet_bus),
        cmocka_unit_test(a_whole_frame_must_be_faster_by_a_sixteenth),
        cmocka_unit_test(the_median_of_the_last_three_frames_decides),
        cmocka_unit_test(where_writes_cost_time_bytes_and_time_are_within_ten_percent_of_the_best),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
