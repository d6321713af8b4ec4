/* The depth of small triangles that crosses octaves. See setup.h. */
#include "setup.h"

#include "knee.h"
#include "lift.h"
#include "planes.h"

PH_TIER(mesh)
bool ph_finish_octaves(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                       const struct ph_sides *sides, const uint32_t d[3], bool has_plane)
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    struct ph_depth any;
    uint8_t block = PH_BLOCK_NONE;
    if (has_plane && ph_small_plane_does(d, t->block)) {
        ph_lift_small(t, ph_depth_top(&r->lens), d);
        small->d = ph_block_rounded(small->d, t->block); /* rounded: see planes.c; the gradients are multiples of 256 */
        return true;
    }
    if (!ph_set_depth(r, t->material, v, sides, &any, &block)) {
        return false;
    }
    t->block = block;
    ph_set_small_depth(t, &any.as.plane);
    return true;
}
