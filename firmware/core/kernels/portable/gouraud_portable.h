/*
 * gouraud_portable: rows along a ramp of colours, in C for any CPU. Private to the kernels of this folder. light_down,
 * a constant: the entry of the ramp is light >> this.
 */
#ifndef PH_GOURAUD_PORTABLE_H
#define PH_GOURAUD_PORTABLE_H

#include "edge.h"
#include "span.h"

/* Draws as many rows between the edges of r, which then stand at the row below. */
static inline uint32_t draw_small_rows(struct ph_small_triangle *r, uint32_t rows, uint16_t *depth, uint16_t *pixels,
                                       uint32_t stride_bytes, unsigned light_down)
{
    const uint16_t *const ramp = r->ramp;
    const uint32_t gd = r->gd, glight = r->glight;
    uint32_t count = 0;
    for (; rows > 0; rows--) {
        const uint32_t from = r->left >> 16, to = r->right >> 16;
        uint32_t d = r->d + gd * from, light = r->light + glight * from;
        uint32_t x = from;
        for (; (int32_t)(to - x) > 1; x += 2) { /* two pixels in each turn */
            ph_pixel_gouraud(&pixels[x], &depth[x], d, light, ramp, light_down);
            d += gd;
            light += glight;
            ph_pixel_gouraud(&pixels[x + 1], &depth[x + 1], d, light, ramp, light_down);
            d += gd;
            light += glight;
        }
        if ((int32_t)(to - x) > 0) {
            ph_pixel_gouraud(&pixels[x], &depth[x], d, light, ramp, light_down);
        }
        count += (int32_t)(to - from) > 0 ? to - from : 0;
        ph_small_step(r, 1);
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}

/* Draws as many rows with a knee between the edges of r, which then stand at the row below. */
static inline uint32_t draw_knee_rows(struct ph_small_triangle *r, uint32_t rows, uint16_t *depth, uint16_t *pixels,
                                      uint32_t stride_bytes, unsigned light_down)
{
    const uint16_t *const ramp = r->ramp;
    const uint32_t gd = r->gd, glight = r->glight, knee = r->knee;
    uint32_t count = 0;
    for (; rows > 0; rows--) {
        const int32_t from = (int32_t)(r->left >> 16), to = (int32_t)(r->right >> 16);
        if (to > from) {
            uint32_t d = r->d + gd * (uint32_t)to, light = r->light + glight * (uint32_t)to;
            uint16_t *const row_depth = depth + to, *const row_pixels = pixels + to;
            for (int32_t x = -1; x >= from - to; x--) {
                d -= gd;
                light -= glight;
                ph_pixel_gouraud(&row_pixels[x], &row_depth[x], ph_knee_code(d, knee), light, ramp, light_down);
            }
            count += (uint32_t)(to - from);
        }
        ph_small_step(r, 1);
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}

/* Draws the upper rows and then the lower ones, all by draw_rows, a constant. */
static inline __attribute__((always_inline)) uint32_t
draw_halves(const struct ph_small_triangle *small, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes,
            unsigned light_down,
            uint32_t (*draw_rows)(struct ph_small_triangle *r, uint32_t rows, uint16_t *depth, uint16_t *pixels,
                                  uint32_t stride_bytes, unsigned light_down))
{
    struct ph_small_triangle r = *small;
    const uint32_t above = r.upper_rows * stride_bytes;
    const uint32_t count = draw_rows(&r, r.upper_rows, depth, pixels, stride_bytes, light_down);
    if (r.lower_rows == 0) {
        return count;
    }
    ph_small_lower(&r);
    return count + draw_rows(&r, r.upper_rows, ph_row_below(depth, above), ph_row_below(pixels, above), stride_bytes,
                             light_down);
}

/* Draws rows of any length, cut to the picture; see ph_long_gouraud in kernels.h. */
static inline uint32_t draw_long_rows(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                                      uint32_t stride_bytes, unsigned light_down)
{
    const uint32_t width = stride_bytes / 2;
    struct ph_small_triangle r = *rows;
    uint32_t count = 0;
    for (; r.upper_rows > 0; ph_small_lower(&r)) {
        for (; r.upper_rows > 0; r.upper_rows--) {
            const uint32_t from = ph_from_column(r.left), columns = ph_to_column(r.right, width) - from;
            if ((int32_t)columns > 0) {
                ph_span_gouraud(pixels + from, depth + from, columns, r.d + r.gd * from, r.gd,
                                r.light + r.glight * from, r.glight, r.ramp, light_down);
                count += columns;
            }
            ph_small_step(&r, 1);
            depth = ph_row_below(depth, stride_bytes);
            pixels = ph_row_below(pixels, stride_bytes);
        }
    }
    return count;
}

#endif
