/*
 * Triangles that are walked row by row: of one colour, Gouraud with linear-w or depth of 24 bits, and single pixels. A
 * span is drawn in one run, unless its depth crosses octaves. See raster_walk.h.
 */
/* Kits on armv6m: -O2. */
#include "raster_walk.h"

#include "edge.h"
#include "kernels.h"
#include "span.h"

void ph_draw_run(const struct ph_triangle *t, const struct ph_run *run)
{
    ph_span_flat(run->pixels, run->depth, run->n, run->d, run->gd, t->as.large.of.colour);
}

void ph_draw_run24(const struct ph_triangle *t, const struct ph_run *run)
{
    if (t->kind == PH_KIND_GOURAUD) {
        ph_span_gouraud24(run->pixels, run->depth, run->n, run->d, run->gd, run->light, run->glight, t->material->ramp);
    } else {
        ph_span_flat24(run->pixels, run->depth, run->n, run->d, run->gd, t->as.large.of.colour);
    }
}

/* Apart: a span has no registers left for the division. */
static FX_APART uint32_t linear_code(const struct ph_linear *linear, uint32_t over_w)
{
    return ph_depth_linear(linear, over_w);
}

/* Draws a span in one colour with depth in linear-w: d and gd belong to the plane of 1/w. */
static inline void span_flat_linear(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                                    const struct ph_linear *linear, uint16_t colour)
{
    for (; n > 0; n--, d += gd) {
        ph_pixel_flat(pixels++, depth++, linear_code(linear, d), colour);
    }
}

static inline void span_gouraud_linear(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                                       const struct ph_linear *linear, uint32_t light, uint32_t glight,
                                       const uint16_t *ramp)
{
    for (; n > 0; n--, d += gd, light += glight) {
        ph_pixel_gouraud(pixels++, depth++, linear_code(linear, d), light, ramp, PH_LIGHT_DOWN);
    }
}

void ph_draw_run_linear(const struct ph_triangle *t, const struct ph_run *run)
{
    const struct ph_linear *const codes = &t->as.large.depth.over_w.linear;
    if (t->block != PH_BLOCK_LINEAR) {
        ph_draw_run(t, run);
    } else if (t->kind == PH_KIND_GOURAUD) {
        span_gouraud_linear(run->pixels, run->depth, run->n, run->d, run->gd, codes, run->light, run->glight,
                            t->material->ramp);
    } else {
        span_flat_linear(run->pixels, run->depth, run->n, run->d, run->gd, codes, t->as.large.of.colour);
    }
}

/* How many of the next `left` pixels stay in the octave; the first has depth d, and counts in any case. A d just below
 * 0 wraps to the top of the range, where the octave's size is 0: it stays there until it comes back, if it rises. */
static inline uint32_t octave_pixels(const struct ph_octave *octave, uint32_t d, uint32_t gd, uint32_t left)
{
    const bool rises = (int32_t)gd > 0;
    if (octave->size == 0 && !rises) {
        return left;
    }
    const uint32_t to_last = rises ? octave->bottom + octave->size - 1 - d : d - octave->bottom;
    const uint32_t room = fx_quotient_far(to_last, fx_magnitude((int32_t)gd)) + 1;
    return room < left ? room : left;
}

struct ph_piece ph_depth_piece(const struct ph_triangle *t, uint32_t d, uint32_t *n)
{
    const uint32_t gd = t->as.large.depth.as.plane.gx;
    if (t->block >= PH_BLOCK_LINEAR) {
        return (struct ph_piece){d, gd};
    }
    struct ph_octave octave;
    ph_octave_of(&octave, t, d, gd);
    if (!ph_octave_holds(&octave, d, d + gd * (*n - 1))) { /* only this takes a division */
        *n = octave_pixels(&octave, d, gd, *n);
    }
    return (struct ph_piece){ph_depth_float16_code(&octave, d), octave.size > 0 ? octave.slope : 0};
}

/* Draws a row in as many runs as it needs. */
static void draw_span(const struct ph_triangle *t, const struct ph_band *band, struct ph_run run)
{
    uint32_t left = run.n, d = run.d;
    while (left > 0) { /* each turn draws at least one pixel */
        run.n = left;
        const struct ph_piece piece = ph_depth_piece(t, d, &run.n);
        run.d = piece.d;
        run.gd = piece.gd;
        band->ways->draw_run(t, &run);
        run.pixels += run.n;
        run.depth = ph_depth_from(run.depth, run.n, band->depth24);
        run.light += run.glight * run.n;
        d += t->as.large.depth.as.plane.gx * run.n;
        left -= run.n;
    }
}

/* Draws rows of a half. Returns the number of pixels. */
PH_TIER(figure)
static uint32_t walk_rows(const struct ph_triangle *t, const struct ph_band *band, struct ph_half_rows in)
{
    static const struct ph_plane no_light = {0, 0, 0};
    const uint32_t stride = band->stride;
    const struct ph_plane *const depth = &t->as.large.depth.as.plane;
    const struct ph_plane *const shade = t->kind == PH_KIND_GOURAUD ? &t->as.large.of.light : &no_light;
    uint32_t at = (uint32_t)(in.y - band->y0) * stride, count = 0;
    uint32_t d = ph_plane_at(depth, 0, (uint32_t)in.y), light = ph_plane_at(shade, 0, (uint32_t)in.y);
    for (; in.y < in.y_end; in.y++) {
        int32_t from, to;
        if (ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
            const uint32_t x = (uint32_t)from, n = (uint32_t)(to - from);
            const struct ph_run row = {band->pixels + at + x,
                                       ph_depth_from(band->depth, at + x, band->depth24),
                                       n,
                                       d + x * depth->gx,
                                       depth->gx,
                                       light + x * shade->gx,
                                       shade->gx};
            if (t->block >= PH_BLOCK_LINEAR) { /* no octaves to cross */
                band->ways->draw_run(t, &row);
            } else {
                draw_span(t, band, row);
            }
            count += n;
        }
        at += stride;
        d += depth->gy;
        light += shade->gy;
    }
    return count;
}

PH_TIER(figure) uint32_t ph_walk(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (ph_rows_of_half_apart(t, band, half, &in)) {
            count += walk_rows(t, band, in);
        }
    }
    return count;
}

PH_TIER(figure)
void ph_draw_flat_across(const struct ph_triangle *t, const struct ph_band *band, struct ph_octave *octave,
                         const struct ph_run *row)
{
    const uint32_t last = row->d + row->gd * (row->n - 1);
    if (!ph_octave_holds(octave, row->d, last)) {
        ph_octave_of(octave, t, row->d, row->gd);
        if (!ph_octave_holds(octave, row->d, last)) {
            draw_span(t, band, *row);
            return;
        }
    }
    ph_span_flat(row->pixels, row->depth, row->n, ph_depth_float16_code(octave, row->d), octave->slope,
                 t->as.large.of.colour);
}

/* Draws rows of a half in one colour, with depth codes of 16 bits. */
PH_TIER(figure)
static uint32_t walk_flat_rows(const struct ph_triangle *t, const struct ph_band *band, struct ph_half_rows in)
{
    const uint32_t stride = band->stride, start = (uint32_t)(in.y - band->y0) * stride;
    const uint32_t gd = t->as.large.depth.as.plane.gx, d_dy = t->as.large.depth.as.plane.gy;
    uint16_t *pixels = band->pixels + start, *depth = (uint16_t *)band->depth + start;
    uint32_t row_d = t->as.large.depth.as.plane.base + (uint32_t)in.y * d_dy, count = 0;
    const uint16_t colour = t->as.large.of.colour;
    struct ph_octave octave = {0};
    for (int32_t rows = in.y_end - in.y; rows > 0; rows--) {
        int32_t from, to;
        if (ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
            const uint32_t n = (uint32_t)(to - from), d = row_d + (uint32_t)from * gd;
            if (t->block == PH_BLOCK_NONE) {
                ph_span_flat(pixels + from, depth + from, n, d, gd, colour);
            } else {
                const struct ph_run row = {pixels + from, depth + from, n, d, gd, 0, 0};
                band->ways->octaves->draw_flat(t, band, &octave, &row);
            }
            count += n;
        }
        row_d += d_dy;
        pixels += stride;
        depth += stride;
    }
    return count;
}

PH_TIER(figure) uint32_t ph_walk_flat(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (ph_rows_of_half_apart(t, band, half, &in)) {
            count += walk_flat_rows(t, band, in);
        }
    }
    return count;
}

PH_NOINLINE void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band)
{
    const uint32_t at = (uint32_t)(y - band->y0) * band->stride + (uint32_t)x;
    draw_span(t, band,
              (struct ph_run){band->pixels + at, ph_depth_from(band->depth, at, band->depth24), 1,
                              ph_plane_at(&t->as.large.depth.as.plane, (uint32_t)x, (uint32_t)y), 0, 0, 0});
}
