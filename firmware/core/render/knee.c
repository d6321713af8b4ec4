/* See knee.h. */
#include "knee.h"

#include "depth.h"
#include "edge.h"
#include "triangle.h"

enum {
    SMALL_UP = 2,        /* octaves: see ph_small_plane_does */
    KNEE_ROOM = 8 << 16, /* 16.16 codes */
};

PH_TIER(scenery) struct ph_octaves ph_octaves_of(const uint32_t d[3], int block)
{
    const int low = ph_depth_lowest(ph_block_exponent(block), ph_block_down(block));
    const int a = ph_depth_octave(d[0], low), b = ph_depth_octave(d[1], low), c = ph_depth_octave(d[2], low);
    return (struct ph_octaves){ph_min(ph_min(a, b), c), ph_max(ph_max(a, b), c)};
}

PH_TIER(scenery) bool ph_small_plane_does(const uint32_t d[3], int block)
{
    const struct ph_octaves at = ph_octaves_of(d, block);
    return at.far - at.near <= 1 && at.far - ph_block_down(block) <= SMALL_UP;
}

/* Finishes the plane of a small triangle with float depth across octaves: it gets its knee. d and its gradients are
 * multiples of 2^down, so no shift loses a bit. */
PH_TIER(scenery) static void bend_plane(struct ph_triangle *t, int octave, uint32_t middle)
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    const int down = ph_block_down(t->block), up = octave - down;
    const uint32_t from = small->left >> 16, above = small->d + from * small->gd - middle;
    small->knee = ph_depth_float16_value(middle, up) +
                  ph_depth_float16_offset(octave, ph_block_exponent(t->block), down) +
                  (ph_depth_bias(t->material) << 13);
    small->gd = ph_depth_float16_slope(small->gd, up);
    small->d_dy = ph_depth_float16_slope(small->d_dy, up);
    small->d = small->knee + ph_depth_float16_slope(above, up) - from * small->gd;
    t->kind = PH_KIND_SMALL_KNEE;
    t->block = PH_BLOCK_NONE;
}

PH_TIER(scenery) void ph_set_knee(struct ph_triangle *t, const uint32_t d[3])
{
    const struct ph_small_triangle *const small = &t->as.small.rows;
    const struct ph_octaves at = ph_octaves_of(d, t->block);
    const int down = ph_block_down(t->block), up = at.near - down;
    const uint32_t middle = ((uint32_t)1 << 31) >> at.near; /* where the near octave ends */
    const uint32_t bottom = at.far == ph_depth_lowest(ph_block_exponent(t->block), down) ? 0 : middle / 2;
    /* A pixel may lie 2^-9 px outside, and its depth some codes beside the corners' plane. */
    const uint32_t gx = ph_without_sign((int32_t)small->gd), gy = ph_without_sign((int32_t)small->d_dy);
    const uint32_t codes = up >= 0 ? KNEE_ROOM >> up : KNEE_ROOM << -up, room = (gx >> 8) + (gy >> 8) + codes;
    if (at.near == 0 || at.far - at.near != 1 || t->material->depth_bias_slope != 0 || /* above the depths d */
        (gx | gy) >> 28 != 0) { /* where the first row begins d has not wrapped */
        return;
    }
    for (int i = 0; i < 3; i++) {
        if (d[i] < bottom + room || d[i] + room > 2 * middle) {
            return;
        }
    }
    bend_plane(t, at.near, middle);
}
