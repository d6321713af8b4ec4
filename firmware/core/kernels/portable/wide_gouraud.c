/* ph_wide_gouraud of kernels.h. */
#include "kernels.h"

#include "edge.h"

uint32_t ph_wide_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const int32_t width = (int32_t)(stride_bytes / 2);
    uint32_t left = rows->left, right = rows->right, d = rows->d, light = rows->light, count = 0;
    for (uint32_t n = rows->upper_rows; n > 0; n--) {
        const int32_t from = ph_max((int32_t)left >> 16, 0), to = ph_min((int32_t)right >> 16, width);
        if (from < to) {
            ph_span_gouraud(pixels + from, depth + from, (uint32_t)(to - from), d + rows->gd * (uint32_t)from, rows->gd,
                            light + rows->glight * (uint32_t)from, rows->glight, rows->ramp);
            count += (uint32_t)(to - from);
        }
        left += rows->left_dx;
        right += rows->right_dx;
        d += rows->d_dy;
        light += rows->light_dy;
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}
