/* ph_texel_run_rows for x86-64, with u and v in one word, and with edges and depth in one vector. See texture_small.h.
 */
#include "small_rows.h"
#include "texel_mix.h"
#include "texel_run_portable.h"
#include "texels2_row.h"

/* Red, green and blue of a texel that stands in a word twice, each with five spare bits above, 3 bits up. */
#define FIELDS (PH_MIX_FIELDS << 3)

/* What all rows of a triangle have in common. The compiler must not know `twice`, as in texels2_common_of. */
struct lit_texels {
    struct texels2_common all;
    uint64_t twice;
    uint32_t light_step; /* of four pixels */
};

/* A pixel, its light, and the light of the next four. */
struct lit_walk {
    struct texels2_walk texel;
    uint64_t level;
    uint32_t light;
};

static inline __attribute__((always_inline)) void draw_texel(const struct lit_texels *t, struct lit_walk *w,
                                                             uint16_t *depth)
{
    w->texel.before = _mm_add_epi32(w->texel.before, t->all.gd);
    const uint16_t code = (uint16_t)_mm_extract_epi16(w->texel.before, 1);
    if (*depth < code) {
        const uint64_t texel = t->all.texels[(w->texel.at & t->all.mask) * t->all.u_to_v >> TEXELS2_SMALL] * t->twice;
        const uint32_t lit = (uint32_t)((texel & FIELDS) * w->level >> 5) & FIELDS;
        *depth = code;
        *(uint16_t *)(void *)((uint8_t *)depth + t->all.to_pixels) = (uint16_t)(lit | lit >> 16);
    }
    w->texel.at += w->texel.step;
}

static inline __attribute__((always_inline)) void next_light(const struct lit_texels *t, struct lit_walk *w)
{
    w->texel.step += t->all.bend;
    w->level = w->light >> 24;
    w->light += t->light_step;
}

#define TEXEL(k)                                                                                                       \
    case k:                                                                                                            \
        draw_texel(t, &w, end - (k));
#define NEXT(k)                                                                                                        \
    __attribute__((fallthrough));                                                                                      \
    TEXEL(k)
#define FOUR(k)                                                                                                        \
    NEXT(k) NEXT((k)-1) w.texel.step += t->all.bend;                                                                   \
    NEXT((k)-2) NEXT((k)-3) next_light(t, &w);

/* Draws the n = 1 .. PH_SMALL_COLUMNS pixels before `end`. The step grows behind every second pixel, counted from the
 * last one. The last four have one light, so do the four before them, and so on. */
/* NOLINTNEXTLINE(readability-function-size): 32 times the same */
static inline void draw_row(const struct lit_texels *t, uint16_t *end, uint64_t n, struct lit_walk w)
{
    switch (n) {
        TEXEL(32)
        NEXT(31)
        w.texel.step += t->all.bend;
        NEXT(30)
        NEXT(29)
        next_light(t, &w);
        FOUR(28)
        FOUR(24)
        FOUR(20)
        FOUR(16)
        FOUR(12)
        FOUR(8)
        FOUR(4)
        break;
    default:
        __builtin_unreachable();
    }
}

/* Sets the light of n pixels, of which the first one's is given. False if it is not within 0 .. 32. */
static inline bool set_light(struct lit_walk *w, uint32_t first, uint32_t n, uint32_t glight)
{
    const uint32_t end = (uint32_t)33 << 24, more = (n - 1) & 3, half = (uint32_t)((int32_t)glight >> 1);
    w->level = (first + more * half) >> 24;
    w->light = first + (more + 2) * glight + half;
    return first < end && first + (n - 1) * glight < end;
}

static inline struct lit_texels texels_of(const struct ph_texel_run *r, uint64_t bend)
{
    struct lit_texels t = {texels2_common_of(r->row.texels, r->row.u_mask, r->row.v_mask, r->row.depth, r->row.pixels,
                                             r->row.gd, bend, TEXELS2_SMALL),
                           1 << 16 | 1, 4 * r->row.glight};
    __asm__("" : "+r"(t.twice));
    return t;
}

/* Draws the rows above the lower edge. Those from one on whose light is not within 0 .. 32 are left. */
static inline uint64_t draw_rows(struct ph_texel_run *r, const struct lit_texels *t, struct texels2_lines *l)
{
    const __m128i down = _mm_loadu_si128((const __m128i *)&r->row.left_dx), before = _mm_slli_si128(t->all.gd, 8);
    __m128i row = _mm_sub_epi32(_mm_loadu_si128((const __m128i *)&r->row.left), before);
    uint16_t *depth = r->row.depth;
    uint32_t light = r->row.light, rows = r->row.rows;
    uint64_t count = 0;
    for (; rows > 0; rows--) {
        const int64_t from = (int16_t)_mm_extract_epi16(row, 1), to = (int16_t)_mm_extract_epi16(row, 3), n = to - from;
        if (n > 0) {
            struct lit_walk w = {.texel.before = texels2_depth(row, (uint64_t)from, t->all.gd)};
            if (!set_light(&w, light + (uint32_t)from * r->row.glight, (uint32_t)n, r->row.glight)) {
                break;
            }
            texels2_start(l, (uint64_t)from, t->all.pair_bend[n & 1], &w.texel.at, &w.texel.step);
            draw_row(t, depth + to, (uint64_t)n, w);
            count += (uint64_t)n;
        }
        row = _mm_add_epi32(row, down);
        __asm__("" : "+x"(row)); /* else the compiler keeps it in two registers */
        light += r->row.light_dy;
        depth = ph_row_below(depth, r->row.stride_bytes);
        texels2_lines_down(l);
    }
    _mm_storeu_si128((__m128i *)&r->row.left, _mm_add_epi32(row, before));
    _mm_storeu_si128((__m128i *)&r->row.left_dx, down); /* behind the row's store, which changes the first of them */
    r->row.light = light;
    r->row.rows = rows;
    r->row.depth = depth;
    r->row.pixels = (uint16_t *)(void *)((uint8_t *)depth + t->all.to_pixels);
    return count;
}

uint32_t ph_texel_run_rows(struct ph_texel_run *r, struct ph_texel_row *row)
{
    return ph_texel_run_rows_portable(r, row);
}

uint32_t ph_texel_run_rows_lit(struct ph_texel_run *r, struct ph_texel_row *row)
{
    if (texels2_down(r->row.v_mask) != TEXELS2_SMALL || !texels2_fit(r)) {
        return ph_texel_run_rows(r, row);
    }
    struct texels2_lines l = texels2_lines_of(r);
    const struct lit_texels t = texels_of(r, l.bend);
    uint64_t count = 0;
    do {
        count += draw_rows(r, &t, &l);
    } while (r->row.rows == 0 && ph_texel_run_lower(r));
    texels2_give_back(&l, r);
    return (uint32_t)count + (r->row.rows > 0 ? ph_texel_run_rows(r, row) : 0);
}
