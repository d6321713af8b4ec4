/* ph_texture_small for x86-64, with u and v in one word, and with edges and depth in one vector. See texture_small.h.
 */
#include "small_rows.h"
#include "texels2_row.h"
#include "texture_small_plain.h"

uint32_t ph_texture_small(struct ph_texel_run *r)
{
    if (!texels2_fit(r)) {
        return ph_texture_small_plain(r);
    }
    struct texels2_lines l = texels2_lines_of(r);
    const struct texels2_common t =
        texels2_common_of(r->texels, r->u_mask, r->v_mask, r->depth, r->pixels, r->gd, l.bend);
    __m128i row = _mm_loadu_si128((const __m128i *)&r->left), down = _mm_loadu_si128((const __m128i *)&r->left_dx);
    row = _mm_sub_epi32(row, _mm_slli_si128(t.gd, 8)); /* depth is that of column -1 */
    uint16_t *depth = r->depth;
    uint32_t rows = r->rows, lower_rows = r->lower_rows;
    uint64_t count = 0;
    for (;;) {
        do {
            const int64_t from = (int16_t)_mm_extract_epi16(row, 1), to = (int16_t)_mm_extract_epi16(row, 3),
                          n = to - from;
            if (n > 0) {
                struct texels2_walk w = {.before = texels2_depth(row, (uint64_t)from, t.gd)};
                texels2_start(&l, (uint64_t)from, t.pair_bend[n & 1], &w.at, &w.step);
                texels2_row(&t, depth + to, (uint64_t)n, &w);
                count += (uint64_t)n;
            }
            row = _mm_add_epi32(row, down);
            __asm__("" : "+x"(row)); /* else the compiler keeps it in two registers */
            depth = ph_row_below(depth, r->stride_bytes);
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
