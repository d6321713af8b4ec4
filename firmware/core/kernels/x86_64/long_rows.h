/*
 * long_rows: rows of any length along a ramp of colours, x86-64, 8 pixels at once; edges and planes step in one
 * addition. Private to the kernels of this folder.
 */
#ifndef PH_LONG_ROWS_H
#define PH_LONG_ROWS_H

#include "gouraud8.h"

/* The columns of a row in words 1 and 3, cut to the picture. */
static inline __m128i columns_of(__m128i row, __m128i width)
{
    return _mm_min_epi16(_mm_max_epi16(row, _mm_setzero_si128()), width);
}

/* Draws rows of any triangle; see kernels.h. light_down: as in struct small_rows. */
static inline uint32_t long_draw(const struct ph_small_triangle *rows, uint16_t *depth, const uint16_t *pixels,
                                 uint32_t stride_bytes, unsigned light_down)
{
    const __m128i step = _mm_unpacklo_epi32(_mm_loadl_epi64((const __m128i *)&rows->gd), _mm_setzero_si128());
    const __m128i width = _mm_set1_epi16((short)(stride_bytes / 2));
    const struct gouraud8 g = gouraud8_of(step, rows->ramp, depth, pixels, light_down);
    __m128i row = _mm_loadu_si128((const __m128i *)&rows->left);
    __m128i down = _mm_loadu_si128((const __m128i *)&rows->left_dx);
    row = _mm_sub_epi32(row, _mm_unpackhi_epi64(_mm_setzero_si128(), _mm_shuffle_epi32(step, _MM_SHUFFLE(2, 0, 0, 0))));
    uint32_t count = 0, left = rows->upper_rows, lower_rows = rows->lower_rows;
    for (;;) {
        for (; left > 0; left--) {
            const __m128i columns = columns_of(row, width);
            const uint32_t from = (uint32_t)_mm_extract_epi16(columns, 1), to = (uint32_t)_mm_extract_epi16(columns, 3);
            if (to > from) {
                const __m128i beyond = _mm_mul_epu32(_mm_shuffle_epi32(_mm_cvtsi32_si128((int)from), 0), step);
                gouraud8_row(&g, depth + to, to - from,
                             _mm_add_epi32(_mm_shuffle_epi32(row, _MM_SHUFFLE(3, 3, 2, 2)), beyond));
                count += to - from;
            }
            row = _mm_add_epi32(row, down);
            depth = ph_row_below(depth, stride_bytes);
        }
        if (!small_turn(rows, &row, &down, &left, &lower_rows)) {
            return count;
        }
    }
}

#endif
