/*
 * Rasterizer: a triangle is walked down its edges, as far as they lie in the band, and its spans are drawn. See
 * raster.h. Small triangles, which are the most, are drawn here; the others in raster_*.c.
 *
 * What a triangle gives at a pixel depends on the triangle and the pixel alone, because planes are exact modulo 2^32.
 * So the picture does not depend on where a band begins.
 */
/* Kits on armv6m: -O2. */
#include "raster.h"

#include "coarse.h"
#include "line.h"
#include "raster_exact.h"
#include "raster_large.h"
#include "raster_rows.h"
#include "samples.h"
#include "shading.h"

/* Draws a small triangle that the band cuts, or that has a knee. */
PH_TIER(loop) static PH_NOINLINE uint32_t draw_cut(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = ph_cut_rows(t, band, &r);
    ph_gouraud_kernel *const draw = t->kind == PH_KIND_SMALL ? at.draw_gouraud : band->ways->octaves->draw_knee;
    return draw(&r, at.depth, at.pixels, 2 * at.stride);
}

/* Whether a triangle is small and has a plane of codes, with or without a knee. */
static inline bool can_step(const struct ph_triangle *t)
{
    return t->kind == PH_KIND_SMALL || t->kind == PH_KIND_SMALL_KNEE;
}

PH_TIER(loop) uint32_t ph_draw_triangle(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind == PH_KIND_SMALL && t->y_top >= band->y0 && t->y_bottom <= band->y1) {
        return ph_draw_whole(t, band, ph_small_gouraud);
    }
    if (t->kind == PH_KIND_SMALL_TEXTURE) {
        return t->block == PH_BLOCK_NONE ? t->material->shading->texturing.draw_texels(t, band)
                                         : band->ways->octaves->draw_split(t, band);
    }
    if (PH_TEXTURE_KNEE && t->kind == PH_KIND_SMALL_TEXTURE_KNEE) {
        return t->material->shading->texturing.draw_texels(t, band);
    }
    if (can_step(t)) {
        return draw_cut(t, band);
    }
    if (t->kind == PH_KIND_SMALL_SPLIT) {
        return band->ways->octaves->draw_split(t, band);
    }
    if (t->kind == PH_KIND_SMALL_OWN) {
        return t->as.small.of.own.draw(t, band);
    }
    if (t->kind >= PH_KIND_LINE) {
        return t->as.line.lines->draw_line(t, band);
    }
    if (t->block == PH_BLOCK_EXACT) {
        return ph_draw_exact(t, band);
    }
    const bool tests = t->block == PH_BLOCK_NONE && band->coarse != NULL && t->y_bottom - t->y_top >= PH_OCCLUDED_ROWS;
    return tests ? band->coarse->occlusion->draw_unless_hidden(t, band) : ph_draw_large(t, band);
}

/* Steps a small triangle down to row y1, where the next band begins; y_bottom is below y1. A triangle that crosses
 * octaves stays as it is, since its depth is rounded at its first row. */
PH_TIER(loop) void ph_step_below(struct ph_triangle *t, int32_t y1)
{
    if (can_step(t)) {
        ph_skip_rows(&t->as.small.rows, (uint32_t)(y1 - t->y_top));
        t->y_top = (int16_t)y1;
    }
}

/* The general case of ph_draw_above: draws the triangle, then steps it down to the next band. */
PH_TIER(loop) static PH_NOINLINE uint32_t draw_then_step(struct ph_triangle *t, const struct ph_band *band)
{
    const uint32_t count = ph_draw_triangle(t, band);
    ph_step_below(t, band->y1);
    return count;
}

PH_TIER(scenery) uint32_t ph_draw_above(struct ph_triangle *t, const struct ph_band *band)
{
    if (t->y_top >= band->y0) {
        if (t->kind == PH_KIND_SMALL) { /* the most frequent */
            return ph_draw_above_with(t, band, ph_small_gouraud);
        }
        if (t->kind == PH_KIND_SMALL_KNEE) {
            return ph_draw_above_with(t, band, band->ways->octaves->draw_knee);
        }
    }
    if (t->kind >= PH_KIND_LINE) {
        return t->as.line.lines->draw_and_step(t, band);
    }
    return draw_then_step(t, band);
}
