/*
 * Rows of texels: ph_texture_tile of texture_tile.h and the kernels of texel_row.h draw those with 16-bit depth codes,
 * draw_other all others. See texel_rows.h.
 */
/* Kits on armv6m: -O2. */
#include "texel_rows.h"

#include "band.h"
#include "span.h"
#include "texel_light.h"
#include "texel_mix.h"

/* Apart: the loop over pixels has no registers left for it. */
PH_TIER(scenery) static FX_APART uint16_t shade(uint16_t texel, uint32_t light)
{
    return ph_mix_in_light(texel, light);
}

/* Light in 32nds, from 2^-24. Planes may err by a little beyond the corners. */
static inline uint32_t light_of(uint32_t light)
{
    return (int32_t)light < 0 ? 0 : light >> 30 != 0 ? 63 : light >> 24;
}

/* The texel at u, v in its light, or filtered. */
static PH_NOINLINE uint16_t sample_lit_or_smooth(const struct ph_tile_kind *k, uint32_t u, uint32_t v, uint32_t light)
{
    const uint16_t texel =
        k->texel != NULL ? k->texel(k, u, v) : ph_texel_in(k, (int32_t)u >> k->u_down, (int32_t)v >> k->v_down);
    return k->lighting != NULL ? shade(texel, light_of(light)) : texel;
}

/* Draws n pixels from column i of the tile on, along one piece of the depth, where ph_texture_tile cannot. */
PH_TIER(scenery)
static PH_NOINLINE void draw_other(const struct ph_tile_kind *k, const struct ph_tile_rows *r, uint32_t i, uint32_t n,
                                   struct ph_piece piece)
{
    const uint32_t ddu = 2 * r->u.bend, ddv = 2 * r->v.bend;
    uint32_t u = ph_texel_at(&r->u, i), du = r->u.step + i * ddu + r->u.bend;
    uint32_t v = ph_texel_at(&r->v, i), dv = r->v.step + i * ddv + r->v.bend;
    const bool lit_or_filtered = k->lit_or_filtered, depth24 = k->depth24;
    const bool linear = k->triangle->block == PH_BLOCK_LINEAR;
    const struct ph_depth *const plane = &k->triangle->as.large.depth;
    uint16_t *pixel = r->row.pixels + i;
    void *depth = ph_depth_from(r->row.depth, i, depth24);
    for (; n > 0; n--) {
        const uint32_t d = linear ? ph_depth_linear(&plane->over_w.linear, piece.d) : piece.d;
        if (depth24 ? ph_nearer24(depth, d) : ph_nearer16(depth, d)) {
            *pixel =
                lit_or_filtered
                    ? sample_lit_or_smooth(k, u, v, r->row.light + (uint32_t)(pixel - r->row.pixels) * r->row.glight)
                    : ph_texel_in(k, (int32_t)u >> k->u_down, (int32_t)v >> k->v_down);
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

/* Steps to the next row. */
PH_TIER(scenery) static void row_down(const struct ph_tile_kind *k, struct ph_tile_rows *r)
{
    r->row.left += r->row.left_dx;
    r->row.right += r->row.right_dx;
    r->row.d += r->row.d_dy;
    r->row.light += r->row.light_dy;
    ph_texel_way_down(&r->u);
    ph_texel_way_down(&r->v);
    r->row.depth += k->depth24 ? r->row.stride_bytes : r->row.stride_bytes / 2;
    r->row.pixels += r->row.stride_bytes / 2;
    r->row.rows--;
}

/* Draws the n columns from `first` on that lie in the tile, along one piece of the depth. */
PH_TIER(few)
static void draw_piece(const struct ph_tile_kind *k, struct ph_tile_rows *r, int32_t first, int32_t n,
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

PH_TIER(few) void ph_draw_rows_in_pieces(const struct ph_tile_kind *k, struct ph_tile_rows *r)
{
    for (; r->row.rows > 0; row_down(k, r)) {
        const int32_t left = (int32_t)r->row.left >> 16, right = (int32_t)r->row.right >> 16;
        const int32_t end = right < k->end ? right : k->end;
        uint32_t n;
        for (int32_t i = left > k->from ? left : k->from; i < end && i < (int32_t)r->columns; i += (int32_t)n) {
            n = (uint32_t)(end - i);
            const struct ph_piece piece = ph_depth_piece(k->triangle, r->row.d + (uint32_t)i * r->row.gd, &n);
            draw_piece(k, r, i, (int32_t)n, piece);
        }
    }
}

/* ---- rows with depth in codes ---- */

/* A row before it is handed to a kernel. */
struct general_row {
    struct ph_texel_row texels;
    struct ph_texel_way u, v;
};

/* Copies u or v for one row, from column i on. It copies member by member, because gcc calls memcpy for a whole
 * struct. */
static inline void set_row_way(struct ph_texel_way *to, const struct ph_texel_way *way, uint32_t i)
{
    to->at = ph_texel_at(way, i);
    to->step = way->step + 2 * i * way->bend;
    to->bend = way->bend;
}

/* Sets the light of a row. Returns the most, in 32nds. */
static inline uint32_t set_row_light(const struct ph_texel_lighting *lighting, struct ph_texel_row *row, uint32_t light,
                                     uint32_t glight)
{
    const uint32_t n = row->n, more = (n - 1) & 3; /* of the first four, behind the first */
    if (glight == 0) {
        row->level = light_of(light);
        row->light = light;
        row->light_step = 0;
        return row->level;
    }
    if (((light | (light + (n - 1) * glight)) >> 30) != 0) {
        lighting->clamp_light(&light, &glight, n);
    }
    const uint32_t half = (uint32_t)((int32_t)glight >> 1), last = light + (n - 1) * glight;
    row->level = (light + more * half) >> 24;
    row->light = light + (more + 2) * glight + half;
    row->light_step = 4 * glight;
    return (light > last ? light : last) >> 24;
}

/* Where u or v lies outside a clamped texture: `bits` that it has there, and how far before that the last texel begins
 * for a filter. */
struct border {
    uint32_t bits, before;
};

/* On which side of a clamped texture u or v lies in column i: -1, 1; 0: inside, by as much as pairs of pixels may err.
 */
static inline int side_of(const struct ph_texel_way *way, const struct border *b, uint32_t i)
{
    const uint32_t at = ph_texel_at(way, i), margin = fx_magnitude((int32_t)way->bend);
    return (int32_t)(at - margin) < 0 ? -1 : ((at + margin + b->before) & b->bits) != 0;
}

/* Returns how many of the first n columns lie on the same side as column 0. Outside u or v becomes that of the
 * texture's border. */
PH_TIER(seldom) static uint32_t clamp_way(struct ph_texel_way *way, const struct border *b, uint32_t n)
{
    const int side = side_of(way, b, 0);
    if (side_of(way, b, n - 1) != side) {
        uint32_t same = 0, other = n - 1;
        while (other - same > 1) {
            const uint32_t middle = (same + other) / 2;
            if (side_of(way, b, middle) == side) {
                same = middle;
            } else {
                other = middle;
            }
        }
        n = other;
    }
    if (side != 0) {
        way->at = side < 0 ? 0 : ~b->bits - b->before;
        way->step = way->bend = 0;
    }
    return n;
}

void ph_draw_texel_row(const struct ph_tile_kind *k, struct ph_texel_row *row, uint32_t light, uint32_t glight)
{
    if (k->lighting != NULL && set_row_light(k->lighting, row, light, glight) > 32) {
        k->lighting->draw_shining_row(row, k->filter);
    } else {
        ph_texel_row_kernel *const draw_row = ph_row_kernel(k->filter, k->lighting);
        draw_row(row);
    }
}

/* Draws the next row, which is lit or filtered, or leaves a clamped texture. */
PH_TIER(scenery) static void draw_general_row(const struct ph_tile_kind *k, struct ph_tile_rows *r)
{
    const struct border u_border = {r->u_outside, k->filter != NULL ? (uint32_t)1 << k->u_down : 0};
    const struct border v_border = {r->v_outside, k->filter != NULL ? (uint32_t)1 << k->v_down : 0};
    struct general_row row;
    uint32_t i, left, n;
    if (!ph_tile_columns(r->row.left, r->row.right, r->columns, &i, &left)) {
        return;
    }
    row.texels.gd = r->row.gd;
    row.texels.u_mask = r->row.u_mask;
    row.texels.v_mask = r->row.v_mask;
    row.texels.texels = r->row.texels;
    r->count += left;
    for (; left > 0; i += n, left -= n) {
        n = left;
        set_row_way(&row.u, &r->u, i);
        set_row_way(&row.v, &r->v, i);
        if (k->filter != NULL) {
            row.u.at -= u_border.before >> 1;
            row.v.at -= v_border.before >> 1;
        }
        if (r->u_outside != 0) {
            n = clamp_way(&row.u, &u_border, n);
        }
        if (r->v_outside != 0) {
            n = clamp_way(&row.v, &v_border, n);
        }
        row.texels.depth = r->row.depth + i;
        row.texels.pixels = r->row.pixels + i;
        row.texels.n = n;
        row.texels.d = r->row.d + i * r->row.gd;
        row.texels.u = ph_texel_walk_from(row.u.at, row.u.step, row.u.bend, 0, n);
        row.texels.v = ph_texel_walk_from(row.v.at, row.v.step, row.v.bend, 0, n);
        ph_draw_texel_row(k, &row.texels, r->row.light + i * r->row.glight, r->row.glight);
    }
}

/* ph_texture_tile stops before a row that leaves a clamped texture. */
PH_TIER(scenery) void ph_draw_fast_rows(const struct ph_tile_kind *k, struct ph_tile_rows *r)
{
    while (r->row.rows > 0) {
        if (!k->lit_or_filtered) {
            ph_texture_tile(r);
        }
        if (r->row.rows > 0) {
            draw_general_row(k, r);
            row_down(k, r);
        }
    }
}
