/* ph_long_gouraud of kernels.h, in C for any CPU. */
#include "kernels.h"

#include "edge.h"
#include "span.h"

uint32_t ph_long_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const uint32_t width = stride_bytes / 2;
    struct ph_small_triangle r = *rows;
    uint32_t count = 0;
    for (; r.upper_rows > 0; ph_small_lower(&r)) {
        for (; r.upper_rows > 0; r.upper_rows--) {
            const uint32_t from = ph_from_column(r.left), columns = ph_to_column(r.right, width) - from;
            if ((int32_t)columns > 0) {
                ph_span_gouraud(pixels + from, depth + from, columns, r.d + r.gd * from, r.gd,
                                r.light + r.glight * from, r.glight, r.ramp);
                count += columns;
            }
            r.left += r.left_dx;
            r.right += r.right_dx;
            r.d += r.d_dy;
            r.light += r.light_dy;
            depth = ph_row_below(depth, stride_bytes);
            pixels = ph_row_below(pixels, stride_bytes);
        }
    }
    return count;
}
