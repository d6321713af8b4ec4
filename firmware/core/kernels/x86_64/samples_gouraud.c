/* ph_samples_gouraud of kernels.h for x86-64: the samples of 4 whole pixels of a row at once, and before them those of one
 * and of 2; edges and planes step in one addition. */
#include "kernels.h"
#include "pixels8.h"
#include "small_rows.h"

typedef int __attribute__((may_alias)) two_samples;

/* What all rows of a triangle have in common. Each step has that of depth in word 0 and that of light in word 2. */
struct samples {
    const uint16_t *ramp;
    ptrdiff_t to_pixels;      /* from a depth to its pixel, in bytes */
    __m128i pixel, two, four; /* the steps of so many pixels */
    __m128i d, light;         /* of 4 samples and of 4 pixels, less those of the first one */
    __m128i d_four;           /* the step of 4 samples, in all words */
};

/* Loads the samples of 1, 2 or 4 pixels; `pixels` is a constant. */
static inline __attribute__((always_inline)) __m128i load(const uint16_t *from, int pixels)
{
    return pixels == 1   ? _mm_cvtsi32_si128(*(const two_samples *)(const void *)from)
           : pixels == 2 ? _mm_loadl_epi64((const __m128i *)from)
                         : _mm_loadu_si128((const __m128i *)from);
}

static inline __attribute__((always_inline)) void store(uint16_t *to, __m128i samples, int pixels)
{
    if (pixels == 1) {
        *(two_samples *)(void *)to = _mm_cvtsi128_si32(samples);
    } else if (pixels == 2) {
        _mm_storel_epi64((__m128i *)to, samples);
    } else {
        _mm_storeu_si128((__m128i *)to, samples);
    }
}

/* The colours of the samples of 4 pixels, by the top 7 bits of each pixel's light. */
static inline __attribute__((always_inline)) __m128i colours(__m128i light, const uint16_t *ramp, int pixels)
{
    const __m128i entry = _mm_srli_epi32(light, 25);
    __m128i c = _mm_cvtsi32_si128(ramp[_mm_cvtsi128_si32(entry)]);
    c = pixels > 1 ? _mm_insert_epi16(c, ramp[_mm_extract_epi16(entry, 2)], 1) : c;
    c = pixels > 2 ? _mm_insert_epi16(c, ramp[_mm_extract_epi16(entry, 4)], 2) : c;
    c = pixels > 2 ? _mm_insert_epi16(c, ramp[_mm_extract_epi16(entry, 6)], 3) : c;
    return _mm_unpacklo_epi16(c, c);
}

/* Draws the samples of 1, 2 or 4 pixels; at: depth and light of the first sample. */
static inline __attribute__((always_inline)) void draw(const struct samples *f, uint16_t *depth, __m128i at, int pixels)
{
    const __m128i d = _mm_add_epi32(_mm_shuffle_epi32(at, 0), f->d);
    const struct depths8 depths = {d, pixels > 2 ? _mm_add_epi32(d, f->d_four) : d};
    const __m128i light = _mm_add_epi32(_mm_shuffle_epi32(at, _MM_SHUFFLE(2, 2, 2, 2)), f->light);
    const __m128i codes = depths8_codes(&depths), stored = load(depth, pixels), above = _mm_subs_epu16(codes, stored);
    const __m128i hidden = _mm_cmpeq_epi16(above, _mm_setzero_si128());
    uint16_t *const to = (uint16_t *)(void *)((uint8_t *)depth + f->to_pixels);
    const int all = (1 << 4 * pixels) - 1, mask = _mm_movemask_epi8(hidden) & all;
    store(depth, _mm_add_epi16(stored, above), pixels);
    if (mask == 0) {
        store(to, colours(light, f->ramp, pixels), pixels);
    } else if (mask != all) {
        const __m128i there = load(to, pixels), change = _mm_xor_si128(there, colours(light, f->ramp, pixels));
        store(to, _mm_xor_si128(there, _mm_andnot_si128(hidden, change)), pixels);
    }
}

/* Draws a sample that is alone in its pixel. */
static inline void draw_one(const struct samples *f, uint16_t *depth, __m128i at)
{
    const uint16_t code = (uint16_t)_mm_extract_epi16(at, 1);
    if (code > *depth) {
        *depth = code;
        *(uint16_t *)(void *)((uint8_t *)depth + f->to_pixels) = f->ramp[(uint32_t)_mm_extract_epi16(at, 5) >> 9];
    }
}

/* Draws the samples from .. to - 1 of a row; at: depth and light of the first sample of the first pixel. */
static inline void draw_row(const struct samples *f, uint16_t *depth, uint32_t from, uint32_t to, __m128i at,
                            __m128i sample)
{
    uint16_t *first = depth + from;
    uint32_t pixels = to / 2 - from / 2;
    if ((from & 1) != 0) {
        draw_one(f, first, _mm_add_epi32(at, sample));
        at = _mm_add_epi32(at, f->pixel);
        first++;
        pixels--;
    }
    if ((pixels & 1) != 0) {
        draw(f, first, at, 1);
        at = _mm_add_epi32(at, f->pixel);
        first += 2;
    }
    if ((pixels & 2) != 0) {
        draw(f, first, at, 2);
        at = _mm_add_epi32(at, f->two);
        first += 4;
    }
    for (const uint16_t *const end = depth + (to & ~1u); first != end; first += 8) {
        draw(f, first, at, 4);
        at = _mm_add_epi32(at, f->four);
    }
    if ((to & 1) != 0) {
        draw_one(f, first, at);
    }
}

static inline struct samples samples_of(const struct ph_small_triangle *small, const uint16_t *depth, const uint16_t *pixels)
{
    const uint32_t gd = small->gd, glight = small->glight;
    const __m128i pixel = _mm_setr_epi32((int)(2 * gd), 0, (int)glight, 0), two = _mm_add_epi32(pixel, pixel);
    return (struct samples){.ramp = small->ramp,
                         .to_pixels = (const uint8_t *)pixels - (const uint8_t *)depth,
                         .pixel = pixel,
                         .two = two,
                         .four = _mm_add_epi32(two, two),
                         .d = _mm_setr_epi32(0, (int)gd, (int)(2 * gd), (int)(3 * gd)),
                         .light = _mm_setr_epi32(0, (int)glight, (int)(2 * glight), (int)(3 * glight)),
                         .d_four = _mm_set1_epi32((int)(4 * gd))};
}

uint32_t ph_samples_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes)
{
    const __m128i sample = _mm_cvtsi32_si128((int)rows->gd);
    const struct samples f = samples_of(rows, depth, pixels);
    __m128i row = _mm_loadu_si128((const __m128i *)&rows->left);
    __m128i down = _mm_loadu_si128((const __m128i *)&rows->left_dx);
    const __m128i turn = _mm_setr_epi32(0, 0, 0, (int)(rows->light_dy ^ 1));
    if ((rows->light & 1) == 0) { /* it stays from an even row to the odd one */
        down = _mm_xor_si128(down, turn);
    }
    uint32_t count = 0, left = rows->upper_rows, lower_rows = rows->lower_rows;
    for (;;) {
        do {
            const uint32_t from = (uint32_t)_mm_extract_epi16(row, 1), to = (uint32_t)_mm_extract_epi16(row, 3);
            if (to > from) {
                const __m128i across = _mm_mul_epu32(_mm_shuffle_epi32(_mm_cvtsi32_si128((int)(from / 2)), 0), f.pixel);
                draw_row(&f, depth, from, to, _mm_add_epi32(_mm_shuffle_epi32(row, _MM_SHUFFLE(3, 3, 2, 2)), across),
                         sample);
                count += to - from;
            }
            row = _mm_add_epi32(row, down);
            down = _mm_xor_si128(down, turn);
            depth = ph_row_below(depth, stride_bytes);
        } while (--left > 0);
        if (!small_turn(rows, &row, &down, &left, &lower_rows)) {
            return count;
        }
    }
}
