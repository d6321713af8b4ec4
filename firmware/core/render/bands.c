/*
 * Bands: each band sets up and draws its triangles, which feed.h finds. See list.h, render.h.
 *
 * A triangle is set up in the band where it begins. If it goes on below, it is carried on in its slot; if there is no
 * slot for it, its reference moves to the next band, where it is set up again. That gives the same pixels, because what
 * a triangle gives at a pixel depends on the triangle and the pixel alone: planes are exact modulo 2^32. So the number
 * of slots changes the speed, and nothing else.
 */
/* Kits on armv6m: -O2. */
#include "bands_loop.h"

#include "coarse.h"
#include "samples.h"

/* ---- set-up ----------------------------------------------------------------------------------------------------- */

PH_TIER(mesh) void ph_enter_draw(struct ph_feed *f, uint32_t ref)
{
    ph_feed_find(f, ref);
    ph_take_lens(f->r, f->draw);
    ph_setting_of(&f->setting, f->r, f->draw);
}

/* ---- drawing ---------------------------------------------------------------------------------------------------- */

/* Draws the carried triangles that come before the next reference. */
PH_TIER(scenery)
static PH_NOINLINE uint32_t draw_begun(struct ph_feed *f, struct ph_rest *rest) /* called as draw_begun */
{
    return ph_begun_loop(f, rest, NULL);
}

/* ---- bands ----------------------------------------------------------------------------------------------------- */

/* Draws the triangles of a band that are left, until the other core is idle. */
PH_TIER(mesh) static FX_APART void draw_rest(struct ph_feed *f, struct ph_rest *rest) /* called as draw_rest */
{
    ph_rest_loop(f, rest, draw_begun, NULL);
}

PH_TIER(mesh) void ph_draw_rows(struct ph_feed *f, struct ph_band *rows)
{
    ph_rows_loop(f, rows, draw_rest);
}

PH_TIER(mesh) uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const int32_t lines = r->config.band_height, height = r->config.height;
    const int32_t y0 = (int32_t)band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    if (band != r->list.band || band >= r->band_count || (uintptr_t)pixels % sizeof(uint16_t) != 0 || pixels == NULL) {
        return 0;
    }
    const bool depth24 = r->stats.depth_format->bits > 16;
    r->list.band++;
    struct ph_coarse coarse[2]; /* the other core has its own, for its rows */
    coarse[0].count = coarse[1].count = 0;
    coarse[0].occlusion = coarse[1].occlusion = r->config.occlusion;
    struct ph_band rows = {NULL, r->config.depth, depth24, r->config.width,  y0,
                           y1,   r->config.width, NULL,    ph_depth_ways(r), r->config.colouring};
    rows.coarse = r->config.occlusion != NULL ? coarse : NULL;
    struct ph_feed f;
    ph_feed_start(&f, r, band);
    if (r->config.antialiasing != NULL) {
        r->config.antialiasing->draw_samples(&f, &rows, pixels);
    } else {
        rows.pixels = pixels; /* an assignment, not an initialiser: else clang-tidy asks for a const pointer */
        ph_draw_rows(&f, &rows);
    }
    return (uint32_t)(y1 - y0) >> r->samples_log2;
}
