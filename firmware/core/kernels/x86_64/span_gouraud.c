/* ph_span_gouraud of kernels.h for x86-64, 8 pixels at once. */
#include "kernels.h"
#include "pixels8.h"
#include "span.h"

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

static inline void draw8(uint16_t *pixels, uint16_t *depth, const struct depths8 *d, const struct depths8 *light,
                         const uint16_t *ramp)
{
    const __m128i hidden = depth8_test(depth, depths8_codes(d));
    if (_mm_movemask_epi8(hidden) != 0xffff) {
        pixels8_put(pixels, colours8(light, ramp), hidden);
    }
}

void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp)
{
    if (n < 8) {
        for (uint32_t i = 0; i < n; i++, d += gd, light += glight) {
            ph_pixel_gouraud(&pixels[i], &depth[i], d, light, ramp);
        }
        return;
    }
    const __m128i step = _mm_set1_epi32((int)(8 * gd)), light_step = _mm_set1_epi32((int)(8 * glight));
    struct depths8 at = depths8_from(d, gd), light_at = depths8_from(light, glight);
    const uint32_t whole = n & ~(uint32_t)7;
    for (uint32_t i = 0; i < whole; i += 8) {
        draw8(pixels + i, depth + i, &at, &light_at, ramp);
        depths8_add(&at, step);
        depths8_add(&light_at, light_step);
    }
    if (n > whole) { /* the last 8; those among them that are drawn already do not change */
        at = depths8_from(d + (n - 8) * gd, gd);
        light_at = depths8_from(light + (n - 8) * glight, glight);
        draw8(pixels + n - 8, depth + n - 8, &at, &light_at, ramp);
    }
}
