/*
 * Textured spans: perspective-correct in blocks of 16 pixels. At both ends of a block u and v are divided exactly, at
 * its start so are their derivatives; between, they run along the parabola through all three (two additions a pixel
 * and coordinate). Measured error: tests/test_quality.c.
 */
#include "pipeline.h"
#include "span.h"
#include "wire.h"

enum { BLOCK = 16 };

/* u, v at one pixel and per pixel, in units of 2^-30 of their range. */
struct texture_point {
    int32_t u, v, du, dv;
};

/* The planes at one pixel: u/w and v/w (signed), 1/w. */
struct texture_row {
    int32_t u, v;
    uint32_t w;
};

/* Texels of one triangle. */
struct sampler {
    const uint16_t *texels;
    int u_down, v_down; /* coordinate to texel */
    uint32_t u_mask, v_mask, log2_width;
    uint32_t light; /* 0 .. 32 */
    int32_t limit;  /* coordinate of the texture's far side */
    bool clamp;
};

static int32_t clamp_q30(int64_t v)
{
    const int32_t limit = (1 << 30) - 1;
    return v > limit ? limit : v < -limit ? -limit : (int32_t)v;
}

static int32_t clamp_i32(int64_t v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

/* a 2^30 / w by the reciprocal of w, 2^(61 - shift) / w. */
static int32_t over_w(int32_t a, int32_t reciprocal, int shift)
{
    return clamp_q30(fx_mul_wide(a, reciprocal) >> (31 - shift));
}

static struct texture_point divide(const struct ph_triangle *t, const struct texture_row *row)
{
    int shift;
    const uint32_t w = (int32_t)row->w > 0 ? row->w : 1; /* a sliver's overshoot */
    const int32_t reciprocal = (int32_t)(fx_rcp_norm(w, &shift) >> 1);
    struct texture_point p = {over_w(row->u, reciprocal, shift), over_w(row->v, reciprocal, shift), 0, 0};
    const int32_t gw = (int32_t)t->attribute[2].gx;
    p.du = over_w(clamp_i32((int32_t)t->attribute[0].gx - (fx_mul_wide(p.u, gw) >> 30)), reciprocal, shift);
    p.dv = over_w(clamp_i32((int32_t)t->attribute[1].gx - (fx_mul_wide(p.v, gw) >> 30)), reciprocal, shift);
    return p;
}

static void advance(const struct ph_triangle *t, struct texture_row *row, uint32_t pixels)
{
    row->u = (int32_t)((uint32_t)row->u + t->attribute[0].gx * pixels);
    row->v = (int32_t)((uint32_t)row->v + t->attribute[1].gx * pixels);
    row->w += t->attribute[2].gx * pixels;
}

/* A parabola in steps: value, first difference, second difference; all modulo 2^32. */
struct parabola {
    uint32_t at, step, bend;
};

/* From `from` with slope `slope` to `to` after m pixels. */
static struct parabola parabola(int32_t from, int32_t slope, int32_t to, uint32_t m)
{
    /* 65536 / m^2; m = 0 is a single pixel, which takes no step */
    static const uint16_t inverse_square[BLOCK + 1] = {0,   65535, 16384, 7282, 4096, 2621, 1820, 1337, 1024,
                                                       809, 655,   542,   455,  388,  334,  291,  256};
    const int64_t miss = (int64_t)to - from - (int64_t)slope * m;
    const uint32_t c = (uint32_t)((miss * inverse_square[m]) >> 16);
    return (struct parabola){(uint32_t)from, (uint32_t)slope + c, 2 * c};
}

/* Whether the whole block lies inside the texture: its Bezier control points do, with room for rounding. */
static bool inside(int32_t from, int32_t slope, int32_t to, uint32_t m, int32_t limit)
{
    const int64_t control = from + (((int64_t)slope * m) >> 1);
    const int32_t margin = 1024;
    return from >= margin && from < limit - margin && to >= margin && to < limit - margin && control >= margin &&
           control < limit - margin;
}

static uint32_t clamp_texel(int32_t texel, uint32_t mask)
{
    return texel < 0 ? 0 : (uint32_t)texel > mask ? mask : (uint32_t)texel;
}

/* c * light / 32 for all three channels at once. */
static uint16_t shade(uint16_t wire, uint32_t light)
{
    const uint32_t c = ph_wire16(wire), spread = (c | c << 16) & 0x07e0f81fu;
    const uint32_t lit = (spread * light >> 5) & 0x07e0f81fu;
    return ph_wire16((uint16_t)(lit | lit >> 16));
}

static inline __attribute__((always_inline)) void draw_block(const struct sampler *s, uint16_t *pixels, uint16_t *depth,
                                                             uint32_t n, uint32_t d, uint32_t gd, struct parabola u,
                                                             struct parabola v, bool clamp, bool lit)
{
    for (uint32_t i = 0; i < n; i++) {
        if (d >> 16 > depth[i]) {
            const int32_t tu = (int32_t)u.at >> s->u_down, tv = (int32_t)v.at >> s->v_down;
            const uint32_t column = clamp ? clamp_texel(tu, s->u_mask) : (uint32_t)tu & s->u_mask;
            const uint32_t line = clamp ? clamp_texel(tv, s->v_mask) : (uint32_t)tv & s->v_mask;
            const uint16_t texel = s->texels[line << s->log2_width | column];
            depth[i] = (uint16_t)(d >> 16);
            pixels[i] = lit ? shade(texel, s->light) : texel;
        }
        d += gd;
        u.at += u.step;
        u.step += u.bend;
        v.at += v.step;
        v.step += v.bend;
    }
}

static void draw_plain(const struct sampler *s, uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                       struct parabola u, struct parabola v, bool clamp)
{
    if (clamp) {
        draw_block(s, pixels, depth, n, d, gd, u, v, true, false);
    } else {
        draw_block(s, pixels, depth, n, d, gd, u, v, false, false);
    }
}

static void draw_lit(const struct sampler *s, uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                     struct parabola u, struct parabola v, bool clamp)
{
    if (clamp) {
        draw_block(s, pixels, depth, n, d, gd, u, v, true, true);
    } else {
        draw_block(s, pixels, depth, n, d, gd, u, v, false, true);
    }
}

static void textured_span(const struct ph_triangle *t, const struct sampler *s, uint16_t *pixels, uint16_t *depth,
                          uint32_t n, uint32_t d, struct texture_row row)
{
    struct texture_point from = divide(t, &row);
    while (n > 0) {
        uint32_t k = n < BLOCK ? n : BLOCK;
        const struct ph_piece piece = ph_depth_piece(t, d, &k);
        const uint32_t m = k < n ? k : k - 1; /* never past the last pixel of the span */
        advance(t, &row, m);
        const struct texture_point to = m > 0 ? divide(t, &row) : from;
        const bool clamp =
            s->clamp && !(inside(from.u, from.du, to.u, m, s->limit) && inside(from.v, from.dv, to.v, m, s->limit));
        const struct parabola u = parabola(from.u, from.du, to.u, m), v = parabola(from.v, from.dv, to.v, m);
        if (s->light < 32) {
            draw_lit(s, pixels, depth, k, piece.d, piece.gd, u, v, clamp);
        } else {
            draw_plain(s, pixels, depth, k, piece.d, piece.gd, u, v, clamp);
        }
        from = to;
        pixels += k;
        depth += k;
        d += t->depth.gx * k;
        n -= k;
    }
}

static struct sampler sampler_of(const struct ph_triangle *t)
{
    const struct ph_texture *texture = t->material->texture;
    const int down = 30 - t->range_log2;
    return (struct sampler){texture->texels,
                            down - texture->log2_width,
                            down - texture->log2_height,
                            ((uint32_t)1 << texture->log2_width) - 1,
                            ((uint32_t)1 << texture->log2_height) - 1,
                            texture->log2_width,
                            t->colour,
                            (int32_t)1 << down,
                            texture->wrap == PH_WRAP_CLAMP};
}

static uint32_t draw_rows(const struct ph_triangle *t, const struct ph_band *band, const struct sampler *s, int32_t y,
                          int32_t y_end, struct ph_edge left, struct ph_edge right)
{
    uint32_t count = 0;
    for (; y < y_end; y++) {
        const int32_t from = left.x < 0 ? 0 : left.x >> 16;
        const int32_t right_column = right.x >> 16, to = right_column > band->width ? band->width : right_column;
        if (from < to) {
            const uint32_t x = (uint32_t)from, at = (uint32_t)(y - band->y0) * (uint32_t)band->width + x;
            const struct texture_row row = {(int32_t)ph_plane_at(&t->attribute[0], x, (uint32_t)y),
                                            (int32_t)ph_plane_at(&t->attribute[1], x, (uint32_t)y),
                                            ph_plane_at(&t->attribute[2], x, (uint32_t)y)};
            const uint32_t n = (uint32_t)(to - from);
            textured_span(t, s, band->pixels + at, band->depth + at, n, ph_plane_at(&t->depth, x, (uint32_t)y), row);
            count += n;
        }
        left.x = (int32_t)((uint32_t)left.x + (uint32_t)left.dx);
        right.x = (int32_t)((uint32_t)right.x + (uint32_t)right.dx);
    }
    return count;
}

uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct sampler s = sampler_of(t);
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        int32_t y, y_end;
        struct ph_edge left, right;
        if (ph_half_rows(t, band, half, &y, &y_end, &left, &right)) {
            count += draw_rows(t, band, &s, y, y_end, left, right);
        }
    }
    return count;
}
