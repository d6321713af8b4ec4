/* ph_texel_run_rows for x86-64, with u and v in one word. See texture_small.h. */
#include "texel_mix.h"
#include "texel_run_plain.h"
#include "texels2.h"

/* Red, green and blue of a texel that stands in a word twice, each with five spare bits above, 3 bits up. */
#define FIELDS (PH_MIX_FIELDS << 3)

/* What draws the pixels of a row; u and v are in w. */
struct lit_row {
    struct texels2_walk w;
    const uint16_t *texels;
    uint64_t mask, bend;
};

static inline __attribute__((always_inline)) void draw_pixel(struct lit_row *r, uint16_t *depth, uint16_t *pixel,
                                                             uint64_t level, uint64_t u_to_v, uint64_t twice)
{
    const uint16_t code = (uint16_t)(r->w.d >> 16);
    if (*depth < code) {
        const uint64_t texel = r->texels[(r->w.at & r->mask) * u_to_v >> 48] * twice;
        const uint32_t lit = (uint32_t)((texel & FIELDS) * level >> 5) & FIELDS;
        *depth = code;
        *pixel = (uint16_t)(lit | lit >> 16);
    }
    r->w.d += r->w.gd;
    r->w.at += r->w.step;
}

/* Draws the n pixels before depth and pixels in light: the last four have one light, so do the four before them, and
 * so on. */
static inline __attribute__((always_inline)) void draw_lit_row(struct lit_row *r, uint16_t *depth, uint16_t *pixels,
                                                               uint32_t n, uint64_t level, uint32_t light,
                                                               uint32_t step)
{
    uint64_t u_to_v = TEXELS2_U_TO_V, twice = 1 << 16 | 1;
    __asm__("" : "+r"(u_to_v), "+r"(twice)); /* see texels2_row */
    intptr_t i = -(intptr_t)n;
    if ((n & 1) != 0) {
        draw_pixel(r, &depth[i], &pixels[i], level, u_to_v, twice);
        r->w.step += r->bend;
        i++;
    }
    if ((i & 2) != 0) {
        draw_pixel(r, &depth[i], &pixels[i], level, u_to_v, twice);
        draw_pixel(r, &depth[i + 1], &pixels[i + 1], level, u_to_v, twice);
        r->w.step += r->bend;
        i += 2;
    }
    if ((n & 3) != 0) {
        level = light >> 24;
        light += step;
    }
    for (; i != 0; i += 4) {
        for (int pair = 0; pair < 4; pair += 2) {
            draw_pixel(r, &depth[i + pair], &pixels[i + pair], level, u_to_v, twice);
            draw_pixel(r, &depth[i + pair + 1], &pixels[i + pair + 1], level, u_to_v, twice);
            r->w.step += r->bend;
        }
        level = light >> 24;
        light += step;
    }
}

uint32_t ph_texel_run_rows(struct ph_texel_run *r, struct ph_texel_row *row)
{
    if (r->kind != PH_TEXEL_ROW_LIT || !texels2_fit(r)) {
        return ph_texel_run_rows_plain(r, row);
    }
    struct texels2_line b = texels2_line(r);
    struct lit_row line = {
        .texels = r->texels, .mask = (uint64_t)r->v_mask << 48 | r->u_mask << 22, .bend = 4 * b.bend};
    const uint32_t gd = r->gd, glight = r->glight, half = (uint32_t)((int32_t)glight >> 1), end = (uint32_t)33 << 24;
    uint16_t *depth = r->depth, *pixels = r->pixels;
    uint32_t d = r->d, light = r->light, count = 0, rows;
    do {
        uint32_t left = r->left, right = r->right;
        for (rows = r->rows; rows > 0; rows--) {
            const int32_t from = (int32_t)left >> 16, to = (int32_t)right >> 16, n = to - from;
            if (n > 0) {
                const uint32_t first = light + (uint32_t)from * glight, more = (uint32_t)(n - 1) & 3;
                if (first >= end || first + (uint32_t)(n - 1) * glight >= end) {
                    break;
                }
                line.w = texels2_walk(&b, from, (uint32_t)n);
                line.w.d = d + (uint32_t)from * gd;
                line.w.gd = gd;
                draw_lit_row(&line, depth + to, pixels + to, (uint32_t)n, (first + more * half) >> 24,
                             first + (more + 2) * glight + half, 4 * glight);
                count += (uint32_t)n;
            }
            left += r->left_dx;
            right += r->right_dx;
            d += r->d_dy;
            light += r->light_dy;
            depth = ph_row_below(depth, r->stride_bytes);
            pixels = ph_row_below(pixels, r->stride_bytes);
            texels2_line_down(&b);
        }
        r->left = left;
        r->right = right;
        r->rows = rows;
    } while (rows == 0 && ph_texel_run_lower(r));
    r->d = d;
    r->light = light;
    r->depth = depth;
    r->pixels = pixels;
    texels2_line_part(&b, r);
    return rows > 0 ? count + ph_texel_run_rows_plain(r, row) : count;
}
