/* Light on texels where it is more than 0 .. 32 32nds: highlights. See texel_light.h. */
/* Kits on armv6m: -O2. */
#include "texel_light.h"

#include "planes.h"
#include "span.h"
#include "texel_filter.h"
#include "texel_mix.h"

/* Brings the light of a row's ends into its range. */
static void clamp_light(uint32_t *light, uint32_t *glight, uint32_t n)
{
    const uint32_t most = ((uint32_t)63 << 24) - 1, last = *light + (n - 1) * *glight;
    const uint32_t from = (int32_t)*light < 0 ? 0 : *light > most ? most : *light;
    const uint32_t to = (int32_t)last < 0 ? 0 : last > most ? most : last;
    *light = from;
    const uint32_t step = n > 1 ? fx_quotient_far(from < to ? to - from : from - to, n - 1) : 0;
    *glight = from < to ? step : 0u - step;
}

/* Draws a row in which light is beyond 32 32nds: a highlight. */
static void draw_shining_row(const struct ph_texel_row *row, const struct ph_filter *filter)
{
    struct ph_texel_walk u = row->u, v = row->v;
    uint32_t d = row->d, level = row->level, light = row->light;
    for (uint32_t i = 0, n = row->n; n > 0; i++, n--, d += row->gd) {
        if (ph_nearer16(&row->depth[i], d)) {
            const uint16_t texel = filter != NULL ? filter->texel_of_row(row, u.at, v.at)
                                                  : ph_texel_nearest(row, u.at, v.at, ph_texel_v_down(row->v_mask));
            row->pixels[i] = ph_mix_in_light(texel, level);
        }
        ph_texel_walk_on(&u, n);
        ph_texel_walk_on(&v, n);
        ph_texel_light_on(&level, &light, row->light_step, n);
    }
}

const struct ph_texel_lighting ph_texel_lighting = {.draw_nearest = ph_texel_row_lit,
                                                    .draw_rows = ph_texel_run_rows_lit,
                                                    .clamp_light = clamp_light,
                                                    .draw_shining_row = draw_shining_row,
                                                    .set_texel_light = ph_set_texel_light};
