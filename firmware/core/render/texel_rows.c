/*
 * Rows of texels: ph_texture_tile of texture_tile.h draws the usual ones (16-bit depth, full light, up to 65,536
 * texels), draw_run all others. See texel_rows.h.
 */
#include "texel_rows.h"

#include "band.h"
#include "colour.h"
#include "kernels.h"
#include "span.h"

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

void ph_draw_rows_in_pieces(const struct ph_tile_kind *k, struct ph_texel_rows *r)
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

/* ph_texture_tile stops before a row that leaves a clamped texture. */
void ph_draw_plain_rows(const struct ph_tile_kind *k, struct ph_texel_rows *r)
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
