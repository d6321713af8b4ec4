/* ph_span_flat of kernels.h for x86-64, 8 pixels at once. */
#include "kernels.h"
#include "pixels8.h"
#include "span.h"

static inline void draw8(uint16_t *pixels, uint16_t *depth, const struct depths8 *d, __m128i colours)
{
    pixels8_put(pixels, colours, depth8_test(depth, depths8_codes(d)));
}

void ph_span_flat(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint16_t colour)
{
    if (n < 8) {
        for (uint32_t i = 0; i < n; i++, d += gd) {
            ph_pixel_flat(&pixels[i], &depth[i], d, colour);
        }
        return;
    }
    const __m128i step = _mm_set1_epi32((int)(8 * gd)), colours = _mm_set1_epi16((short)colour);
    struct depths8 at = depths8_from(d, gd);
    const uint32_t whole = n & ~(uint32_t)7;
    for (uint32_t i = 0; i < whole; i += 8) {
        draw8(pixels + i, depth + i, &at, colours);
        depths8_add(&at, step);
    }
    if (n > whole) { /* the last 8; those among them that are drawn already do not change */
        at = depths8_from(d + (n - 8) * gd, gd);
        draw8(pixels + n - 8, depth + n - 8, &at, colours);
    }
}
