/* Large Gouraud triangles. See gouraud.h. */
#include "gouraud.h"

#include "edge.h"
#include "planes.h"
#include "raster_rows.h"

/* Whether a triangle of any height is as narrow as a small one, less a pixel, and keeps a pixel off the sides of the
 * picture: edges are rounded. */
static bool is_tall(const struct ph_renderer *r, const struct ph_vertex *const v[3], const struct ph_sides *sides)
{
    const uint32_t dx1 = (uint32_t)sides->dx1, dx2 = (uint32_t)sides->dx2, most = PH_SIDE_SMALL - 256;
    return dx1 + most < 2 * most && dx2 + most < 2 * most && dx2 - dx1 + most < 2 * most &&
           ph_is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width);
}

void ph_take_tall(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides)
{
    if (!is_tall(r, v, sides)) {
        return;
    }
    const struct ph_large *const l = &t->as.large;
    const bool long_left = l->long_left != 0;
    const uint32_t y = (uint32_t)t->y_top;
    const int32_t upper_rows = l->y_mid - t->y_top, lower_rows = t->y_bottom - l->y_mid;
    const struct ph_edge edge = l->long_edge, lower = l->lower, other = upper_rows > 0 ? l->upper : lower;
    const struct ph_edge left = long_left ? edge : other, right = long_left ? other : edge;
    const struct ph_plane depth = l->depth.as.plane, light = l->of.light;
    struct ph_small_triangle *const small = &t->as.small.rows;
    t->kind = PH_KIND_SMALL;
    small->left_dx = (uint32_t)left.dx;
    small->right_dx = (uint32_t)right.dx;
    small->d_dy = depth.gy;
    small->light_dy = light.gy;
    small->gd = depth.gx;
    small->glight = light.gx;
    small->ramp = t->material->ramp;
    small->left = (uint32_t)left.x;
    small->right = (uint32_t)right.x;
    small->d = depth.base + y * depth.gy;
    small->light = light.base + y * light.gy;
    small->lower = lower;
    small->lower_is_right = long_left;
    small->upper_rows = (uint16_t)(upper_rows > 0 ? upper_rows : lower_rows);
    small->lower_rows = (uint16_t)(upper_rows > 0 ? lower_rows : 0);
}

static uint32_t draw_long(const struct ph_triangle *t, const struct ph_band *band)
{
    return ph_draw_long(t, band, ph_long_gouraud, PH_LIGHT_DOWN);
}

const struct ph_gouraud ph_gouraud = {.take_tall = ph_take_tall, .set_light = ph_set_light, .draw_long = draw_long};
