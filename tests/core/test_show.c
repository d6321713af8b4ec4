/* ph_show gives a callback the picture that the bands make: whole, or only what changed, in every order of pixels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_stage.h"
#include "overlay.h"

#include <stdlib.h>
#include <string.h>

enum { W = 120, H = 90, BAND = 16, CALLS_PER_FRAME = (H + BAND - 1) / BAND };

/* A display that a callback writes to. */
struct glass {
    unsigned order, calls, stop_at; /* stop_at: the call, from 1 on, that fails */
    uint32_t pixels_sent;
    uint8_t memory[W * H * 3];
};

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    struct glass *g = context;
    const size_t bytes = ph_pixel_bytes(g->order);
    assert_true(width > 0 && height > 0 && x + width <= W && y + height <= H);
    if (++g->calls == g->stop_at) {
        return -5;
    }
    g->pixels_sent += width * height;
    for (uint32_t line = 0; line < height; line++) {
        memcpy(g->memory + ((y + line) * W + x) * bytes, (const uint8_t *)pixels + line * width * bytes, width * bytes);
    }
    return 0;
}

/* A demo that is drawn twice: by the bands of demo_stage_frame(), and on a stage that ph_show shows. */
struct pair {
    struct demo_stage by_bands, shown;
    struct glass glass;
    uint8_t band[W * BAND * 3];
    uint16_t before[W * H];
};

static struct pair *pair_open(const char *name, unsigned order, bool changes)
{
    struct pair *p = calloc(1, sizeof *p);
    assert_non_null(p);
    const struct demo *demo = demo_find(name);
    p->by_bands = demo_stage_open(demo, W, H);
    p->shown = demo_stage_open(demo, W, H);
    rig_close(&p->shown.rig);
    rig_open(&p->shown.rig, W, H, BAND, PH_DEPTH_FIXED16, (int)demo->vertex_max, (int)demo->triangle_max);
    struct ph_config *config = &p->shown.rig.r.config;
    config->pixels = p->band;
    config->pixel_order = (uint8_t)order;
    config->shown = changes ? p->before : NULL;
    memset(p->before, 0xA5, sizeof p->before); /* the first frame may not trust it */
    p->glass.order = order;
    return p;
}

static void pair_close(struct pair *p)
{
    demo_stage_close(&p->by_bands);
    demo_stage_close(&p->shown);
    free(p);
}

static int show(struct pair *p, uint32_t frame)
{
    assert_int_equal(p->shown.demo->frame(&p->shown.context, &p->shown.rig.r, frame), PH_OK);
    return ph_show(&p->shown.rig.r, flush, &p->glass);
}

/* A pixel of the glass as a number: 5 bits red, 6 green, 5 blue. */
static unsigned colour_on_glass(const struct glass *g, int i)
{
    uint16_t native;
    const uint8_t *at = g->memory + i * (int)ph_pixel_bytes(g->order);
    if (g->order == PH_PIXELS_RGB888) { /* the low bits repeat the high ones */
        assert_int_equal(at[0] & 7, at[0] >> 5);
        assert_int_equal(at[1] & 3, at[1] >> 6);
        assert_int_equal(at[2] & 7, at[2] >> 5);
        return (unsigned)(at[0] >> 3) << 11 | (unsigned)(at[1] >> 2) << 5 | (unsigned)(at[2] >> 3);
    }
    memcpy(&native, at, 2);
    return g->order == PH_PIXELS_NATIVE ? native : (unsigned)at[0] << 8 | at[1];
}

static void assert_glass_is(const struct pair *p)
{
    const uint8_t *wire = (const uint8_t *)p->by_bands.rig.pixels;
    for (int i = 0; i < W * H; i++) {
        assert_int_equal(colour_on_glass(&p->glass, i), (unsigned)wire[2 * i] << 8 | wire[2 * i + 1]);
    }
}

static void every_order_shows_what_the_bands_make(void **state)
{
    (void)state;
    for (unsigned order = PH_PIXELS_WIRE; order <= PH_PIXELS_RGB888; order++) {
        for (int changes = 0; changes < 2; changes++) {
            struct pair *p = pair_open("turntable", order, changes != 0);
            for (uint32_t frame = 3; frame < 9; frame++) {
                demo_stage_frame(&p->by_bands, frame);
                assert_int_equal(show(p, frame), PH_OK);
                assert_glass_is(p);
            }
            pair_close(p);
        }
    }
}

static void a_frame_as_before_sends_nothing(void **state)
{
    (void)state;
    struct pair *p = pair_open("cube", PH_PIXELS_NATIVE, true);
    assert_int_equal(show(p, 5), PH_OK);
    assert_int_equal(p->glass.pixels_sent, W * H);
    assert_int_equal(p->glass.calls, CALLS_PER_FRAME);
    assert_int_equal(show(p, 5), PH_OK);
    assert_int_equal(p->glass.calls, CALLS_PER_FRAME);
    assert_int_equal(show(p, 6), PH_OK);
    assert_true(p->glass.pixels_sent > W * H && p->glass.pixels_sent < 2 * W * H);
    demo_stage_frame(&p->by_bands, 6);
    assert_glass_is(p);
    pair_close(p);
}

static void after_a_failure_the_frame_is_sent_whole(void **state)
{
    (void)state;
    struct pair *p = pair_open("torus", PH_PIXELS_WIRE, true);
    assert_int_equal(show(p, 0), PH_OK);
    p->glass.stop_at = p->glass.calls + 2;
    assert_int_equal(show(p, 1), -5);
    const uint32_t sent = p->glass.pixels_sent;
    assert_int_equal(show(p, 1), PH_OK);
    assert_int_equal(p->glass.pixels_sent - sent, W * H);
    demo_stage_frame(&p->by_bands, 1);
    assert_glass_is(p);
    pair_close(p);
}

static void paint(void *context, const struct ph_overlay_band *band)
{
    static const struct ph_overlay_style style = {.colour = 0xffff, .scale = 2};
    assert_int_equal(((const struct glass *)context)->order, PH_PIXELS_WIRE); /* the context is the flush's */
    ph_overlay_text(band, 20, 9, "OVER BANDS", &style);
}

/* Text over the border of two bands; what changed is found with it. */
static void what_is_painted_lies_over_the_picture(void **state)
{
    (void)state;
    for (int changes = 0; changes < 2; changes++) {
        struct pair *p = pair_open("cube", PH_PIXELS_WIRE, changes != 0);
        for (uint32_t frame = 4; frame < 6; frame++) {
            assert_int_equal(p->shown.demo->frame(&p->shown.context, &p->shown.rig.r, frame), PH_OK);
            assert_int_equal(ph_show_painted(&p->shown.rig.r, flush, &p->glass, paint), PH_OK);
            demo_stage_frame(&p->by_bands, frame);
            const struct ph_overlay_band whole = {p->by_bands.rig.pixels, W, 0, H};
            paint(&p->glass, &whole);
            assert_glass_is(p);
        }
        pair_close(p);
    }
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    struct pair *p = pair_open("cube", PH_PIXELS_WIRE, false);
    struct ph_config *config = &p->shown.rig.r.config;
    config->pixels = NULL;
    assert_int_equal(show(p, 0), PH_ERR_INVAL);
    config->pixels = p->band + 1;
    assert_int_equal(show(p, 0), PH_ERR_INVAL);
    config->pixels = p->band;
    config->pixel_order = PH_PIXELS_RGB888 + 1;
    assert_int_equal(show(p, 0), PH_ERR_INVAL);
    assert_int_equal(p->glass.calls, 0);
    pair_close(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_order_shows_what_the_bands_make),
        cmocka_unit_test(a_frame_as_before_sends_nothing),
        cmocka_unit_test(after_a_failure_the_frame_is_sent_whole),
        cmocka_unit_test(what_is_painted_lies_over_the_picture),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
