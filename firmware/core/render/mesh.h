/* mesh: triangles of a mesh on their way to set-up. Private to firmware/core; ph_draw_mesh is in render.h. */
#ifndef PH_MESH_H
#define PH_MESH_H

#include "clip.h"

/* Clips a triangle (under a fisheye: divides it) and sets up the pieces that are left. Counts it in the statistics. */
void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex in[3]);

#endif
