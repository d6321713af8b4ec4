/* ph_small_gouraud of kernels.h, in C for any CPU. */
#include "kernels.h"
#include "span.h"
#include "triangle.h"

/* Draws as many rows between the edges of r, which then stand at the row below. */
static uint32_t draw_rows(struct ph_small_triangle *r, uint32_t rows, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    const uint16_t *const ramp = r->ramp;
    const uint32_t gd = r->gd, glight = r->glight;
    uint32_t count = 0;
    for (; rows > 0; rows--) {
        const uint32_t from = r->left >> 16, to = r->right >> 16;
        uint32_t d = r->d + gd * from, light = r->light + glight * from;
        uint32_t x = from;
        for (; (int32_t)(to - x) > 1; x += 2) { /* two pixels in each turn */
            ph_pixel_gouraud(&pixels[x], &depth[x], d, light, ramp);
            d += gd;
            light += glight;
            ph_pixel_gouraud(&pixels[x + 1], &depth[x + 1], d, light, ramp);
            d += gd;
            light += glight;
        }
        if ((int32_t)(to - x) > 0) {
            ph_pixel_gouraud(&pixels[x], &depth[x], d, light, ramp);
        }
        count += (int32_t)(to - from) > 0 ? to - from : 0;
        r->left += r->left_dx;
        r->right += r->right_dx;
        r->d += r->d_dy;
        r->light += r->light_dy;
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}

uint32_t ph_small_gouraud(const struct ph_small_triangle *small, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    struct ph_small_triangle r = *small;
    const uint32_t above = r.upper_rows * stride_bytes;
    const uint32_t count = draw_rows(&r, r.upper_rows, depth, pixels, stride_bytes);
    if (r.lower_rows == 0) {
        return count;
    }
    ph_small_lower(&r);
    return count + draw_rows(&r, r.upper_rows, ph_row_below(depth, above), ph_row_below(pixels, above), stride_bytes);
}
