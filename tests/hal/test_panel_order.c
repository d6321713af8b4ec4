/*
 * The order of the driver's steps, and its behaviour after errors. The backend is spy_hal: it logs, and it keeps every
 * buffer until the last moment that hal.h allows.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "panels.h"
#include "spy_hal.h"

#include <string.h>

static uint16_t picture[PICTURE_PIXELS], other_picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

/* A panel on the simulator behind the spy. */
struct bench {
    struct board board;
    struct spy spy;
    struct hal hal;
    struct sim *sim;
    struct panel_config config;
    struct panel_driver d;
    uint8_t scratch[256];
};

static struct bench bench, second;

static void set_up(struct bench *b, const struct panel *panel, unsigned rotation, unsigned format)
{
    memset(b, 0, sizeof *b);
    b->board = (struct board){.name = "test",
                              .panel = panel,
                              .spi_hz = panel->controller->write_hz,
                              .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}};
    b->sim = sim_open(&b->board, &b->spy.sim);
    assert_non_null(b->sim);
    b->hal = (struct hal){&spy_ops, &b->spy};
    b->config = (struct panel_config){panel,           (uint8_t)rotation, (uint8_t)format,
                                      b->board.spi_hz, b->scratch,        sizeof b->scratch};
}

static void check_picture(struct bench *b, const uint16_t *pixels, const char *what)
{
    const struct panel *panel = b->config.panel;
    sim_pixels(b->sim, b->config.rotation, seen);
    picture_expect(pixels, b->d.width, b->d.height, b->config.format, panel->round, expected);
    picture_compare(seen, expected, b->d.width, b->d.height, what);
}

static bool dark(struct bench *b)
{
    sim_pixels(b->sim, b->config.rotation, seen);
    for (uint32_t i = 0; i < 3U * b->d.width * b->d.height; i++) {
        if (seen[i] != 0) {
            return false;
        }
    }
    return true;
}

static void no_buffer_is_reused_while_it_may_still_be_sent(void **state)
{
    (void)state;
    static const struct panel *const panels[] = {&panel_st7789_135x240, &panel_st7789_135x240, &panel_st7789_135x240,
                                                 &panel_ssd0323_128x64, &panel_ssd0323_128x64};
    static const uint8_t formats[] = {PANEL_RGB565, PANEL_RGB666, PANEL_RGB444, PANEL_GREY4, PANEL_GREY4};
    for (unsigned i = 0; i < 5; i++) {
        set_up(&bench, panels[i], i, formats[i]);
        bench.config.rotation = i & 3;
        assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
        picture_fill(picture, bench.d.width, bench.d.height, i);
        assert_int_equal(picture_draw(&bench.d, picture, 3), 0);
        check_picture(&bench, picture, panels[i]->name);
        picture_no_complaint(bench.sim, panels[i]->name);
        sim_close(bench.sim);
    }
}

static void two_bands_can_take_turns(void **state)
{
    (void)state;
    static uint16_t bands[2][240 * 8];
    set_up(&bench, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    picture_fill(picture, 240, 240, 5);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    for (uint32_t band = 0; band < 30; band++) {
        memcpy(bands[band & 1], picture + band * 240 * 8, sizeof bands[0]); /* while the other one is held */
        assert_int_equal(panel_rows(&bench.d, bands[band & 1], 8), 0);
    }
    assert_int_equal(panel_frame_end(&bench.d), 0);
    check_picture(&bench, picture, "two bands");
    sim_close(bench.sim);
}

/* 29h and AFh; RAMWR of the panel under test. */
static void check_light(const struct panel *panel, unsigned format, uint8_t on)
{
    set_up(&bench, panel, PANEL_R0, format);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    picture_fill(picture, bench.d.width, bench.d.height, 1);
    assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, on), 0);
    assert_int_equal(spy_count(&bench.spy, SPY_BACKLIGHT, 1), 0);
    assert_true(dark(&bench));

    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_rows(&bench.d, picture, bench.d.height), 0);
    assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, on), 0);
    uint32_t drawn = bench.spy.count;
    assert_int_equal(panel_frame_end(&bench.d), 0);

    uint32_t display = spy_find(&bench.spy, drawn, SPY_COMMAND, on);
    uint32_t backlight = spy_find(&bench.spy, drawn, SPY_BACKLIGHT, 1);
    assert_true(display < backlight);
    assert_false(dark(&bench));

    assert_int_equal(picture_draw(&bench.d, picture, 16), 0); /* once is enough */
    assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, on), 1);
    assert_int_equal(spy_count(&bench.spy, SPY_BACKLIGHT, 1), 1);
    picture_no_complaint(bench.sim, panel->name);
    sim_close(bench.sim);
}

static void display_and_backlight_go_on_after_the_first_frame(void **state)
{
    (void)state;
    check_light(&panel_st7789_240x240, PANEL_RGB565, 0x29);
    check_light(&panel_ili9488_320x480, PANEL_RGB666, 0x29);
    check_light(&panel_ssd1351_128x128, PANEL_RGB565, 0xAF);
    check_light(&panel_ssd0323_128x64, PANEL_GREY4, 0xAF);
}

static void initialisation_is_slow_and_pixels_are_fast(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *panel = panel_list[i];
        unsigned format = 0;
        while ((panel->formats & PANEL_FORMAT_BIT(format)) == 0) {
            format++;
        }
        set_up(&bench, panel, PANEL_R0, format);
        assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
        assert_int_equal(bench.d.clock_hz, panel->controller->write_hz);
        uint32_t slow = spy_find(&bench.spy, 0, SPY_CLOCK, panel->controller->init_hz);
        uint32_t fast = spy_find(&bench.spy, 0, SPY_CLOCK, panel->controller->write_hz);
        assert_int_equal(slow, 0);
        assert_int_equal(fast, bench.spy.count - 1); /* nothing is sent after it */
        assert_true(panel->controller->init_hz <= 4000000);
        assert_true(panel->controller->init_hz < panel->controller->write_hz);
        sim_close(bench.sim);
    }
}

static void reset_is_pulsed_before_the_first_byte(void **state)
{
    (void)state;
    set_up(&bench, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    uint32_t low = spy_find(&bench.spy, 0, SPY_RESET, 0);
    uint32_t high = spy_find(&bench.spy, low, SPY_RESET, 1);
    assert_int_equal(bench.spy.events[low + 1].kind, SPY_DELAY);
    assert_true(bench.spy.events[low + 1].value >= 10);
    assert_int_equal(bench.spy.events[high + 1].kind, SPY_DELAY);
    assert_true(bench.spy.events[high + 1].value >= 120000);
    assert_true(spy_find(&bench.spy, 0, SPY_COMMAND, 0x01) > high);
    assert_true(spy_find(&bench.spy, 0, SPY_BACKLIGHT, 0) < low);
    sim_close(bench.sim);
}

static void the_window_is_set_once_a_frame(void **state)
{
    (void)state;
    set_up(&bench, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    for (uint32_t frame = 1; frame <= 3; frame++) {
        assert_int_equal(picture_draw(&bench.d, picture, 1), 0);
        assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, 0x2A), frame);
        assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, 0x2B), frame);
        assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, 0x2C), frame);
    }
    sim_close(bench.sim);
}

static void close_turns_all_off_and_open_works_again(void **state)
{
    (void)state;
    set_up(&bench, &panel_gc9a01_240x240, PANEL_R270, PANEL_RGB565);
    for (uint32_t turn = 0; turn < 2; turn++) {
        assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
        picture_fill(picture, 240, 240, turn);
        assert_int_equal(picture_draw(&bench.d, picture, 60), 0);
        check_picture(&bench, picture, "opened");
        bench.spy.count = 0;
        assert_int_equal(panel_close(&bench.d), 0);
        uint32_t off = spy_find(&bench.spy, 0, SPY_COMMAND, 0x28);
        assert_true(spy_find(&bench.spy, 0, SPY_BACKLIGHT, 0) < off);
        assert_true(spy_find(&bench.spy, 0, SPY_COMMAND, 0x10) > off);
        assert_true(dark(&bench));
    }
    picture_no_complaint(bench.sim, "close");
    sim_close(bench.sim);
}

static void two_panels_live_side_by_side(void **state)
{
    (void)state;
    set_up(&bench, &panel_st7735s_80x160, PANEL_R90, PANEL_RGB444);
    set_up(&second, &panel_ssd0323_128x64, PANEL_R270, PANEL_GREY4);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    assert_int_equal(panel_open(&second.d, &second.hal, &second.config), 0);
    picture_fill(picture, bench.d.width, bench.d.height, 8);
    picture_fill(other_picture, second.d.width, second.d.height, 9);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_frame_begin(&second.d), 0);
    for (uint32_t y = 0; y < 128; y++) { /* the pictures have 80 and 128 lines */
        if (y < bench.d.height) {
            assert_int_equal(panel_rows(&bench.d, picture + y * bench.d.width, 1), 0);
        }
        assert_int_equal(panel_rows(&second.d, other_picture + y * second.d.width, 1), 0);
    }
    assert_int_equal(panel_frame_end(&bench.d), 0);
    assert_int_equal(panel_frame_end(&second.d), 0);
    check_picture(&bench, picture, "one");
    check_picture(&second, other_picture, "the other");
    sim_close(bench.sim);
    sim_close(second.sim);
}

static void wrong_use_is_refused(void **state)
{
    (void)state;
    set_up(&bench, &panel_ili9488_320x480, PANEL_R0, PANEL_RGB565); /* serial takes 18 bits only */
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    bench.config.format = PANEL_RGB666;
    bench.config.scratch_bytes = PANEL_SCRATCH_MIN - 1;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    bench.config.scratch_bytes = PANEL_SCRATCH_MIN;
    bench.config.scratch = NULL;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    bench.config.scratch = bench.scratch;
    bench.config.clock_hz = 0;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    bench.config.clock_hz = 1000000;
    bench.config.rotation = 4;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    assert_int_equal(sim_counters(bench.sim).bytes, 0); /* nothing was sent for any of these */
    bench.config.rotation = 0;
    struct panel cut = panel_ili9488_320x480;
    cut.init_bytes -= 1;
    bench.config.panel = &cut;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    cut.init_bytes -= 1;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    bench.config.panel = &panel_ili9488_320x480;
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);

    assert_int_equal(panel_rows(&bench.d, picture, 1), HAL_EINVAL); /* not in a frame */
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_rows(&bench.d, picture, 481), HAL_EINVAL);
    assert_int_equal(panel_rows(&bench.d, picture, 479), 0);
    assert_int_equal(panel_rows(&bench.d, picture, 2), HAL_EINVAL);
    assert_int_equal(panel_frame_end(&bench.d), HAL_EINVAL); /* one line is missing */
    assert_true(dark(&bench));
    assert_int_equal(spy_count(&bench.spy, SPY_COMMAND, 0x29), 0);
    sim_close(bench.sim);
}

/* With an odd number of pixels, half a byte of the last line waits in the driver. */
static void an_abandoned_frame_leaves_nothing_behind(void **state)
{
    (void)state;
    set_up(&bench, &panel_st7789_135x240, PANEL_R0, PANEL_RGB444);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    picture_fill(picture, 135, 240, 77);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_rows(&bench.d, picture + 135 * 40, 3), 0);
    assert_int_equal(picture_draw(&bench.d, picture, 9), 0);
    check_picture(&bench, picture, "after an abandoned frame");
    sim_close(bench.sim);
}

/* Every bus_write of an opening and a frame fails once; the error comes back, and the next frame is whole again. */
static void every_failing_write_is_reported(void **state)
{
    (void)state;
    for (uint32_t n = 1;; n++) {
        set_up(&bench, &panel_ssd0323_128x64, PANEL_R90, PANEL_GREY4);
        bench.hal = bench.spy.sim;
        sim_fault(bench.sim, SIM_FAULT_WRITE, n);
        int status = panel_open(&bench.d, &bench.hal, &bench.config);
        picture_fill(picture, 64, 128, n);
        if (status == 0) {
            status = picture_draw(&bench.d, picture, 16);
        }
        uint32_t writes = sim_counters(bench.sim).writes;
        if (writes < n) { /* it was not reached */
            assert_int_equal(status, 0);
            assert_true(n > 50);
            sim_close(bench.sim);
            return;
        }
        assert_int_equal(status, HAL_EIO);
        assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
        assert_int_equal(picture_draw(&bench.d, picture, 16), 0);
        check_picture(&bench, picture, "after a failed write");
        sim_close(bench.sim);
    }
}

static void other_failures_are_reported(void **state)
{
    (void)state;
    set_up(&bench, &panel_st7789_240x240, PANEL_R0, PANEL_RGB565);
    bench.hal = bench.spy.sim;
    sim_fault(bench.sim, SIM_FAULT_CLOCK, 1);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    sim_fault(bench.sim, SIM_FAULT_CLOCK, 2);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), HAL_EINVAL);
    assert_int_equal(panel_open(&bench.d, &bench.hal, &bench.config), 0);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    sim_fault(bench.sim, SIM_FAULT_SHORT_WRITE, 1);
    assert_int_equal(panel_rows(&bench.d, picture, 240), HAL_EIO);
    assert_int_equal(panel_rows(&bench.d, picture, 1), HAL_EINVAL); /* the frame is lost */
    assert_int_equal(panel_frame_end(&bench.d), HAL_EINVAL);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_rows(&bench.d, picture, 240), 0);
    sim_fault(bench.sim, SIM_FAULT_STUCK, 1);
    assert_int_equal(panel_frame_end(&bench.d), HAL_ETIMEDOUT);
    assert_true(dark(&bench));
    assert_int_equal(picture_draw(&bench.d, picture, 240), 0);
    assert_int_equal(panel_frame_begin(&bench.d), 0);
    assert_int_equal(panel_rows(&bench.d, picture, 240), 0);
    sim_fault(bench.sim, SIM_FAULT_STUCK, 1); /* nothing follows the pixels now */
    assert_int_equal(panel_frame_end(&bench.d), HAL_ETIMEDOUT);
    sim_close(bench.sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_buffer_is_reused_while_it_may_still_be_sent),
        cmocka_unit_test(two_bands_can_take_turns),
        cmocka_unit_test(display_and_backlight_go_on_after_the_first_frame),
        cmocka_unit_test(initialisation_is_slow_and_pixels_are_fast),
        cmocka_unit_test(reset_is_pulsed_before_the_first_byte),
        cmocka_unit_test(the_window_is_set_once_a_frame),
        cmocka_unit_test(close_turns_all_off_and_open_works_again),
        cmocka_unit_test(two_panels_live_side_by_side),
        cmocka_unit_test(wrong_use_is_refused),
        cmocka_unit_test(an_abandoned_frame_leaves_nothing_behind),
        cmocka_unit_test(every_failing_write_is_reported),
        cmocka_unit_test(other_failures_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
