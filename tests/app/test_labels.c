/*
 * Labels, on every kit: they never lie on what the scene has drawn, they keep 2 pixels from the edge of the glass, and
 * a demo whose labels are numbers has them on the smallest glass, too. Also: how finely a demo is modelled beside the
 * best kit of the same resolution.
 *
 * The linker leads the calls of ph_overlay_text and ph_text through this test (the Makefile's --wrap), which so has the
 * rectangle of each label and the pixels that the renderer left below it. Small pictures: their outlines can be seen.
 * The test looks at the first, the middle and
 * the last frame of the cycle; with the argument `all` at every frame, with `print` it tells all that it finds.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "overlay.h"
#include "runner.h"
#include "sim.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MARGIN   2           /* px */
#define FAINT    32          /* of 255 */
#define LITTLE   (64u << 10) /* bytes */
#define LOW      64          /* lines */
#define ROWS_MAX 2048

static struct {
    struct runner runner;
    const struct board *board;
    const char *demo;
    uint32_t frame, labels, digits; /* of the frame */
    uint32_t covering, near_edge;   /* labels in all frames, each with the pixels that it is drawn into */
    char first[160];                /* the first complaint */
    bool bare;                      /* no label is drawn */
} at;

static bool all_frames;

__attribute__((format(printf, 2, 3))) static void complain(uint32_t *count, const char *format, ...)
{
    char text[sizeof at.first];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (at.covering + at.near_edge == 0) {
        memcpy(at.first, text, sizeof text);
    }
    ++*count;
}

/* Whether all of a rectangle lies on the glass and MARGIN from its edge; a round glass is the inscribed circle. */
static bool keeps_margin(int32_t x, int32_t y, int32_t width, int32_t height)
{
    const int32_t w = at.runner.context.width, h = at.runner.context.height;
    bool inside = x >= MARGIN && y >= MARGIN && x + width <= w - MARGIN && y + height <= h - MARGIN;
    for (int32_t i = 0; i < 4 && at.board->panel->round; i++) {
        const int32_t dx = 2 * (x + (i & 1) * (width - 1)) - w + 1, dy = 2 * (y + (i >> 1) * (height - 1)) - h + 1;
        inside = inside && dx * dx + dy * dy <= (w - 2 * MARGIN) * (w - 2 * MARGIN);
    }
    return inside;
}

/* Looks at the letters' rectangle and the outline around it, before they are drawn into a band. */
static void look(const struct ph_overlay_band *band, int32_t x, int32_t y, int32_t width, const char *text,
                 uint8_t scale)
{
    const int32_t height = (PH_FONT_HEIGHT - 1) * scale, y1 = y + height + 1, end = band->y0 + band->lines;
    uint32_t drawn = 0;
    for (int32_t row = y - 1 > band->y0 ? y - 1 : band->y0; row < y1 && row < end; row++) {
        for (int32_t column = x > 0 ? x - 1 : 0; column < x + width + 1 && column < band->width; column++) {
            drawn += band->pixels[(row - band->y0) * band->width + column] != at.runner.renderer.background;
        }
    }
    if (drawn > 0) {
        complain(&at.covering, "frame %u: \"%s\" covers %u pixels", (unsigned)at.frame, text, (unsigned)drawn);
    }
    if (y >= band->y0 && y < end) {
        at.labels++;
        at.digits += strcspn(text, "0123456789") < strlen(text);
        if (!keeps_margin(x, y, width, height)) {
            complain(&at.near_edge, "frame %u: \"%s\" is at the edge, %d,%d and %d wide", (unsigned)at.frame, text,
                     (int)x, (int)y, (int)width);
        }
    }
}

void __real_ph_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                            const struct ph_overlay_style *style);
void labels_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                         const struct ph_overlay_style *style);
void __real_ph_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                    const struct ph_overlay_style *style);
void labels_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                 const struct ph_overlay_style *style);

void labels_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                         const struct ph_overlay_style *style)
{
    if (!at.bare) {
        look(band, x, y, ph_overlay_width(text, style->scale) - style->scale, text, style->scale);
        __real_ph_overlay_text(band, x, y, text, style);
    }
}

void labels_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                 const struct ph_overlay_style *style)
{
    if (!at.bare) {
        look(band, x, y, ph_text_width(text, style->scale), text, style->scale);
        __real_ph_text(band, x, y, text, style);
    }
}

/* ---- a demo on a kit --------------------------------------------------------------------------------------------- */

struct seen {
    uint32_t triangles; /* that are drawn, most */
    uint32_t labels, digits, covering, near_edge;
    uint32_t outline,
        faint; /* pixels where something ends at the background; those of them that hardly differ from it */
    char first[sizeof at.first];
};

static int32_t brightness(uint16_t wire)
{
    const uint32_t pixel = (uint32_t)(wire & 255) << 8 | wire >> 8;
    return (int32_t)(299 * (pixel >> 11 << 3) + 587 * (pixel >> 5 << 2 & 255) + 114 * (pixel << 3 & 255)) / 1000;
}

/* Counts the outline in the rows of a band. Fog takes it into the background on purpose. */
static void see_outline(struct seen *seen, const uint16_t *pixels, uint32_t lines)
{
    const uint16_t background = at.runner.renderer.background;
    for (uint32_t i = 1; i < lines * at.runner.context.width && at.runner.renderer.fog == NULL; i++) {
        const uint16_t a = pixels[i - 1], b = pixels[i];
        if ((a == background) != (b == background) && i % at.runner.context.width != 0) {
            seen->outline++;
            seen->faint += abs(brightness(a) - brightness(b)) < FAINT;
        }
    }
}

static void draw(struct seen *seen, bool bare)
{
    at.bare = bare;
    assert_int_equal(runner_scene(&at.runner, at.frame), PH_OK);
    for (uint32_t band = 0, bands = ph_frame_bands(&at.runner.renderer); band < bands; band++) {
        uint16_t *const pixels = at.runner.bands[0];
        const uint32_t lines = demo_draw_band(at.runner.demo, &at.runner.context, &at.runner.renderer, band, pixels);
        if (bare) {
            see_outline(seen, pixels, lines);
        }
    }
}

static void see_frame(struct seen *seen, uint32_t frame)
{
    at.frame = frame;
    at.labels = at.digits = 0;
    draw(seen, false);
    if (at.runner.context.height == LOW) {
        draw(seen, true);
    }
    const uint32_t drawn = at.runner.renderer.stats.triangles_drawn;
    seen->triangles = drawn > seen->triangles ? drawn : seen->triangles;
    seen->labels = at.labels > seen->labels ? at.labels : seen->labels;
    seen->digits = at.digits > seen->digits ? at.digits : seen->digits;
}

static struct seen see(const struct board *board, const struct demo *demo)
{
    struct seen seen = {0};
    struct hal hal;
    struct sim *const sim = sim_open(board, &hal);
    struct runner_config config = {.board = board,
                                   .depth_format = PH_DEPTH_AUTO,
                                   .rotation = board->rotation,
                                   .band_height = board->band_height,
                                   .budget_bytes = board->scene_bytes,
                                   .demo = demo};
    config.memory_bytes = runner_bytes(&config);
    config.memory = malloc(config.memory_bytes);
    assert_non_null(config.memory);
    memset(&at, 0, sizeof at);
    at.board = board;
    assert_int_equal(runner_open(&at.runner, &hal, &config), PH_OK);
    const uint32_t last = demo->loop_frames - 1, step = all_frames ? 1 : last > 1 ? last / 2 : 1;
    for (uint32_t frame = 0; frame <= last; frame += step) {
        see_frame(&seen, frame);
    }
    seen.covering = at.covering;
    seen.near_edge = at.near_edge;
    memcpy(seen.first, at.first, sizeof at.first);
    assert_int_equal(runner_close(&at.runner), 0);
    free(config.memory);
    sim_close(sim);
    return seen;
}

/* ---- all of them ------------------------------------------------------------------------------------------------- */

/* Whether an earlier board of the list shows the same pictures. */
static bool is_seen_before(uint32_t b)
{
    const struct board *const board = board_list[b];
    bool before = false;
    for (uint32_t i = 0; i < b; i++) {
        const struct board *const other = board_list[i];
        before =
            before || (other->panel->width == board->panel->width && other->panel->height == board->panel->height &&
                       other->rotation % 2 == board->rotation % 2 && other->panel->round == board->panel->round &&
                       other->scene_bytes == board->scene_bytes && other->format == board->format &&
                       other->band_height == board->band_height && other->band_buffers == board->band_buffers);
    }
    return before;
}

static struct row {
    const struct board *board;
    const struct demo *demo;
    uint32_t width, height;
    struct seen seen;
} rows[ROWS_MAX];
static uint32_t row_count;

static int see_all(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        for (uint32_t b = 0; b < board_count; b++) {
            if (!is_seen_before(b)) {
                assert_true(row_count < ROWS_MAX);
                struct row *const row = &rows[row_count++];
                *row = (struct row){
                    .board = board_list[b], .demo = demo_list[d], .seen = see(board_list[b], demo_list[d])};
                row->width = at.runner.context.width;
                row->height = at.runner.context.height;
            }
        }
    }
    return 0;
}

static void labels_lie_on_nothing_that_is_drawn_and_keep_two_pixels_from_the_edge(void **state)
{
    (void)state;
    uint32_t labels = 0, failed = 0;
    for (const struct row *row = rows; row < rows + row_count; row++) {
        const struct seen *const s = &row->seen;
        labels += s->labels;
        if (s->covering + s->near_edge != 0) {
            print_error("%s on %s: %s; %u labels cover, %u are near the edge\n", row->demo->name, row->board->name,
                        s->first, (unsigned)s->covering, (unsigned)s->near_edge);
            failed++;
        }
    }
    assert_int_equal(failed, 0);
    assert_true(labels > 100);
}

static void a_demo_with_numbers_has_them_on_glass_of_forty_lines(void **state)
{
    (void)state;
    for (const struct row *row = rows; row < rows + row_count; row++) {
        uint32_t most = 0;
        for (const struct row *other = rows; other < rows + row_count; other++) {
            most = other->demo == row->demo && other->seen.digits > most ? other->seen.digits : most;
        }
        if (most > 0 && row->seen.digits == 0 && row->height >= 40) {
            fail_msg("%s has no number on %s", row->demo->name, row->board->name);
        }
    }
}

/* On a kit with less memory a demo in the cycle of its button is at most so much coarser. (An LM3S6965 has 29 KB for
 * the picture and the scene.) */
static void each_kit_has_three_fifths_of_the_triangles_of_the_best(void **state)
{
    (void)state;
    for (const struct row *row = rows; row < rows + row_count; row++) {
        uint32_t most = 0;
        for (const struct row *other = rows; other < rows + row_count; other++) {
            const bool alike = other->demo == row->demo && other->width == row->width && other->height == row->height;
            most = alike && other->seen.triangles > most ? other->seen.triangles : most;
        }
        if (!row->demo->by_name_only && row->board->scene_bytes >= LITTLE && 5 * row->seen.triangles < 3 * most) {
            fail_msg("%s on %s: %u triangles of %u", row->demo->name, row->board->name, (unsigned)row->seen.triangles,
                     (unsigned)most);
        }
    }
}

/* What is in focus: where a figure ends at the background, it is brighter or darker by an eighth of white at least, on
 * three quarters of the outline. */
static void silhouettes_are_legible_on_glass_of_64_lines(void **state)
{
    (void)state;
    for (const struct row *row = rows; row < rows + row_count; row++) {
        if (row->height == LOW && row->demo->blur_radius == 0 && 4 * row->seen.faint > row->seen.outline) {
            fail_msg("%s on %s: %u of %u pixels of its outlines are faint", row->demo->name, row->board->name,
                     (unsigned)row->seen.faint, (unsigned)row->seen.outline);
        }
    }
}

static void print_all(void)
{
    for (const struct row *row = rows; row < rows + row_count; row++) {
        const struct seen *const s = &row->seen;
        printf("%-12s %-26s %ux%u\t%u triangles, %u labels, %u numbers, %u cover, %u at the edge, faint %u of %u; %s\n",
               row->demo->name, row->board->name, (unsigned)row->width, (unsigned)row->height, (unsigned)s->triangles,
               (unsigned)s->labels, (unsigned)s->digits, (unsigned)s->covering, (unsigned)s->near_edge,
               (unsigned)s->faint, (unsigned)s->outline, s->first);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_lie_on_nothing_that_is_drawn_and_keep_two_pixels_from_the_edge),
        cmocka_unit_test(a_demo_with_numbers_has_them_on_glass_of_forty_lines),
        cmocka_unit_test(each_kit_has_three_fifths_of_the_triangles_of_the_best),
        cmocka_unit_test(silhouettes_are_legible_on_glass_of_64_lines),
    };
    bool tells = false;
    for (int i = 1; i < argc; i++) {
        tells = tells || strcmp(argv[i], "print") == 0;
        all_frames = all_frames || strcmp(argv[i], "all") == 0;
    }
    if (tells) {
        see_all(NULL);
        print_all();
        return 0;
    }
    return cmocka_run_group_tests(tests, see_all, NULL);
}
