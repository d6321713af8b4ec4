/* ph_samples_gouraud of kernels.h, in C for any CPU. */
#include "kernels.h"
#include "span.h"
#include "triangle.h"

/* Draws the samples from .. to - 1 of a row; d and light are those of the first. */
static void draw_row(uint16_t *pixels, uint16_t *depth, uint32_t from, uint32_t to, uint32_t d, uint32_t light,
                     const struct ph_small_triangle *r)
{
    const uint32_t gd = r->gd;
    uint32_t x = from;
    if ((x & 1) != 0) {
        ph_pixel_gouraud(&pixels[x], &depth[x], d, light, r->ramp);
        d += gd;
        light += r->glight;
        x++;
    }
    for (; to - x > 1; x += 2) {
        ph_pixel_gouraud(&pixels[x], &depth[x], d, light, r->ramp);
        d += gd;
        ph_pixel_gouraud(&pixels[x + 1], &depth[x + 1], d, light, r->ramp);
        d += gd;
        light += r->glight;
    }
    if (x < to) {
        ph_pixel_gouraud(&pixels[x], &depth[x], d, light, r->ramp);
    }
}

uint32_t ph_samples_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                            uint32_t stride_bytes)
{
    struct ph_small_triangle r = *rows;
    uint32_t count = 0;
    for (; r.upper_rows > 0; ph_small_lower(&r)) {
        for (; r.upper_rows > 0; r.upper_rows--) {
            const uint32_t from = r.left >> 16, to = r.right >> 16;
            if ((int32_t)(to - from) > 0) {
                draw_row(pixels, depth, from, to, r.d + r.gd * from, r.light + r.glight * (from / 2), &r);
                count += to - from;
            }
            r.left += r.left_dx;
            r.right += r.right_dx;
            r.d += r.d_dy;
            r.light += (r.light & 1) != 0 ? r.light_dy : 1;
            depth = ph_row_below(depth, stride_bytes);
            pixels = ph_row_below(pixels, stride_bytes);
        }
    }
    return count;
}
