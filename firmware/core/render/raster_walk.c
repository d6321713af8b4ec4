/*
 * Triangles that are walked row by row: of one colour, Gouraud with linear-w or depth of 24 bits, and single pixels. A
 * span is drawn in one run, unless its depth crosses octaves. See raster_walk.h.
 */
/* Kits on armv6m: -O2. */
#include "raster_walk.h"

#include "edge.h"
#include "kernels.h"
#include "span.h"

/* n pixels of a row of a triangle. */
struct row {
    uint16_t *pixels;
    void *depth;            /* as in struct ph_band; pixels and depth are those of the first pixel */
    uint32_t n, d;          /* d: depth at the first pixel, in units of the plane */
    uint32_t light, glight; /* Gouraud: at the first pixel, and per pixel; else not read */
};

/* Draws a run of pixels along which the depth code is linear. */
static inline void draw_run(const struct ph_triangle *t, bool depth24, const struct row *row, uint32_t gd)
{
    const bool gouraud = t->kind == PH_KIND_GOURAUD, linear = t->block == PH_BLOCK_LINEAR;
    const struct ph_linear *const codes = &t->as.large.depth.over_w.linear;
    const uint16_t *const ramp = t->material->ramp;
    if (depth24 && gouraud) {
        ph_span_gouraud24(row->pixels, row->depth, row->n, row->d, gd, row->light, row->glight, ramp);
    } else if (depth24) {
        ph_span_flat24(row->pixels, row->depth, row->n, row->d, gd, t->as.large.of.colour);
    } else if (linear && gouraud) {
        ph_span_gouraud_linear(row->pixels, row->depth, row->n, row->d, gd, codes, row->light, row->glight, ramp);
    } else if (linear) {
        ph_span_flat_linear(row->pixels, row->depth, row->n, row->d, gd, codes, t->as.large.of.colour);
    } else if (gouraud) {
        ph_span_gouraud(row->pixels, row->depth, row->n, row->d, gd, row->light, row->glight, ramp);
    } else {
        ph_span_flat(row->pixels, row->depth, row->n, row->d, gd, t->as.large.of.colour);
    }
}

/* Draws a span in as many runs as it needs. */
static void draw_span(const struct ph_triangle *t, bool depth24, struct row row)
{
    uint32_t left = row.n, d = row.d;
    while (left > 0) { /* each turn draws at least one pixel */
        row.n = left;
        const struct ph_piece piece = ph_depth_piece(t, d, &row.n);
        row.d = piece.d;
        draw_run(t, depth24, &row, piece.gd);
        row.pixels += row.n;
        row.depth = ph_depth_from(row.depth, row.n, depth24);
        row.light += row.glight * row.n;
        d += t->as.large.depth.as.plane.gx * row.n;
        left -= row.n;
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
            const struct row row = {band->pixels + at + x,
                                    ph_depth_from(band->depth, at + x, band->depth24),
                                    n,
                                    d + x * depth->gx,
                                    light + x * shade->gx,
                                    shade->gx};
            if (t->block >= PH_BLOCK_LINEAR) { /* no octaves to cross */
                draw_run(t, band->depth24, &row, depth->gx);
            } else {
                draw_span(t, band->depth24, row);
            }
            count += n;
        }
        at += stride;
        d += depth->gy;
        light += shade->gy;
    }
    return count;
}

/* The depth code of the first of n pixels, and in `slope` its change from pixel to pixel; false: they cross octaves. */
static inline bool take_code(const struct ph_triangle *t, struct ph_octave *octave, uint32_t n, uint32_t *d,
                             uint32_t *slope)
{
    const uint32_t last = *d + *slope * (n - 1);
    if (!ph_octave_holds(octave, *d, last)) {
        ph_octave_of(octave, t, *d, *slope);
        if (!ph_octave_holds(octave, *d, last)) {
            return false;
        }
    }
    *d = ph_depth_float16_code(octave, *d);
    *slope = octave->slope;
    return true;
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
            const uint32_t n = (uint32_t)(to - from);
            uint32_t d = row_d + (uint32_t)from * gd, slope = gd;
            if (t->block == PH_BLOCK_NONE || take_code(t, &octave, n, &d, &slope)) {
                ph_span_flat(pixels + from, depth + from, n, d, slope, colour);
            } else {
                draw_span(t, false, (struct row){pixels + from, depth + from, n, d, 0, 0});
            }
            count += n;
        }
        row_d += d_dy;
        pixels += stride;
        depth += stride;
    }
    return count;
}

PH_TIER(figure) uint32_t ph_walk(const struct ph_triangle *t, const struct ph_band *band)
{
    const bool flat = t->block != PH_BLOCK_LINEAR && !band->depth24 && t->kind == PH_KIND_FLAT;
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (ph_rows_of_half_apart(t, band, half, &in)) {
            count += flat ? walk_flat_rows(t, band, in) : walk_rows(t, band, in);
        }
    }
    return count;
}

PH_NOINLINE void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band)
{
    const uint32_t at = (uint32_t)(y - band->y0) * band->stride + (uint32_t)x;
    draw_span(t, band->depth24,
              (struct row){band->pixels + at, ph_depth_from(band->depth, at, band->depth24), 1,
                           ph_plane_at(&t->as.large.depth.as.plane, (uint32_t)x, (uint32_t)y), 0, 0});
}
