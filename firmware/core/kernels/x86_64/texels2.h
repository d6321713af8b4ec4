/* texels2: u and v in one word, for x86-64. Private to the kernels of this folder. */
#ifndef PH_TEXELS2_H
#define PH_TEXELS2_H

#include "texture_small.h"

#include <emmintrin.h>
#include <stddef.h>

_Static_assert(offsetof(struct ph_texel_rows, d) == offsetof(struct ph_texel_rows, left) + 8 &&
                   offsetof(struct ph_texel_rows, d_dy) == offsetof(struct ph_texel_rows, left_dx) + 8,
               "left, right and d are loaded at once, and so are their steps");
_Static_assert(offsetof(struct ph_texel_line, step_dy) == 12 && offsetof(struct ph_texel_line, bend) == 20,
               "coefficients are loaded four and two at once");

#define TEXELS2_SIGN                                                                                                   \
    ((uint64_t)1 << 31) /* added to u, so that it is not negative; a multiple of the texture's width                   \
                         */

/* How far u and v in one word are shifted down, to become an index: see ph_texel_v_down. */
#define TEXELS2_SMALL 48
#define TEXELS2_LARGE 44

static inline unsigned texels2_down(uint32_t v_mask)
{
    return 32 + ph_texel_v_down(v_mask);
}

/* Whether |v| is below 2^log2. */
static inline bool texels2_below(uint32_t v, int log2)
{
    return v + ((uint32_t)1 << log2) < (uint32_t)2 << log2;
}

static inline uint64_t texels2(uint32_t u, uint32_t v)
{
    return ((uint64_t)v << 32) + (uint64_t)(int64_t)(int32_t)u;
}

static inline void texels2_part(uint64_t both, uint32_t *u, uint32_t *v)
{
    *u = (uint32_t)both;
    *v = (uint32_t)((both - (uint64_t)(int64_t)(int32_t)*u) >> 32);
}

/* Whether each word of v is in -limit .. limit - 1; limits are powers of 2. Adds nothing to `beyond` if it is. */
static inline __m128i texels2_beyond(__m128i beyond, __m128i v, __m128i limit)
{
    const __m128i above = _mm_add_epi32(limit, _mm_sub_epi32(limit, _mm_set1_epi32(1)));
    return _mm_or_si128(beyond, _mm_andnot_si128(above, _mm_add_epi32(v, limit)));
}

/* Whether u and its differences are within limits: of at, step, at_dy, step_dy; of at_ddy, bend. */
static inline bool texels2_within(const struct ph_texel_line *u, __m128i linear, __m128i bent)
{
    const __m128i zero = _mm_setzero_si128();
    const __m128i beyond = texels2_beyond(texels2_beyond(zero, _mm_loadu_si128((const __m128i *)u), linear),
                                          _mm_loadl_epi64((const __m128i *)&u->at_ddy), bent);
    return _mm_movemask_epi8(_mm_cmpeq_epi32(beyond, zero)) == 0xffff;
}

/* Whether u of a run, over 32 columns to both sides and 16 or 32 rows down, stays below 2^31 and never wraps. */
static inline bool texels2_fit(const struct ph_texel_run *r)
{
    const uint32_t rows = r->row.rows + r->lower_rows;
    if (r->row.u_mask >= 512) {
        return false;
    }
    if (rows <= 16) { /* which holds in bands of 16 lines */
        return texels2_within(&r->u, _mm_setr_epi32(1 << 29, 1 << 24, 1 << 24, 1 << 19),
                              _mm_setr_epi32(1 << 21, 1 << 18, 1, 1));
    }
    return rows <= 32 && texels2_within(&r->u, _mm_setr_epi32(1 << 29, 1 << 24, 1 << 24, 1 << 17),
                                        _mm_setr_epi32(1 << 18, 1 << 17, 1, 1));
}

/* u and v of a row in one word, and their step beside it; how both grow to the row below, and how that grows. */
struct texels2_lines {
    __m128i at, dy, ddy;
    uint64_t bend;
};

/* Words of u and of v become pairs: 2^32 v + u, where u may be negative. */
static inline __m128i texels2_lower(__m128i u, __m128i v)
{
    return _mm_unpacklo_epi32(u, _mm_add_epi32(v, _mm_srai_epi32(u, 31)));
}

static inline __m128i texels2_upper(__m128i u, __m128i v)
{
    return _mm_unpackhi_epi32(u, _mm_add_epi32(v, _mm_srai_epi32(u, 31)));
}

static inline struct texels2_lines texels2_lines_of(const struct ph_texel_run *r)
{
    const __m128i u = _mm_loadu_si128((const __m128i *)&r->u), v = _mm_loadu_si128((const __m128i *)&r->v);
    const __m128i bent =
        texels2_lower(_mm_loadl_epi64((const __m128i *)&r->u.at_ddy), _mm_loadl_epi64((const __m128i *)&r->v.at_ddy));
    const __m128i sign = _mm_set_epi64x(0, (int64_t)TEXELS2_SIGN);
    return (struct texels2_lines){_mm_add_epi64(texels2_lower(u, v), sign), texels2_upper(u, v), _mm_move_epi64(bent),
                                  (uint64_t)_mm_cvtsi128_si64(_mm_unpackhi_epi64(bent, bent))};
}

/* Gives u and v back to the run. */
static inline void texels2_give_back(const struct texels2_lines *l, struct ph_texel_run *r)
{
    const __m128i at = _mm_sub_epi64(l->at, _mm_set_epi64x(0, (int64_t)TEXELS2_SIGN));
    const __m128i u =
        _mm_castps_si128(_mm_shuffle_ps(_mm_castsi128_ps(at), _mm_castsi128_ps(l->dy), _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128i v =
        _mm_castps_si128(_mm_shuffle_ps(_mm_castsi128_ps(at), _mm_castsi128_ps(l->dy), _MM_SHUFFLE(3, 1, 3, 1)));
    _mm_storeu_si128((__m128i *)&r->u, u);
    _mm_storeu_si128((__m128i *)&r->v, _mm_sub_epi32(v, _mm_srai_epi32(u, 31)));
}

static inline void texels2_lines_down(struct texels2_lines *l)
{
    l->at = _mm_add_epi64(l->at, l->dy);
    l->dy = _mm_add_epi64(l->dy, l->ddy);
}

/* u and v at column `from`. pair_bend: what the first step of a row of even or odd length, as this one is, has more. */
static inline void texels2_start(const struct texels2_lines *l, uint64_t from, uint64_t pair_bend, uint64_t *at,
                                 uint64_t *step)
{
    const uint64_t bends = from * l->bend;
    const uint64_t middle = (uint64_t)_mm_cvtsi128_si64(_mm_unpackhi_epi64(l->at, l->at)) + bends;
    *at = (uint64_t)_mm_cvtsi128_si64(l->at) + from * middle;
    *step = middle + bends + pair_bend;
}

/* Depth at column `from`; that of column 0 is in word 2 of a row. */
static inline __m128i texels2_depth(__m128i row, uint64_t from, __m128i gd)
{
    const __m128i along = _mm_mul_epu32(_mm_cvtsi32_si128((int)from), gd);
    return _mm_add_epi32(_mm_shuffle_epi32(row, _MM_SHUFFLE(3, 3, 3, 2)), along);
}

#endif
