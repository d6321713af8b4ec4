/* texture_small_portable: ph_texture_small of texture_small.h in portable C, for a CPU without a form of its own, and
 * for the triangles that such a form cannot take. */
#ifndef PH_TEXTURE_SMALL_PORTABLE_H
#define PH_TEXTURE_SMALL_PORTABLE_H

#include "texel_row_portable.h"
#include "texture_small.h"

/* Draws n pixels of a row from column `from` on, where the depth is d; gd: its step. */
static inline void ph_draw_texel_line(const struct ph_texel_run *r, uint32_t from, uint32_t n, uint32_t d, uint32_t gd)
{
    const struct ph_texel_row pixels = {
        .depth = r->row.depth + (int32_t)from,
        .pixels = r->row.pixels + (int32_t)from,
        .n = n,
        .d = d,
        .gd = gd,
        .u = ph_texel_walk_from(r->u.at, r->u.step, r->u.bend, from, n),
        .v = ph_texel_walk_from(r->v.at, r->v.step, r->v.bend, from, n),
        .u_mask = r->row.u_mask,
        .v_mask = r->row.v_mask,
        .texels = r->row.texels,
    };
    ph_texel_row_any(&pixels, false, false, ph_texel_v_down(pixels.v_mask));
}

/* How many of n pixels lie on the same side of a knee as the first one, which has depth d. */
static inline uint32_t ph_knee_pixels(uint32_t d, uint32_t gd, uint32_t n, uint32_t knee)
{
    const bool far = d < knee;
    uint32_t count = n;
    if ((d + (n - 1) * gd < knee) != far) {
        for (count = 0; (d < knee) == far; d += gd) {
            count++;
        }
    }
    return count;
}

/* Draws n pixels of a row whose depth has a knee. Where it crosses the knee, it is drawn in two pieces, as
 * ph_draw_rows_split does. */
static inline void ph_draw_knee_line(const struct ph_texel_run *r, uint32_t from, uint32_t n, uint32_t knee)
{
    for (uint32_t left = n, x = from, part; left > 0; left -= part, x += part) {
        const uint32_t d = r->row.d + x * r->row.gd;
        part = ph_knee_pixels(d, r->row.gd, left, knee);
        ph_draw_texel_line(r, x, part, ph_knee_code(d, knee), d < knee ? 2 * r->row.gd : r->row.gd);
    }
}

/* The rows of ph_texture_small, or with a knee, which is 0 if there is none. */
static inline uint32_t ph_texture_small_rows(struct ph_texel_run *r, uint32_t knee)
{
    uint32_t count = 0;
    do {
        for (; r->row.rows > 0; r->row.rows--) {
            const int32_t from = (int32_t)r->row.left >> 16, n = ((int32_t)r->row.right >> 16) - from;
            if (n > 0) {
                if (knee != 0) {
                    ph_draw_knee_line(r, (uint32_t)from, (uint32_t)n, knee);
                } else {
                    ph_draw_texel_line(r, (uint32_t)from, (uint32_t)n, r->row.d + (uint32_t)from * r->row.gd,
                                       r->row.gd);
                }
                count += (uint32_t)n;
            }
            r->row.left += r->row.left_dx;
            r->row.right += r->row.right_dx;
            r->row.d += r->row.d_dy;
            r->row.depth = ph_row_below(r->row.depth, r->row.stride_bytes);
            r->row.pixels = ph_row_below(r->row.pixels, r->row.stride_bytes);
            ph_texel_line_down(&r->u);
            ph_texel_line_down(&r->v);
        }
    } while (ph_texel_run_lower(r));
    return count;
}

#endif
