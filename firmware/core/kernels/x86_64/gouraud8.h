/* gouraud8: rows along a ramp of colours, 8 pixels at once, x86-64 (SSE2). Private to the kernels of this folder. */
#ifndef PH_GOURAUD8_H
#define PH_GOURAUD8_H

#include "pixels8.h"
#include "span.h"

/* A value that changes by the same from pixel to pixel: what pixels 0 to 3 have beyond pixel 0, and 4 and 8 steps. */
struct steps8 {
    __m128i first, four, eight;
    uint32_t one;
};

struct gouraud8 {
    struct steps8 d, light;
    const uint16_t *ramp;
};

static inline struct steps8 steps8_of(uint32_t step)
{
    const __m128i one = _mm_set1_epi32((int)step), two = _mm_add_epi32(one, one);
    const __m128i first = _mm_add_epi32(_mm_and_si128(one, _mm_setr_epi32(0, -1, 0, -1)),
                                        _mm_and_si128(two, _mm_setr_epi32(0, 0, -1, -1)));
    return (struct steps8){first, _mm_slli_epi32(one, 2), _mm_slli_epi32(one, 3), step};
}

static inline struct depths8 steps8_from(const struct steps8 *steps, uint32_t value)
{
    const __m128i four = _mm_add_epi32(_mm_set1_epi32((int)value), steps->first);
    return (struct depths8){four, _mm_add_epi32(four, steps->four)};
}

/* Colours of 8 pixels, by the top 7 bits of their light. */
static inline __m128i colours8(const struct depths8 *light, const uint16_t *ramp)
{
    const __m128i entry = _mm_packs_epi32(_mm_srli_epi32(light->low, 25), _mm_srli_epi32(light->high, 25));
    __m128i colours = _mm_cvtsi32_si128(ramp[_mm_extract_epi16(entry, 0)]);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 1)], 1);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 2)], 2);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 3)], 3);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 4)], 4);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 5)], 5);
    colours = _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 6)], 6);
    return _mm_insert_epi16(colours, ramp[_mm_extract_epi16(entry, 7)], 7);
}

static inline void gouraud8_draw(uint16_t *pixels, uint16_t *depth, const struct depths8 *d,
                                 const struct depths8 *light, const uint16_t *ramp)
{
    const __m128i hidden = depth8_test(depth, depths8_codes(d));
    const int mask = _mm_movemask_epi8(hidden);
    if (mask == 0) {
        _mm_storeu_si128((__m128i *)pixels, colours8(light, ramp));
    } else if (mask != 0xffff) {
        pixels8_put(pixels, colours8(light, ramp), hidden);
    }
}

/* Draws n >= 1 pixels; d and light are those of the first one. */
static inline void gouraud8_row(const struct gouraud8 *g, uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d,
                                uint32_t light)
{
    if (n < 8) {
        for (uint32_t i = 0; i < n; i++, d += g->d.one, light += g->light.one) {
            ph_pixel_gouraud(&pixels[i], &depth[i], d, light, g->ramp);
        }
        return;
    }
    struct depths8 at = steps8_from(&g->d, d), light_at = steps8_from(&g->light, light);
    for (uint32_t left = n / 8; left > 0; left--) {
        gouraud8_draw(pixels, depth, &at, &light_at, g->ramp);
        depths8_add(&at, g->d.eight);
        depths8_add(&light_at, g->light.eight);
        pixels += 8;
        depth += 8;
    }
    const uint32_t beyond = n % 8;
    if (beyond > 0) { /* the last 8; those among them that are drawn already do not change */
        at = steps8_from(&g->d, d + (n - 8) * g->d.one);
        light_at = steps8_from(&g->light, light + (n - 8) * g->light.one);
        gouraud8_draw(pixels + beyond - 8, depth + beyond - 8, &at, &light_at, g->ramp);
    }
}

#endif
