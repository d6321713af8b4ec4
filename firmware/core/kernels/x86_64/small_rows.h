/*
 * small_rows: rows of a small triangle, x86-64: edges and planes step in one addition, and so do depth and light.
 * Private to the kernels of this folder.
 */
#ifndef PH_SMALL_ROWS_H
#define PH_SMALL_ROWS_H

#include "triangle.h"

#include <emmintrin.h>
#include <stddef.h>

_Static_assert(offsetof(struct ph_small_triangle, light_dy) == 12 &&
                   offsetof(struct ph_small_triangle, light) == offsetof(struct ph_small_triangle, left) + 12,
               "left, right, d, light are loaded at once, and so are their steps");

/* What all rows of a triangle have in common; knee: 0 if it has none. light_down: the entry of the ramp is light >>
 * this; a constant. */
struct small_rows {
    __m128i step; /* a column's: of depth in word 0, of light in word 2 */
    const uint16_t *ramp;
    ptrdiff_t to_pixels; /* from a depth to its pixel, in bytes */
    bool has_knee;
    uint32_t knee;
    unsigned light_down;
};

/* Draws a pixel. before has the depth of the one before it in word 0 and the light in word 2; so has the result. */
static inline __m128i small_pixel(const struct small_rows *rows, uint16_t *depth, __m128i before)
{
    const __m128i at = _mm_add_epi32(before, rows->step);
    const uint16_t code = rows->has_knee ? (uint16_t)(ph_knee_code((uint32_t)_mm_cvtsi128_si32(at), rows->knee) >> 16)
                                         : (uint16_t)_mm_extract_epi16(at, 1);
    if (code > *depth) {
        *depth = code;
        *(uint16_t *)(void *)((uint8_t *)depth + rows->to_pixels) =
            rows->ramp[(uint32_t)_mm_extract_epi16(at, 5) >> (rows->light_down - 16)];
    }
    return at;
}

#define SMALL_PIXEL(k)                                                                                                 \
    case k:                                                                                                            \
        at = small_pixel(rows, end - (k), at);
#define SMALL_NEXT(k)                                                                                                  \
    __attribute__((fallthrough));                                                                                      \
    SMALL_PIXEL(k)
#define SMALL_FOUR(k) SMALL_NEXT(k) SMALL_NEXT((k)-1) SMALL_NEXT((k)-2) SMALL_NEXT((k)-3)

/* Draws the n = 1 .. PH_SMALL_COLUMNS pixels before `end`; `at` has depth and light of the pixel before them. */
static inline void small_row(const struct small_rows *rows, uint16_t *end, uint32_t n, __m128i at)
{
    switch (n) {
        SMALL_PIXEL(32)
        SMALL_NEXT(31)
        SMALL_NEXT(30)
        SMALL_NEXT(29)
        SMALL_FOUR(28)
        SMALL_FOUR(24)
        SMALL_FOUR(20)
        SMALL_FOUR(16)
        SMALL_FOUR(12)
        SMALL_FOUR(8)
        SMALL_FOUR(4)
        break;
    default:
        __builtin_unreachable();
    }
}

/* Puts the lower edge in the place of the left (0) or the right one (1). */
static inline __m128i small_below(__m128i of_edges, uint32_t side, int32_t lower)
{
    int32_t word[4];
    _mm_storeu_si128((__m128i *)word, of_edges);
    word[side] = lower;
    return _mm_loadu_si128((const __m128i *)word);
}

/* After the upper rows the lower edge takes over; `left` rows are left then. False: there are no lower rows, or they
 * have been drawn. */
static inline __attribute__((always_inline)) bool small_turn(const struct ph_small_triangle *small, __m128i *row,
                                                             __m128i *down, uint32_t *left, uint32_t *lower_rows)
{
    if (*lower_rows == 0) {
        return false;
    }
    *row = small_below(*row, small->lower_is_right, small->lower.x);
    *down = small_below(*down, small->lower_is_right, small->lower.dx);
    *left = *lower_rows;
    *lower_rows = 0;
    return true;
}

/* Draws a small triangle; see kernels.h. has_knee and light_down are constants. */
static inline uint32_t small_draw(const struct ph_small_triangle *small, uint16_t *depth, const uint16_t *pixels,
                                  uint32_t stride_bytes, bool has_knee, unsigned light_down)
{
    const __m128i step = _mm_unpacklo_epi32(_mm_loadl_epi64((const __m128i *)&small->gd), _mm_setzero_si128());
    const struct small_rows rows = {step,     small->ramp, (const uint8_t *)pixels - (const uint8_t *)depth,
                                    has_knee, small->knee, light_down};
    __m128i row = _mm_loadu_si128((const __m128i *)&small->left);
    __m128i down = _mm_loadu_si128((const __m128i *)&small->left_dx);
    uint32_t count = 0, left = small->upper_rows, lower_rows = small->lower_rows;
    for (;;) {
        do {
            const uint32_t from = (uint32_t)_mm_extract_epi16(row, 1), to = (uint32_t)_mm_extract_epi16(row, 3);
            if (to > from) {
                const __m128i before = _mm_shuffle_epi32(_mm_cvtsi32_si128((int)from - 1), 0);
                small_row(&rows, depth + to, to - from,
                          _mm_add_epi32(_mm_shuffle_epi32(row, _MM_SHUFFLE(3, 3, 2, 2)), _mm_mul_epu32(before, step)));
                count += to - from;
            }
            row = _mm_add_epi32(row, down);
            depth = ph_row_below(depth, stride_bytes);
        } while (--left > 0);
        if (!small_turn(small, &row, &down, &left, &lower_rows)) {
            return count;
        }
    }
}

#endif
