/* Rows of a Gouraud triangle: see hot.h. */
#include "hot.h"
#include "span.h"

static uint16_t *row_below(uint16_t *row, uint32_t bytes)
{
    return (uint16_t *)(void *)((uint8_t *)row + bytes);
}

void ph_rows_gouraud(struct ph_rows *r)
{
    const uint16_t *const ramp = r->ramp;
    const uint32_t gd = r->gd, glight = r->glight;
    uint32_t left = r->left, right = r->right, count = 0;
    for (; r->rows > 0; r->rows--) {
        const uint32_t from = left >> 16, to = right >> 16;
        uint16_t *const depth = r->depth, *const pixels = r->pixels;
        uint32_t d = r->d + gd * from, light = r->light + glight * from;
        uint32_t x = from;
        for (; (int32_t)(to - x) > 1; x += 2) { /* two pixels a turn */
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
        left += r->left_dx;
        right += r->right_dx;
        r->d += r->d_dy;
        r->light += r->light_dy;
        r->depth = row_below(depth, r->stride_bytes);
        r->pixels = row_below(pixels, r->stride_bytes);
    }
    r->left = left;
    r->right = right;
    r->count += count;
}
