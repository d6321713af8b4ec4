/* See lift.h. */
#include "lift.h"

/* The least and the largest of the depths of three corners. */
struct corner_range {
    uint32_t low, high;
};

static inline struct corner_range range_of(const uint32_t d[3])
{
    const uint32_t low = d[0] < d[1] ? d[0] : d[1], high = d[0] < d[1] ? d[1] : d[0];
    return (struct corner_range){low < d[2] ? low : d[2], high > d[2] ? high : d[2]};
}

/* So many sixteenths of a plane's larger gradient, but at most `size`. */
static inline __attribute__((always_inline)) uint32_t lift_of(const struct ph_plane *plane, uint32_t slope,
                                                              uint32_t size)
{
    const uint32_t right = fx_magnitude((int32_t)plane->gx), below = fx_magnitude((int32_t)plane->gy);
    const uint32_t part = (right > below ? right : below) >> 4, by = part * slope;
    return fx_mulhi_u32(part, slope) == 0 && by < size ? by : size;
}

PH_TIER(seldom)
void ph_lift_plane(const struct ph_material *material, uint32_t top, const uint32_t d[3], struct ph_plane *plane)
{
    if (material->depth_bias_slope == 0) {
        return;
    }
    const struct corner_range range = range_of(d);
    const uint32_t by = lift_of(plane, material->depth_bias_slope, range.high - range.low);
    plane->base += range.high > top ? 0 : by < top - range.high ? by : top - range.high;
}

PH_TIER(seldom) void ph_lift_small(struct ph_triangle *t, uint32_t top, const uint32_t d[3])
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    struct ph_plane plane = {small->d, small->gd, small->d_dy};
    ph_lift_plane(t->material, top, d, &plane);
    small->d = plane.base;
}

PH_TIER(seldom) void ph_lift_codes(struct ph_linear *linear, uint32_t from, uint32_t to, uint32_t nearest)
{
    const uint32_t codes = (to - from) >> 16, most = (UINT32_MAX - nearest) >> 16, bias = linear->bias;
    const uint32_t more = codes < most ? codes : most;
    linear->bias = (uint8_t)(bias + more < 255 ? bias + more : 255);
}

void ph_lift_linear(const struct ph_material *material, const uint32_t w[3], struct ph_depth *depth)
{
    const struct corner_range range = range_of(w);
    const struct ph_plane *const plane = &depth->as.plane;
    struct ph_linear *const linear = &depth->over_w.linear;
    const uint32_t by = lift_of(plane, material->depth_bias_slope, range.high - range.low);
    ph_lift_codes(linear, ph_depth_linear_code(linear, range.low), ph_depth_linear_code(linear, range.low + by),
                  ph_depth_linear_code(linear, range.high));
}
