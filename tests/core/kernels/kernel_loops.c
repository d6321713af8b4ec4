/*
 * The kernels (kernels.h) on random input: a line for each of them, with a hash of all that it left behind, the memory
 * round its rows included. tests/core/test_kernels.sh compares the lines of the C and of the assembly.
 */
#include "cull.h"
#include "fog.h"
#include "fx.h"
#include "kernels.h"
#include "pairs.h"
#include "texel_row.h"
#include "texture_knee.h"
#include "texture_tile.h"
#include "triangle.h"
#include "vertices.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { TURNS = 20000, ROOM = 2048, TEXELS = 1 << 20 };

static uint32_t state;
static _Alignas(4) uint16_t pixels[ROOM], depth[ROOM];
static uint16_t texels[TEXELS], ramp[PH_DITHER_STEPS * PH_RAMP_SIZE];

static uint32_t bits(void)
{
    state = state * 1664525u + 1013904223u;
    return state ^ state >> 15;
}

static uint32_t below(uint32_t n)
{
    return (uint32_t)((uint64_t)bits() * n >> 32);
}

static void randomise(uint16_t *to, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        to[i] = (uint16_t)bits();
    }
}

static uint32_t hash(uint32_t h, const void *data, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++) {
        h = (h ^ ((const uint8_t *)data)[i]) * 16777619u;
    }
    return h;
}

static uint32_t hash_rows(uint32_t h)
{
    return hash(hash(h, pixels, sizeof pixels), depth, sizeof depth);
}

static uint32_t word(uint32_t h, uint32_t value)
{
    return hash(h, &value, sizeof value);
}

/* A random factor of any length and either sign; now and then an end of the range. */
static int32_t any_factor(void)
{
    const uint32_t v = bits();
    return below(8) == 0 ? (below(2) == 0 ? INT32_MIN : INT32_MAX) : (int32_t)v >> below(32);
}

static uint32_t try_mul(uint32_t h)
{
    const int32_t a = any_factor(), b = any_factor();
    const uint64_t product = (uint64_t)fx_mul_far(a, b);
    return word(word(h, (uint32_t)product), (uint32_t)(product >> 32));
}

static uint32_t try_fill(uint32_t h)
{
    uint16_t *const to = pixels + below(64);
    const uint32_t n = below(4) > 0 ? below(200) : below(ROOM - 64);
    ph_fill(to, (uint16_t)bits(), n);
    return h;
}

static uint32_t try_flat(uint32_t h)
{
    const uint32_t at = below(64), depth_at = below(64), n = 1 + below(below(2) > 0 ? 20 : 600), d = bits();
    const uint32_t gd = below(1 << 22);
    ph_span_flat(pixels + at, depth + depth_at, n, d, gd, (uint16_t)bits());
    return h;
}

static uint32_t try_blend(uint32_t h)
{
    const uint32_t at = below(64), depth_at = below(64), n = 1 + below(below(2) > 0 ? 20 : 600), d = bits();
    const uint32_t gd = below(1 << 22), rest = below(33), mean = bits() & 0x07e0f81f;
    for (uint32_t i = 0; i < 64; i++) { /* some hide it */
        depth[depth_at + below(n)] = (uint16_t)bits();
    }
    ph_span_blend(pixels + at, depth + depth_at, n, d, gd, mean * (32 - rest) + 0x02008010, rest);
    return h;
}

/* Pairs over others; now and then their share is all of it. */
static uint32_t try_pairs(uint32_t h, void (*lay)(ph_pair *, const ph_pair *, uint32_t, uint32_t))
{
    static ph_pair over[64];
    const uint32_t n = below(64), at = 2 * below(64);
    for (uint32_t i = 0; i < n; i++) {
        over[i] = bits();
    }
    lay((ph_pair *)(void *)(pixels + at), over, n, below(4) == 0 ? 32 : below(33));
    return h;
}

static uint32_t try_mix(uint32_t h)
{
    return try_pairs(h, ph_pairs_mix);
}

static uint32_t try_add(uint32_t h)
{
    return try_pairs(h, ph_pairs_add);
}

static void times(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share)
{
    (void)share;
    ph_pairs_times(to, from, n);
}

static uint32_t try_times(uint32_t h)
{
    return try_pairs(h, times);
}

/* Codes around the depth, most of them seen, or hidden. */
static uint32_t try_seen(uint32_t h)
{
    const uint32_t at = below(64), depth_at = below(64), n = below(100), some = 1 + below(64), more = below(3);
    for (uint32_t i = 0; i < n; i++) {
        pixels[at + i] = (uint16_t)(depth[depth_at + i] + (below(some) == 0 ? below(3) - 1 : more - 1));
    }
    const bool same = below(2) > 0, seen = below(2) > 0;
    return word(h, ph_span_seen(pixels + at, depth + depth_at, n, same, seen));
}

/* Codes in and beside a range, most of them in it. */
static uint32_t try_fog(uint32_t h)
{
    const uint32_t at = below(64), depth_at = below(64), n = below(100), some = 1 + below(64);
    const uint32_t from = bits() & 0xffff, size = 1 + below(300);
    struct ph_fog_mix mix = {.left = below(33)};
    const uint32_t colour = (bits() & 0xffff) * 0x10001, share = 32 - mix.left;
    mix.added = (colour & PH_SPREAD) * share + PH_SPREAD_HALF;
    mix.others = (colour & ~PH_SPREAD) / 32 * share + PH_PAIR_HALF;
    for (uint32_t i = 0; i < n; i++) {
        depth[depth_at + i] = (uint16_t)(from + (below(some) == 0 ? size + below(2) - 1 : below(size)));
    }
    return word(h, ph_fog_alike(pixels + at, depth + depth_at, n, from, size, below(4) > 0 ? &mix : NULL));
}

/* A line in rows of 32 pixels, along its columns or its rows, forwards or backwards; it stays in ROOM. */
static uint32_t try_line(uint32_t h)
{
    const bool wide = below(2) > 0, back = wide && below(2) > 0;
    const uint32_t n = 1 + below(31), depth_at = below(64), at = back ? n : 0;
    const int32_t from = (int32_t)below(31 << 16), to = (int32_t)below(31 << 16);
    const struct ph_line_run run = {.slope = (to - from) / (int32_t)n,
                                    .gd = bits() >> below(32),
                                    .forward = wide ? back ? -1 : 1 : 32,
                                    .colour = bits() & 0xffff,
                                    .across = from,
                                    .d = bits(),
                                    .stride = wide ? 32 : 1};
    ph_line_pixels(&run, pixels + below(64) + at, depth + depth_at + at, n);
    return h;
}

/* Most fours of samples are of one colour, some are not. */
static uint32_t try_halve(uint32_t h)
{
    static uint32_t upper[128], lower[128];
    const uint32_t n = 1 + below(128), at = below(64);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t colour = below(8) > 0 ? (bits() & 0xffff) * 0x10001 : bits(); /* two beside each other differ */
        upper[i] = i > 0 && below(2) > 0 ? upper[i - 1] : colour;
        lower[i] = upper[i];
        upper[i] ^= below(8) == 0 ? bits() : 0;
        lower[i] ^= below(8) == 0 ? bits() : 0;
    }
    ph_halve(pixels + at, (const uint16_t *)upper, (const uint16_t *)lower, n);
    return h;
}

/* The depth of a triangle: with the gradients below no code of it is 0. */
static uint32_t depth_bits(void)
{
    return ((uint32_t)1 << 16) + below((uint32_t)3 << 30);
}

/* A small triangle on the rows from `at` on, which have room for it. */
static struct ph_small_triangle any_small(void)
{
    struct ph_small_triangle r = {.ramp = ramp, .knee = bits()};
    r.d = depth_bits();
    r.light = bits();
    r.left = (40 << 16) + below(20 << 16);
    r.d_dy = below(1 << 24);
    r.light_dy = bits() >> 8;
    r.gd = below(1 << 22);
    r.glight = bits() >> 6;
    r.upper_rows = (uint16_t)(1 + below(8));
    r.lower_rows = (uint16_t)below(8);
    r.right = r.left + below(16 << 16) - (3 << 16); /* also empty rows */
    r.left_dx = below(1 << 16);
    r.right_dx = r.left_dx + below(1 << 16);
    r.lower_is_right = below(2);
    const uint32_t other = r.upper_rows * (r.lower_is_right ? r.left_dx : r.right_dx);
    r.lower.x = (int32_t)((r.lower_is_right ? r.left + below(20 << 16) : r.right - below(20 << 16)) + other);
    r.lower.dx = (int32_t)(r.lower_is_right ? r.left_dx : r.right_dx);
    return r;
}

/* A small triangle, drawn by a kernel. */
static uint32_t try_small(uint32_t h,
                          uint32_t (*draw)(const struct ph_small_triangle *, uint16_t *, uint16_t *, uint32_t))
{
    const struct ph_small_triangle r = any_small();
    const uint32_t at = below(16), pixels_at = below(16), stride_bytes = 2 * (96 + below(16));
    return word(h, draw(&r, depth + at, pixels + pixels_at, stride_bytes));
}

/* A small triangle in colours; now and then a single row of many pixels. */
static uint32_t try_colours(uint32_t h)
{
    struct ph_small small = {.rows = any_small(), .of.own.green = {bits(), bits() >> 8, bits() >> 6}};
    if (below(3) == 0) {
        small.rows.upper_rows = 1;
        small.rows.lower_rows = 0;
        small.rows.right = small.rows.left + below(300 << 16);
    }
    const uint32_t at = below(16), pixels_at = below(16), stride_bytes = 2 * (96 + below(16));
    return word(h, ph_small_colours(&small, depth + at, pixels + pixels_at, stride_bytes));
}

static uint32_t try_rows(uint32_t h)
{
    return try_small(h, ph_small_gouraud);
}

static uint32_t try_knee(uint32_t h)
{
    return try_small(h, ph_small_knee);
}

static uint32_t try_dithered_rows(uint32_t h)
{
    return try_small(h, ph_small_dithered);
}

static uint32_t try_dithered_knee(uint32_t h)
{
    return try_small(h, ph_knee_dithered);
}

static struct ph_sides sides_of(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dy1 = b->y - a->y, dx2 = c->x - a->x, dy2 = c->y - a->y;
    return (struct ph_sides){dx1, dy1, dx2, dy2, dx2 * dy1 - dx1 * dy2, true};
}

static uint32_t hash_small(uint32_t h, const struct ph_triangle *t)
{
    const struct ph_small_triangle *const s = &t->as.small.rows;
    const uint32_t rows[] = {s->left_dx, s->right_dx, s->left, s->right, s->d, s->gd, s->d_dy};
    const uint32_t light[] = {s->light, s->glight, s->light_dy};
    h = hash(h, rows, sizeof rows);
    h = s->ramp != NULL ? hash(h, light, sizeof light) : hash(h, &t->as.small.of.slopes, sizeof t->as.small.of.slopes);
    h = s->lower_rows > 0 ? word(word(h, (uint32_t)s->lower.x), (uint32_t)s->lower.dx) : h;
    h = word(word(word(h, s->upper_rows), s->lower_rows), s->lower_is_right);
    return word(word(h, (uint32_t)t->y_top), (uint32_t)t->y_bottom);
}

/* A reference to a triangle that is mostly small, within a picture, and in one octave of depth or in fixed16. */
static uint32_t try_setup_fast(uint32_t h)
{
    const struct ph_lens lens = {.far_q = (uint32_t)1 << 30 | bits() >> 2, .far_s = 8, .float_down = 3};
    const uint32_t size = below(4) > 0   ? 5000
                          : below(2) > 0 ? 2 * PH_SIDE_SMALL
                          : below(2) > 0 ? 20000
                                         : 40,
                   depths = below(20);
    const bool fixed = below(4) == 0;
    const uint32_t left = below(4) > 0 ? 40 * 256 : 0, top = below(4) > 0 ? 40 * 256 : 60 * 256;
    struct ph_vertex corner[4];
    for (int i = 0; i < 4; i++) {
        corner[i].x = (int32_t)(left + below(size));
        corner[i].y = (int32_t)(top + below(size));
        corner[i].light = (uint16_t)bits();
        corner[i].q = ((uint32_t)5 << 28) + (bits() >> (2 + depths));
        corner[i].s = (int8_t)(fixed ? (int)below(6) - 1 : below(16) > 0 ? 3 : 2 + (int)below(3));
    }
    const struct ph_material material = {0};
    const uint32_t side = below(3) > 0 ? PH_SIDE_SMALL : PH_SIDE_SHORT;
    const struct ph_fast fast = {.base = corner,
                                 .margin = side + 256,
                                 .side = side,
                                 .lens = fixed ? NULL : &lens,
                                 .inner_x = 20000,
                                 .inner_y = 1000 + below(20000),
                                 .bias = below(1 << 20),
                                 .ramp = below(4) > 0 ? ramp : NULL,
                                 .material = &material,
                                 .set_codes = ph_float_depths};
    const uint16_t first = (uint16_t)below(2), second = (uint16_t)(first + 1);
    const struct ph_sides sides = sides_of(&corner[first], &corner[second], &corner[3]);
    const struct ph_ref ref = {{first, sides.area > 0 ? second : 3, sides.area > 0 ? 3 : second}, 0};
    struct ph_triangle t;
    memset(&t, 0, sizeof t);
    if (sides.area == 0 || ph_setup_fast(&fast, &ref, &t) != PH_SMALL_SET) {
        return word(h, 0);
    }
    h = word(h, t.kind == PH_KIND_SMALL && t.block == PH_BLOCK_NONE && t.material == &material &&
                    t.as.small.rows.ramp == fast.ramp);
    return hash_small(h, &t);
}

/* A triangle round a point within the picture; also without rows, as a sliver and steep. */
static uint32_t try_setup_small(uint32_t h)
{
    if (below(3) == 0) {
        return try_setup_fast(h);
    }
    const uint32_t size = below(3) > 0 ? 2 * PH_SIDE_SMALL : below(2) > 0 ? 600 : 40, flat = below(4) > 0 ? 0 : 7;
    struct ph_vertex corner[3];
    const uint32_t high = below(4) > 0 ? 0 : 1; /* textured ones may have twice as many rows */
    uint32_t d[3], far_apart = below(32);
    for (int i = 0; i < 3; i++) {
        corner[i].x = (int32_t)(100 * 256 + below(size) / 2);
        corner[i].y = (int32_t)(50 * 256 + (below(size << high) / 2 >> flat));
        corner[i].light = (uint16_t)(below(4) > 0 ? 30000 + below(2000) : bits());
        d[i] = (uint32_t)1 << 31 | bits() >> (1 + far_apart % 31);
    }
    const struct ph_sides first = sides_of(&corner[0], &corner[1], &corner[2]);
    const bool turned = first.area < 0;
    const struct ph_sides sides = turned ? sides_of(&corner[0], &corner[2], &corner[1]) : first;
    const struct ph_vertex *const v[3] = {&corner[0], &corner[turned ? 2 : 1], &corner[turned ? 1 : 2]};
    struct ph_triangle t;
    memset(&t, 0, sizeof t);
    t.as.small.rows.ramp = below(4) > 0 ? ramp : NULL;
    if (sides.area == 0 || !ph_setup_small(&t, v, &sides, d)) {
        return word(h, 0);
    }
    return hash_small(h, &t);
}

/* Corners in front of a far plane, mostly near each other. */
static uint32_t try_float(uint32_t h)
{
    struct ph_lens lens = {.far_q = (uint32_t)1 << 30 | bits() >> 2,
                           .far_s = (int8_t)(1 + below(30)),
                           .float_down = (uint8_t)(2 + below(4))};
    const uint32_t near = below((uint32_t)lens.far_s), down = below(31);
    struct ph_vertex corner[3];
    for (int i = 0; i < 3; i++) {
        corner[i].s = (int8_t)(lens.far_s - (int)(below(4) > 0 ? near : below((uint32_t)lens.far_s)));
        corner[i].q = ((uint32_t)1 << 30) + (bits() >> (2 + down % 30));
        corner[i].q = corner[i].s == lens.far_s ? lens.far_q + (bits() >> (3 + down % 29)) : corner[i].q;
    }
    const struct ph_vertex *const v[3] = {&corner[0], &corner[1], &corner[2]};
    uint32_t d[3];
    return ph_float_depths(&lens, v, below(1 << 20), d) ? hash(h, d, sizeof d) : word(h, 0);
}

/* Rows that may begin and end outside of the picture. */
static uint32_t try_long_by(uint32_t h, ph_gouraud_kernel *draw)
{
    struct ph_small_triangle r = {.ramp = ramp};
    const uint32_t log2 = 18 + below(10);
    r.left = below((uint32_t)1 << log2) - ((uint32_t)1 << log2 >> 1);
    r.right = r.left + below((uint32_t)1 << log2) - (3 << 16);
    r.left_dx = below(1 << 20) - (1 << 19);
    r.right_dx = below(1 << 20) - (1 << 19);
    r.d = depth_bits();
    r.light = bits();
    r.d_dy = below(1 << 24);
    r.light_dy = bits() >> 8;
    r.gd = below(1 << 22);
    r.glight = bits() >> 6;
    r.upper_rows = (uint16_t)(1 + below(PH_LONG_ROWS));
    if (below(2) > 0) { /* a lower edge takes over */
        r.lower_rows = (uint16_t)below(PH_LONG_ROWS + 1 - r.upper_rows);
        r.lower_is_right = below(2);
        r.lower.x = (int32_t)(below((uint32_t)1 << log2) - ((uint32_t)1 << log2 >> 1));
        r.lower.dx = (int32_t)(below(1 << 20) - (1 << 19));
    }
    const uint32_t at = below(16), pixels_at = below(16);
    return word(h, draw(&r, depth + at, pixels + pixels_at, 2 * (40 + below(60))));
}

static uint32_t try_long(uint32_t h)
{
    return try_long_by(h, ph_long_gouraud);
}

static uint32_t try_dithered_long(uint32_t h)
{
    return try_long_by(h, ph_long_dithered);
}

static uint32_t spread(int log2)
{
    return below((uint32_t)2 << log2) - ((uint32_t)1 << log2);
}

/* Coefficients as a tile has them, or (wild) any at all. */
static struct ph_texel_way way(int log2, bool wild)
{
    struct ph_texel_way w;
    w.at = wild ? bits() : below((uint32_t)64 << log2);
    w.step = wild ? bits() : spread(log2 - 1);
    w.bend = wild ? bits() : spread(log2 - 6);
    w.at_dy = wild ? bits() : spread(log2);
    w.step_dy = wild ? bits() : spread(log2 - 5);
    w.bend_dy = wild ? bits() : spread(log2 - 10);
    w.at_ddy = wild ? bits() : spread(log2 - 4);
    w.step_ddy = wild ? bits() : spread(log2 - 9);
    return w;
}

static uint32_t hash_way(uint32_t h, const struct ph_texel_way *w)
{
    return hash(h, w, sizeof *w);
}

/* A texture of 64 x 64 texels, or one of over 65,536. */
static void set_size(uint32_t *u_mask, uint32_t *v_mask)
{
    const uint32_t width_log2 = below(4) > 0 ? 6 : 7 + below(4);
    const uint32_t height_log2 = width_log2 == 6 ? 6 : 17 - width_log2 + below(width_log2 - 6);
    *u_mask = (1u << width_log2) - 1;
    *v_mask = ((1u << height_log2) - 1) << width_log2;
}

static uint32_t try_texture(uint32_t h)
{
    const bool wild = below(4) == 0;
    const uint32_t clamp = below(4); /* along neither, u, v, both */
    struct ph_tile_rows r = {.row = {.texels = texels}};
    set_size(&r.row.u_mask, &r.row.v_mask);
    r.row.left = below(30 << 16) - (10 << 16);
    r.row.right = r.row.left + below(40 << 16) - (5 << 16);
    r.row.left_dx = below(1 << 17) - (1 << 16);
    r.row.right_dx = below(1 << 17) - (1 << 16);
    r.row.d = bits();
    r.row.d_dy = below(1 << 24);
    r.row.depth = depth + below(16);
    r.row.pixels = pixels + below(16);
    r.row.stride_bytes = 2 * (64 + below(16));
    r.row.gd = below(1 << 24);
    r.columns = 1 + below(PH_TILE);
    r.row.rows = 1 + below(16);
    r.count = bits();
    r.u_outside = (clamp & 1) != 0 ? UINT32_MAX << 28 : 0;
    r.v_outside = (clamp & 2) != 0 ? UINT32_MAX << 28 : 0;
    r.outside = r.u_outside | r.v_outside;
    r.u = way(22, wild);
    r.v = way(22, wild || below(2) == 0);
    ph_texture_tile(&r);
    h = word(word(word(word(h, r.row.left), r.row.right), r.row.d), r.row.rows);
    h = word(word(word(h, (uint32_t)(r.row.depth - depth)), (uint32_t)(r.row.pixels - pixels)), r.count);
    return hash_way(hash_way(h, &r.u), &r.v);
}

static struct ph_texel_line line(bool wild)
{
    const struct ph_texel_way w = way(22, wild);
    return (struct ph_texel_line){w.at, w.step, w.at_dy, w.step_dy, w.at_ddy, w.bend};
}

/* A triangle of up to 14 rows of up to 32 pixels, on both sides of column 0. */
/* A row of texels for one of the kernels of texel_row.h. Every other one has small steps, so that many lie within one
 * repeat of the texture. */
static uint32_t try_texel_row(uint32_t h, void (*draw)(const struct ph_texel_row *))
{
    struct ph_texel_row row = {.depth = depth + 256, .pixels = pixels + 256, .texels = texels};
    uint32_t *const walks = &row.u.at; /* u and v, one after the other */
    const uint32_t width_log2 = below(11);
    row.u_mask = (1u << width_log2) - 1;
    row.v_mask = ((1u << below(11)) - 1) << width_log2;
    row.n = 1 + below(64);
    row.d = bits();
    row.gd = bits();
    row.gd >>= below(32);
    for (int i = 0; i < 6; i++) {
        walks[i] = bits();
        walks[i] >>= below(32);
    }
    if (below(2) == 0) {
        row.u.step = below(1 << 22) - (1 << 21);
        row.v.step = below(1 << 22) - (1 << 21);
        row.u.bend = below(1 << 18) - (1 << 17);
        row.v.bend = below(1 << 18) - (1 << 17);
    }
    row.level = below(33);
    row.light = below(33 << 24);
    row.light_step = below(33 << 20);
    row.light_step = row.light + 16 * row.light_step < 33u << 24 ? row.light_step : 0; /* light stays in its range */
    draw(&row);
    return hash_rows(h);
}

static uint32_t try_texel_row_nearest(uint32_t h)
{
    return try_texel_row(h, ph_texel_row_nearest);
}

static uint32_t try_texel_row_lit(uint32_t h)
{
    return try_texel_row(h, ph_texel_row_lit);
}

static uint32_t try_texel_row_smooth(uint32_t h)
{
    return try_texel_row(h, ph_texel_row_smooth);
}

static uint32_t try_texel_row_smooth_lit(uint32_t h)
{
    return try_texel_row(h, ph_texel_row_smooth_lit);
}

static struct ph_texel_run texel_run(void)
{
    const bool wild = below(4) == 0;
    struct ph_texel_run r = {.row = {.texels = texels}};
    const uint32_t at = 40 + below(16), pixels_at = 40 + below(16);
    set_size(&r.row.u_mask, &r.row.v_mask);
    r.row.left = below(20 << 16) - (10 << 16);
    r.row.right = r.row.left + below(18 << 16) - (2 << 16);
    r.row.left_dx = below(1 << 16) - (1 << 15);
    r.row.right_dx = below(1 << 16) - (1 << 15);
    r.row.d = bits();
    r.row.d_dy = below(1 << 24);
    r.row.gd = below(1 << 24);
    r.u = line(wild);
    r.v = line(wild || below(2) == 0);
    r.row.depth = depth + at;
    r.row.pixels = pixels + pixels_at;
    r.row.stride_bytes = 2 * (96 + below(16));
    r.row.rows = 1 + below(7);
    r.lower_rows = below(8);
    r.lower_is_right = below(2);
    r.lower_x = r.lower_is_right ? r.row.right + r.row.rows * r.row.right_dx : r.row.left + r.row.rows * r.row.left_dx;
    r.lower_dx = below(1 << 16) - (1 << 15);
    return r;
}

static uint32_t try_texture_small(uint32_t h)
{
    struct ph_texel_run r = texel_run();
    h = word(h, ph_texture_small(&r));
    return hash(hash(h, &r.u, sizeof r.u), &r.v, sizeof r.v);
}

/* The depth of some column of the first row is that of the knee. */
static uint32_t try_texture_knee(uint32_t h)
{
    struct ph_texel_run r = texel_run();
    h = word(h, ph_texture_knee(&r, (r.row.d + below(64) * r.row.gd) | 1));
    return hash(hash(h, &r.u, sizeof r.u), &r.v, sizeof r.v);
}

/* Light is mostly in its range, and now and then a little or far beyond it. */
static uint32_t try_texel_run(uint32_t h)
{
    struct ph_texel_run r = texel_run();
    const int steep = (int)below(12);
    r.row.light = below(33 << 24);
    r.row.light_dy = (uint32_t)(((int32_t)below(1 << 30) - (1 << 29)) >> steep);
    r.row.glight = (uint32_t)(((int32_t)below(1 << 30) - (1 << 29)) >> (steep + 3));
    static ph_texel_row_kernel *const rows[4] = {ph_texel_row_nearest, ph_texel_row_lit, ph_texel_row_smooth,
                                                 ph_texel_row_smooth_lit};
    r.draw_row = rows[below(4)];
    r.draw_rows = r.draw_row == ph_texel_row_lit ? ph_texel_run_rows_lit : ph_texel_run_rows;
    struct ph_texel_row row = {.gd = r.row.gd, .u_mask = r.row.u_mask, .v_mask = r.row.v_mask, .texels = texels};
    row.light_step = 4 * r.row.glight;
    row.u.bend = 4 * r.u.bend;
    row.v.bend = 4 * r.v.bend;
    uint32_t count = 0;
    do {
        count += r.draw_rows(&r, &row);
    } while (row.level != UINT32_MAX && ph_texel_run_lower(&r));
    h = word(h, count);
    h = hash(hash(hash(h, &r.u, sizeof r.u), &r.v, sizeof r.v), &r.row.left, 3 * sizeof r.row.left);
    h = word(word(word(h, r.row.light), (uint32_t)(r.row.depth - depth)),
             (uint32_t)(r.row.pixels - pixels) + r.row.rows);
    if (row.level == UINT32_MAX) {
        h = hash(word(word(h, row.light), (uint32_t)(row.depth - depth)), &row.n, 9 * sizeof row.n);
    }
    return h;
}

static int32_t around(int32_t most)
{
    return (int32_t)below(2 * (uint32_t)most) - most;
}

static struct ph_clip_matrix any_matrix(void)
{
    struct ph_clip_matrix m;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m.m[i][j] = around(1 << 28);
        }
        m.t[i] = fx_mul_wide(around(i < 2 ? 1 << 16 : 8 << 16), 1 << 28) + (1 << 27);
    }
    return m;
}

/* Vertices of a mesh, most of them in the picture; one beyond every reach. */
static uint32_t try_vertices(uint32_t h)
{
    enum { VERTICES = 40 };
    struct fx_vec3 positions[VERTICES];
    struct ph_vertex out[VERTICES];
    const struct ph_clip_matrix m = any_matrix();
    struct ph_vertex_run run = {.from = positions, .end = positions + VERTICES, .to = out};
    for (int i = 0; i < VERTICES; i++) {
        const int32_t size = below(8) > 0 ? 1 << 16 : 1 << 20;
        positions[i] = (struct fx_vec3){around(size), around(size), around(size)};
    }
    positions[below(VERTICES)].y = -(1 << 27) - 1;
    ph_matvec_prepare(&run.matvec, &m);
    run.near = 1 + below(1 << (1 + below(16)));
    run.range = below((1 << 28) - run.near);
    run.down = 1 + below(16);
    run.round_x = (int64_t)((uint64_t)(bits() >> 6) << 32);
    run.round_y = (int64_t)((uint64_t)(bits() >> 6) << 32);
    run.depth_scale = bits() | (uint32_t)1 << 31;
    run.near_shift = (int32_t)below(32);
    run.guard_up = below(4);
    run.right = below(1 << 20);
    run.bottom = below(1 << 20);
    memset(out, 0, sizeof out);
    for (; run.from < run.end; run.from++, run.to++) {
        run.at = (struct fx_vec3){0, 0, 0};
        ph_vertices(&run);
        h = word(hash(h, &run.at, sizeof run.at), (uint32_t)(run.to - out));
    }
    return word(hash(h, out, sizeof out), run.codes);
}

static uint8_t any_code(void)
{
    static const uint8_t codes[] = {PH_LEFT, PH_RIGHT | PH_TOP, PH_NEAR | PH_GUARD | PH_BOTTOM,
                                    PH_FAR,  PH_GUARD,          PH_LEFT | PH_BOTTOM};
    return (uint8_t)((below(3) > 0 ? 0 : codes[below(sizeof codes)]) | (below(2) > 0 ? PH_LIT : 0));
}

/* Triangles large and small, many without area, of vertices with and without clip codes. */
static uint32_t try_cull(uint32_t h)
{
    enum { VERTICES = 12, TRIANGLES = 40 };
    struct ph_vertex vertices[VERTICES];
    uint16_t triangles[TRIANGLES][3];
    struct ph_ref refs[TRIANGLES];
    const uint32_t size = 4u << below(17), coded = below(2), at = below(1 << 10);
    memset(vertices, 0, sizeof vertices);
    memset(refs, 0, sizeof refs);
    for (int i = 0; i < VERTICES; i++) {
        vertices[i] = (struct ph_vertex){.x = (int32_t)(at + below(size)), .y = (int32_t)(at + below(size))};
        vertices[i].code = coded > 0 ? any_code() : 0;
        vertices[i].light = (uint16_t)bits();
    }
    for (int i = 0; i < TRIANGLES; i++) {
        for (int k = 0; k < 3; k++) {
            triangles[i][k] = (uint16_t)below(VERTICES);
        }
    }
    struct ph_cull_run run = {.vertices = vertices, .index = triangles, .end = triangles + below(TRIANGLES + 1)};
    run.codes = coded;
    run.to = refs + TRIANGLES;
    run.limit = refs + (below(2) > 0 ? 0 : TRIANGLES - below(8));
    run.band_scale = ((1 << 20) + 15) / (1 + below(16));
    run.mark = below(2) * PH_LIT;
    while (ph_cull(&run)) {
        h = word(word(h, (uint32_t)(run.index - triangles)), (uint32_t)(run.to - refs));
    }
    h = hash(hash(h, refs, sizeof refs), vertices, sizeof vertices);
    return word(h, (uint32_t)(run.index - triangles));
}

int main(void)
{
    static const struct {
        const char *name;
        uint32_t (*one)(uint32_t h);
    } loops[] = {{"fx_mul", try_mul},
                 {"fill", try_fill},
                 {"span_flat", try_flat},
                 {"span_blend", try_blend},
                 {"pairs_mix", try_mix},
                 {"pairs_add", try_add},
                 {"pairs_times", try_times},
                 {"span_seen", try_seen},
                 {"fog_alike", try_fog},
                 {"line_pixels", try_line},
                 {"halve", try_halve},
                 {"small_gouraud", try_rows},
                 {"small_knee", try_knee},
                 {"long_gouraud", try_long},
                 {"small_dithered", try_dithered_rows},
                 {"knee_dithered", try_dithered_knee},
                 {"small_colours", try_colours},
                 {"long_dithered", try_dithered_long},
                 {"setup_small", try_setup_small},
                 {"float_depths", try_float},
                 {"texture_tile", try_texture},
                 {"texture_small", try_texture_small},
                 {"texture_knee", try_texture_knee}, /* in C, but for x86-64 */
                 {"texel_row_nearest", try_texel_row_nearest},
                 {"texel_row_lit", try_texel_row_lit},
                 {"texel_row_smooth", try_texel_row_smooth},
                 {"texel_row_smooth_lit", try_texel_row_smooth_lit},
                 {"texel_run_rows", try_texel_run},
                 {"vertices", try_vertices},
                 {"cull", try_cull}};
    randomise(texels, TEXELS);
    randomise(ramp, PH_DITHER_STEPS * PH_RAMP_SIZE);
    for (size_t i = 0; i < sizeof loops / sizeof loops[0]; i++) {
        uint32_t h = 2166136261u;
        state = 1;
        for (int turn = 0; turn < TURNS; turn++) {
            if (turn % 64 == 0) {
                h = turn > 0 ? hash_rows(h) : h;
                randomise(pixels, ROOM);
                memset(depth, 0, sizeof depth);
            }
            h = loops[i].one(h);
        }
        printf("%s %08lx\n", loops[i].name, (unsigned long)hash_rows(h));
    }
    return 0;
}
