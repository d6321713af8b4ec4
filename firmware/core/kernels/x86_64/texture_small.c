/* ph_texture_small and ph_texture_knee for x86-64, with u and v in one word, and with edges and depth in one vector.
 * See texture_small.h, texture_knee.h.
 */
#include "small_rows.h"
#include "texels2_row.h"
#include "texture_knee.h"
#include "texture_small_portable.h"

/* Draws n pixels of a row from column `from` on. */
static inline __attribute__((always_inline)) void draw_line(const struct texels2_common *t,
                                                            const struct texels2_lines *l, uint16_t *depth,
                                                            int64_t from, int64_t n, __m128i before, unsigned v_down)
{
    struct texels2_walk w = {.before = before};
    texels2_start(l, (uint64_t)from, t->pair_bend[n & 1], &w.at, &w.step);
    texels2_row(t, depth + from + n, (uint64_t)n, &w, v_down);
}

/* Draws n pixels of a row whose depth has a knee, in one or two pieces; gd: in codes above the knee. */
static inline __attribute__((always_inline)) void draw_knee_line(struct texels2_common *t,
                                                                 const struct texels2_lines *l, uint16_t *depth,
                                                                 int64_t from, int64_t n, uint32_t d, uint32_t gd,
                                                                 uint32_t knee, unsigned v_down)
{
    for (int64_t part; n > 0; n -= part, from += part, d += (uint32_t)part * gd) {
        const uint32_t step = d < knee ? 2 * gd : gd;
        part = ph_knee_pixels(d, gd, (uint32_t)n, knee);
        t->gd = _mm_cvtsi32_si128((int)step);
        draw_line(t, l, depth, from, part, _mm_cvtsi32_si128((int)(ph_knee_code(d, knee) - step)), v_down);
    }
}

/* Draws the rows of a triangle; knee: a constant 0 if there is none; v_down: a constant, as in
 * texels2_down. */
static inline __attribute__((always_inline)) uint32_t draw(struct ph_texel_run *r, uint32_t knee, unsigned v_down)
{
    if (!texels2_fit(r)) {
        return ph_texture_small_rows(r, knee);
    }
    struct texels2_lines l = texels2_lines_of(r);
    struct texels2_common t = texels2_common_of(r->row.texels, r->row.u_mask, r->row.v_mask, r->row.depth,
                                                r->row.pixels, r->row.gd, l.bend, v_down);
    const __m128i gd = t.gd;
    __m128i row = _mm_loadu_si128((const __m128i *)&r->row.left),
            down = _mm_loadu_si128((const __m128i *)&r->row.left_dx);
    row = _mm_sub_epi32(row, _mm_slli_si128(gd, 8)); /* depth is that of column -1 */
    uint16_t *depth = r->row.depth;
    uint32_t rows = r->row.rows, lower_rows = r->lower_rows;
    uint64_t count = 0;
    for (;;) {
        do {
            int64_t from = (int16_t)_mm_extract_epi16(row, 1);
            const int64_t to = (int16_t)_mm_extract_epi16(row, 3), n = to - from;
            __asm__("" : "+r"(from)); /* else the compiler extends it a second time */
            if (n > 0) {
                const __m128i before = texels2_depth(row, (uint64_t)from, gd);
                if (knee != 0) {
                    draw_knee_line(&t, &l, depth, from, n, (uint32_t)_mm_cvtsi128_si32(before) + r->row.gd, r->row.gd,
                                   knee, v_down);
                } else {
                    draw_line(&t, &l, depth, from, n, before, v_down);
                }
                count += (uint64_t)n;
            }
            row = _mm_add_epi32(row, down);
            __asm__("" : "+x"(row)); /* else the compiler keeps it in two registers */
            depth = ph_row_below(depth, r->row.stride_bytes);
            texels2_lines_down(&l);
        } while (--rows > 0);
        if (lower_rows == 0) {
            break;
        }
        row = small_below(row, r->lower_is_right, (int32_t)r->lower_x);
        down = small_below(down, r->lower_is_right, (int32_t)r->lower_dx);
        rows = lower_rows;
        lower_rows = 0;
    }
    texels2_give_back(&l, r);
    return (uint32_t)count;
}

uint32_t ph_texture_small(struct ph_texel_run *r)
{
    return texels2_down(r->row.v_mask) == TEXELS2_SMALL ? draw(r, 0, TEXELS2_SMALL) : draw(r, 0, TEXELS2_LARGE);
}

uint32_t ph_texture_knee(struct ph_texel_run *r, uint32_t knee)
{
    return texels2_down(r->row.v_mask) == TEXELS2_SMALL ? draw(r, knee, TEXELS2_SMALL) : draw(r, knee, TEXELS2_LARGE);
}
