/* ph_wide_gouraud of kernels.h for x86-64, 8 pixels at once. */
#include "edge.h"
#include "gouraud8.h"
#include "kernels.h"

uint32_t ph_wide_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const uint32_t width = stride_bytes / 2;
    const struct gouraud8 g = {steps8_of(rows->gd), steps8_of(rows->glight), rows->ramp};
    struct ph_small_triangle r = *rows;
    uint32_t count = 0;
    for (; r.upper_rows > 0; ph_small_lower(&r)) {
        uint32_t left = r.left, right = r.right;
        for (uint32_t n = r.upper_rows; n > 0; n--) {
            const uint32_t from = ph_from_column(left), columns = ph_to_column(right, width) - from;
            if ((int32_t)columns > 0) {
                gouraud8_row(&g, pixels + from, depth + from, columns, r.d + g.d.one * from,
                             r.light + g.light.one * from);
                count += columns;
            }
            left += r.left_dx;
            right += r.right_dx;
            r.d += r.d_dy;
            r.light += r.light_dy;
            depth = ph_row_below(depth, stride_bytes);
            pixels = ph_row_below(pixels, stride_bytes);
        }
        r.left = left;
        r.right = right;
    }
    return count;
}
