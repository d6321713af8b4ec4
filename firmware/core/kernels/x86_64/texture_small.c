/* ph_texture_small for x86-64, with u and v in one word. See texture_small.h. */
#include "texture_small_plain.h"

#include "texels2.h"

/* Whether u, over 32 columns and 32 rows to all sides, stays below 2^31 and never wraps. */
static bool fits_both(const struct ph_texel_run *r)
{
    const struct ph_texel_line *const u = &r->u;
    return r->rows + r->lower_rows <= 32 && r->u_mask < 512 && texels2_below(u->at, 29) && texels2_below(u->step, 24) &&
           texels2_below(u->bend, 17) && texels2_below(u->at_dy, 24) && texels2_below(u->step_dy, 17) &&
           texels2_below(u->at_ddy, 18);
}

/* All coefficients as 2^32 v + u, so that one operation serves both. */
struct both {
    uint64_t at, step, at_dy, step_dy, at_ddy, bend;
};

uint32_t ph_texture_small(struct ph_texel_run *r)
{
    if (!fits_both(r)) {
        return ph_texture_small_plain(r);
    }
    struct both b = {texels2(r->u.at, r->v.at) + TEXELS2_SIGN, texels2(r->u.step, r->v.step),
                     texels2(r->u.at_dy, r->v.at_dy),          texels2(r->u.step_dy, r->v.step_dy),
                     texels2(r->u.at_ddy, r->v.at_ddy),        texels2(r->u.bend, r->v.bend)};
    const uint64_t mask = (uint64_t)r->v_mask << 48 | r->u_mask << 22;
    uint16_t *depth = r->depth, *pixels = r->pixels;
    uint32_t d = r->d, count = 0;
    do {
        uint32_t left = r->left, right = r->right;
        for (uint32_t rows = r->rows; rows > 0; rows--) {
            const int32_t from = (int32_t)left >> 16, to = (int32_t)right >> 16, n = to - from;
            if (n > 0) {
                const uint64_t first = (uint64_t)(int64_t)from, pair = 2 * (first + 1 - (n & 1));
                const struct texels2_walk w = {b.at + first * (b.step + first * b.bend), b.step + pair * b.bend,
                                               d + (uint32_t)from * r->gd, r->gd};
                texels2_row(depth + to, pixels + to, (uint32_t)n, w, 4 * b.bend, mask, r->texels);
                count += (uint32_t)n;
            }
            left += r->left_dx;
            right += r->right_dx;
            d += r->d_dy;
            depth = ph_row_below(depth, r->stride_bytes);
            pixels = ph_row_below(pixels, r->stride_bytes);
            b.at += b.at_dy;
            b.step += b.step_dy;
            b.at_dy += b.at_ddy;
        }
        r->left = left;
        r->right = right;
    } while (ph_texel_run_lower(r));
    texels2_part(b.at - TEXELS2_SIGN, &r->u.at, &r->v.at);
    texels2_part(b.step, &r->u.step, &r->v.step);
    texels2_part(b.at_dy, &r->u.at_dy, &r->v.at_dy);
    return count;
}
