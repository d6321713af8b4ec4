/* pixels8: 8 pixels at once, their depths and the depth test, x86-64 (SSE2). Private to the kernels of this folder. */
#ifndef PH_PIXELS8_H
#define PH_PIXELS8_H

#include <emmintrin.h>
#include <stdint.h>

/* d of 8 pixels, 4 in each. */
struct depths8 {
    __m128i low, high;
};

/* The depths d, d + gd, .. d + 7 gd of 8 pixels. */
static inline struct depths8 depths8_from(uint32_t d, uint32_t gd)
{
    const __m128i four = _mm_setr_epi32((int)d, (int)(d + gd), (int)(d + 2 * gd), (int)(d + 3 * gd));
    return (struct depths8){four, _mm_add_epi32(four, _mm_set1_epi32((int)(4 * gd)))};
}

static inline void depths8_add(struct depths8 *d, __m128i step)
{
    d->low = _mm_add_epi32(d->low, step);
    d->high = _mm_add_epi32(d->high, step);
}

/* The codes of 8 pixels: the upper halves of their depths. */
static inline __m128i depths8_codes(const struct depths8 *d)
{
    return _mm_packs_epi32(_mm_srai_epi32(d->low, 16), _mm_srai_epi32(d->high, 16));
}

/* Stores the larger one of each code and the stored code. Returns all ones for each pixel that is hidden. */
static inline __m128i depth8_test(uint16_t *depth, __m128i codes)
{
    const __m128i stored = _mm_loadu_si128((const __m128i *)depth), above = _mm_subs_epu16(codes, stored);
    _mm_storeu_si128((__m128i *)depth, _mm_add_epi16(stored, above));
    return _mm_cmpeq_epi16(above, _mm_setzero_si128());
}

/* Stores the colours of the pixels that are not hidden. */
static inline void pixels8_put(uint16_t *pixels, __m128i colours, __m128i hidden)
{
    const __m128i there = _mm_loadu_si128((const __m128i *)pixels);
    const __m128i change = _mm_andnot_si128(hidden, _mm_xor_si128(there, colours));
    _mm_storeu_si128((__m128i *)pixels, _mm_xor_si128(there, change));
}

#endif
