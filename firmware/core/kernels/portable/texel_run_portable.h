/* texel_run_portable: ph_texel_run_rows of texture_small.h in portable C. */
#ifndef PH_TEXEL_RUN_PORTABLE_H
#define PH_TEXEL_RUN_PORTABLE_H

#include "texel_mix.h"
#include "texture_small.h"
#include "triangle.h"

/* Sets the light of a row, whose first and last light these are. False if they are not within 0 .. 32. */
static inline bool ph_set_run_light(struct ph_texel_row *row, uint32_t first, uint32_t last, uint32_t glight)
{
    const uint32_t end = (uint32_t)33 << 24, more = (row->n - 1) & 3, half = (uint32_t)((int32_t)glight >> 1);
    const bool in_range = first < end && last < end;
    row->level = in_range ? (first + more * half) >> 24 : UINT32_MAX;
    row->light = in_range ? first + (more + 2) * glight + half : first;
    return in_range;
}

/* Sets n pixels of the run's next row, from column `from` on. False if its light is not within 0 .. 32. */
static inline bool ph_set_run_row(const struct ph_texel_run *r, struct ph_texel_row *row, uint32_t from, uint32_t n)
{
    const uint32_t light = r->row.light + from * r->row.glight;
    row->depth = r->row.depth + (int32_t)from;
    row->pixels = r->row.pixels + (int32_t)from;
    row->n = n;
    row->d = r->row.d + from * r->row.gd;
    row->u = ph_texel_walk_from(r->u.at, r->u.step, r->u.bend, from, n);
    row->v = ph_texel_walk_from(r->v.at, r->v.step, r->v.bend, from, n);
    return ph_set_run_light(row, light, light + (n - 1) * r->row.glight, r->row.glight);
}

static inline void ph_run_row_down(struct ph_texel_run *r)
{
    r->row.left += r->row.left_dx;
    r->row.right += r->row.right_dx;
    r->row.d += r->row.d_dy;
    r->row.light += r->row.light_dy;
    r->row.depth = ph_row_below(r->row.depth, r->row.stride_bytes);
    r->row.pixels = ph_row_below(r->row.pixels, r->row.stride_bytes);
    ph_texel_line_down(&r->u);
    ph_texel_line_down(&r->v);
    r->row.rows--;
}

static inline uint32_t ph_texel_run_rows_portable(struct ph_texel_run *r, struct ph_texel_row *row)
{
    uint32_t count = 0;
    while (r->row.rows > 0) {
        const int32_t from = (int32_t)r->row.left >> 16, n = ((int32_t)r->row.right >> 16) - from;
        const bool any = n > 0, fast = !any || ph_set_run_row(r, row, (uint32_t)from, (uint32_t)n);
        ph_run_row_down(r);
        if (any) {
            count += (uint32_t)n;
            if (!fast) {
                break;
            }
            r->draw_row(row);
        }
    }
    return count;
}

#endif
