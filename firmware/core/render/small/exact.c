/*
 * Triangles of the small profile whose depth takes 64 bits: what render/exact.c and render/raster_exact.c do, for
 * fixed16 alone, where a run has one slope. See small.h, exact.h.
 */
#include "../exact.c"

#include "small.h"

enum { CODE_DOWN = 24 }; /* from 2^-56 to 16.16 codes */

/* The plane of a run, through d at pixel (x, y). */
static void set_plane_of_run(const struct ph_exact *e, uint32_t bias, uint64_t d, uint32_t x, uint32_t y,
                             struct ph_plane *run)
{
    const uint32_t gx = in_codes(load(e->gx), CODE_DOWN, 1), gy = in_codes(load(e->gy), CODE_DOWN, 1);
    *run =
        (struct ph_plane){in_codes(d, CODE_DOWN, 0) + PH_DEPTH_BIAS_FIXED16 + (bias << 16) - x * gx - y * gy, gx, gy};
}

static bool is_in_range(const struct ph_exact *e, uint32_t x, uint32_t y)
{
    return depth_at(e, x, y) - load(e->low) <= load(e->size);
}

void ph_small_set_exact(const struct ph_renderer *r, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                        struct ph_exact *e)
{
    const int64_t far = in_40_bits(r->lens.far_q, r->lens.far_s);
    int64_t d[3];
    for (int i = 0; i < 3; i++) {
        const int64_t before = in_40_bits(v[i]->q, v[i]->s) - far;
        d[i] = before > 0 ? before : 0;
    }
    set_plane(e, d, v[0], sides);
}

bool ph_small_exact_rows(const struct ph_exact *e, uint32_t bias, const struct ph_half_rows *rows, int32_t width,
                         struct ph_plane *run)
{
    const int32_t more = rows->y_end - 1 - rows->y;
    const int32_t x = ph_max(ph_min(rows->left.x >> 16, column_below(rows->left, more)), 0);
    const int32_t x_end = ph_min(ph_max(rows->right.x >> 16, column_below(rows->right, more)), width);
    const uint32_t x0 = (uint32_t)x, x1 = (uint32_t)x_end - 1, y0 = (uint32_t)rows->y, y1 = y0 + (uint32_t)more;
    if (x >= x_end || x_end - x > PH_EXACT_RUN || !is_in_range(e, x0, y0) || !is_in_range(e, x1, y0) ||
        !is_in_range(e, x0, y1) || !is_in_range(e, x1, y1)) {
        return false;
    }
    const uint32_t x_mid = (x0 + x1) / 2, y_mid = (y0 + y1) / 2;
    set_plane_of_run(e, bias, depth_at(e, x_mid, y_mid), x_mid, y_mid, run);
    return true;
}

int32_t ph_small_exact_run(const struct ph_exact *e, uint32_t bias, int32_t x, int32_t x_end, int32_t y,
                           struct ph_plane *run)
{
    const struct range range = {load(e->low), load(e->size)};
    const uint64_t gx = load(e->gx);
    uint64_t d = depth_at(e, (uint32_t)x, (uint32_t)y);
    uint32_t count = 1;
    if (holds(&range, d)) {
        count = pixels_in(&range, d, gx, (uint32_t)ph_min(x_end - x, PH_EXACT_RUN));
    } else {
        d = (int64_t)(d - range.bottom) < 0 ? range.bottom : range.bottom + range.size;
    }
    const uint32_t mid = (count - 1) / 2;
    set_plane_of_run(e, bias, d + mid * gx, (uint32_t)x + mid, (uint32_t)y, run);
    return (int32_t)count;
}
