/* ph_texture_tile for x86-64, with u and v in one word. See texture_tile.h. */
#include "texture_tile_plain.h"

/* All coefficients as 2^32 v + u, so that one operation serves both. */
struct both {
    uint64_t at, step, bend, at_dy, step_dy, bend_dy, at_ddy, step_ddy;
};

#define SIGN   ((uint64_t)1 << 31)     /* added to u, so that it is not negative; a multiple of the texture's width */
#define U_TO_V ((uint64_t)1 << 26 | 1) /* a product with this adds the texel column of u to the texel row of v */

/* Whether |v| is below 2^log2. */
static bool is_below(uint32_t v, int log2)
{
    return v + ((uint32_t)1 << log2) < (uint32_t)2 << log2;
}

/* Whether u, over 32 columns and 16 rows, stays below 2^31 and never wraps. */
static bool fits_both(const struct ph_texel_rows *r)
{
    const struct ph_texel_way *const u = &r->u;
    return r->rows <= 16 && r->u_mask < 512 && is_below(u->at, 30) && is_below(u->step, 23) && is_below(u->bend, 17) &&
           is_below(u->at_dy, 24) && is_below(u->step_dy, 18) && is_below(u->bend_dy, 13) && is_below(u->at_ddy, 19) &&
           is_below(u->step_ddy, 14);
}

static uint64_t both(uint32_t u, uint32_t v)
{
    return ((uint64_t)v << 32) + (uint64_t)(int64_t)(int32_t)u;
}

static void part(uint64_t both, uint32_t *u, uint32_t *v)
{
    *u = (uint32_t)both;
    *v = (uint32_t)((both - (uint64_t)(int64_t)(int32_t)*u) >> 32);
}

/* The state along a row. */
struct walk {
    uint64_t at, step;
    uint32_t d, gd;
};

static inline __attribute__((always_inline)) void draw_texel(struct walk *w, uint16_t *depth, uint16_t *pixel,
                                                             const uint16_t *texels, uint64_t mask, uint64_t u_to_v)
{
    const uint16_t code = (uint16_t)(w->d >> 16);
    if (*depth < code) {
        *depth = code;
        *pixel = texels[(w->at & mask) * u_to_v >> 48];
    }
    w->d += w->gd;
    w->at += w->step;
}

/* Draws a row. The step changes behind every second pixel, counted from the last one. */
static inline void draw_row(const struct ph_texel_rows *r, const struct ph_row_run *row, struct walk w, uint64_t bend,
                            uint64_t mask)
{
    uint16_t *depth = r->depth + row->first, *pixels = r->pixels + row->first;
    const uint16_t *const texels = r->texels;
    uint64_t u_to_v = U_TO_V;
    __asm__("" : "+r"(u_to_v)); /* else the compiler takes several instructions in place of the product */
    if ((row->n & 1) != 0) {
        draw_texel(&w, depth, pixels, texels, mask, u_to_v);
        w.step += bend;
    }
    depth += row->n;
    pixels += row->n;
    for (intptr_t i = -(intptr_t)(row->n & ~(uint32_t)1); i != 0; i += 2) {
        draw_texel(&w, &depth[i], &pixels[i], texels, mask, u_to_v);
        draw_texel(&w, &depth[i + 1], &pixels[i + 1], texels, mask, u_to_v);
        w.step += bend;
    }
}

static void draw_rows(struct ph_texel_rows *r)
{
    struct both b = {both(r->u.at, r->v.at) + SIGN,    both(r->u.step, r->v.step),
                     both(r->u.bend, r->v.bend),       both(r->u.at_dy, r->v.at_dy),
                     both(r->u.step_dy, r->v.step_dy), both(r->u.bend_dy, r->v.bend_dy),
                     both(r->u.at_ddy, r->v.at_ddy),   both(r->u.step_ddy, r->v.step_ddy)};
    const uint64_t mask = (uint64_t)r->v_mask << 48 | r->u_mask << 22;
    const uint64_t outside = (uint64_t)r->v_outside << 32 | r->u_outside;
    while (r->rows > 0) {
        __asm__ volatile("" : : : "memory"); /* the state does not fit the registers: keep all of it in memory */
        struct ph_row_run row;
        if (ph_next_row(r, &row)) {
            const uint64_t first = b.at + row.first * (b.step + row.first * b.bend), i = row.first + row.n - 1;
            if (outside != 0 && (((first ^ SIGN) | ((b.at + i * (b.step + i * b.bend)) ^ SIGN)) & outside) != 0) {
                break;
            }
            const struct walk w = {first, b.step + (uint64_t)row.pair * b.bend, r->d + row.first * r->gd, r->gd};
            draw_row(r, &row, w, 4 * b.bend, mask);
            r->count += row.n;
        }
        ph_row_down(r);
        b.at += b.at_dy;
        b.step += b.step_dy;
        b.bend += b.bend_dy;
        b.at_dy += b.at_ddy;
        b.step_dy += b.step_ddy;
    }
    part(b.at - SIGN, &r->u.at, &r->v.at);
    part(b.step, &r->u.step, &r->v.step);
    part(b.bend, &r->u.bend, &r->v.bend);
    part(b.at_dy, &r->u.at_dy, &r->v.at_dy);
    part(b.step_dy, &r->u.step_dy, &r->v.step_dy);
}

void ph_texture_tile(struct ph_texel_rows *r)
{
    if (fits_both(r)) {
        draw_rows(r);
    } else {
        ph_texture_tile_plain(r);
    }
}
