/*
 * Textured spans: perspective-correct in blocks of 16 pixels. At both ends of a block u and v are divided exactly, at
 * its start so are their derivatives; between, they run along the parabola through all three (two additions a pixel
 * and coordinate). Measured error: tests/test_quality.c.
 */
#include "pipeline.h"
#include "span.h"
#include "wire.h"

enum { BLOCK = 16 };

/* u, v at one pixel and per pixel, in units of 2^-27 of their range. */
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
    bool wide; /* struct ph_band */
};

/* linear-w has the plane of 1/w in place of the depth. */
static const struct ph_plane *over_w(const struct ph_triangle *t)
{
    return t->block == PH_BLOCK_LINEAR ? &t->depth : &t->attribute[2];
}

static int32_t mulhi(int32_t a, int32_t b)
{
    return (int32_t)(fx_mul_wide(a, b) >> 32);
}

static int32_t shift_left(int32_t v, int by)
{
    return (int32_t)((uint32_t)v << by);
}

/*
 * The exact quotients at one pixel. |u/w| <= 1/w inside the triangle, with room for twice that; a sliver that
 * overshoots further gets some wrong texel, but never one outside the texture.
 */
static struct texture_point divide(const struct ph_triangle *t, const struct texture_row *row)
{
    int shift;
    const uint32_t w = row->w - 4 < ((uint32_t)1 << 30) - 4 ? row->w : 4; /* 2^29 with head room */
    const int32_t reciprocal = (int32_t)(fx_rcp_norm(w, &shift) >> 1), gw = (int32_t)over_w(t)->gx;
    shift -= 2; /* a 2^shift times the reciprocal, high word: a 2^27 / w */
    struct texture_point p;
    p.u = mulhi(shift_left(row->u, shift), reciprocal);
    p.v = mulhi(shift_left(row->v, shift), reciprocal);
    const uint32_t u_gw = (uint32_t)mulhi(shift_left(p.u, 3), gw) << 2, v_gw = (uint32_t)mulhi(shift_left(p.v, 3), gw)
                                                                               << 2;
    p.du = mulhi(shift_left((int32_t)(t->attribute[0].gx - u_gw), shift), reciprocal);
    p.dv = mulhi(shift_left((int32_t)(t->attribute[1].gx - v_gw), shift), reciprocal);
    return p;
}

static void advance(const struct ph_triangle *t, struct texture_row *row, uint32_t pixels)
{
    row->u = (int32_t)((uint32_t)row->u + t->attribute[0].gx * pixels);
    row->v = (int32_t)((uint32_t)row->v + t->attribute[1].gx * pixels);
    row->w += over_w(t)->gx * pixels;
}

/* A parabola in steps: value, first difference, second difference; all modulo 2^32. */
struct parabola {
    uint32_t at, step, bend;
};

/* From `from` with slope `slope` to `to` after m pixels. */
static struct parabola parabola(int32_t from, int32_t slope, int32_t to, uint32_t m)
{
    /* 2^32 / m^2; m = 0 is a single pixel, which takes no step */
    static const int32_t inverse_square[BLOCK + 1] = {0,         INT32_MAX, 1073741824, 477218588, 268435456, 171798692,
                                                      119304647, 87652394,  67108864,   53024287,  42949673,  35495598,
                                                      29826162,  25414009,  21913098,   19088744,  16777216};
    const int32_t miss = (int32_t)((uint32_t)to - (uint32_t)from - (uint32_t)slope * m);
    const int32_t c = m == BLOCK ? miss >> 8 : mulhi(miss, inverse_square[m]);
    return (struct parabola){(uint32_t)from, (uint32_t)slope + (uint32_t)c, 2 * (uint32_t)c};
}

/* Whether the whole block lies inside the texture: its Bezier control points do, with room for rounding. */
static bool inside(int32_t from, int32_t slope, int32_t to, uint32_t m, int32_t limit)
{
    const uint32_t margin = 1024, room = (uint32_t)limit - 2 * margin;
    const uint32_t control = (uint32_t)from + (uint32_t)((int32_t)((uint32_t)slope * m) >> 1);
    return (uint32_t)from - margin < room && (uint32_t)to - margin < room && control - margin < room;
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

/* The texel at u, v, clamped or repeated, lit or as it is. */
static inline __attribute__((always_inline)) uint16_t sample(const struct sampler *s, uint32_t u, uint32_t v,
                                                             bool clamp, bool lit)
{
    const int32_t tu = (int32_t)u >> s->u_down, tv = (int32_t)v >> s->v_down;
    const uint32_t column = clamp ? clamp_texel(tu, s->u_mask) : (uint32_t)tu & s->u_mask;
    const uint32_t line = clamp ? clamp_texel(tv, s->v_mask) : (uint32_t)tv & s->v_mask;
    const uint16_t texel = s->texels[line << s->log2_width | column];
    return lit ? shade(texel, s->light) : texel;
}

static inline __attribute__((always_inline)) void step(struct parabola *p)
{
    p->at += p->step;
    p->step += p->bend;
}

static inline __attribute__((always_inline)) void draw_block(const struct sampler *s, uint16_t *pixels, uint16_t *depth,
                                                             uint32_t n, uint32_t d, uint32_t gd, struct parabola u,
                                                             struct parabola v, bool clamp, bool lit)
{
    for (uint32_t i = 0; i < n; i++) {
        if (d >> 16 > depth[i]) {
            depth[i] = (uint16_t)(d >> 16);
            pixels[i] = sample(s, u.at, v.at, clamp, lit);
        }
        d += gd;
        step(&u);
        step(&v);
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

/* The 24-bit formats. */
static void draw_wide(const struct sampler *s, uint16_t *pixels, uint32_t *depth, uint32_t n, struct ph_piece piece,
                      struct parabola u, struct parabola v, bool clamp)
{
    for (uint32_t i = 0; i < n; i++) {
        if (ph_nearer24(&depth[i], piece.d)) {
            pixels[i] = sample(s, u.at, v.at, clamp, s->light < 32);
        }
        piece.d += piece.gd;
        step(&u);
        step(&v);
    }
}

/* linear-w: over_w is 1/w at the first pixel and per pixel. */
static void draw_linear(const struct sampler *s, uint16_t *pixels, uint16_t *depth, uint32_t n, struct ph_piece over_w,
                        const struct ph_linear *linear, struct parabola u, struct parabola v, bool clamp)
{
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t code = ph_depth_linear(linear, over_w.d) >> 16;
        if (code > depth[i]) {
            depth[i] = (uint16_t)code;
            pixels[i] = sample(s, u.at, v.at, clamp, s->light < 32);
        }
        over_w.d += over_w.gd;
        step(&u);
        step(&v);
    }
}

/* Whether the distance changes by more than about a quarter along a block: a parabola does not follow it then. */
static bool is_steep(uint32_t w, uint32_t change)
{
    const uint32_t size = (int32_t)change < 0 ? 0u - change : change;
    return size > w >> 2;
}

/* n pixels of a block whose depth is one piece. */
static void draw_piece(const struct ph_triangle *t, const struct sampler *s, uint16_t *pixels, void *depth, uint32_t n,
                       struct ph_piece piece, struct parabola u, struct parabola v, bool clamp)
{
    if (s->wide) {
        draw_wide(s, pixels, depth, n, piece, u, v, clamp);
    } else if (t->block == PH_BLOCK_LINEAR) {
        draw_linear(s, pixels, depth, n, piece, &t->linear, u, v, clamp);
    } else if (s->light < 32) {
        draw_lit(s, pixels, depth, n, piece.d, piece.gd, u, v, clamp);
    } else {
        draw_plain(s, pixels, depth, n, piece.d, piece.gd, u, v, clamp);
    }
}

static void textured_span(const struct ph_triangle *t, const struct sampler *s, uint16_t *pixels, void *depth,
                          uint32_t n, uint32_t d, struct texture_row row)
{
    struct texture_point from = divide(t, &row);
    struct ph_piece piece = {0, 0};
    uint32_t run = 0; /* pixels left of the piece */
    while (n > 0) {
        if (run == 0) {
            run = n;
            piece = ph_depth_piece(t, d, &run);
        }
        uint32_t k = n < BLOCK ? n : BLOCK;
        while (k > 4 && is_steep(row.w, over_w(t)->gx * k)) {
            k >>= 1;
        }
        k = k < run ? k : run;
        const uint32_t m = k < n ? k : k - 1; /* never past the last pixel of the span */
        advance(t, &row, m);
        const struct texture_point to = m > 0 ? divide(t, &row) : from;
        const bool clamp =
            s->clamp && !(inside(from.u, from.du, to.u, m, s->limit) && inside(from.v, from.dv, to.v, m, s->limit));
        const struct parabola u = parabola(from.u, from.du, to.u, m), v = parabola(from.v, from.dv, to.v, m);
        draw_piece(t, s, pixels, depth, k, piece, u, v, clamp);
        from = to;
        pixels += k;
        depth = ph_depth_from(depth, k, s->wide);
        piece.d += piece.gd * k;
        d += t->depth.gx * k;
        run -= k;
        n -= k;
    }
}

static struct sampler sampler_of(const struct ph_triangle *t, bool wide)
{
    const struct ph_texture *texture = t->material->texture;
    const int down = 27 - t->range_log2;
    return (struct sampler){texture->texels,
                            down - texture->log2_width,
                            down - texture->log2_height,
                            ((uint32_t)1 << texture->log2_width) - 1,
                            ((uint32_t)1 << texture->log2_height) - 1,
                            texture->log2_width,
                            t->colour,
                            (int32_t)1 << down,
                            texture->wrap == PH_WRAP_CLAMP,
                            wide};
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
                                            ph_plane_at(over_w(t), x, (uint32_t)y)};
            const uint32_t n = (uint32_t)(to - from);
            textured_span(t, s, band->pixels + at, ph_depth_from(band->depth, at, s->wide), n,
                          ph_plane_at(&t->depth, x, (uint32_t)y), row);
            count += n;
        }
        left.x = (int32_t)((uint32_t)left.x + (uint32_t)left.dx);
        right.x = (int32_t)((uint32_t)right.x + (uint32_t)right.dx);
    }
    return count;
}

uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct sampler s = sampler_of(t, band->wide);
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
