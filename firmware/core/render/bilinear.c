/* The bilinear filter. See bilinear.h, texel_filter.h. */
/* Kits on armv6m: -O2. */
#include "bilinear.h"

#include "texel_mix.h"
#include "texel_rows.h"

/* The fraction of a texel coordinate, in 32nds of a texel. */
static inline int32_t in_32nds(uint32_t v, int down)
{
    return down >= 5 ? (int32_t)v >> (down - 5) : (int32_t)(v << (5 - down));
}

uint16_t ph_bilinear(const struct ph_tile_kind *k, uint32_t u, uint32_t v)
{
    const int32_t across = in_32nds(u, k->u_down) - 16, down = in_32nds(v, k->v_down) - 16;
    const int32_t column = across >> 5, line = down >> 5;
    const uint16_t four[4] = {ph_texel_in(k, column, line), ph_texel_in(k, column + 1, line),
                              ph_texel_in(k, column, line + 1), ph_texel_in(k, column + 1, line + 1)};
    return ph_mix_folded(ph_mix_four(four, (uint32_t)across & 31, (uint32_t)down & 31));
}

uint16_t ph_bilinear_of_row(const struct ph_texel_row *row, uint32_t u, uint32_t v)
{
    return ph_mix_folded(ph_mix_at(row, u, v));
}

const struct ph_filter ph_filter_bilinear = {.draw_row = ph_texel_row_smooth,
                                             .draw_lit_row = ph_texel_row_smooth_lit,
                                             .texel_of_row = ph_bilinear_of_row,
                                             .texel = ph_bilinear};
