/* Why a picture is empty: see status.h. */
#include "status.h"

#include "list.h"

const char *ph_why_empty(const struct ph_renderer *r)
{
    const struct ph_stats *const s = &r->stats;
    const uint32_t drawn = s->triangles_drawn + s->points_drawn;
    const bool begun = r->list.stage != PH_LIST_CLOSED || r->list.band != PH_NO_BAND;
    return r->band_count == 0 ? "the renderer is not initialised: look at what ph_renderer_init returned"
           : !begun           ? "no frame has begun: look at what ph_frame_begin returned"
           : s->fragments > 0 ? NULL
           : drawn > 0        ? "no band was drawn: call ph_show, or ph_draw_band for each band of ph_frame_bands"
           : s->vertices_dropped > 0 ? "no room for the vertices: make vertex_max or triangle_max larger"
           : s->triangles_dropped > 0
               ? "no room for the triangles: make triangle_max larger; or a blend lacks its `draw`"
           : s->meshes_culled > 0 && s->vertices == 0
               ? "all meshes are off the picture by their bounds: look at the camera and at to_world"
           : s->vertices == 0     ? "nothing was drawn: look at what ph_draw_mesh and the others returned"
           : s->triangles_in == 0 ? "no part of a mesh has triangles, or no line, edge or point can be seen"
                                  : "all triangles face away, lie off the picture, or cover no pixel: look at "
                                    "ph_check_mesh, the camera and "
                                    "to_world, which is ph_xform_identity rather than zero";
}
