/*
 * Textured spans: perspective-correct in blocks of up to 32 pixels. At both ends of a block u and v are divided
 * exactly; between, they run along the parabola that is exact in the middle, too (two additions a pixel and
 * coordinate): where 1/w goes from w0 to w1 and u by U, the middle lies U (w1 - w0) / (2 (w0 + w1)) beside the straight
 * line's. Measured error: tests/test_quality.c.
 */
#include "hot.h"
#include "pipeline.h"
#include "span.h"
#include "wire.h"

enum { BLOCK = PH_TEXEL_RUN };

/* u, v at one pixel, in units of 2^-27 of their range. */
struct texture_point {
    int32_t u, v;
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
    bool clamp;
    bool wide;  /* struct ph_band */
    bool plain; /* ph_span_texture can draw it where it stays within the texture */
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
 * overshoots further gets some wrong texel, but never one outside the texture. change: of 1/w from the
 * last such pixel, at most a quarter of it; *part: that change over their mean 1/w, in 2^-16.
 */
static inline __attribute__((always_inline)) struct texture_point divide(const struct texture_row *row, uint32_t change,
                                                                         int32_t *part)
{
    int shift;
    const uint32_t w = row->w - 4 < ((uint32_t)1 << 30) - 4 ? row->w : 4; /* 2^29 with head room */
    const int32_t reciprocal = (int32_t)(fx_rcp_norm(w, &shift) >> 1);
    const int32_t q = ((int32_t)(change << shift) >> 16) * (reciprocal >> 15) >> 14; /* change / w, 2^-16 */
    *part = q + (int32_t)((uint32_t)q * (uint32_t)q >> 17);
    shift -= 2; /* a 2^shift times the reciprocal, high word: a 2^27 / w */
    return (struct texture_point){mulhi(shift_left(row->u, shift), reciprocal),
                                  mulhi(shift_left(row->v, shift), reciprocal)};
}

/* A parabola in steps: value, first difference, second difference; all modulo 2^32. */
struct parabola {
    uint32_t at, step, bend;
};

/* The way of u or v along m pixels; part: how 1/w changes along them, as divide() says. */
static inline __attribute__((always_inline)) struct parabola parabola(int32_t from, int32_t to, int32_t part,
                                                                      uint32_t m)
{
    /* 2^31 / m; m = 0 is a single pixel, which takes no step */
    static const int32_t inverse[BLOCK] = {0,         INT32_MAX, 1073741824, 715827882, 536870912, 429496729, 357913941,
                                           306783378, 268435456, 238609294,  214748364, 195225786, 178956970, 165191049,
                                           153391689, 143165576, 134217728,  126322567, 119304647, 113025455, 107374182,
                                           102261126, 97612893,  93368854,   89478485,  85899345,  82595524,  79536431,
                                           76695844,  74051160,  71582788,   69273666};
    const int32_t way = (int32_t)((uint32_t)to - (uint32_t)from);
    const int32_t bow = (int32_t)(0u - (uint32_t)(way >> 12) * (uint32_t)part) >> 4;
    const int32_t straight = (int32_t)((uint32_t)way - (uint32_t)bow);
    if (m == BLOCK) { /* from + straight i / m + bow (i / m)^2 */
        return (struct parabola){(uint32_t)from, (uint32_t)((straight >> 5) + (bow >> 10)), (uint32_t)(bow >> 9)};
    }
    const int32_t bend = (bow >> 12) * (inverse[m] >> 16) >> 2; /* 2 bow / m */
    const int32_t step = mulhi((int32_t)((uint32_t)straight + (uint32_t)(bend >> 1)), inverse[m]);
    return (struct parabola){(uint32_t)from, (uint32_t)step * 2, 2 * (uint32_t)mulhi(bend, inverse[m])};
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

static inline __attribute__((always_inline)) void go_on(struct parabola *p)
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
        go_on(&u);
        go_on(&v);
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
        go_on(&u);
        go_on(&v);
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
        go_on(&u);
        go_on(&v);
    }
}

/* Whether 1/w changes by more than 3/16 along a block: a parabola does not follow u and v closely then. */
static inline bool is_steep(uint32_t w, uint32_t change)
{
    const uint32_t size = (int32_t)change < 0 ? 0u - change : change;
    return size > (w >> 3) + (w >> 4);
}

/* n pixels of a block that ph_span_texture does not draw. */
static void draw_piece(const struct ph_triangle *t, const struct sampler *s, struct ph_texel_run *run, uint32_t n,
                       struct parabola u, struct parabola v)
{
    const struct ph_piece piece = {run->d, run->gd};
    if (s->wide) {
        draw_wide(s, run->pixels, (uint32_t *)(void *)run->depth, n, piece, u, v, s->clamp);
    } else if (t->block == PH_BLOCK_LINEAR) {
        draw_linear(s, run->pixels, run->depth, n, piece, &t->linear, u, v, s->clamp);
    } else if (s->light < 32) {
        draw_lit(s, run->pixels, run->depth, n, piece.d, piece.gd, u, v, s->clamp);
    } else {
        draw_plain(s, run->pixels, run->depth, n, piece.d, piece.gd, u, v, s->clamp);
    }
    run->d += run->gd * n;
    run->pixels += n;
    run->depth = ph_depth_from(run->depth, n, s->wide);
}

/* Whether all of a block lies in one repeat of the texture, or of a clamped one in the only one; its columns from 0. */
static inline bool is_within(const struct sampler *s, const struct texture_point *from, const struct texture_point *to,
                             uint32_t *column)
{
    const uint32_t margin = 256, width = (s->u_mask + 1) << 16, height = (s->v_mask + 1) << 16;
    const uint32_t u = (uint32_t)(from->u >> (s->u_down - 16)), u_to = (uint32_t)(to->u >> (s->u_down - 16));
    const uint32_t repeat = u & (0u - width);
    *column = u - repeat;
    if (*column - margin >= width - 2 * margin || u_to - repeat - margin >= width - 2 * margin) {
        return false;
    }
    const uint32_t v = (uint32_t)(from->v >> (s->v_down - 16)), v_to = (uint32_t)(to->v >> (s->v_down - 16));
    return !s->clamp || (repeat == 0 && v - margin < height - 2 * margin && v_to - margin < height - 2 * margin);
}

/* Texel run of a block. */
static inline void set_run(struct ph_texel_run *run, const struct sampler *s, struct parabola u, struct parabola v,
                           uint32_t column)
{
    const int u_down = s->u_down - 16, v_down = s->v_down - 16;
    run->u = column;
    run->du = (uint32_t)((int32_t)u.step >> u_down);
    run->ddu = (uint32_t)((int32_t)u.bend >> u_down);
    run->v = (uint32_t)((int32_t)v.at >> v_down) << s->log2_width;
    run->dv = (uint32_t)((int32_t)v.step >> v_down) << s->log2_width;
    run->ddv = (uint32_t)((int32_t)v.bend >> v_down) << s->log2_width;
}

/* Steps of the planes for a block; that of 1/w alone is the last. */
struct texture_step {
    uint32_t u, v, w;
};

static inline void advance(struct texture_row *row, const struct texture_step *per_pixel, uint32_t pixels)
{
    row->u = (int32_t)((uint32_t)row->u + per_pixel->u * pixels);
    row->v = (int32_t)((uint32_t)row->v + per_pixel->v * pixels);
    row->w += per_pixel->w * pixels;
}

/* Pixels of the next block, of n that are left. */
static inline uint32_t block_pixels(uint32_t n, uint32_t w, uint32_t gw)
{
    uint32_t k = n < BLOCK ? n : BLOCK;
    while (k > 1 && is_steep(w, gw * k)) {
        k >>= 1;
    }
    return k;
}

/* A span of n pixels from run->pixels, run->depth on; d: depth there, in units of the plane. */
static void textured_span(const struct ph_triangle *t, const struct sampler *s, struct ph_texel_run *run, uint32_t n,
                          uint32_t d, struct texture_row row)
{
    const struct texture_step step = {t->attribute[0].gx, t->attribute[1].gx, over_w(t)->gx};
    int32_t part;
    struct texture_point from = divide(&row, 0, &part);
    uint32_t left = 0; /* pixels left of the piece */
    while (n > 0) {
        if (left == 0) {
            left = n;
            const struct ph_piece piece = ph_depth_piece(t, d, &left);
            run->d = piece.d;
            run->gd = piece.gd;
        }
        uint32_t k = block_pixels(n, row.w, step.w);
        k = k < left ? k : left;
        const uint32_t m = k < n ? k : k - 1; /* never past the last pixel of the span */
        advance(&row, &step, m);
        const struct texture_point to = divide(&row, step.w * m, &part);
        const struct parabola u = parabola(from.u, to.u, part, m), v = parabola(from.v, to.v, part, m);
        uint32_t column;
        if (s->plain && is_within(s, &from, &to, &column)) {
            set_run(run, s, u, v, column);
            ph_span_texture(run, k);
        } else {
            draw_piece(t, s, run, k, u, v);
        }
        from = to;
        d += t->depth.gx * k;
        left -= k;
        n -= k;
    }
}

static struct sampler sampler_of(const struct ph_triangle *t, bool wide)
{
    const struct ph_texture *texture = t->material->texture;
    const int down = 27 - t->range_log2, u_down = down - texture->log2_width, v_down = down - texture->log2_height;
    const bool fits = u_down >= 16 && v_down >= 16 && texture->log2_width + texture->log2_height <= 16;
    return (struct sampler){texture->texels,
                            u_down,
                            v_down,
                            ((uint32_t)1 << texture->log2_width) - 1,
                            ((uint32_t)1 << texture->log2_height) - 1,
                            texture->log2_width,
                            t->colour,
                            texture->wrap == PH_WRAP_CLAMP,
                            wide,
                            fits && !wide && t->block != PH_BLOCK_LINEAR && t->colour >= 32};
}

static uint32_t draw_rows(const struct ph_triangle *t, const struct ph_band *band, const struct sampler *s, int32_t y,
                          int32_t y_end, struct ph_edge left, struct ph_edge right)
{
    struct ph_texel_run run = {.texels = s->texels, .row_mask = s->v_mask << s->log2_width};
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
            run.pixels = band->pixels + at;
            run.depth = ph_depth_from(band->depth, at, s->wide);
            textured_span(t, s, &run, n, ph_plane_at(&t->depth, x, (uint32_t)y), row);
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
