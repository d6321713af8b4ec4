/* mesh: triangles and lines on their way to the list. Private to firmware/core; ph_draw_mesh is in render.h. */
#ifndef PH_MESH_H
#define PH_MESH_H

#include "clip.h"
#include "list.h"

/* Clips a triangle (under a fisheye: divides it) and lists the pieces that are left. Counts it in the statistics. kind:
 * enum ph_draw_kind. */
void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                     const struct ph_clip_vertex in[3]);

#endif
