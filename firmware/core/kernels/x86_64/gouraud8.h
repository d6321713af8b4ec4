/*
 * gouraud8: rows along a ramp of colours, x86-64 (SSE2): 8 pixels at once, and before them one by one what is left of a
 * division by 8. Private to the kernels of this folder.
 */
#ifndef PH_GOURAUD8_H
#define PH_GOURAUD8_H

#include "pixels8.h"
#include "small_rows.h"

/* A value that changes by the same from pixel to pixel: the change of 1 to 4 pixels, and 4 and 8 times. */
struct steps8 {
    __m128i first, four, eight;
};

/* What all rows of a triangle have in common. */
struct gouraud8 {
    struct small_rows one; /* at a time */
    struct steps8 d, light;
};

/* The multiples of a step; step: that of a pixel, in all words. */
static inline struct steps8 steps8_of(__m128i step)
{
    const __m128i two = _mm_add_epi32(step, step), four = _mm_add_epi32(two, two);
    const __m128i odd = _mm_unpacklo_epi32(step, two);
    return (struct steps8){_mm_add_epi32(_mm_unpacklo_epi64(odd, odd), _mm_unpackhi_epi64(_mm_setzero_si128(), two)),
                           four, _mm_add_epi32(four, four)};
}

static inline struct gouraud8 gouraud8_of(__m128i step, const uint16_t *ramp, const uint16_t *depth,
                                          const uint16_t *pixels, unsigned light_down)
{
    return (struct gouraud8){
        .one = {step, ramp, (const uint8_t *)pixels - (const uint8_t *)depth, false, 0, light_down},
        .d = steps8_of(_mm_shuffle_epi32(step, 0)),
        .light = steps8_of(_mm_shuffle_epi32(step, _MM_SHUFFLE(2, 2, 2, 2))),
    };
}

/* Colours of 8 pixels, by the top bits of their light; any: any value, its register becomes the colours'. */
static inline __m128i colours8(__m128i any, __m128i light, __m128i light_high, const struct small_rows *rows)
{
    const uint16_t *const ramp = rows->ramp;
    const __m128i low = _mm_srli_epi32(light, (int)rows->light_down),
                  high = _mm_srli_epi32(light_high, (int)rows->light_down);
    __m128i colours = _mm_insert_epi16(any, ramp[_mm_extract_epi16(low, 0)], 0);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(low, 2)], 1);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(low, 4)], 2);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(low, 6)], 3);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(high, 0)], 4);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(high, 2)], 5);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(high, 4)], 6);
    return _mm_insert_epi16(colours, ramp[_mm_extract_epi16(high, 6)], 7);
}

/* Draws 8 pixels; d and light: those of the first 4. */
static inline void gouraud8_draw(const struct gouraud8 *g, uint16_t *depth, __m128i d, __m128i light)
{
    struct depths8 depths = {d, _mm_add_epi32(d, g->d.four)};
    __asm__("" : "+x"(depths.low)); /* else the compiler keeps copies of both and moves them back for each 8 pixels */
    __asm__("" : "+x"(light));
    const __m128i light_high = _mm_add_epi32(light, g->light.four), hidden = depth8_test(depth, depths8_codes(&depths));
    uint16_t *const pixels = (uint16_t *)(void *)((uint8_t *)depth + g->one.to_pixels);
    const int mask = _mm_movemask_epi8(hidden);
    if (mask == 0) {
        _mm_storeu_si128((__m128i *)pixels, colours8(hidden, light, light_high, &g->one));
    } else if (mask != 0xffff) {
        pixels8_put(pixels, colours8(light_high, light, light_high, &g->one), hidden);
    }
}

#define GOURAUD8_PIXEL(k)                                                                                              \
    case k:                                                                                                            \
        at = small_pixel(&g->one, depth - (k), at);                                                                    \
        __attribute__((fallthrough));

/* Draws the n >= 1 pixels before `end`; `at` has depth and light of the pixel before them, as in small_rows.h. */
static inline __attribute__((always_inline)) void gouraud8_row(const struct gouraud8 *g, uint16_t *end, uint32_t n,
                                                               __m128i at)
{
    uint16_t *depth = end - (n & ~(uint32_t)7);
    switch (n & 7) {
        GOURAUD8_PIXEL(7)
        GOURAUD8_PIXEL(6)
        GOURAUD8_PIXEL(5)
        GOURAUD8_PIXEL(4)
        GOURAUD8_PIXEL(3)
        GOURAUD8_PIXEL(2)
        GOURAUD8_PIXEL(1)
    default:
        break;
    }
    __m128i d = _mm_add_epi32(_mm_shuffle_epi32(at, 0), g->d.first);
    __m128i light = _mm_add_epi32(_mm_shuffle_epi32(at, _MM_SHUFFLE(2, 2, 2, 2)), g->light.first);
    for (; depth != end; depth += 8) {
        gouraud8_draw(g, depth, d, light);
        d = _mm_add_epi32(d, g->d.eight);
        light = _mm_add_epi32(light, g->light.eight);
    }
}

#endif
