/*
 * Textured triangles, perspective-correct, in tiles of up to 32 x 16 pixels.
 *
 * At the four corners of a tile u and v are divided exactly. Between them they follow a surface that is a parabola
 * along each row and each column and is exact in the middle of each side, too: if 1/w goes from w0 to w1 along a side,
 * and u changes by U, then u in its middle lies U (w1 - w0) / (2 (w0 + w1)) beside the straight line. So a pixel and a
 * row cost a few additions. Where 1/w changes much, tiles are smaller. They are not placed by the band,
 * so the picture does not depend on where bands begin. Measured error: tests/core/test_quality.c, test_texture.c.
 *
 * A triangle is cut into strips, rows in which all tiles have one height, a power of two. A strip begins at a row that
 * is a multiple of its height, so bands of a multiple of 16 lines cut no tile. A strip is cut into tiles from left to
 * right. ph_texture_tile of texture_tile.h draws the usual ones (16-bit depth, full light, up to 65,536 texels),
 * draw_run here all others.
 */
#include "texture.h"

#include "colour.h"
#include "kernels.h"
#include "planes.h"
#include "span.h"

enum { WIDTH_LOG2 = 5, HEIGHT_LOG2 = 4 };

_Static_assert(1 << WIDTH_LOG2 == PH_TILE, "texture_tile.h");

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

/* As ph_wire16, of the low 16 bits, in the registers of a CPU that knows REV16. */
static inline uint32_t wire_of(uint32_t v)
{
    return ph_wire16(1) == 1 ? v : (v >> 8 & 255) | v << 8;
}

/* c * light / 32 for all three channels at once. */
static inline uint16_t shade(uint16_t wire, uint32_t light)
{
    const uint32_t fields = 0x07e0f81fu, c = wire_of(wire);
    const uint32_t lit = ((c & 0xffff) | c << 16) & fields, scaled = lit * light >> 5 & fields;
    const uint32_t both = scaled | scaled >> 16;
    return (uint16_t)wire_of(both);
}

/* The texel at u, v; it is clamped or repeated, and lit if the light is not full. */
static inline uint16_t sample(const struct ph_tile_kind *k, uint32_t u, uint32_t v)
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
static inline __attribute__((always_inline)) void draw_run(const struct ph_tile_kind *k, const struct ph_texel_rows *r,
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

/* Apart, because it runs from RAM where flash is slow. */
static __attribute__((noinline)) void draw_other(const struct ph_tile_kind *k, const struct ph_texel_rows *r,
                                                 uint32_t i, uint32_t n, struct ph_piece piece)
{
    if (k->depth24) {
        draw_run(k, r, i, n, piece, true);
    } else {
        draw_run(k, r, i, n, piece, false);
    }
}

/* Steps to the next row. */
static void row_down(const struct ph_tile_kind *k, struct ph_texel_rows *r)
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

/* Draws the n columns from `first` on that lie in the tile, along one piece of the depth. */
static void draw_piece(const struct ph_tile_kind *k, struct ph_texel_rows *r, int32_t first, int32_t n,
                       struct ph_piece piece)
{
    const int32_t columns = (int32_t)r->columns, from = first > 0 ? first : 0;
    const int32_t end = first + n < columns ? first + n : columns;
    if (from < end) {
        piece.d += (uint32_t)(from - first) * piece.gd;
        draw_other(k, r, (uint32_t)from, (uint32_t)(end - from), piece);
        r->count += (uint32_t)(end - from);
    }
}

/* Draws rows whose depth may have several pieces each. r->d and r->gd are in units of the triangle's plane. Pieces
 * begin with the triangle's row, as in all other shadings, not with the tile. */
static void draw_rows_in_pieces(const struct ph_tile_kind *k, struct ph_texel_rows *r)
{
    for (; r->rows > 0; row_down(k, r)) {
        const int32_t left = (int32_t)r->left >> 16, right = (int32_t)r->right >> 16;
        const int32_t end = right < k->end ? right : k->end;
        uint32_t n;
        for (int32_t i = left > k->from ? left : k->from; i < end && i < (int32_t)r->columns; i += (int32_t)n) {
            n = (uint32_t)(end - i);
            const struct ph_piece piece = ph_depth_piece(k->triangle, r->d + (uint32_t)i * r->gd, &n);
            draw_piece(k, r, i, (int32_t)n, piece);
        }
    }
}

/* ---- rows with depth in codes, of a texture of up to 65,536 texels ---- */

/* Texels of a row on their way to be lit. Each row has a code above the last: all of its texels are drawn. */
struct lit_row {
    uint16_t texels[PH_TILE], codes[PH_TILE];
    uint32_t code;
};

/* Copies of u or v for one row, from column i on: without calls, which a copy of a whole struct may cost. */
static inline void set_row_way(struct ph_texel_way *to, const struct ph_texel_way *way, uint32_t i)
{
    to->at = ph_texel_at(way, i);
    to->step = way->step + 2 * i * way->bend;
    to->bend = way->bend;
    to->at_dy = to->step_dy = to->bend_dy = to->at_ddy = to->step_ddy = 0;
}

/* n columns of the next row from column i on, as a row of its own. */
static inline void set_row(struct ph_texel_rows *row, const struct ph_texel_rows *r, uint32_t i, uint32_t n)
{
    row->left = row->left_dx = row->right_dx = row->d_dy = row->stride_bytes = row->count = 0;
    row->right = n << 16;
    row->d = r->d + i * r->gd;
    row->gd = r->gd;
    row->depth = r->depth + i;
    row->pixels = r->pixels + i;
    row->u_mask = r->u_mask;
    row->v_mask = r->v_mask;
    row->texels = r->texels;
    row->columns = n;
    row->rows = 1;
    row->u_outside = row->v_outside = 0;
}

/* Draws a row with little light. */
static void draw_lit_row(struct ph_texel_rows *row, struct lit_row *lit, uint32_t light)
{
    uint16_t *depth = row->depth, *pixel = row->pixels;
    const uint16_t *texel = lit->texels, *const end = texel + row->columns;
    const uint32_t gd = row->gd;
    uint32_t d = row->d;
    row->d = ++lit->code << 16;
    row->gd = 0;
    row->depth = lit->codes;
    row->pixels = lit->texels;
    ph_texture_tile(row);
    for (; texel < end; d += gd, texel++, depth++, pixel++) {
        if (ph_nearer16(depth, d)) {
            PH_KEEP_BRANCH();
            *pixel = shade(*texel, light);
        }
    }
}

/* On which side of a clamped texture u or v lies in column i: -1, 1; 0: inside, by as much as pairs of pixels may err.
 */
static inline int side_of(const struct ph_texel_way *way, uint32_t outside, uint32_t i)
{
    const uint32_t at = ph_texel_at(way, i), margin = fx_magnitude((int32_t)way->bend);
    return (int32_t)(at - margin) < 0 ? -1 : ((at + margin) & outside) != 0;
}

/* Returns how many of the first n columns lie on the same side as column 0. Outside u or v becomes that of the
 * texture's border. */
static uint32_t clamp_way(struct ph_texel_way *way, uint32_t outside, uint32_t n)
{
    const int side = side_of(way, outside, 0);
    if (side_of(way, outside, n - 1) != side) {
        uint32_t same = 0, other = n - 1;
        while (other - same > 1) {
            const uint32_t middle = (same + other) / 2;
            if (side_of(way, outside, middle) == side) {
                same = middle;
            } else {
                other = middle;
            }
        }
        n = other;
    }
    if (side != 0) {
        way->at = side < 0 ? 0 : ~outside;
        way->step = way->bend = 0;
    }
    return n;
}

/* Draws the next row, which has little light or leaves a clamped texture. */
static void draw_rare_row(const struct ph_tile_kind *k, struct ph_texel_rows *r, struct lit_row *lit)
{
    uint32_t i, left, n;
    if (!ph_tile_columns(r->left, r->right, r->columns, &i, &left)) {
        return;
    }
    r->count += left;
    for (; left > 0; i += n, left -= n) {
        struct ph_texel_rows row;
        n = left;
        set_row_way(&row.u, &r->u, i);
        set_row_way(&row.v, &r->v, i);
        if (r->u_outside != 0) {
            n = clamp_way(&row.u, r->u_outside, n);
            n = clamp_way(&row.v, r->v_outside, n);
        }
        set_row(&row, r, i, n);
        if (k->light < 32) {
            draw_lit_row(&row, lit, k->light);
        } else {
            ph_texture_tile(&row);
        }
    }
}

/* Draws rows. ph_texture_tile stops before a row that leaves a clamped texture. */
static void draw_plain_rows(const struct ph_tile_kind *k, struct ph_texel_rows *r)
{
    struct lit_row lit;
    lit.code = 0;
    if (k->light < 32) {
        ph_fill(lit.codes, 0, PH_TILE);
    }
    while (r->rows > 0) {
        if (k->light >= 32) {
            ph_texture_tile(r);
        }
        if (r->rows > 0) {
            draw_rare_row(k, r, &lit);
            row_down(k, r);
        }
    }
}

/* u or v of a small triangle, n rows below the row from which they count. */
static inline void set_small_line(struct ph_texel_line *line, const struct ph_plane *linear,
                                  const struct ph_curve *curve, uint32_t n)
{
    const uint32_t rise = n * curve->yy;
    line->at = linear->base + n * (linear->gy + rise);
    line->step = linear->gx + n * curve->xy;
    line->at_dy = linear->gy + 2 * rise + curve->yy;
    line->step_dy = curve->xy;
    line->at_ddy = 2 * curve->yy;
    line->bend = curve->xx;
}

/* The same as a tile has it, from PH_TILE columns further left on. */
static struct ph_texel_way way_of(const struct ph_texel_line *line)
{
    return (struct ph_texel_way){.at = line->at - PH_TILE * (line->step - PH_TILE * line->bend),
                                 .step = line->step - 2 * PH_TILE * line->bend,
                                 .bend = line->bend,
                                 .at_dy = line->at_dy - PH_TILE * line->step_dy,
                                 .step_dy = line->step_dy,
                                 .at_ddy = line->at_ddy};
}

/* The same for what ph_texture_small cannot draw: a clamped texture, or little light. */
static FX_APART void begin_unusual(struct ph_small_texels *s, const struct ph_triangle *t)
{
    const struct ph_texture *const texture = t->material->texture;
    const int width = texture->log2_width, height = texture->log2_height;
    const bool clamp = texture->wrap == PH_WRAP_CLAMP;
    struct ph_texel_rows *const r = &s->rows;
    s->kind = (struct ph_tile_kind){.triangle = t,
                                    .texels = texture->texels,
                                    .u_mask = s->run.u_mask,
                                    .v_mask = (1u << height) - 1,
                                    .log2_width = (uint32_t)width,
                                    .u_down = 22,
                                    .v_down = 16 + width,
                                    .light = t->colour,
                                    .clamp = clamp,
                                    .plain = true};
    r->texels = texture->texels;
    r->u_mask = s->run.u_mask;
    r->v_mask = s->run.v_mask;
    r->u_outside = clamp ? UINT32_MAX << width << 22 : 0;
    r->v_outside = clamp ? UINT32_MAX << (width + height) << 16 : 0;
    r->stride_bytes = s->run.stride_bytes;
    r->columns = 2 * PH_TILE - 1;
}

/* Sets u, v and the texture; y: the first row that is drawn. */
static inline void begin_run(struct ph_texel_run *r, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes)
{
    const struct ph_texture *const texture = t->material->texture;
    const struct ph_plane u = {t->small.light, t->small.glight, t->small.light_dy};
    const uint32_t below = (uint32_t)(y - t->y_top - t->range_log2 + 1);
    r->texels = texture->texels;
    r->u_mask = (1u << texture->log2_width) - 1;
    r->v_mask = ((1u << texture->log2_height) - 1) << texture->log2_width;
    r->stride_bytes = stride_bytes;
    r->x = (uint32_t)t->y_mid;
    set_small_line(&r->u, &u, &t->curves[0], below);
    set_small_line(&r->v, &t->v, &t->curves[1], below);
}

void ph_small_texels_begin(struct ph_small_texels *s, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes)
{
    begin_run(&s->run, t, y, stride_bytes);
    s->usual = ph_texels_are_usual(t);
    if (!s->usual) {
        begin_unusual(s, t);
    }
}

uint32_t ph_draw_small_texels(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct ph_small_triangle *const s = &t->small;
    const int32_t y = t->y_top > band->y0 ? t->y_top : band->y0;
    const uint32_t above = (uint32_t)(y - t->y_top), rows = (uint32_t)(band->y1 - y), x = (uint32_t)t->y_mid;
    const uint32_t at = (uint32_t)(y - band->y0) * (uint32_t)band->width + x;
    struct ph_texel_run r;
    begin_run(&r, t, y, 2 * (uint32_t)band->width);
    r.left_dx = s->left_dx;
    r.right_dx = s->right_dx;
    r.left = s->left - (x << 16) + above * r.left_dx;
    r.right = s->right - (x << 16) + above * r.right_dx;
    r.lower_is_right = s->lower_is_right;
    r.lower_x = (uint32_t)s->lower.x - (x << 16);
    r.lower_dx = (uint32_t)s->lower.dx;
    r.lower_rows = s->lower_rows;
    r.rows = s->upper_rows - above;
    if ((int32_t)r.rows <= 0) { /* it begins below the upper rows */
        r.lower_x -= r.rows * r.lower_dx;
        r.lower_rows += r.rows;
        ph_texel_run_lower(&r);
    }
    if (r.rows + r.lower_rows > rows) {
        r.rows = r.rows < rows ? r.rows : rows;
        r.lower_rows = rows - r.rows;
    }
    r.gd = s->gd;
    r.d_dy = s->d_dy;
    r.d = s->d + x * r.gd + above * r.d_dy;
    r.depth = (uint16_t *)band->depth + at;
    r.pixels = band->pixels + at;
    return ph_texture_small(&r);
}

/* Draws the rows of a run that ph_texture_small cannot draw. Columns of a tile are not negative: they count from
 * PH_TILE columns further left. */
static FX_APART uint32_t draw_unusual(struct ph_small_texels *s)
{
    struct ph_texel_run *const run = &s->run;
    struct ph_texel_rows *const r = &s->rows;
    r->count = 0;
    r->depth = run->depth - PH_TILE;
    r->pixels = run->pixels - PH_TILE;
    r->d = run->d - PH_TILE * run->gd;
    r->d_dy = run->d_dy;
    r->gd = run->gd;
    r->u = way_of(&run->u);
    r->v = way_of(&run->v);
    do {
        const uint32_t rows = run->rows;
        r->left = run->left + ((uint32_t)PH_TILE << 16);
        r->right = run->right + ((uint32_t)PH_TILE << 16);
        r->left_dx = run->left_dx;
        r->right_dx = run->right_dx;
        r->rows = rows;
        draw_plain_rows(&s->kind, r);
        run->left += rows * run->left_dx;
        run->right += rows * run->right_dx;
        for (uint32_t i = 0; i < rows; i++) {
            ph_texel_line_down(&run->u);
            ph_texel_line_down(&run->v);
        }
    } while (ph_texel_run_lower(run));
    return r->count;
}

static uint32_t draw_run_of(struct ph_small_texels *s)
{
    return s->usual ? ph_texture_small(&s->run) : draw_unusual(s);
}

uint32_t ph_small_texels_draw(struct ph_small_texels *s, const struct ph_small_triangle *small, uint16_t *depth,
                              uint16_t *pixels)
{
    struct ph_texel_run *const r = &s->run;
    r->left = small->left - (r->x << 16);
    r->right = small->right - (r->x << 16);
    r->d = small->d + r->x * small->gd;
    r->left_dx = small->left_dx;
    r->right_dx = small->right_dx;
    r->d_dy = small->d_dy;
    r->gd = small->gd;
    r->depth = depth + r->x;
    r->pixels = pixels + r->x;
    r->rows = small->upper_rows;
    r->lower_rows = small->lower_rows;
    r->lower_is_right = small->lower_is_right;
    r->lower_x = (uint32_t)small->lower.x - (r->x << 16);
    r->lower_dx = (uint32_t)small->lower.dx;
    return draw_run_of(s);
}

void ph_small_texels_piece(struct ph_small_texels *s, const struct ph_row_piece *piece, uint16_t *depth,
                           uint16_t *pixels)
{
    struct ph_texel_run *const r = &s->run;
    const uint32_t x = piece->x - r->x;
    const struct ph_texel_line u = r->u, v = r->v;
    r->left = x << 16;
    r->right = (x + piece->n) << 16;
    r->d = piece->d - x * piece->gd;
    r->gd = piece->gd;
    r->depth = depth + r->x;
    r->pixels = pixels + r->x;
    r->rows = 1;
    r->lower_rows = 0;
    draw_run_of(s);
    if (!piece->last) {
        r->u = u;
        r->v = v;
    }
}

/* Depth of a tile that crosses octaves. Codes and border are stepped from its first row, whatever the band. */
struct tile_depth {
    uint32_t d, d_dy;            /* of its first row, in units of the triangle's plane */
    struct ph_octave octaves[2]; /* the far and the near one, or twice the only one */
};

/* Draws rows in one octave; the first of them is row `row` of the tile. */
static void draw_rows_in_octave(const struct ph_tile_kind *k, struct ph_texel_rows *r, const struct tile_depth *depth,
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

/* The first of the columns i + 1 .. i + n - 1 of a row that is on the other side of the octaves' border than column i,
 * from a guess. d, gd: depth at column 0 and per column. */
static uint32_t border_column(uint32_t d, uint32_t gd, uint32_t border, bool near, uint32_t i, uint32_t n,
                              int32_t guess)
{
    uint32_t x = guess <= (int32_t)i ? i + 1 : guess >= (int32_t)(i + n) ? i + n - 1 : (uint32_t)guess;
    while (x < i + n - 1 && (d + x * gd >= border) == near) {
        x++;
    }
    while (x > i + 1 && (d + (x - 1) * gd >= border) != near) {
        x--;
    }
    return x;
}

/* For how many of n rows the edge is the border to the pixel. If it is not in the first row, it is put right there. */
static uint32_t rows_at_border(const struct ph_texel_rows *r, uint32_t border, bool near, struct ph_edge *edge,
                               uint32_t n)
{
    uint32_t left = r->left, right = r->right, d = r->d;
    for (uint32_t row = 0; row < n; row++) {
        uint32_t i, pixels;
        const int32_t guess = (int32_t)((uint32_t)edge->x + row * (uint32_t)edge->dx) >> 16;
        ph_tile_columns(left, right, r->columns, &i, &pixels);
        const uint32_t x = border_column(d, r->gd, border, near, i, pixels, guess);
        if ((int32_t)x != guess) {
            edge->x = row > 0 ? edge->x : (int32_t)(x << 16);
            return row > 0 ? row : 1;
        }
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* Draws rows that have a near and a far octave in them, from row `row` of the tile on. */
static void draw_rows_in_two(const struct ph_tile_kind *k, struct ph_texel_rows *r, const struct tile_depth *depth,
                             uint32_t row)
{
    const uint32_t bottom = depth->octaves[1].bottom, way = bottom - depth->d;
    uint32_t n;
    for (uint32_t rows = r->rows; rows > 0; rows -= n, row += n) {
        bool near[2] = {false, false};
        r->rows = rows;
        r->rows = n = rows_alike(r, bottom, near);
        if (near[0] == near[1]) {
            draw_rows_in_octave(k, r, depth, near[0], row);
            continue;
        }
        struct ph_edge border = {0, 0};
        if (fx_magnitude((int32_t)r->gd) > fx_magnitude((int32_t)way) >> 29) { /* else it is almost a row */
            border = border_edge(depth, r->gd, row);
        }
        r->rows = n = rows_at_border(r, bottom, near[0], &border, n);
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
static void set_texels(struct ph_tile_kind *k, const struct tile *tile, const struct surface *s,
                       struct ph_texel_rows *r)
{
    const struct ph_triangle *const t = k->triangle;
    const struct ph_texture *const texture = t->material->texture;
    const int width = texture->log2_width, height = texture->log2_height, range = t->range_log2;
    k->from = -(int32_t)tile->x;
    k->texels = r->texels = texture->texels;
    k->u_mask = r->u_mask = (1u << width) - 1;
    k->v_mask = (1u << height) - 1;
    k->log2_width = texture->log2_width;
    k->clamp = texture->wrap == PH_WRAP_CLAMP && !is_inside(t, s);
    k->plain = !k->depth24 && t->block != PH_BLOCK_LINEAR && width + height <= 16 &&
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
static void draw_half(const struct ph_tile_kind *k, const struct ph_band *rows, int half, const struct tile *tile,
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
    } else if (!k->plain || ((t->depth.base | t->depth.gx | t->depth.gy) & 7) != 0 || !tile_depth(t, tile, &depth)) {
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
    const int32_t top = y > t->y_top ? y : t->y_top;
    const struct ph_band rows = {NULL, NULL, false, top > band->y0 ? top : band->y0, y1 < band->y1 ? y1 : band->y1, 0};
    const uint32_t width = (uint32_t)band->width, left = width - tile->x, columns = 1u << tile->width_log2;
    const uint32_t at = (uint32_t)(rows.y0 - band->y0) * width + tile->x;
    struct ph_tile_kind k = {.triangle = t, .light = t->colour, .depth24 = band->depth24};
    struct ph_texel_rows r;
    r.depth = ph_depth_from(band->depth, at, band->depth24);
    r.pixels = band->pixels + at;
    r.stride_bytes = 2 * width;
    k.end = (int32_t)left;
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

/* The highest strip from row y of the triangle on that is gentle. */
static void choose_strip(const struct ph_triangle *t, int32_t width, uint32_t y, struct strip *strip)
{
    strip->height_log2 = HEIGHT_LOG2;
    while (strip->height_log2 > 0 && (y ^ ((uint32_t)t->y_bottom - 1)) >> (strip->height_log2 - 1) == 0) {
        strip->height_log2--;
    }
    for (;; strip->height_log2--) {
        const uint32_t height = 1u << strip->height_log2;
        strip->y = y & (0u - height);
        strip->y_end = strip->y + height;
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
    const uint32_t top = (uint32_t)t->y_top, above = (uint32_t)band->y0 & (0u - (1u << HEIGHT_LOG2));
    uint32_t count = 0;
    struct strip strip;
    for (uint32_t y = top > above ? top : above; y < (uint32_t)t->y_bottom && y < (uint32_t)band->y1; y = strip.y_end) {
        choose_strip(t, band->width, y, &strip);
        if (strip.y_end > (uint32_t)band->y0) {
            count += draw_strip(t, band, &strip);
        }
    }
    return count;
}
