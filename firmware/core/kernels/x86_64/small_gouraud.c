/* ph_small_gouraud of kernels.h for x86-64: edges and planes step in one addition, and so do depth and light. */
#include "kernels.h"
#include "triangle.h"

#include <emmintrin.h>
#include <stddef.h>

_Static_assert(offsetof(struct ph_small_triangle, light_dy) == 12 &&
                   offsetof(struct ph_small_triangle, light) == offsetof(struct ph_small_triangle, left) + 12,
               "left, right, d, light are loaded at once, and so are their steps");

/* Draws the pixels -n .. -1 before the end of the row. at has the depth in word 0, light in word 2; so has step. */
static inline void draw_row(uint16_t *pixels, uint16_t *depth, intptr_t n, __m128i at, __m128i step,
                            const uint16_t *ramp)
{
    for (intptr_t i = -n; i < 0; i++) {
        const uint16_t code = (uint16_t)_mm_extract_epi16(at, 1);
        if (code > depth[i]) {
            depth[i] = code;
            pixels[i] = ramp[(uint32_t)_mm_extract_epi16(at, 5) >> 9];
        }
        at = _mm_add_epi32(at, step);
    }
}

/* Draws the upper rows of r, which then stands below them. */
static inline uint32_t draw_upper(struct ph_small_triangle *r, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const uint16_t *const ramp = r->ramp;
    const __m128i down = _mm_loadu_si128((const __m128i *)&r->left_dx);
    const __m128i step = _mm_unpacklo_epi32(_mm_loadl_epi64((const __m128i *)&r->gd), _mm_setzero_si128());
    __m128i row = _mm_loadu_si128((const __m128i *)&r->left);
    uint32_t count = 0;
    for (uint32_t rows = r->upper_rows; rows > 0; rows--) {
        const uint32_t from = (uint32_t)_mm_extract_epi16(row, 1), to = (uint32_t)_mm_extract_epi16(row, 3);
        if (to > from) {
            const __m128i right = _mm_mul_epu32(_mm_shuffle_epi32(_mm_cvtsi32_si128((int)from), 0), step);
            const __m128i first = _mm_add_epi32(_mm_shuffle_epi32(row, _MM_SHUFFLE(3, 3, 2, 2)), right);
            draw_row(pixels + to, depth + to, to - from, first, step, ramp);
            count += to - from;
        }
        row = _mm_add_epi32(row, down);
        depth = ph_row_below(depth, stride_bytes);
        pixels = ph_row_below(pixels, stride_bytes);
    }
    _mm_storeu_si128((__m128i *)&r->left, row);
    return count;
}

uint32_t ph_small_gouraud(const struct ph_small_triangle *small, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes)
{
    struct ph_small_triangle r = *small;
    const uint32_t above = r.upper_rows * stride_bytes;
    const uint32_t count = draw_upper(&r, depth, pixels, stride_bytes);
    if (r.lower_rows == 0) {
        return count;
    }
    ph_small_lower(&r);
    return count + draw_upper(&r, ph_row_below(depth, above), ph_row_below(pixels, above), stride_bytes);
}
