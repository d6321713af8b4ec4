/* ph_halve of kernels.h for x86-64: the means of 8 pixels at once. Most fours of samples are of one colour. */
#include "blend.h"
#include "kernels.h"

#include <emmintrin.h>
#include <stddef.h>

/* Samples of 8 pixels in a row: the first and the second one of each. */
struct pairs8 {
    __m128i first, second;
};

static inline struct pairs8 pairs8_of(__m128i low, __m128i high)
{
    return (struct pairs8){
        _mm_packs_epi32(_mm_srai_epi32(_mm_slli_epi32(low, 16), 16), _mm_srai_epi32(_mm_slli_epi32(high, 16), 16)),
        _mm_packs_epi32(_mm_srai_epi32(low, 16), _mm_srai_epi32(high, 16))};
}

/* The sums of the four samples of each pixel, after a mask has cut out channels. */
static inline __m128i sums_of(const struct pairs8 *upper, const struct pairs8 *lower, __m128i mask)
{
    return _mm_add_epi16(_mm_add_epi16(_mm_and_si128(upper->first, mask), _mm_and_si128(upper->second, mask)),
                         _mm_add_epi16(_mm_and_si128(lower->first, mask), _mm_and_si128(lower->second, mask)));
}

/* In wire order red stands at bit 3, blue at bit 8, the upper half of green at bit 0 and the lower one at bit 13. */
static inline __m128i means_of(const struct pairs8 *upper, const struct pairs8 *lower)
{
    const __m128i red = _mm_set1_epi16(31 << 3), blue = _mm_set1_epi16(31 << 8);
    const __m128i reds = _mm_add_epi16(sums_of(upper, lower, red), _mm_set1_epi16(2 << 3));
    const __m128i blues = _mm_add_epi16(sums_of(upper, lower, blue), _mm_set1_epi16(2 << 8));
    const __m128i greens = _mm_add_epi16(
        _mm_slli_epi16(sums_of(upper, lower, _mm_set1_epi16(7)), 3),
        _mm_add_epi16(_mm_add_epi16(_mm_srli_epi16(upper->first, 13), _mm_srli_epi16(upper->second, 13)),
                      _mm_add_epi16(_mm_srli_epi16(lower->first, 13), _mm_srli_epi16(lower->second, 13))));
    const __m128i green = _mm_srli_epi16(_mm_add_epi16(greens, _mm_set1_epi16(2)), 2);
    return _mm_or_si128(
        _mm_or_si128(_mm_and_si128(_mm_srli_epi16(reds, 2), red), _mm_and_si128(_mm_srli_epi16(blues, 2), blue)),
        _mm_or_si128(_mm_srli_epi16(green, 3), _mm_slli_epi16(green, 13)));
}

static inline __m128i load(const uint16_t *from)
{
    return _mm_loadu_si128((const __m128i *)from);
}

static inline void halve8(uint16_t *to, const uint16_t *upper, const uint16_t *lower)
{
    const __m128i low = load(upper), high = load(upper + 8), below_low = load(lower), below_high = load(lower + 8);
    const struct pairs8 above = pairs8_of(low, high);
    const __m128i rows = _mm_and_si128(_mm_cmpeq_epi16(low, below_low), _mm_cmpeq_epi16(high, below_high));
    const __m128i same = _mm_and_si128(rows, _mm_cmpeq_epi16(above.first, above.second));
    __m128i means = above.first;
    if (_mm_movemask_epi8(same) != 0xffff) {
        const struct pairs8 below = pairs8_of(below_low, below_high);
        means = means_of(&above, &below);
    }
    _mm_storeu_si128((__m128i *)to, means);
}

void ph_halve(uint16_t *to, const uint16_t *upper, const uint16_t *lower, uint32_t n)
{
    size_t next = ((n - 1) & 7) + 1; /* the first eight overlaps the one behind it */
    for (size_t at = 0; n >= 8 && at < n; at = next, next += 8) {
        halve8(to + at, upper + 2 * at, lower + 2 * at);
    }
    for (; n < 8 && n > 0; n--, to++, upper += 2, lower += 2) {
        *to = ph_mean(upper[0], upper[1], lower[0], lower[1]);
    }
}
