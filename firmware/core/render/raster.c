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
#include "shading.h"

/* Steps n rows down, which are fewer than the upper ones. */
static inline void skip_upper_rows(struct ph_small_triangle *r, uint32_t n, uint32_t upper_rows, uint32_t lower_rows)
{
    r->left += n * r->left_dx;
    r->right += n * r->right_dx;
    r->d += n * r->d_dy;
    r->light += n * r->light_dy;
    r->upper_rows = (uint16_t)(upper_rows - n);
    r->lower_rows = (uint16_t)lower_rows;
}

/* Steps n rows down, through both halves, which have so many rows. */
static inline void skip_rows_of(struct ph_small_triangle *r, uint32_t n, uint32_t upper_rows, uint32_t lower_rows)
{
    if (n < upper_rows) {
        skip_upper_rows(r, n, upper_rows, lower_rows);
        return;
    }
    const uint32_t below = n - upper_rows, dx = (uint32_t)r->lower.dx, x = (uint32_t)r->lower.x + below * dx;
    r->d += n * r->d_dy;
    r->light += n * r->light_dy;
    if (r->lower_is_right) {
        r->left += n * r->left_dx;
        r->right = x;
        r->right_dx = dx;
    } else {
        r->right += n * r->right_dx;
        r->left = x;
        r->left_dx = dx;
    }
    r->upper_rows = (uint16_t)(lower_rows - below);
    r->lower_rows = 0;
}

PH_TIER(loop) static FX_APART void skip_rows(struct ph_small_triangle *r, uint32_t n)
{
    skip_rows_of(r, n, r->upper_rows, r->lower_rows);
}

/* Cuts a triangle down to its rows in the band. Returns the place of the first of them. */
PH_TIER(loop)
static FX_APART struct ph_place cut_rows(const struct ph_triangle *t, const struct ph_band *band,
                                         struct ph_small_triangle *r)
{
    int32_t y = t->y_top - band->y0;
    if (y < 0) {
        skip_rows(r, 0u - (uint32_t)y);
        y = 0;
    }
    const uint32_t rows = (uint32_t)(band->y1 - band->y0 - y), upper_rows = r->upper_rows;
    if (upper_rows >= rows) {
        r->upper_rows = (uint16_t)rows;
        r->lower_rows = 0;
    } else if (r->lower_rows > rows - upper_rows) {
        r->lower_rows = (uint16_t)(rows - upper_rows);
    }
    const uint32_t stride = band->stride, start = (uint32_t)y * stride;
    return (struct ph_place){(uint16_t *)band->depth + start, band->pixels + start, stride, false};
}

/* Draws the rows of a small triangle that are left. */
static inline uint32_t draw_left(const struct ph_triangle *t, const struct ph_small_triangle *r,
                                 const struct ph_place *at)
{
    return t->kind == PH_KIND_SMALL_KNEE ? ph_small_knee(r, at->depth, at->pixels, 2 * at->stride)
                                         : ph_small_gouraud(r, at->depth, at->pixels, 2 * at->stride);
}

/* Sets the light of a small triangle of samples after n rows were skipped: it steps by pixels, see light_pixels in
 * setup.c. */
static PH_NOINLINE void mend_light(struct ph_small_triangle *r, uint32_t n)
{
    const uint32_t light = r->light - n * r->light_dy, rows = (light & 1) + n; /* from the first pixel's on */
    r->light = (light & ~(uint32_t)1) + rows / 2 * (r->light_dy + 1) + (rows & 1);
}

/* Draws a small triangle that the band cuts, or that has a knee. */
PH_TIER(loop) static PH_NOINLINE uint32_t draw_cut(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = cut_rows(t, band, &r);
    return draw_left(t, &r, &at);
}

/* Draws a small triangle that crosses octaves. */
PH_TIER(scenery) static PH_NOINLINE uint32_t draw_split(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = cut_rows(t, band, &r);
    return ph_draw_rows_split(t, &r, at, NULL);
}

/* Draws a small triangle of samples. */
static PH_NOINLINE uint32_t draw_samples(const struct ph_triangle *t, const struct ph_band *band)
{
    const uint32_t stride_bytes = 2 * (uint32_t)band->stride;
    if (t->y_top >= band->y0 && t->y_bottom <= band->y1) {
        const uint32_t start = (uint32_t)(t->y_top - band->y0) * band->stride;
        return ph_samples_gouraud(&t->as.small.rows, (uint16_t *)band->depth + start, band->pixels + start,
                                  stride_bytes);
    }
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = cut_rows(t, band, &r);
    if (t->y_top < band->y0) {
        mend_light(&r, (uint32_t)(band->y0 - t->y_top));
    }
    return ph_samples_gouraud(&r, at.depth, at.pixels, stride_bytes);
}

/* ph_draw_above for a small triangle of samples. */
static PH_NOINLINE uint32_t draw_samples_above(struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    if (t->y_top < band->y0) {
        ph_step_below(t, band->y0);
    }
    const uint16_t upper_rows = small->upper_rows, lower_rows = small->lower_rows;
    const struct ph_place at = cut_rows(t, band, small);
    const uint32_t count = ph_samples_gouraud(small, at.depth, at.pixels, 2 * at.stride);
    small->upper_rows = upper_rows;
    small->lower_rows = lower_rows;
    ph_step_below(t, band->y1);
    return count;
}

/* Draws a triangle that is small but for its long rows. */
static PH_NOINLINE uint32_t draw_long(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    struct ph_place at = cut_rows(t, band, &r);
    if (t->block != PH_BLOCK_NONE) {
        at.long_rows = true;
        return ph_draw_rows_split(t, &r, at, NULL);
    }
    return ph_long_gouraud(&r, at.depth, at.pixels, 2 * at.stride);
}

/* Draws a small textured triangle that crosses octaves. */
PH_TIER(few) static PH_NOINLINE uint32_t draw_split_texture(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = cut_rows(t, band, &r);
    struct ph_small_texels texels;
    t->material->shading->texturing.begin_texels(&texels, t, t->y_top > band->y0 ? t->y_top : band->y0, 2 * at.stride);
    return ph_draw_rows_split(t, &r, at, &texels);
}

/* Draws a small triangle. Only the borders of the band can cut it. */
static inline uint32_t draw_small(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->y_top < band->y0 || t->y_bottom > band->y1) {
        return draw_cut(t, band);
    }
    const uint32_t stride = band->stride, start = (uint32_t)(t->y_top - band->y0) * stride;
    return ph_small_gouraud(&t->as.small.rows, (uint16_t *)band->depth + start, band->pixels + start, 2 * stride);
}

/* Draws a triangle, or only counts its pixels if an occluder hides it. */
PH_TIER(loop) static PH_NOINLINE uint32_t draw_unless_hidden(const struct ph_triangle *t, const struct ph_band *band)
{
    const uint32_t hidden = ph_coarse_hidden(t, band);
    if (hidden > 0) {
        return hidden;
    }
    const uint32_t count = ph_draw_large(t, band);
    if (count >= PH_OCCLUDER_LEAST) {
        ph_coarse_add(t, band);
    }
    return count;
}

PH_TIER(loop) uint32_t ph_draw_triangle(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind == PH_KIND_SMALL) {
        return draw_small(t, band);
    }
    if (t->kind == PH_KIND_SMALL_TEXTURE) {
        return t->block == PH_BLOCK_NONE ? t->material->shading->texturing.draw_texels(t, band)
                                         : draw_split_texture(t, band);
    }
    if (PH_TEXTURE_KNEE && t->kind == PH_KIND_SMALL_TEXTURE_KNEE) {
        return t->material->shading->texturing.draw_texels(t, band);
    }
    if (t->kind == PH_KIND_SMALL_KNEE) {
        return draw_cut(t, band);
    }
    if (t->kind == PH_KIND_SMALL_SPLIT) {
        return draw_split(t, band);
    }
    if (t->kind == PH_KIND_SMALL_SAMPLES) {
        return draw_samples(t, band);
    }
    if (t->kind == PH_KIND_SMALL_LONG) {
        return draw_long(t, band);
    }
    if (t->kind >= PH_KIND_LINE) {
        return t->as.line.lines->draw_line(t, band);
    }
    if (t->block == PH_BLOCK_EXACT) {
        return ph_draw_exact(t, band);
    }
    const bool tests = t->block == PH_BLOCK_NONE && band->coarse != NULL && t->y_bottom - t->y_top >= PH_OCCLUDED_ROWS;
    return tests ? draw_unless_hidden(t, band) : ph_draw_large(t, band);
}

/* Whether a triangle is small and has a plane of codes, with or without a knee. */
static inline bool can_step(const struct ph_triangle *t)
{
    return t->kind == PH_KIND_SMALL || t->kind == PH_KIND_SMALL_KNEE;
}

/* Steps a small triangle or a line down to row y1, where the next band begins; y_bottom is below y1. A triangle that
 * crosses octaves stays as it is, since its depth is rounded at its first row. */
PH_TIER(loop) void ph_step_below(struct ph_triangle *t, int32_t y1)
{
    if (t->kind >= PH_KIND_LINE) {
        t->as.line.lines->step_line(t, y1);
        return;
    }
    const bool has_samples = t->kind == PH_KIND_SMALL_SAMPLES;
    if (has_samples || can_step(t)) {
        const uint32_t rows = (uint32_t)(y1 - t->y_top);
        skip_rows(&t->as.small.rows, rows);
        t->y_top = (int16_t)y1;
        if (has_samples) {
            mend_light(&t->as.small.rows, rows);
        }
    }
}

/* The general case of ph_draw_above: draws the triangle, then steps it down to the next band. */
PH_TIER(loop) static PH_NOINLINE uint32_t draw_then_step(struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind == PH_KIND_SMALL_SAMPLES) {
        return draw_samples_above(t, band);
    }
    const uint32_t count = ph_draw_triangle(t, band);
    ph_step_below(t, band->y1);
    return count;
}

PH_TIER(scenery) uint32_t ph_draw_above(struct ph_triangle *t, const struct ph_band *band)
{
    if (!can_step(t) || t->y_top < band->y0) {
        return draw_then_step(t, band);
    }
    struct ph_small_triangle *const small = &t->as.small.rows;
    const uint32_t rows = (uint32_t)(band->y1 - t->y_top), upper_rows = small->upper_rows, stride = band->stride;
    const uint32_t lower_rows = small->lower_rows, start = (uint32_t)(t->y_top - band->y0) * stride;
    const struct ph_place at = {(uint16_t *)band->depth + start, band->pixels + start, stride, false};
    t->y_top = (int16_t)band->y1;
    if (rows < upper_rows) {
        small->upper_rows = (uint16_t)rows;
        small->lower_rows = 0;
        const uint32_t count = draw_left(t, small, &at);
        skip_upper_rows(small, rows, upper_rows, lower_rows);
        return count;
    }
    small->lower_rows = (uint16_t)(rows - upper_rows);
    const uint32_t count = draw_left(t, small, &at);
    skip_rows_of(small, rows, upper_rows, lower_rows);
    return count;
}
