/*
 * shadow: the shadow that a mesh casts on a plane, lit by a point light.
 *
 * Each vertex p is projected from the light L onto the plane: s = L + (p - L) H / (H - h), with the heights h of the
 * vertex and H of the light above the plane. The projected triangles are drawn like any others.
 *
 * Only the part of a mesh between plane and light casts a shadow: triangles are clipped at the heights 0 and 63/64 H.
 * At the upper one the shadow is 64 times as far from the light as the object. A light on or below the plane casts no
 * shadow.
 *
 * Source: K. Juenemann, HAW Hamburg, chapter 9, projection onto any plane, self-made shadows.
 */
#ifndef PH_SHADOW_H
#define PH_SHADOW_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The plane normal . p + d = 0 in world space. The light shines on its side normal . p + d > 0. */
struct ph_plane_equation {
    struct fx_vec3 normal_q30; /* unit vector, Q2.30; what is beyond -1 .. 1 counts as -1 or 1 */
    fx_t d;                    /* Q16.16 */
};

/*
 * Draws the shadow of a mesh. Call it between ph_frame_begin() and ph_frame_bands(), before or after the ground is
 * drawn: the order changes only the speed.
 *
 * In:     to_world places the mesh, which must lie within 512 of the light, so that its shadow fits Q16.16.
 *         light is the position of the point light in world space.
 *         material holds for all parts of the mesh: PH_SHADE_UNLIT in the colour of the shadow. With a blend the ground
 *         is seen through the shadow; where parts of a mesh that is not convex lie over each other in it, they are
 *         blended one after the other. With two_sided = 0 only triangles that face the light are drawn, which is enough
 *         for closed meshes, and only if the viewer is on the lit side of the plane. With two_sided = 1 all are drawn.
 *         A depth_bias of 16 is right for most scenes. Besides, the shadow is moved towards the viewer by 1/512 of its
 *         distance (orthographic: by 1/2048 of the way from near to far plane; fisheye, whose depth is coarser: by
 *         1/32), which moves nothing on the screen.
 * Out:    0, also where there is no shadow. A point of the shadow is within 1 LSB, times its distance from the light
 *         over the object's (at most 64). Statistics count as in ph_draw_mesh. Wire parts cast no shadow.
 * Errors: PH_ERR_INVAL: to_world, plane or material is NULL, or the mesh is one that ph_draw_mesh refuses.
 *         PH_ERR_NOMEM: the mesh does not fit the vertex budget; its shadow is left out and counted.
 */
int ph_draw_shadow(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world,
                   struct fx_vec3 light, const struct ph_plane_equation *plane, const struct ph_material *material);

#ifdef __cplusplus
}
#endif

#endif
