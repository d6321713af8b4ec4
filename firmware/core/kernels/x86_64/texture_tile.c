/* ph_texture_tile for x86-64, with u and v in one word. See texture_tile.h. */
#include "texture_tile_plain.h"

#include "texels2.h"

/* All coefficients as 2^32 v + u, so that one operation serves both. */
struct both {
    uint64_t at, step, bend, at_dy, step_dy, bend_dy, at_ddy, step_ddy;
};

/* Whether u, over 32 columns and 16 rows, stays below 2^31 and never wraps. */
static bool fits_both(const struct ph_texel_rows *r)
{
    const struct ph_texel_way *const u = &r->u;
    return r->rows <= 16 && r->u_mask < 512 && texels2_below(u->at, 30) && texels2_below(u->step, 23) &&
           texels2_below(u->bend, 17) && texels2_below(u->at_dy, 24) && texels2_below(u->step_dy, 18) &&
           texels2_below(u->bend_dy, 13) && texels2_below(u->at_ddy, 19) && texels2_below(u->step_ddy, 14);
}

static void draw_rows(struct ph_texel_rows *r)
{
    struct both b = {texels2(r->u.at, r->v.at) + TEXELS2_SIGN,
                     texels2(r->u.step, r->v.step),
                     texels2(r->u.bend, r->v.bend),
                     texels2(r->u.at_dy, r->v.at_dy),
                     texels2(r->u.step_dy, r->v.step_dy),
                     texels2(r->u.bend_dy, r->v.bend_dy),
                     texels2(r->u.at_ddy, r->v.at_ddy),
                     texels2(r->u.step_ddy, r->v.step_ddy)};
    const uint64_t mask = (uint64_t)r->v_mask << 48 | r->u_mask << 22;
    const uint64_t outside = (uint64_t)r->v_outside << 32 | r->u_outside;
    while (r->rows > 0) {
        __asm__ volatile("" : : : "memory"); /* the state does not fit the registers: keep all of it in memory */
        struct ph_row_run row;
        if (ph_next_row(r, &row)) {
            const uint64_t first = b.at + row.first * (b.step + row.first * b.bend), i = row.first + row.n - 1;
            if (outside != 0 &&
                (((first ^ TEXELS2_SIGN) | ((b.at + i * (b.step + i * b.bend)) ^ TEXELS2_SIGN)) & outside) != 0) {
                break;
            }
            const struct texels2_walk w = {first, b.step + (uint64_t)row.pair * b.bend, r->d + row.first * r->gd,
                                           r->gd};
            texels2_row(r->depth + row.first + row.n, r->pixels + row.first + row.n, row.n, w, 4 * b.bend, mask,
                        r->texels);
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
    texels2_part(b.step, &r->u.step, &r->v.step);
    texels2_part(b.bend, &r->u.bend, &r->v.bend);
    texels2_part(b.at_dy, &r->u.at_dy, &r->v.at_dy);
    texels2_part(b.step_dy, &r->u.step_dy, &r->v.step_dy);
}

void ph_texture_tile(struct ph_texel_rows *r)
{
    if (fits_both(r)) {
        draw_rows(r);
    } else {
        ph_texture_tile_plain(r);
    }
}
