/* Depth of a triangle: see setup_depth.h; the formats are in depth.h. */
#include "setup_depth.h"

#define NOINLINE __attribute__((noinline)) /* keeps rare work out of the registers of what is usual */

static void depth_plane(const struct ph_renderer *r, const struct ph_plane_base *s, const uint32_t v[3], int limit,
                        struct ph_plane *out)
{
    if (r->stats.depth_format >= PH_DEPTH_FIXED24) {
        *out = ph_plane_exact(s, v, limit);
    } else {
        ph_plane_through(out, s, v, limit);
    }
}

/* Depth of the corners in the fixed formats. */
static inline void fixed_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias,
                                uint32_t d[3])
{
    const uint32_t far = ph_depth_far(&r->lens, 0), offset = PH_DEPTH_BIAS_FIXED16 + (bias << 16);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, 0) + offset;
    }
}

uint8_t ph_block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3])
{
    const int above = ph_least_exponent(v) - 2, block = above > 0 ? above : 0;
    const uint32_t far = ph_depth_far(&r->lens, block);
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), far, block);
    }
    const int octave = ph_depth_octave(d[0], block);
    if (!ph_depth_in_octave(d[1], octave, block) || !ph_depth_in_octave(d[2], octave, block)) {
        return (uint8_t)block;
    }
    const uint32_t offset = ph_depth_float16_offset(octave, block) + (bias << 13);
    for (int i = 0; i < 3; i++) { /* in one octave a float is a fixed number with another slope */
        d[i] = ph_depth_float16_value(d[i], octave) + offset;
    }
    return PH_BLOCK_NONE;
}

/* linear-w: the plane of N/w, and how it becomes a code. */
static NOINLINE void setup_linear(const struct ph_renderer *r, const struct ph_plane_base *s,
                                  const struct ph_vertex *const v[3], uint32_t bias, struct ph_triangle *t)
{
    const int least = ph_least_exponent(v);
    const uint32_t w[3] = {ph_over_w(v[0], least), ph_over_w(v[1], least), ph_over_w(v[2], least)};
    t->block = PH_BLOCK_LINEAR;
    t->depth = ph_plane_exact(s, w, 29);
    t->linear = r->lens.linear;
    t->linear.bias = (uint8_t)(t->linear.bias + bias);
    t->linear.down = (int8_t)(t->linear.down - least);
}

void ph_setup_depth(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                    struct ph_triangle *t)
{
    const uint32_t bias = ph_depth_bias(t->material);
    const unsigned format = r->stats.depth_format;
    t->block = PH_BLOCK_NONE;
    uint32_t d[3];
    if (format == PH_DEPTH_FLOAT16 || format == PH_DEPTH_FLOAT24) {
        t->block = ph_block_depths(r, v, bias, d);
        depth_plane(r, s, d, 27, &t->depth);
    } else if (format == PH_DEPTH_LINEAR_W && r->lens.kind != PH_ORTHOGRAPHIC) {
        setup_linear(r, s, v, bias, t);
    } else {
        fixed_depths(r, v, bias, d);
        depth_plane(r, s, d, 28, &t->depth);
    }
}
