/* ph_wide_gouraud of kernels.h. */
#include "kernels.h"

#include "edge.h"

uint32_t ph_wide_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const int32_t width = (int32_t)(stride_bytes / 2);
    struct ph_edge left = {(int32_t)rows->left, (int32_t)rows->left_dx};
    struct ph_edge right = {(int32_t)rows->right, (int32_t)rows->right_dx};
    uint32_t d = rows->d, light = rows->light, count = 0;
    for (uint32_t n = rows->upper_rows; n > 0; n--) {
        int32_t from, to;
        if (ph_next_row(&left, &right, width, &from, &to)) {
            ph_span_gouraud(pixels + from, depth + from, (uint32_t)(to - from), d + rows->gd * (uint32_t)from, rows->gd,
                            light + rows->glight * (uint32_t)from, rows->glight, rows->ramp);
            count += (uint32_t)(to - from);
        }
        d += rows->d_dy;
        light += rows->light_dy;
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}
