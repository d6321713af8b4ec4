/*
 * bounds: meshes and parts that are off the picture are passed over. Private to firmware/core.
 *
 * A mesh names its culling and the culling these functions, so the linker leaves them out of a program without bounds.
 */
#ifndef PH_BOUNDS_H
#define PH_BOUNDS_H

#include "render.h"

struct ph_culling {
    /* Whether the bounds of a mesh, or of its part number i, lie off the picture. Then it is counted. False also if no
     * frame has begun. */
    bool (*cull_mesh)(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);
    bool (*cull_part)(struct ph_renderer *r, const struct ph_mesh *mesh, uint32_t i, const struct ph_xform *to_world);
};

#endif
