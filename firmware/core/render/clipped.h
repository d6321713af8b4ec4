/* clipped: triangles and lines that may have to be clipped. Private to firmware/core; ph_draw_line is in render.h. */
#ifndef PH_CLIPPED_H
#define PH_CLIPPED_H

#include "clip.h"
#include "list.h"

/* Clips a triangle (under a fisheye: divides it) and lists the pieces that are left. Counts it in the statistics. kind:
 * enum ph_draw_kind. */
void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                     const struct ph_clip_vertex in[3]);
void ph_draw_clipped_line(struct ph_renderer *r, const struct ph_material *material,
                          const struct ph_clip_vertex ends[2]);

#endif
