/*
 * panel_tiles: the model's glass shows the same picture as after a whole frame. Little is sent where little changed,
 * and a change that a signature missed is healed in time.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "panel_tiles.h"
#include "panels.h"
#include "sim.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint16_t picture[PICTURE_PIXELS] __attribute__((aligned(4)));
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS];

struct rig {
    struct board board;
    struct sim *sim;
    struct hal hal;
    struct panel_driver d;
    struct panel_tiles tiles;
    uint32_t lines;
    void *memory;
};

static void rig_open(struct rig *rig, const struct panel *panel, unsigned rotation, uint32_t lines)
{
    rig->board = (struct board){.name = "test",
                                .panel = panel,
                                .spi_hz = panel->controller->write_hz,
                                .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)}};
    rig->lines = lines;
    rig->sim = sim_open(&rig->board, &rig->hal);
    assert_non_null(rig->sim);
    const struct panel_config config = {panel, (uint8_t)rotation, PANEL_RGB565, rig->board.spi_hz, NULL, 0};
    assert_int_equal(panel_open(&rig->d, &rig->hal, &config), 0);
    const size_t bytes = panel_tiles_bytes(rig->d.width, rig->d.height, (uint16_t)lines);
    rig->memory = malloc(bytes);
    assert_int_equal(panel_tiles_init(&rig->tiles, &rig->d, (uint16_t)lines, rig->memory, bytes - 1), HAL_EINVAL);
    assert_int_equal(panel_tiles_init(&rig->tiles, &rig->d, 0, rig->memory, bytes), HAL_EINVAL);
    assert_int_equal(panel_tiles_init(&rig->tiles, &rig->d, (uint16_t)lines, rig->memory, bytes), 0);
}

static void rig_close(struct rig *rig)
{
    assert_int_equal(panel_close(&rig->d), 0);
    picture_no_complaint(rig->sim, "tiles");
    sim_close(rig->sim);
    free(rig->memory);
}

/* Copies bands into aligned memory, as those of a kit are. */
static int show(struct rig *rig)
{
    static uint16_t band[PICTURE_PIXELS] __attribute__((aligned(4)));
    int status = panel_tiles_begin(&rig->tiles, &rig->d);
    for (uint32_t y = 0; y < rig->d.height && status >= 0; y += rig->lines) {
        const uint32_t n = rig->d.height - y < rig->lines ? rig->d.height - y : rig->lines;
        memcpy(band, picture + y * rig->d.width, sizeof *band * n * rig->d.width);
        status = panel_tiles_rows(&rig->tiles, &rig->d, band, n);
    }
    const int ended = panel_tiles_end(&rig->tiles, &rig->d);
    return status < 0 ? status : ended;
}

static bool glass_agrees(struct rig *rig)
{
    const struct panel_config *c = &rig->d.config;
    sim_pixels(rig->sim, c->rotation, seen);
    picture_expect(picture, rig->d.width, rig->d.height, PANEL_RGB565, c->panel->round, expected);
    return memcmp(seen, expected, 3U * rig->d.width * rig->d.height) == 0;
}

static uint32_t random_state;

static uint32_t draw(uint32_t below)
{
    random_state = random_state * 1664525U + 1013904223U;
    return (uint32_t)((uint64_t)random_state * below >> 32);
}

/* One pixel, a box of noise, nothing, or everything. */
static void change(uint32_t width, uint32_t height, uint32_t step)
{
    if (step % 7 == 3) {
        return;
    }
    if (step % 7 == 5) {
        picture_fill(picture, width, height, step);
        return;
    }
    const uint32_t w = step % 2 ? 1 : 1 + draw(width / 2), h = step % 2 ? 1 : 1 + draw(height / 2);
    const uint32_t x = draw(width - w + 1), y = draw(height - h + 1);
    for (uint32_t i = 0; i < w * h; i++) {
        picture[(y + i / w) * width + x + i % w] ^= (uint16_t)(1U << draw(16));
    }
}

static void the_glass_shows_what_was_drawn(void **state)
{
    (void)state;
    static const struct {
        const struct panel *panel;
        unsigned rotation;
        uint32_t lines;
    } cases[] = {{&panel_st7789_240x320, PANEL_R90, 16}, {&panel_st7789_240x240, PANEL_R0, 16},
                 {&panel_st7789_135x240, PANEL_R90, 16}, {&panel_st7789_135x240, PANEL_R0, 7}, /* 135 px wide */
                 {&panel_st7735s_80x160, PANEL_R270, 8}, {&panel_gc9a01_240x240, PANEL_R180, 240},
                 {&panel_st7789_170x320, PANEL_R0, 1},   {&panel_ssd1351_128x128, PANEL_R90, 100}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        rig_open(&rig, cases[i].panel, cases[i].rotation, cases[i].lines);
        for (uint32_t step = 0; step < 60; step++) {
            change(rig.d.width, rig.d.height, step);
            assert_int_equal(show(&rig), 0);
            if (!glass_agrees(&rig)) {
                picture_compare(seen, expected, rig.d.width, rig.d.height, cases[i].panel->name);
            }
        }
        rig_close(&rig);
    }
}

/* Shows the picture until only the tiles in their turn are sent. */
static void settle(struct rig *rig)
{
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(show(rig), 0);
    }
}

static void one_pixel_costs_one_tile(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    const uint32_t tile = 2 * 16 * 16, window = 11;
    assert_int_equal(rig.d.frame_bytes, tile + window); /* only the tile in its turn */
    for (uint32_t i = 0; i < 200; i++) {
        picture[draw(240 * 240)] ^= (uint16_t)(1U << draw(16));
        assert_int_equal(show(&rig), 0);
        assert_true(glass_agrees(&rig));
        assert_in_range(rig.d.frame_bytes, tile + window, 2 * (tile + window));
    }
    rig_close(&rig);
}

/* Tiles at the right edge are narrower, and those of an odd width end with half a word. */
static void a_pixel_counts_for_its_own_tile_alone(void **state)
{
    (void)state;
    static const struct {
        const struct panel *panel;
        uint32_t lines, tile_pixels; /* in a line of the largest tile */
    } cases[] = {{&panel_st7789_170x320, 16, 16}, {&panel_st7789_135x240, 7, 135}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        rig_open(&rig, cases[i].panel, PANEL_R0, cases[i].lines);
        picture_fill(picture, rig.d.width, rig.d.height, 1);
        settle(&rig);
        const uint32_t width = rig.d.width, lines = cases[i].lines, most = 2 * cases[i].tile_pixels * lines + 11;
        const uint32_t places[] = {lines * width - 1, 0, width - 1, (lines - 1) * width, width, 2 * width - 1};
        for (size_t place = 0; place < sizeof places / sizeof places[0]; place++) {
            picture[places[place]] ^= 0x0101;
            assert_int_equal(show(&rig), 0);
            assert_true(glass_agrees(&rig));
            assert_in_range(rig.d.frame_bytes, 2 * lines, 2 * most); /* the other is in its turn */
        }
        rig_close(&rig);
    }
}

static void if_all_changes_it_costs_no_more_than_whole_frames(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x320, PANEL_R90, 16);
    const uint32_t whole = panel_frame_bytes(&panel_st7789_240x320, PANEL_RGB565, PANEL_R90);
    for (uint32_t step = 0; step < 50; step++) {
        for (uint32_t i = 0; i < 320 * 240; i++) {
            picture[i] = (uint16_t)draw(65536);
        }
        assert_int_equal(show(&rig), 0);
        assert_int_equal(rig.d.frame_bytes, whole);
    }
    assert_true(glass_agrees(&rig));
    rig_close(&rig);
}

/* Columns 5 .. 9 of all bands change: one window all the way down. */
static void bands_with_the_same_columns_share_a_window(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    for (uint32_t y = 0; y < 240; y++) {
        for (uint32_t x = 80; x < 160; x++) {
            picture[y * 240 + x] = (uint16_t)draw(65536);
        }
    }
    assert_int_equal(show(&rig), 0);
    assert_in_range(rig.d.frame_bytes, 2 * 80 * 240 + 11,
                    2 * 80 * 240 + 2 * 16 * 16 + 4 * 11); /* and one in its turn */
    assert_true(glass_agrees(&rig));
    rig_close(&rig);
}

/* Mixes as panel_tiles.c does; if that changes, the next test says so. */
static uint32_t mix(uint32_t sign, uint32_t word)
{
    const uint32_t mixed = (sign ^ word) * 0x9e3779b1U;
    return mixed >> 15 | mixed << 17;
}

static uint32_t word_at(const uint16_t *pixels)
{
    uint32_t word;
    memcpy(&word, pixels, sizeof word);
    return word;
}

/* Makes another tile with the same signature: its second word undoes the effect of the first. */
static void forge(uint16_t *tile)
{
    const uint32_t first = word_at(tile), second = word_at(tile + 2), other = first ^ 0x00f00010;
    const uint32_t forged = second ^ mix(0, first) ^ mix(0, other);
    memcpy(tile, &other, sizeof other);
    memcpy(tile + 2, &forged, sizeof forged);
}

static void a_false_match_is_healed_in_time(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    for (uint32_t i = 0; i < 5; i++) {
        forge(picture + draw(15) * 16 * 240 + draw(15) * 16);
        const uint32_t n = panel_tiles_refresh_frames(&rig.tiles);
        assert_int_equal(n, 15 * 15);
        uint32_t frames = 0;
        do {
            assert_int_equal(show(&rig), 0);
            frames++;
        } while (!glass_agrees(&rig) && frames < 2 * n);
        assert_in_range(frames, 1, n);
        assert_true(i != 0 || frames > 1); /* the signatures were the same */
    }
    rig_close(&rig);
}

/* A disturbance that writes into the panel's memory. The numbers of tiles are odd, even, and without a factor that both
 * have: a turn that leaves some out heals them in none of the other cases. */
static void a_disturbed_panel_is_healed_in_time(void **state)
{
    (void)state;
    static const struct {
        const struct panel *panel;
        unsigned rotation;
        uint32_t lines, tiles;
    } cases[] = {{&panel_st7789_240x240, PANEL_R0, 16, 15 * 15},
                 {&panel_st7789_240x320, PANEL_R90, 16, 20 * 15}, /* 320 wide */
                 {&panel_st7789_240x320, PANEL_R0, 40, 15 * 8},
                 {&panel_st7735s_80x160, PANEL_R0, 23, 5 * 7},
                 {&panel_st7789_135x240, PANEL_R0, 16, 15}}; /* odd: one tile a band */
    static uint16_t noise[320 * 240];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        rig_open(&rig, cases[i].panel, cases[i].rotation, cases[i].lines);
        picture_fill(picture, rig.d.width, rig.d.height, 1);
        settle(&rig);
        assert_int_equal(panel_tiles_refresh_frames(&rig.tiles), cases[i].tiles);
        assert_int_equal(panel_frame_begin(&rig.d), 0);
        assert_int_equal(panel_rows(&rig.d, noise, rig.d.height), 0);
        assert_int_equal(panel_frame_end(&rig.d), 0);
        assert_false(glass_agrees(&rig));
        for (uint32_t frame = 0; frame < cases[i].tiles; frame++) {
            assert_int_equal(show(&rig), 0);
        }
        assert_true(glass_agrees(&rig));
        rig_close(&rig);
    }
}

/* Fills these columns of the whole picture with noise. */
static void spoil(uint32_t columns)
{
    for (uint32_t i = 0; i < 240 * 240; i++) {
        picture[i] = i % 240 < columns ? (uint16_t)(picture[i] + 1 + draw(65535)) : picture[i];
    }
}

/* Nearly all is 14 of 15 tiles, for 7 of 8 are fewer than 13.2. After two such frames in a row a change is sent whole
 * for 15 more, and the signatures of the last of them count in the next. */
static void bands_that_change_nearly_all_are_sent_whole_for_sixteen_frames(void **state)
{
    (void)state;
    struct rig rig;
    const uint32_t whole = 2 * 240 * 240 + 11;
    for (uint32_t columns = 13; columns <= 14; columns++) {
        rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
        picture_fill(picture, 240, 240, 1);
        settle(&rig);
        for (uint32_t frame = 0; frame < 2; frame++) {
            spoil(columns * PANEL_TILE_PX);
            assert_int_equal(show(&rig), 0);
            assert_in_range(rig.d.frame_bytes, 2 * 240 * 16 * columns, whole - 200);
        }
        for (uint32_t frame = 0; frame < 16; frame++) { /* nothing changes any more */
            assert_int_equal(show(&rig), 0);
            assert_int_equal(rig.d.frame_bytes, columns == 14 ? whole : 2 * 16 * 16 + 11);
        }
        assert_int_equal(show(&rig), 0);
        assert_int_equal(rig.d.frame_bytes, 2 * 16 * 16 + 11);
        assert_true(glass_agrees(&rig));
        rig_close(&rig);
    }
}

/* A single frame in which nearly all changes is followed by watched ones. */
static void one_large_change_alone_is_no_reason_to_send_all(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    for (uint32_t i = 0; i < 4; i++) {
        spoil(240);
        assert_int_equal(show(&rig), 0);
        assert_int_equal(show(&rig), 0);
        assert_int_equal(rig.d.frame_bytes, 2 * 16 * 16 + 11);
    }
    rig_close(&rig);
}

/* Shows a still picture n times. A frame takes three times as long as a whole one on the bus, and `more` if its tiles
 * were watched. Returns how many frames were not whole. */
static uint32_t show_slowly(struct rig *rig, uint32_t n, uint32_t more_us)
{
    const struct hal *hal = &rig->hal;
    const uint32_t whole_us = panel_frame_us(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0, (uint32_t)rig->d.clock_hz);
    const uint32_t whole = panel_frame_bytes(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0);
    uint32_t few = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t from = hal->ops->time_us(hal->context);
        assert_int_equal(show(rig), 0);
        const bool watched = rig->d.frame_bytes < whole;
        few += watched;
        hal->ops->delay_us(hal->context,
                           3 * whole_us + (watched ? more_us : 0) - (hal->ops->time_us(hal->context) - from));
    }
    return few;
}

static void slow_cores_send_whole_frames_if_that_is_faster(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    assert_in_range(show_slowly(&rig, 310, 1000), 2, 12);
    rig_close(&rig);
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    settle(&rig);
    assert_in_range(show_slowly(&rig, 310, 0), 300, 308); /* whole ones are no faster: a trial takes two frames */
    assert_true(glass_agrees(&rig));
    rig_close(&rig);
}

static int broken_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context, (void)dc, (void)bytes, (void)n;
    return HAL_EIO;
}

static void after_an_error_all_is_sent(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    const struct hal_ops *const works = rig.d.hal.ops;
    struct hal_ops broken = *works;
    broken.bus_write = broken_write;
    rig.d.hal.ops = &broken;
    picture_fill(picture, 240, 240, 2);
    assert_int_equal(show(&rig), HAL_EIO);
    rig.d.hal.ops = works;
    assert_int_equal(show(&rig), 0);
    assert_int_equal(rig.d.frame_bytes, panel_frame_bytes(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0));
    assert_true(glass_agrees(&rig));
    rig_close(&rig);
}

static int broken_wait(void *context)
{
    (void)context;
    return HAL_EIO;
}

static void after_a_wait_that_failed_all_is_sent(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    const struct hal_ops *const works = rig.d.hal.ops;
    struct hal_ops broken = *works;
    broken.bus_wait = broken_wait;
    rig.d.hal.ops = &broken;
    assert_int_equal(show(&rig), HAL_EIO);
    rig.d.hal.ops = works;
    assert_int_equal(show(&rig), 0);
    assert_int_equal(rig.d.frame_bytes, panel_frame_bytes(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0));
    rig_close(&rig);
}

static void a_frame_that_lacks_bands_is_refused_and_all_is_sent_again(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    picture_fill(picture, 240, 240, 1);
    settle(&rig);
    assert_int_equal(panel_tiles_begin(&rig.tiles, &rig.d), 0);
    assert_int_equal(panel_tiles_rows(&rig.tiles, &rig.d, picture, 16), 0);
    assert_int_equal(panel_tiles_end(&rig.tiles, &rig.d), HAL_EINVAL);
    assert_int_equal(show(&rig), 0);
    assert_int_equal(rig.d.frame_bytes, panel_frame_bytes(&panel_st7789_240x240, PANEL_RGB565, PANEL_R0));
    rig_close(&rig);
}

static void bands_of_another_height_are_refused(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, &panel_st7789_240x240, PANEL_R0, 16);
    assert_int_equal(panel_tiles_begin(&rig.tiles, &rig.d), 0);
    assert_int_equal(panel_tiles_rows(&rig.tiles, &rig.d, picture, 15), HAL_EINVAL);
    assert_int_equal(panel_tiles_rows(&rig.tiles, &rig.d, picture, 17), HAL_EINVAL);
    assert_int_equal(panel_tiles_end(&rig.tiles, &rig.d), HAL_EINVAL); /* bands are missing */
    assert_int_equal(show(&rig), 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_glass_shows_what_was_drawn),
        cmocka_unit_test(one_pixel_costs_one_tile),
        cmocka_unit_test(a_pixel_counts_for_its_own_tile_alone),
        cmocka_unit_test(if_all_changes_it_costs_no_more_than_whole_frames),
        cmocka_unit_test(bands_with_the_same_columns_share_a_window),
        cmocka_unit_test(a_false_match_is_healed_in_time),
        cmocka_unit_test(a_disturbed_panel_is_healed_in_time),
        cmocka_unit_test(bands_that_change_nearly_all_are_sent_whole_for_sixteen_frames),
        cmocka_unit_test(one_large_change_alone_is_no_reason_to_send_all),
        cmocka_unit_test(slow_cores_send_whole_frames_if_that_is_faster),
        cmocka_unit_test(after_an_error_all_is_sent),
        cmocka_unit_test(after_a_wait_that_failed_all_is_sent),
        cmocka_unit_test(a_frame_that_lacks_bands_is_refused_and_all_is_sent_again),
        cmocka_unit_test(bands_of_another_height_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
