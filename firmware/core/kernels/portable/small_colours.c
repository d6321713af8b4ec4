/* ph_small_colours of kernels.h, in C for any CPU. */
#include "edge.h"
#include "span.h"

/* Draws the n pixels before `end`; d, red_blue and green: those of the first one. */
static inline void draw_row(const struct ph_small_triangle *r, uint32_t green_gx, uint16_t *depth_end,
                            uint16_t *pixels_end, int32_t n, uint32_t d, uint32_t red_blue, uint32_t green)
{
    for (int32_t i = -n; i < 0; i++) {
        if (ph_nearer16(depth_end + i, d)) {
            PH_KEEP_BRANCH();
            pixels_end[i] = ph_pixel_colour(red_blue, green);
        }
        d += r->gd;
        red_blue += r->glight;
        green += green_gx;
    }
}

/* Draws the upper rows of r, which then stands at the row below. */
static inline uint32_t draw_rows(struct ph_small_triangle *r, struct ph_plane *green, uint16_t *depth, uint16_t *pixels,
                                 uint32_t stride_bytes)
{
    uint32_t count = 0;
    for (uint32_t rows = r->upper_rows; rows > 0; rows--) {
        const uint32_t from = r->left >> 16, to = r->right >> 16;
        if (to > from) {
            draw_row(r, green->gx, depth + to, pixels + to, (int32_t)(to - from), r->d + from * r->gd,
                     r->light + from * r->glight, green->base + from * green->gx);
            count += to - from;
        }
        ph_small_step(r, 1);
        green->base += green->gy;
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    return count;
}

uint32_t ph_small_colours(const struct ph_small *small, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    struct ph_small_triangle r = small->rows;
    struct ph_plane green = small->of.own.green;
    const uint32_t above = r.upper_rows * stride_bytes;
    const uint32_t count = draw_rows(&r, &green, depth, pixels, stride_bytes);
    if (r.lower_rows == 0) {
        return count;
    }
    ph_small_lower(&r);
    return count + draw_rows(&r, &green, ph_row_below(depth, above), ph_row_below(pixels, above), stride_bytes);
}
