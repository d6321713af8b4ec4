/*
 * For every panel, rotation and format the model's glass shows the picture that went through the driver; so does a
 * glass of any size. The expected pictures come from panel_picture.c (floating point, no shared code).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "panels.h"

#include <stdio.h>
#include <string.h>

static uint16_t picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

/* A kit with this panel whose clock is within the datasheet's limit. */
static struct board board_with(const struct panel *panel)
{
    return (struct board){.name = "test",
                          .panel = panel,
                          .spi_hz = panel->controller->write_hz,
                          .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}};
}

struct shot {
    const struct panel *panel;
    unsigned rotation, format;
    uint32_t lines; /* at a time */
    size_t scratch_bytes;
};

/* Draws two frames and checks the second. */
static void shoot(const struct shot *s)
{
    static uint8_t scratch[4096];
    char what[80];
    snprintf(what, sizeof what, "%s, rotation %u, format %u, %u lines, scratch %u", s->panel->name, s->rotation * 90,
             s->format, s->lines, (unsigned)s->scratch_bytes);

    struct board board = board_with(s->panel);
    struct hal hal;
    struct sim *sim = sim_open(&board, &hal);
    assert_non_null(sim);
    struct panel_config config = {s->panel, (uint8_t)s->rotation, (uint8_t)s->format, board.spi_hz,
                                  scratch,  s->scratch_bytes};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    for (uint32_t frame = 0; frame < 2; frame++) {
        picture_fill(picture, d.width, d.height, frame);
        uint64_t before = sim_counters(sim).bytes;
        assert_int_equal(picture_draw(&d, picture, s->lines), 0);
        uint64_t bytes = sim_counters(sim).bytes - before;
        if (frame == 1) { /* the first one also turns the display on */
            assert_int_equal(d.frame_bytes, bytes);
            assert_int_equal(bytes, panel_frame_bytes(s->panel, s->format, s->rotation));
        }
    }
    sim_pixels(sim, s->rotation, seen);
    picture_expect(picture, d.width, d.height, s->format, s->panel->round, expected);
    picture_compare(seen, expected, d.width, d.height, what);
    assert_int_equal(panel_close(&d), 0);
    picture_no_complaint(sim, what);
    sim_close(sim);
}

static void every_panel_shows_the_picture_in_every_rotation_and_format(void **state)
{
    (void)state;
    uint32_t shots = 0;
    for (uint32_t i = 0; i < panel_count; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            for (unsigned format = PANEL_RGB565; format < PANEL_FORMATS; format++) {
                if (panel_can_turn(panel_list[i], rotation) && panel_list[i]->formats & PANEL_FORMAT_BIT(format)) {
                    shoot(&(struct shot){panel_list[i], rotation, format, 16, 512});
                    shots++;
                }
            }
        }
    }
    /* ST7789 and ST7735S, GC9A01, ILI9341, ILI9488, ST7796S, HX8357D, ILI9486, OLEDs, those of one bit; memory LCDs */
    assert_true(shots >= 4 * (8 * 3 + 3 + 2 + 1 + 2 + 2 + 1 + 1 + 1 + 5 * 2) + 2 * 2 * 2);
}

static void the_number_of_lines_at_a_time_is_not_seen(void **state)
{
    (void)state;
    static const uint32_t lines[] = {1, 2, 7, 13, 240};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            shoot(&(struct shot){&panel_ssd0323_128x64, rotation, PANEL_GREY4, lines[i], 256});
            shoot(&(struct shot){&panel_sh1106_128x64, rotation, PANEL_MONO_DITHER, lines[i], 256});
            shoot(&(struct shot){&panel_sh1107_64x128, rotation, PANEL_MONO_DITHER, lines[i], 256});
            shoot(&(struct shot){&panel_st7789_135x240, rotation, PANEL_RGB444, lines[i], 256});
        }
        shoot(&(struct shot){&panel_ls027b7dh01_400x240, PANEL_R0, PANEL_MONO_DITHER, lines[i], 256});
        shoot(&(struct shot){&panel_ls013b7dh03_128x128, PANEL_R180, PANEL_MONO_DITHER, lines[i], 256});
        shoot(&(struct shot){&panel_st7789_135x240, PANEL_R90, PANEL_RGB565, lines[i], 0});
        shoot(&(struct shot){&panel_st7735s_80x160, PANEL_R270, PANEL_RGB666, lines[i], 256});
    }
}

static void the_size_of_scratch_is_not_seen(void **state)
{
    (void)state;
    static const size_t sizes[] = {256, 257, 259, 300, 1001, 4096};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        shoot(&(struct shot){&panel_st7789_135x240, PANEL_R0, PANEL_RGB444, 9, sizes[i]});
        shoot(&(struct shot){&panel_st7789_135x240, PANEL_R0, PANEL_RGB666, 9, sizes[i]});
        shoot(&(struct shot){&panel_ssd0323_128x64, PANEL_R0, PANEL_GREY4, 9, sizes[i]});
        shoot(&(struct shot){&panel_ssd0323_128x64, PANEL_R90, PANEL_GREY4, 9, sizes[i]});
        shoot(&(struct shot){&panel_ssd1306_128x64, PANEL_R0, PANEL_MONO_DITHER, 9, sizes[i]});
        shoot(&(struct shot){&panel_ssd1306_128x64, PANEL_R90, PANEL_MONO_DITHER, 9, sizes[i]});
        shoot(&(struct shot){&panel_ls013b7dh03_128x128, PANEL_R0, PANEL_MONO_DITHER, 9, sizes[i]});
    }
}

static void a_glass_of_any_size_can_be_made(void **state)
{
    (void)state;
    static const uint16_t sizes[][2] = {{1, 1}, {1, 9}, {3, 3}, {7, 5}, {320, 240}, {1, 1024}, {1024, 1}, {131, 97}};
    struct sim_virtual v;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        assert_int_equal(sim_virtual(&v, sizes[i][0], sizes[i][1]), 0);
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            for (unsigned format = PANEL_RGB565; format <= PANEL_RGB444; format++) {
                shoot(&(struct shot){&v.panel, rotation, format, 3, 256});
            }
        }
    }
    assert_int_equal(sim_virtual(&v, 0, 1), HAL_EINVAL);
    assert_int_equal(sim_virtual(&v, 1, 1025), HAL_EINVAL);
}

/* The bits that a pixel needs, compared with those that go out. A page is addressed by 3 bytes, and turned by 90 or 270
 * so are each 8 bytes of it. A memory LCD's line has an address and a trailer, a frame 3 bytes more. */
static void a_frame_costs_at_most_one_percent_more_than_its_pixels(void **state)
{
    (void)state;
    static const uint32_t bits[PANEL_FORMATS] = {16, 24, 12, 4, 1, 1};
    for (uint32_t i = 0; i < panel_count; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            for (unsigned format = PANEL_RGB565; format < PANEL_FORMATS; format++) {
                const bool pages = panel_list[i]->controller->set_page != 0, lines = panel_list[i]->controller->lines;
                if ((pages || lines) != (bits[format] == 1)) {
                    continue;
                }
                uint64_t net = (uint64_t)panel_list[i]->width * panel_list[i]->height * bits[format];
                uint64_t gross = 8ULL * panel_frame_bytes(panel_list[i], format, rotation);
                assert_true(gross > net);
                if (lines) {
                    gross -= 8ULL * (2 * panel_height(panel_list[i], rotation) + 3);
                    assert_int_equal(gross, net);
                } else if (pages) {
                    gross -= 8ULL * 3 * (net / 8 / (rotation % 2 == 0 ? panel_list[i]->width : 8U));
                    assert_int_equal(gross, net);
                }
                assert_true(gross * 100 <= net * 101);
            }
        }
    }
}

static void the_frame_time_is_that_of_the_bits(void **state)
{
    (void)state;
    /* 2 * 240 * 240 pixels' bytes, CASET and RASET with four parameters each, RAMWR. */
    assert_int_equal(panel_frame_bytes(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0), 115211);
    assert_int_equal(panel_frame_us(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0, 62500000), 14748); /* 14747.008 */
    assert_int_equal(panel_frame_us(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0, 8000000), 115211);
    assert_int_equal(panel_frame_us(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0, 1), UINT32_MAX);
    /* 15h, 75h with two parameters each; two pixels a byte. */
    assert_int_equal(panel_frame_bytes(&panel_ssd0323_128x64, PANEL_GREY4, PANEL_R90), 6 + 4096);
}

static void the_clock_can_be_changed_between_frames(void **state)
{
    (void)state;
    struct board board = board_with(&panel_st7789_240x240);
    struct hal hal;
    struct sim *sim = sim_open(&board, &hal);
    assert_non_null(sim);
    const struct panel_config config = {.panel = board.panel, .format = PANEL_RGB565, .clock_hz = board.spi_hz};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    assert_int_equal(d.clock_hz, board.spi_hz);
    assert_int_equal(panel_clock(&d, 10000000), 0);
    assert_int_equal(d.clock_hz, 10000000);
    assert_int_equal(sim_counters(sim).clock_hz, 10000000);
    sim_fault(sim, SIM_FAULT_CLOCK, 1);
    assert_int_equal(panel_clock(&d, 20000000), HAL_EINVAL);
    sim_close(sim);
}

static void a_panel_is_not_opened_with_what_it_does_not_have(void **state)
{
    (void)state;
    static uint8_t scratch[PANEL_SCRATCH_MIN];
    struct board board = board_with(&panel_st7735s_80x160);
    struct hal hal;
    struct panel_driver d;
    struct sim *const sim = sim_open(&board, &hal);
    const struct panel_config right = {board.panel, PANEL_R270, PANEL_RGB666, board.spi_hz, scratch, sizeof scratch};
    struct panel_config wrong[6];
    for (size_t i = 0; i < 6; i++) {
        wrong[i] = right;
    }
    wrong[0].rotation = PANEL_R270 + 1;
    wrong[1].format = PANEL_FORMATS;
    wrong[2].format = PANEL_GREY4; /* the glass has colours */
    wrong[3].clock_hz = 0;
    wrong[4].scratch = NULL;
    wrong[5].scratch_bytes = PANEL_SCRATCH_MIN - 1;
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(panel_open(&d, &hal, &wrong[i]), HAL_EINVAL);
    }
    assert_int_equal(panel_open(&d, &hal, &right), 0);
    assert_int_equal(panel_close(&d), 0);
    sim_close(sim);
}

/* ---- windows ----------------------------------------------------------------------------------------------------- */

struct open_panel {
    struct board board;
    struct hal hal;
    struct sim *sim;
    struct panel_driver d;
    uint8_t scratch[PANEL_SCRATCH_MIN];
};

/* An open panel that shows picture number 1. RGB565 needs no scratch memory; in two rotations it has none. */
static void open_panel(struct open_panel *p, const struct panel *panel, unsigned rotation, unsigned format)
{
    p->board = board_with(panel);
    p->sim = sim_open(&p->board, &p->hal);
    assert_non_null(p->sim);
    uint8_t *const scratch = format == PANEL_RGB565 && (rotation & 1) != 0 ? NULL : p->scratch;
    const struct panel_config config = {panel,           (uint8_t)rotation, (uint8_t)format,
                                        p->board.spi_hz, scratch,           scratch != NULL ? sizeof p->scratch : 0};
    assert_int_equal(panel_open(&p->d, &p->hal, &config), 0);
    picture_fill(picture, p->d.width, p->d.height, 1);
    assert_int_equal(picture_draw(&p->d, picture, 16), 0);
}

static void close_panel(struct open_panel *p, const char *what)
{
    assert_int_equal(panel_close(&p->d), 0);
    picture_no_complaint(p->sim, what);
    sim_close(p->sim);
}

/* Changes a part of the picture, and sends it out of the whole picture, `lines` lines at a time. */
static void show_window(struct open_panel *p, uint32_t x, uint32_t y, uint32_t width, uint32_t height, uint32_t lines)
{
    const uint32_t stride = p->d.width;
    for (uint32_t i = 0; i < width * height; i++) {
        picture[(y + i / width) * stride + x + i % width] ^= (uint16_t)(0x1F3F + i);
    }
    assert_int_equal(panel_window(&p->d, x, y, width, height), 0);
    for (uint32_t row = 0; row < height; row += lines) {
        const uint32_t n = height - row < lines ? height - row : lines;
        assert_int_equal(panel_window_rows(&p->d, picture + (y + row) * stride + x, stride, n), 0);
    }
    assert_int_equal(panel_window_rows(&p->d, picture, stride, 1), HAL_EINVAL); /* it is full */
    assert_int_equal(panel_wait(&p->d), 0);
}

static void windows_show_their_part_of_the_picture_wherever_they_lie(void **state)
{
    (void)state;
    static const struct panel *const panels[] = {&panel_st7735s_80x160, &panel_ssd1351_128x128, &panel_ssd0323_128x64};
    for (size_t i = 0; i < sizeof panels / sizeof panels[0]; i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            static struct open_panel p;
            const unsigned format = (unsigned)__builtin_ctz(panels[i]->formats);
            open_panel(&p, panels[i], rotation, format);
            const uint32_t width = p.d.width, height = p.d.height;
            panel_windows_begin(&p.d);
            assert_int_equal(panel_rows(&p.d, picture, 1), HAL_EINVAL); /* none is open */
            show_window(&p, 0, 0, 2, 2, 1);
            show_window(&p, 4, 6, 10, 12, 5);
            show_window(&p, 4, 20, 10, 8, 8);                /* in the same columns */
            show_window(&p, 20, 20, 8, 8, 3);                /* in the same lines */
            show_window(&p, width - 6, height - 4, 6, 4, 4); /* in the last corner */
            show_window(&p, 0, height - 2, width, 2, 2);
            sim_pixels(p.sim, rotation, seen);
            picture_expect(picture, width, height, format, panels[i]->round, expected);
            picture_compare(seen, expected, width, height, panels[i]->name);
            close_panel(&p, panels[i]->name);
        }
    }
}

static uint32_t flushes;

static void count_flush(void *context)
{
    (void)context;
    flushes++;
}

/* A border is a command and four bytes, and a window ends its borders with a command. */
static void borders_that_the_controller_has_are_not_sent_again(void **state)
{
    (void)state;
    static struct open_panel p;
    open_panel(&p, &panel_st7735s_80x160, PANEL_R0, PANEL_RGB565);
    const struct hal_ops *const plain = p.d.hal.ops;
    struct hal_ops ops = *plain;
    ops.bus_flush = count_flush;
    p.d.hal.ops = &ops;
    panel_windows_begin(&p.d);
    flushes = 0;
    static const struct {
        uint32_t x, y, bytes;
    } windows[] = {{4, 6, 11}, {4, 20, 6}, {20, 20, 6}, {20, 20, 1}};
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; i++) {
        const uint32_t before = p.d.frame_bytes;
        show_window(&p, windows[i].x, windows[i].y, 10, 8, 8);
        assert_int_equal(p.d.frame_bytes - before, windows[i].bytes + 2 * 10 * 8);
        assert_int_equal(flushes, i + 1); /* one when it is full */
    }
    assert_int_equal(panel_window(&p.d, 20, 20, 10, 8), 0);
    assert_int_equal(panel_window_rows(&p.d, picture, 80, 7), 0); /* not all of it */
    assert_int_equal(flushes, 4);
    const uint32_t before = p.d.frame_bytes;
    show_window(&p, 20, 20, 10, 8, 8);
    assert_int_equal(p.d.frame_bytes - before, 11 + 2 * 10 * 8);
    p.d.hal.ops = plain;
    sim_pixels(p.sim, PANEL_R0, seen);
    picture_expect(picture, 80, 160, PANEL_RGB565, false, expected);
    picture_compare(seen, expected, 80, 160, "windows in a row");
    close_panel(&p, "windows in a row");
}

static void a_window_outside_of_the_picture_or_within_a_byte_is_refused(void **state)
{
    (void)state;
    static const uint32_t wrong[][4] = {{0, 0, 0, 1},  {0, 0, 1, 0},   {80, 0, 1, 1}, {0, 160, 1, 1},
                                        {79, 0, 2, 1}, {0, 159, 1, 2}, {1, 0, 80, 1}, {0, 100, 1, 61}};
    static struct open_panel p;
    open_panel(&p, &panel_st7735s_80x160, PANEL_R0, PANEL_RGB565);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(panel_window(&p.d, 3, 3, 5, 5), 0); /* odd ones are fine in this format */
        assert_int_equal(panel_window(&p.d, wrong[i][0], wrong[i][1], wrong[i][2], wrong[i][3]), HAL_EINVAL);
        assert_int_equal(panel_rows(&p.d, picture, 1), HAL_EINVAL); /* none is open any more */
    }
    show_window(&p, 79, 159, 1, 1, 1);
    close_panel(&p, "windows");
    for (unsigned rotation = PANEL_R0; rotation <= PANEL_R90;
         rotation++) { /* two columns, or two lines, share a byte */
        open_panel(&p, &panel_ssd0323_128x64, rotation, PANEL_GREY4);
        assert_int_equal(panel_window(&p.d, 3, 2, 2, 2), rotation == PANEL_R0 ? HAL_EINVAL : 0);
        assert_int_equal(panel_window(&p.d, 2, 2, 3, 2), rotation == PANEL_R0 ? HAL_EINVAL : 0);
        assert_int_equal(panel_window(&p.d, 2, 3, 2, 2), rotation == PANEL_R0 ? 0 : HAL_EINVAL);
        assert_int_equal(panel_window(&p.d, 2, 2, 2, 3), rotation == PANEL_R0 ? 0 : HAL_EINVAL);
        show_window(&p, 2, 2, 2, 2, 2);
        show_window(&p, 2, 6, 2, 4, 1);
        panel_close(&p.d);
        sim_close(p.sim);
    }
}

static void grey_is_dithered_evenly_between_its_levels(void **state)
{
    (void)state;
    assert_int_equal(panel_grey4(0x00, 0x00, 3, 0), 0);
    for (uint32_t y = 0; y < 4; y++) {
        for (uint32_t x = 0; x < 4; x++) {
            assert_int_equal(panel_grey4(0x00, 0x00, x, y), 0);
            assert_int_equal(panel_grey4(0xFF, 0xFF, x, y), 15);
        }
    }
    /* Over a 4x4 tile the mean level is the luma within half a sixteenth of a level, for every colour. */
    for (uint32_t value = 0; value < 65536; value += 37) {
        uint32_t sum = 0;
        for (uint32_t i = 0; i < 16; i++) {
            sum += panel_grey4((uint8_t)(value >> 8), (uint8_t)value, i % 4 + 8, i / 4 + 12);
        }
        double r = (int)(value / 2048 * 8.25);
        double g = (int)(value / 32 % 64 * 4.0625);
        double b = (int)(value % 32 * 8.25);
        double luma = (int)((77 * r + 150 * g + 29 * b) / 256);
        double error = sum / 16.0 - luma * 15 / 255;
        assert_true(error <= 0.5 / 16 + 1e-9 && error >= -0.5 / 16 - 1e-9);
    }
}

/*
 * A glass of 127 columns, bonded to the first columns of a controller that takes pixels in pairs. The model's glass has
 * 128. Half a byte of padding falls on the last column, which must be black.
 */
static void check_odd_greys(unsigned rotation, uint32_t pad_x, uint32_t pad_y)
{
    static uint8_t scratch[256];
    struct panel panel = panel_ssd0323_128x64;
    panel.width = 127;
    struct board board = board_with(&panel);
    struct hal hal;
    struct sim *sim = sim_open(&board, &hal);
    struct panel_config config = {&panel, (uint8_t)rotation, PANEL_GREY4, board.spi_hz, scratch, sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    picture_fill(picture, d.width, d.height, rotation);
    assert_int_equal(picture_draw(&d, picture, 5), 0);
    assert_int_equal(panel_frame_bytes(&panel, PANEL_GREY4, rotation), 6 + 64 * 64);
    sim_pixels(sim, rotation, seen);
    picture_expect(picture, d.width, d.height, PANEL_GREY4, false, expected);

    uint32_t width = panel_width(&panel_ssd0323_128x64, rotation);
    uint32_t height = panel_height(&panel_ssd0323_128x64, rotation);
    uint32_t x0 = rotation == PANEL_R180;
    uint32_t y0 = rotation == PANEL_R90;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            bool pad = width == 128 ? x == pad_x : y == pad_y;
            uint8_t grey = pad ? 0 : expected[3 * ((y - y0) * d.width + x - x0)];
            assert_int_equal(seen[3 * (y * width + x)], grey);
        }
    }
    picture_no_complaint(sim, "odd greys");
    sim_close(sim);
}

static void odd_greys_are_padded_beside_the_glass(void **state)
{
    (void)state;
    check_odd_greys(PANEL_R0, 127, 0);
    check_odd_greys(PANEL_R90, 0, 0);
    check_odd_greys(PANEL_R180, 0, 0);
    check_odd_greys(PANEL_R270, 0, 127);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_panel_shows_the_picture_in_every_rotation_and_format),
        cmocka_unit_test(the_number_of_lines_at_a_time_is_not_seen),
        cmocka_unit_test(the_size_of_scratch_is_not_seen),
        cmocka_unit_test(a_glass_of_any_size_can_be_made),
        cmocka_unit_test(a_frame_costs_at_most_one_percent_more_than_its_pixels),
        cmocka_unit_test(the_frame_time_is_that_of_the_bits),
        cmocka_unit_test(the_clock_can_be_changed_between_frames),
        cmocka_unit_test(a_panel_is_not_opened_with_what_it_does_not_have),
        cmocka_unit_test(windows_show_their_part_of_the_picture_wherever_they_lie),
        cmocka_unit_test(borders_that_the_controller_has_are_not_sent_again),
        cmocka_unit_test(a_window_outside_of_the_picture_or_within_a_byte_is_refused),
        cmocka_unit_test(grey_is_dithered_evenly_between_its_levels),
        cmocka_unit_test(odd_greys_are_padded_beside_the_glass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
