/*
 * Textured triangles, perspective-correct, in tiles of up to 32 x 16 pixels.
 *
 * At the four corners of a tile u and v are divided exactly. Between them they follow a surface that is a parabola
 * along each row and each column and is exact in the middle of each side, too: if 1/w goes from w0 to w1 along a side,
 * and u changes by U, then u in its middle lies U (w1 - w0) / (2 (w0 + w1)) beside the straight line. So a pixel and a
 * row cost a few additions. Where 1/w changes much, tiles are smaller. They are placed by the triangle, not by the
 * band, so the picture does not depend on where bands begin. Measured error: tests/core/test_quality.c, test_texture.c.
 *
 * A triangle is cut into strips, rows in which all tiles have one height; a strip is cut into tiles from left to right.
 * ph_texture_tile of texture_tile.h draws the usual ones (16-bit depth, full light, up to 65,536 texels), draw_run here
 * all others.
 */
#include "texture.h"

#include "colour.h"
#include "planes.h"
#include "span.h"
#include "texture_tile.h"

enum { WIDTH_LOG2 = 5, HEIGHT_LOG2 = 4 };

_Static_assert(1 << WIDTH_LOG2 == PH_TILE, "texture_tile.h");

/* How the pixels of a tile are drawn. */
struct tile_kind {
    const struct ph_triangle *triangle;
    const uint16_t *texels;
    uint32_t u_mask, v_mask, log2_width;
    int u_down, v_down; /* from u, v to whole texels */
    uint32_t light;     /* 0 .. 32 */
    bool clamp;
    bool depth24; /* as in struct ph_band */
    bool plain;   /* ph_texture_tile can draw them */
};

/* u or v, in 2^-25 of their range, at the top and the bottom of the left and the right side of a tile. */
struct corners {
    int32_t left[2], right[2];
};

/* u and v over a tile. A side's number is the part of the change of u or v along it by which the parabola through its
 * ends and its middle bends: the change of 1/w over the mean of 1/w, in 2^-16. */
struct surface {
    struct corners u, v;
    int32_t top, bottom, left, right;
};

struct tile {
    uint32_t x, y;
    int width_log2, height_log2;
};

/* Rows of a triangle whose tiles have one height. */
struct strip {
    uint32_t y, y_end;
    int height_log2;
    int32_t x, x_end; /* the columns in which there are pixels; none if x >= x_end */
    uint32_t least_w; /* 1/w at its pixels */
};

/* The plane of 1/w; linear-w has it as its depth. */
static const struct ph_plane *over_w(const struct ph_triangle *t)
{
    return t->block == PH_BLOCK_LINEAR ? &t->depth : &t->attribute[2];
}

static int32_t mulhi(int32_t a, int32_t b)
{
    return (int32_t)(fx_mul_wide(a, b) >> 32);
}

/* 1/w at a point: 2^(61 - shift) / reciprocal. */
struct over_w {
    int32_t reciprocal;
    int shift;
};

/* Divides exactly: u and v at a point from the planes of u/w and v/w (see setup_texture), below 8 of their range. */
static inline struct over_w divide(const struct ph_triangle *t, uint32_t x, uint32_t y, int32_t *u, int32_t *v)
{
    const uint32_t plane = ph_plane_at(over_w(t), x, y);
    const uint32_t w = plane - 4 < ((uint32_t)1 << 30) - 4 ? plane : 4; /* 2^29 with head room */
    struct over_w at;
    at.reciprocal = (int32_t)(fx_rcp_norm(w, &at.shift) >> 1);
    *u = mulhi((int32_t)(ph_plane_at(&t->attribute[0], x, y) << (at.shift - 2)), at.reciprocal);
    *v = mulhi((int32_t)(ph_plane_at(&t->attribute[1], x, y) << (at.shift - 2)), at.reciprocal);
    return at;
}

/* The part of a side that ends here: q (1 + q / 2). q is the change over 1/w, 1/4 at most. See struct surface. */
static inline int32_t part_of(const struct over_w *end, uint32_t change)
{
    const int32_t q = ((int32_t)(change << end->shift) >> 16) * (end->reciprocal >> 15) >> 14;
    return q + (int32_t)((uint32_t)q * (uint32_t)q >> 17);
}

/* Divides at the right side of a tile, which ends at column x; ends: 1/w at its upper and its lower corner. */
static void divide_side(const struct ph_triangle *t, const struct tile *tile, uint32_t x, struct surface *s,
                        struct over_w ends[2])
{
    const uint32_t height = 1u << tile->height_log2;
    for (int i = 0; i < 2; i++) {
        ends[i] = divide(t, x, i == 0 ? tile->y : tile->y + height, &s->u.right[i], &s->v.right[i]);
    }
    s->right = part_of(&ends[1], over_w(t)->gy * height);
}

/* Goes on to the next tile: its left side is the right side of the one before. */
static void divide_tile(const struct ph_triangle *t, const struct tile *tile, struct surface *s)
{
    const uint32_t width = 1u << tile->width_log2, change = over_w(t)->gx * width;
    struct over_w ends[2];
    for (int i = 0; i < 2; i++) {
        s->u.left[i] = s->u.right[i];
        s->v.left[i] = s->v.right[i];
    }
    s->left = s->right;
    divide_side(t, tile, tile->x + width, s, ends);
    s->top = part_of(&ends[0], change);
    s->bottom = part_of(&ends[1], change);
}

/* A change along a side: linear s + square s^2, s = 0 .. 1. Its middle is -square / 4 beside the straight line. */
struct curve {
    uint32_t linear, square;
};

static inline struct curve curve_of(int32_t from, int32_t to, int32_t part)
{
    const uint32_t change = (uint32_t)to - (uint32_t)from;
    const uint32_t square = (uint32_t)((int32_t)(0u - (uint32_t)((int32_t)change >> 10) * (uint32_t)part) >> 6);
    return (struct curve){change - square, square};
}

/* v 2^by. */
static inline uint32_t scaled(uint32_t v, int by)
{
    return by >= 0 ? v << by : (uint32_t)((int32_t)v >> -by);
}

/*
 * The way of u or v over a tile, in 2^-(25 + up) of their range. The coefficients of a row are polynomials of the row's
 * number, stepped by forward differences: the first is linear + square, and it grows by 2 square from row to row. `at`
 * comes from the left side, step and bend from the top and the bottom. The right side bends more than the left by
 * twist; since `at` follows the left side alone, step takes it up.
 */
static void set_way(struct ph_texel_way *way, const struct corners *c, const struct surface *s, const struct tile *tile,
                    int up)
{
    const int x = up - tile->width_log2, xx = x - tile->width_log2, y = tile->height_log2;
    const struct curve top = curve_of(c->left[0], c->right[0], s->top);
    const struct curve bottom = curve_of(c->left[1], c->right[1], s->bottom);
    const struct curve left = curve_of(c->left[0], c->left[1], s->left);
    const struct curve right = curve_of(c->right[0], c->right[1], s->right);
    const uint32_t twist = right.square - left.square;
    way->at = scaled((uint32_t)c->left[0], up);
    way->at_dy = scaled(left.linear, up - y) + scaled(left.square, up - 2 * y);
    way->at_ddy = scaled(left.square, up - 2 * y + 1);
    way->step = scaled(top.linear, x);
    way->step_dy = scaled(bottom.linear - top.linear - twist, x - y) + scaled(twist, x - 2 * y);
    way->step_ddy = scaled(twist, x - 2 * y + 1);
    way->bend = scaled(top.square, xx);
    way->bend_dy = scaled(bottom.square - top.square, xx - y);
}

static int32_t clamp_texel(int32_t texel, uint32_t mask)
{
    return texel < 0 ? 0 : (uint32_t)texel > mask ? (int32_t)mask : texel;
}

/* c * light / 32 for all three channels at once. */
static uint16_t shade(uint16_t wire, uint32_t light)
{
    const uint32_t c = ph_wire16(wire), spread = (c | c << 16) & 0x07e0f81fu;
    const uint32_t lit = (spread * light >> 5) & 0x07e0f81fu;
    return ph_wire16((uint16_t)(lit | lit >> 16));
}

/* The texel at u, v; it is clamped or repeated, and lit if the light is not full. */
static inline uint16_t sample(const struct tile_kind *k, uint32_t u, uint32_t v)
{
    int32_t column = (int32_t)u >> k->u_down, line = (int32_t)v >> k->v_down;
    if (k->clamp) {
        column = clamp_texel(column, k->u_mask);
        line = clamp_texel(line, k->v_mask);
    }
    const uint16_t texel = k->texels[((uint32_t)line & k->v_mask) << k->log2_width | ((uint32_t)column & k->u_mask)];
    return k->light < 32 ? shade(texel, k->light) : texel;
}

/* Draws n pixels from column i of the tile on, along one piece of the depth, where ph_texture_tile cannot. */
static inline __attribute__((always_inline)) void draw_run(const struct tile_kind *k, const struct ph_texel_rows *r,
                                                           uint32_t i, uint32_t n, struct ph_piece piece, bool depth24)
{
    const uint32_t ddu = 2 * r->u.bend, ddv = 2 * r->v.bend;
    uint32_t u = ph_texel_at(&r->u, i), du = r->u.step + i * ddu + r->u.bend;
    uint32_t v = ph_texel_at(&r->v, i), dv = r->v.step + i * ddv + r->v.bend;
    uint16_t *pixel = r->pixels + i;
    void *depth = ph_depth_from(r->depth, i, depth24);
    for (; n > 0; n--) {
        const uint32_t d =
            k->triangle->block == PH_BLOCK_LINEAR ? ph_depth_linear(&k->triangle->linear, piece.d) : piece.d;
        if (depth24 ? ph_nearer24(depth, d) : ph_nearer16(depth, d)) {
            *pixel = sample(k, u, v);
        }
        depth = ph_depth_from(depth, 1, depth24);
        pixel++;
        piece.d += piece.gd;
        u += du;
        du += ddu;
        v += dv;
        dv += ddv;
    }
}

static void draw_other(const struct tile_kind *k, const struct ph_texel_rows *r, uint32_t i, uint32_t n,
                       struct ph_piece piece)
{
    if (k->depth24) {
        draw_run(k, r, i, n, piece, true);
    } else {
        draw_run(k, r, i, n, piece, false);
    }
}

/* Steps to the next row. */
static void row_down(const struct tile_kind *k, struct ph_texel_rows *r)
{
    r->left += r->left_dx;
    r->right += r->right_dx;
    r->d += r->d_dy;
    ph_texel_way_down(&r->u);
    ph_texel_way_down(&r->v);
    r->depth += k->depth24 ? r->stride_bytes : r->stride_bytes / 2;
    r->pixels += r->stride_bytes / 2;
    r->rows--;
}

/* Draws rows whose depth may have several pieces each. r->d and r->gd are in units of the triangle's plane. */
static void draw_rows_in_pieces(const struct tile_kind *k, struct ph_texel_rows *r)
{
    for (; r->rows > 0; row_down(k, r)) {
        uint32_t i, left, n;
        if (!ph_tile_columns(r->left, r->right, r->columns, &i, &left)) {
            continue;
        }
        r->count += left;
        for (; left > 0; i += n, left -= n) {
            n = left;
            const struct ph_piece piece = ph_depth_piece(k->triangle, r->d + i * r->gd, &n);
            draw_other(k, r, i, n, piece);
        }
    }
}

/* Draws rows with depth in codes. ph_texture_tile stops before a row that leaves a clamped texture. */
static void draw_plain_rows(const struct tile_kind *k, struct ph_texel_rows *r)
{
    for (;;) {
        uint32_t i, n;
        ph_texture_tile(r);
        if (r->rows == 0) {
            return;
        }
        if (ph_tile_columns(r->left, r->right, r->columns, &i, &n)) {
            draw_other(k, r, i, n, (struct ph_piece){r->d + i * r->gd, r->gd});
            r->count += n;
        }
        row_down(k, r);
        if (r->rows == 0) {
            return;
        }
    }
}

/* Depth of a tile that crosses octaves. Codes and border are stepped from its first row, whatever the band. */
struct tile_depth {
    uint32_t d, d_dy;            /* of its first row, in units of the triangle's plane */
    struct ph_octave octaves[2]; /* the far and the near one, or twice the only one */
};

/* Draws rows in one octave; the first of them is row `row` of the tile. */
static void draw_rows_in_octave(const struct tile_kind *k, struct ph_texel_rows *r, const struct tile_depth *depth,
                                bool near, uint32_t row)
{
    const struct ph_octave *const octave = &depth->octaves[near];
    const uint32_t d = r->d, gd = r->gd, rows = r->rows;
    r->d_dy = ph_depth_float16_slope(depth->d_dy, octave->up);
    r->d = ph_depth_float16_value(octave->bottom, octave->up) + octave->offset +
           ph_depth_float16_slope(depth->d - octave->bottom, octave->up) + row * r->d_dy;
    r->gd = octave->slope;
    draw_plain_rows(k, r);
    r->d = d + rows * depth->d_dy;
    r->gd = gd;
    r->d_dy = depth->d_dy;
}

/* How many next rows begin and end on the same sides of the octaves' border as the first. Without pixels: far. */
static uint32_t rows_alike(const struct ph_texel_rows *r, uint32_t border, bool near[2])
{
    uint32_t left = r->left, right = r->right, d = r->d, n = 0;
    for (; n < r->rows; n++) {
        uint32_t i, pixels;
        const bool any = ph_tile_columns(left, right, r->columns, &i, &pixels);
        const bool first = any && d + i * r->gd >= border, last = any && d + (i + pixels - 1) * r->gd >= border;
        if (n > 0 && (first != near[0] || last != near[1])) {
            break;
        }
        near[0] = first;
        near[1] = last;
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* The line on which d is at the octaves' border, as an edge of the tile at row `row`. */
static struct ph_edge border_edge(const struct tile_depth *depth, uint32_t gd, uint32_t row)
{
    int shift;
    const int32_t reciprocal = ph_wide_reciprocal(fx_magnitude((int32_t)gd), &shift);
    const uint32_t sign = (int32_t)gd < 0 ? UINT32_MAX : 1, way = depth->octaves[1].bottom - depth->d;
    const int64_t x = fx_mul_wide((int32_t)(way * sign), reciprocal) >> (45 - shift);
    const uint32_t dx = (uint32_t)(fx_mul_wide((int32_t)((0u - depth->d_dy) * sign), reciprocal) >> (45 - shift));
    return (struct ph_edge){(int32_t)((uint32_t)x + 65535u + row * dx), (int32_t)dx};
}

/* Draws rows that have a near and a far octave in them, from row `row` of the tile on. */
static void draw_rows_in_two(const struct tile_kind *k, struct ph_texel_rows *r, const struct tile_depth *depth,
                             uint32_t row)
{
    const uint32_t way = depth->octaves[1].bottom - depth->d;
    uint32_t n;
    for (uint32_t rows = r->rows; rows > 0; rows -= n, row += n) {
        bool near[2] = {false, false};
        r->rows = rows;
        r->rows = n = rows_alike(r, depth->octaves[1].bottom, near);
        if (near[0] == near[1] || fx_magnitude((int32_t)r->gd) <= fx_magnitude((int32_t)way) >>
                                      29) { /* or so flat that the border is a row */
            draw_rows_in_octave(k, r, depth, near[0], row);
            continue;
        }
        const struct ph_edge border = border_edge(depth, r->gd, row);
        const uint32_t left = r->left, left_dx = r->left_dx;
        struct ph_texel_rows part = *r;
        part.right = (uint32_t)border.x;
        part.right_dx = (uint32_t)border.dx;
        draw_rows_in_octave(k, &part, depth, near[0], row);
        r->left = (uint32_t)border.x;
        r->left_dx = (uint32_t)border.dx;
        r->count = part.count;
        draw_rows_in_octave(k, r, depth, near[1], row);
        r->left = left + n * left_dx;
        r->left_dx = left_dx;
    }
    r->rows = 0;
}

static inline bool are_inside(const struct corners *c, uint32_t margin, uint32_t span)
{
    return (uint32_t)c->left[0] - margin < span && (uint32_t)c->left[1] - margin < span &&
           (uint32_t)c->right[0] - margin < span && (uint32_t)c->right[1] - margin < span;
}

/* Whether all of a tile lies in the texture's only repeat, with a margin. */
static bool is_inside(const struct ph_triangle *t, const struct surface *s)
{
    const uint32_t margin = 1 << 15, span = ((uint32_t)1 << (25 - t->range_log2)) - 2 * margin;
    return are_inside(&s->u, margin, span) && are_inside(&s->v, margin, span);
}

/*
 * Chooses how a tile is drawn. For ph_texture_tile u and v are in its units: they wrap, and so the texture repeats. In
 * a clamped texture they must not wrap, or a point outside would seem to be inside: its texels must fit in beside the
 * sign, with room for as many again. For draw_run u and v are in 2^-29 of their range.
 */
static void set_texels(struct tile_kind *k, const struct tile *tile, const struct surface *s, struct ph_texel_rows *r)
{
    const struct ph_triangle *const t = k->triangle;
    const struct ph_texture *const texture = t->material->texture;
    const int width = texture->log2_width, height = texture->log2_height, range = t->range_log2;
    k->texels = r->texels = texture->texels;
    k->u_mask = r->u_mask = (1u << width) - 1;
    k->v_mask = (1u << height) - 1;
    k->log2_width = texture->log2_width;
    k->clamp = texture->wrap == PH_WRAP_CLAMP && !is_inside(t, s);
    k->plain = !k->depth24 && t->block != PH_BLOCK_LINEAR && t->colour >= 32 && width + height <= 16 &&
               (!k->clamp || (range + width <= 8 && range + width + height <= 14));
    k->u_down = k->plain ? 22 : 29 - range - width;
    k->v_down = k->plain ? 16 + width : 29 - range - height;
    r->v_mask = k->v_mask << width;
    r->u_outside = k->clamp ? UINT32_MAX << width << 22 : 0;
    r->v_outside = k->clamp ? UINT32_MAX << (width + height) << 16 : 0;
    set_way(&r->u, &s->u, s, tile, k->u_down + range + width - 25);
    set_way(&r->v, &s->v, s, tile, k->v_down + range + height - 25);
}

/* The octaves of a tile; false if there are more than two. */
static bool tile_depth(const struct ph_triangle *t, const struct tile *tile, struct tile_depth *depth)
{
    const uint32_t right = ((1u << tile->width_log2) - 1) * t->depth.gx;
    const uint32_t below = ((1u << tile->height_log2) - 1) * t->depth.gy;
    const uint32_t d = ph_plane_at(&t->depth, tile->x, tile->y);
    const uint32_t least = d + ((int32_t)right < 0 ? right : 0) + ((int32_t)below < 0 ? below : 0);
    const uint32_t most = d + ((int32_t)right < 0 ? 0 : right) + ((int32_t)below < 0 ? 0 : below);
    struct ph_octave *const least_in = &depth->octaves[0], *const most_in = &depth->octaves[1];
    depth->d = d;
    depth->d_dy = t->depth.gy;
    ph_octave_of(least_in, t, least, t->depth.gx);
    ph_octave_of(most_in, t, most, t->depth.gx);
    return least_in->size > 0 && most_in->size > 0 && least <= most && least_in->up - most_in->up < 2;
}

/* Draws the rows of the upper or the lower half that are in the band; r stands at the first of them. */
static void draw_half(const struct tile_kind *k, const struct ph_band *rows, int half, const struct tile *tile,
                      struct ph_texel_rows *r)
{
    const struct ph_triangle *const t = k->triangle;
    int32_t from, to;
    struct ph_edge left, right;
    struct tile_depth depth;
    if (!ph_half_rows(t, rows, half, &from, &to, &left, &right)) {
        return;
    }
    const uint32_t row = (uint32_t)from - tile->y;
    r->left = (uint32_t)left.x - (tile->x << 16);
    r->left_dx = (uint32_t)left.dx;
    r->right = (uint32_t)right.x - (tile->x << 16);
    r->right_dx = (uint32_t)right.dx;
    r->rows = (uint32_t)(to - from);
    if (k->plain && t->block == PH_BLOCK_NONE) {
        draw_plain_rows(k, r);
    } else if (!k->plain || !tile_depth(t, tile, &depth)) {
        draw_rows_in_pieces(k, r);
    } else if (depth.octaves[0].up == depth.octaves[1].up) {
        draw_rows_in_octave(k, r, &depth, false, row);
    } else {
        draw_rows_in_two(k, r, &depth, row);
    }
}

/* Draws the rows of a tile that are in the band. */
static uint32_t draw_tile(const struct ph_triangle *t, const struct ph_band *band, const struct tile *tile,
                          const struct surface *s)
{
    const int32_t y = (int32_t)tile->y, y1 = y + (1 << tile->height_log2);
    const struct ph_band rows = {NULL, NULL, false, y > band->y0 ? y : band->y0, y1 < band->y1 ? y1 : band->y1, 0};
    const uint32_t width = (uint32_t)band->width, left = width - tile->x, columns = 1u << tile->width_log2;
    const uint32_t at = (uint32_t)(rows.y0 - band->y0) * width + tile->x;
    struct tile_kind k = {.triangle = t, .light = t->colour, .depth24 = band->depth24};
    struct ph_texel_rows r;
    r.depth = ph_depth_from(band->depth, at, band->depth24);
    r.pixels = band->pixels + at;
    r.stride_bytes = 2 * width;
    r.columns = left < columns ? left : columns;
    r.count = 0;
    r.d = ph_plane_at(&t->depth, tile->x, (uint32_t)rows.y0);
    r.gd = t->depth.gx;
    r.d_dy = t->depth.gy;
    set_texels(&k, tile, s, &r);
    for (int32_t skipped = y; skipped < rows.y0; skipped++) {
        ph_texel_way_down(&r.u);
        ph_texel_way_down(&r.v);
    }
    draw_half(&k, &rows, 0, tile, &r);
    draw_half(&k, &rows, 1, tile, &r);
    return r.count;
}

/* Whether slopes are gentle along a side of 2^log2 pixels: 1/w changes by 3/16 at most, u and v by 2 of their range. */
static bool is_gentle(uint32_t gu, uint32_t gv, uint32_t gw, uint32_t least_w, int log2)
{
    return least_w < (uint32_t)1 << 30 && fx_magnitude((int32_t)gw) <= ((least_w >> 3) + (least_w >> 4)) >> log2 &&
           (fx_magnitude((int32_t)gu) | fx_magnitude((int32_t)gv)) <= (least_w >> 1) >> log2;
}

/* The widest tile at x, y that is gentle. */
static int tile_width(const struct ph_triangle *t, const struct tile *tile, uint32_t columns)
{
    const struct ph_plane *const w = over_w(t);
    uint32_t least = ph_plane_at(w, tile->x, tile->y);
    const uint32_t below = w->gy << tile->height_log2;
    least += (int32_t)below < 0 ? below : 0;
    int log2 = WIDTH_LOG2;
    while (log2 > 0 && 1u << (log2 - 1) >= columns) {
        log2--;
    }
    for (; log2 > 0; log2--) {
        const uint32_t right = w->gx << log2, corner = (int32_t)right < 0 ? least + right : least;
        if (is_gentle(t->attribute[0].gx, t->attribute[1].gx, w->gx, corner, log2)) {
            break;
        }
    }
    return log2;
}

/* Finds columns and least 1/w of the rows of a strip. */
static void measure_strip(const struct ph_triangle *t, int32_t width, struct strip *strip)
{
    const struct ph_band rows = {NULL, NULL, false, (int32_t)strip->y, (int32_t)strip->y_end, 0};
    strip->x = width;
    strip->x_end = 0;
    strip->least_w = UINT32_MAX;
    for (int half = 0; half < 2; half++) {
        int32_t y, y_end;
        struct ph_edge left, right;
        if (!ph_half_rows(t, &rows, half, &y, &y_end, &left, &right)) {
            continue;
        }
        for (int end = 0; end < 2; end++) {
            const int32_t from = left.x < 0 ? 0 : left.x >> 16;
            const int32_t right_column = right.x >> 16, to = right_column > width ? width : right_column;
            strip->x = from < strip->x ? from : strip->x;
            strip->x_end = to > strip->x_end ? to : strip->x_end;
            if (from < to) {
                const uint32_t w0 = ph_plane_at(over_w(t), (uint32_t)from, (uint32_t)y);
                const uint32_t w1 = ph_plane_at(over_w(t), (uint32_t)to - 1, (uint32_t)y);
                strip->least_w = w0 < strip->least_w ? w0 : strip->least_w;
                strip->least_w = w1 < strip->least_w ? w1 : strip->least_w;
            }
            const int32_t more = y_end - 1 - y;
            left.x = (int32_t)((uint32_t)left.x + (uint32_t)more * (uint32_t)left.dx);
            right.x = (int32_t)((uint32_t)right.x + (uint32_t)more * (uint32_t)right.dx);
            y = y_end - 1;
        }
    }
}

/* The highest strip from row y on that is gentle. */
static void choose_strip(const struct ph_triangle *t, int32_t width, uint32_t y, struct strip *strip)
{
    const uint32_t rows = (uint32_t)t->y_bottom - y;
    strip->y = y;
    strip->height_log2 = HEIGHT_LOG2;
    while (strip->height_log2 > 0 && 1u << (strip->height_log2 - 1) >= rows) {
        strip->height_log2--;
    }
    for (;; strip->height_log2--) {
        const uint32_t height = 1u << strip->height_log2;
        strip->y_end = y + (height < rows ? height : rows);
        measure_strip(t, width, strip);
        if (strip->height_log2 == 0 || strip->x >= strip->x_end ||
            is_gentle(t->attribute[0].gy, t->attribute[1].gy, over_w(t)->gy, strip->least_w, strip->height_log2)) {
            return;
        }
    }
}

static uint32_t draw_strip(const struct ph_triangle *t, const struct ph_band *band, const struct strip *strip)
{
    struct surface surface;
    struct over_w ends[2];
    struct tile tile = {(uint32_t)strip->x, strip->y, 0, strip->height_log2};
    uint32_t count = 0;
    if (strip->x < strip->x_end) {
        divide_side(t, &tile, tile.x, &surface, ends);
    }
    for (; (int32_t)tile.x < strip->x_end; tile.x += 1u << tile.width_log2) {
        tile.width_log2 = tile_width(t, &tile, (uint32_t)strip->x_end - tile.x);
        divide_tile(t, &tile, &surface);
        count += draw_tile(t, band, &tile, &surface);
    }
    return count;
}

uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0;
    struct strip strip;
    for (uint32_t y = (uint32_t)t->y_top; y < (uint32_t)t->y_bottom && y < (uint32_t)band->y1; y = strip.y_end) {
        choose_strip(t, band->width, y, &strip);
        if (strip.y_end > (uint32_t)band->y0) {
            count += draw_strip(t, band, &strip);
        }
    }
    return count;
}
