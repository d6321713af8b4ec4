/* texel_mix: light and filter of texels, all three channels of a colour in one word. Private to firmware/core. */
#ifndef PH_TEXEL_MIX_H
#define PH_TEXEL_MIX_H

#include "texel_row.h"

/* A colour in wire order, read as little endian, is spread to red, green and blue, each with five spare bits above. */
#define PH_MIX_FIELDS 0x03e0fc1fu
#define PH_MIX_HALVES (16u << 21 | 16u << 10 | 16u)

/* The two bytes in little-endian order, and back, on any CPU. */
static inline uint32_t ph_mix_little(uint32_t v)
{
    const union {
        uint8_t bytes[2];
        uint16_t value;
    } one = {{1, 0}};
    return one.value == 1 ? v : (v >> 8 & 255) | (v & 255) << 8;
}

static inline uint32_t ph_mix_spread(uint16_t wire)
{
    const uint32_t c = ph_mix_little(wire);
    return (c << 16 | c) >> 3 & PH_MIX_FIELDS;
}

static inline uint16_t ph_mix_folded(uint32_t fields)
{
    return (uint16_t)ph_mix_little(fields << 3 | fields >> 13);
}

/* Multiplies the fields of a spread colour by light / 32. */
static inline uint32_t ph_mix_lit(uint32_t fields, uint32_t light)
{
    return fields * light >> 5 & PH_MIX_FIELDS;
}

/* The colour between four texels at fu, fv in 32nds of a texel. */
static inline uint32_t ph_mix_four(const uint16_t texels[4], uint32_t fu, uint32_t fv)
{
    const uint32_t a = ph_mix_spread(texels[0]), b = ph_mix_spread(texels[1]), c = ph_mix_spread(texels[2]);
    const uint32_t d = ph_mix_spread(texels[3]), across = b - a, down = c - a, far = fu * fv >> 5;
    const uint32_t sum = (a << 5) + across * fu + down * fv + (d - b - down) * far;
    return (sum + PH_MIX_HALVES) >> 5 & PH_MIX_FIELDS;
}

/* The bilinear texel at u, v of a row, both in 2^-22 of a texel. */
static inline uint32_t ph_mix_at(const struct ph_texel_row *r, uint32_t u, uint32_t v)
{
    const uint32_t column = u >> 22 & r->u_mask, right = (column + 1) & r->u_mask;
    const uint32_t width = r->u_mask + 1, line = (v >> 22) * width & r->v_mask, below = (line + width) & r->v_mask;
    const uint16_t four[4] = {r->texels[line + column], r->texels[line + right], r->texels[below + column],
                              r->texels[below + right]};
    return ph_mix_four(four, u >> 17 & 31, v >> 17 & 31);
}

/* The nearest texel at u, v of a row; v_down: see ph_texel_v_down. */
static inline uint16_t ph_texel_nearest(const struct ph_texel_row *r, uint32_t u, uint32_t v, uint32_t v_down)
{
    return r->texels[(v >> v_down & r->v_mask) + (u >> 22 & r->u_mask)];
}

/* u or v along n pixels of a row from column `from` on, which is at + i step + i^2 bend at column i. The step of a
 * parabola over two pixels grows by 8 bend from pair to pair, so the step of each pixel grows by 4. */
static inline struct ph_texel_walk ph_texel_walk_from(uint32_t at, uint32_t step, uint32_t bend, uint32_t from,
                                                      uint32_t n)
{
    const uint32_t pair = 2 * (from + 1 - (n & 1)); /* that of the pair which the first pixel begins or ends */
    return (struct ph_texel_walk){at + from * (step + from * bend), step + pair * bend, 4 * bend};
}

static inline void ph_texel_walk_on(struct ph_texel_walk *w, uint32_t left)
{
    w->at += w->step;
    if ((left & 1) != 0) {
        w->step += w->bend;
    }
}

/* The light of the pixel behind the one that is `left` pixels from the row's end. */
static inline void ph_texel_light_on(uint32_t *level, uint32_t *light, uint32_t step, uint32_t left)
{
    if ((left & 3) == 1) {
        *level = *light >> 24;
        *light += step;
    }
}

/* A texel in light of 0 .. 64 32nds. */
static inline uint16_t ph_mix_in_light(uint16_t texel, uint32_t light)
{
    const uint32_t c = ph_mix_spread(texel);
    return light <= 32 ? ph_mix_folded(ph_mix_lit(c, light))
                       : ph_mix_folded(PH_MIX_FIELDS - ph_mix_lit(PH_MIX_FIELDS - c, 64 - light));
}

#endif
