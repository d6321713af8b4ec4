/*
 * shadow: the shadow that a mesh casts on a plane by a point light (source: K. Juenemann, HAW Hamburg,
 * chapter 9: projection onto any plane).
 *
 * Seen from the light, shadow and object are the same picture: every vertex is moved along its ray from the light L
 * onto the plane, s = L + (p - L) H / (H - h), h and H the heights of vertex and light above the plane, and what comes
 * out is drawn as any triangle. Only what lies between plane and light casts a shadow: triangles are cut at h = 0 and
 * at h = 63/64 H (a shadow ends where it is 64 times as far from the light as its object). So there is none where the
 * light is on or below the plane, none of what is below it, and none of what reaches above the light.
 */
#ifndef PH_SHADOW_H
#define PH_SHADOW_H

#include "render.h"

/* The points with normal . p + d = 0; normal . p + d > 0 is the side that the light shines on. World space. */
struct ph_plane_equation {
    struct fx_vec3 normal_q30; /* unit vector, Q2.30 */
    fx_t d;                    /* Q16.16 */
};

/*
 * Lists the shadow of mesh placed by to_world, for a point light at `light` (world space). Call it after the ground is
 * drawn or before, and before ph_frame_bands(); the order does not matter but for speed.
 *
 * material: PH_SHADE_UNLIT in the colour of the shadow, for all parts of the mesh; it must live until the last band is
 *           drawn. two_sided = 0 draws what faces the light (enough for closed meshes), and only if the viewer is on
 * the lit side of the plane; two_sided = 1 everything, seen from both sides. depth_bias 16 is right for most scenes:
 * the shadow is also moved 1/512 of its distance towards the viewer (orthographic: 1/2048 from near to far plane;
 * fisheye: 1/32, as its depth is that much coarser), which moves nothing on the screen. Overlapping triangles have one
 * colour, so their order does not show. Range:    objects within 512 of the light, so that a shadow 64 times as far
 * away fits Q16.16. Shadow points are exact to 1 LSB, times their distance from the light in units of the object's (at
 * most 64). Returns 0, also where there is no shadow; PH_ERR_NOMEM (left out, counted) where the vertices do not fit
 * the budget. Statistics count as in ph_draw_mesh; parts of edges (PH_SHADE_WIRE) cast none.
 */
int ph_draw_shadow(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world,
                   struct fx_vec3 light, const struct ph_plane_equation *plane, const struct ph_material *material);

#endif
