/* ph_texture_tile for x86-64, with u and v in one word. See texture_tile.h. */
#include "texture_tile_portable.h"

#include "texels2_row.h"

/* All coefficients as 2^32 v + u, so that one operation serves both. */
struct both {
    uint64_t at, step, bend, at_dy, step_dy, bend_dy, at_ddy, step_ddy;
};

/* u at the first column, as near to 0 as can be where the texture repeats. */
static uint32_t least_u(const struct ph_tile_rows *r)
{
    const uint32_t period = (r->row.u_mask + 1) << 22;
    return r->u_outside == 0 ? ((r->u.at + period / 2) & (period - 1)) - period / 2 : r->u.at;
}

/* Whether u, over 64 columns and 16 rows, stays below 2^31 and never wraps; at: least_u. */
static bool fits_both(const struct ph_tile_rows *r, uint32_t at)
{
    const struct ph_texel_way *const u = &r->u;
    return r->row.rows <= 16 && r->row.u_mask < 512 && texels2_below(at, 29) && texels2_below(u->step, 23) &&
           texels2_below(u->bend, 16) && texels2_below(u->at_dy, 23) && texels2_below(u->step_dy, 18) &&
           texels2_below(u->bend_dy, 12) && texels2_below(u->at_ddy, 19) && texels2_below(u->step_ddy, 14);
}

/* Draws the n pixels before `end`: 32 at a time, the others first. */
static inline __attribute__((always_inline)) void draw_row(const struct texels2_common *t, uint16_t *end, uint64_t n,
                                                           struct texels2_walk *w, unsigned v_down)
{
    for (uint64_t left = n, part; left > 0; left -= part) {
        part = (left - 1) % 32 + 1;
        texels2_row(t, end - left + part, part, w, v_down);
    }
}

/* v_down: a constant, as in texels2_down. */
static inline __attribute__((always_inline)) void draw_rows(struct ph_tile_rows *r, uint32_t at, unsigned v_down)
{
    const uint32_t further = r->u.at - at;
    struct both b = {texels2(at, r->v.at) + TEXELS2_SIGN, texels2(r->u.step, r->v.step),
                     texels2(r->u.bend, r->v.bend),       texels2(r->u.at_dy, r->v.at_dy),
                     texels2(r->u.step_dy, r->v.step_dy), texels2(r->u.bend_dy, r->v.bend_dy),
                     texels2(r->u.at_ddy, r->v.at_ddy),   texels2(r->u.step_ddy, r->v.step_ddy)};
    struct texels2_common t = texels2_common_of(r->row.texels, r->row.u_mask, r->row.v_mask, r->row.depth,
                                                r->row.pixels, r->row.gd, b.bend, v_down);
    const uint64_t outside = (uint64_t)r->v_outside << 32 | r->u_outside;
    while (r->row.rows > 0) {
        __asm__ volatile("" : : : "memory"); /* the state does not fit the registers: keep all of it in memory */
        struct ph_row_run row;
        if (ph_next_row(r, &row)) {
            const uint64_t first = b.at + row.first * (b.step + row.first * b.bend), i = row.first + row.n - 1;
            const uint64_t last = b.at + i * (b.step + i * b.bend) + (i - row.first) % 2 * b.bend; /* as it is drawn */
            if (outside != 0 && (((first ^ TEXELS2_SIGN) | (last ^ TEXELS2_SIGN)) & outside) != 0) {
                break;
            }
            struct texels2_walk w = {first, b.step + (uint64_t)row.pair * b.bend,
                                     _mm_cvtsi32_si128((int)(r->row.d + (row.first - 1) * r->row.gd))};
            t.bend = 4 * b.bend;
            draw_row(&t, r->row.depth + row.first + row.n, row.n, &w, v_down);
            r->count += row.n;
        }
        ph_row_down(r);
        b.at += b.at_dy;
        b.step += b.step_dy;
        b.bend += b.bend_dy;
        b.at_dy += b.at_ddy;
        b.step_dy += b.step_ddy;
    }
    texels2_part(b.at - TEXELS2_SIGN, &r->u.at, &r->v.at);
    r->u.at += further;
    texels2_part(b.step, &r->u.step, &r->v.step);
    texels2_part(b.bend, &r->u.bend, &r->v.bend);
    texels2_part(b.at_dy, &r->u.at_dy, &r->v.at_dy);
    texels2_part(b.step_dy, &r->u.step_dy, &r->v.step_dy);
}

void ph_texture_tile(struct ph_tile_rows *r)
{
    const uint32_t at = least_u(r);
    if (!fits_both(r, at)) {
        ph_texture_tile_portable(r);
    } else if (texels2_down(r->row.v_mask) == TEXELS2_SMALL) {
        draw_rows(r, at, TEXELS2_SMALL);
    } else {
        draw_rows(r, at, TEXELS2_LARGE);
    }
}
