/* ph_texture_small for x86-64, with u and v in one word. See texture_small.h. */
#include "texture_small_plain.h"

#include "texels2.h"

uint32_t ph_texture_small(struct ph_texel_run *r)
{
    if (!texels2_fit(r)) {
        return ph_texture_small_plain(r);
    }
    struct texels2_line b = texels2_line(r);
    const uint64_t mask = (uint64_t)r->v_mask << 48 | r->u_mask << 22;
    uint16_t *depth = r->depth, *pixels = r->pixels;
    uint32_t d = r->d, count = 0;
    do {
        uint32_t left = r->left, right = r->right;
        for (uint32_t rows = r->rows; rows > 0; rows--) {
            const int32_t from = (int32_t)left >> 16, to = (int32_t)right >> 16, n = to - from;
            if (n > 0) {
                struct texels2_walk w = texels2_walk(&b, from, (uint32_t)n);
                w.d = d + (uint32_t)from * r->gd;
                w.gd = r->gd;
                texels2_row(depth + to, pixels + to, (uint32_t)n, w, 4 * b.bend, mask, r->texels);
                count += (uint32_t)n;
            }
            left += r->left_dx;
            right += r->right_dx;
            d += r->d_dy;
            depth = ph_row_below(depth, r->stride_bytes);
            pixels = ph_row_below(pixels, r->stride_bytes);
            texels2_line_down(&b);
        }
        r->left = left;
        r->right = right;
    } while (ph_texel_run_lower(r));
    texels2_line_part(&b, r);
    return count;
}
