/*
 * camera: the ways to state a camera, and its matrices as the textbooks write them.
 *
 * A camera is a view (world to camera, geom.h) and a projection. Internally the camera looks along -z, and n, f are
 * positive distances along the view. The conventions write both down differently, but give the same picture:
 *
 *                 handed   looks along   clip w              near -> far in NDC   n, f given as        screen y
 *   PH_GL         right    -z            -z                  -1 -> +1             distances            down
 *   PH_D3D        left     +z            +z                   0 -> 1              distances            down
 *   PH_LMU        right    -z            z (negative)        +1 -> -1             coordinates, n > f   up
 *   PH_REVERSED   right    -z            -z                   1 -> 0              distances            down
 *
 * Matrices are written as in the sources: rows first, applied to column vectors, in Q16.16. Each element is rounded
 * once from the fields of the view or projection; geom.h says how these are rounded. So at any field of view the
 * element of cot(fov / 2) is within 0.54 LSB, and that of cot(fov / 2) / aspect within 0.54 + 0.04 / aspect.
 *
 * Sources: GL: gluPerspective, glFrustum, glOrtho; EECE 478, viewing and projection; K. Juenemann, HAW Hamburg, chapter
 * 9, camera models and the view pipeline; S.-E. Yoon, Rendering, KAIST, ch. 4. D3D: course 4600, notes 4.1, virtual
 * cameras. LMU: LMU Munich, computer graphics, summer 2020, tutorial 4, camera.
 */
#ifndef PH_CAMERA_H
#define PH_CAMERA_H

#include "geom.h"
#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The conventions of clip space above. */
enum ph_convention { PH_GL, PH_D3D, PH_LMU, PH_REVERSED };

/* A matrix of 4 x 4 numbers, rows first. */
struct ph_mat4 {
    fx_t m[4][4];
};

/* A point in clip space. */
struct ph_vec4 {
    fx_t x, y, z, w;
};

/* Products a b and a v; each element is rounded once and saturates. */
struct ph_mat4 ph_mat4_mul(const struct ph_mat4 *a, const struct ph_mat4 *b);
struct ph_vec4 ph_mat4_apply(const struct ph_mat4 *a, struct ph_vec4 v);

/* The matrix of a transform; its rotation is rounded to Q16.16. */
struct ph_mat4 ph_mat4_xform(const struct ph_xform *a);

/* World to camera coordinates of the convention (PH_D3D: third row is the view direction). */
struct ph_mat4 ph_matrix_view(const struct ph_xform *view, enum ph_convention convention);

/*
 * Camera to clip coordinates.
 * Errors: PH_ERR_INVAL: a fisheye, far_z <= near_z, or a perspective with near_z <= 0. PH_ERR_RANGE: an element does
 *         not fit Q16.16, because near and far plane are too close together.
 */
int ph_matrix_projection(struct ph_mat4 *out, const struct ph_projection *p, enum ph_convention convention);

/* NDC x, y to pixels. y points down, for PH_LMU up. */
struct ph_mat4 ph_matrix_viewport(uint16_t width, uint16_t height, enum ph_convention convention);

/*
 * Converts a camera of a convention to ours, exactly.
 * In:     view in the convention's camera coordinates, near_z and far_z as the convention gives them.
 * Errors: PH_ERR_INVAL: an impossible volume; for PH_LMU, unless 0 > near_z > far_z > -32768.
 */
int ph_camera_from(enum ph_convention convention, struct ph_xform *view, fx_t *near_z, fx_t *far_z);

/* ---- views: world to camera, rigid --------------------------------------------------------------------------- */

/* OpenGL's glRotate(-turn, axis), glTranslate(-position). */
struct ph_xform ph_view_rotate_translate(struct fx_vec3 axis, uint32_t turn32, struct fx_vec3 position);

/* PHIGS: view reference point, view plane normal (towards the viewer), view up vector. Degenerate as in geom.h. */
struct ph_xform ph_view_phigs(struct fx_vec3 vrp, struct fx_vec3 vpn, struct fx_vec3 vup);

/* The camera is turned by yaw about y, then by pitch about its x, then by roll about its z (turn32). */
struct ph_xform ph_view_yaw_pitch_roll(struct fx_vec3 position, uint32_t yaw, uint32_t pitch, uint32_t roll);

/* The camera has this orientation. */
struct ph_xform ph_view_quat(struct fx_quat orientation, struct fx_vec3 position);

/* The camera is a node with this world transform; a scale in it is removed. */
struct ph_xform ph_view_of_node(const struct ph_xform *world);

/* Placement of an object at `position` whose +z points at `target`, as Object3D.lookAt of three.js. */
struct ph_xform ph_object_look_at(struct fx_vec3 position, struct fx_vec3 target, struct fx_vec3 up);

/* ---- projections ---------------------------------------------------------------------------------------------- */

/* A pinhole whose image, width x height, is at the distance focal from it. Errors as ph_projection_perspective. */
int ph_projection_pinhole(struct ph_projection *p, fx_t focal, fx_t width, fx_t height, fx_t near_z, fx_t far_z);

/*
 * Fits the camera to a picture of width x height, in any unit, e.g. pixels; the vertical extent stays. scale_x is
 * scale_y height / width, rounded once: 16:9 and 4:3 are exact, which no aspect in Q16.16 is.
 * Errors: PH_ERR_INVAL: a side that is not more than 0, a scale that does not fit Q12.20, or a fisheye, whose pixels
 * are square whatever the picture.
 */
int ph_projection_fit(struct ph_projection *p, fx_t width, fx_t height);

/* Fits the camera to a picture of another aspect (width / height), as ph_projection_fit(p, aspect, FX_ONE) does. */
int ph_projection_resize(struct ph_projection *p, fx_t aspect);

/* Width and height of the view volume at the distance z along the view, within 0.5 LSB of what the scales say; they
 * saturate. */
void ph_projection_size_at(const struct ph_projection *p, fx_t z, fx_t *width, fx_t *height);

/* Vertical field of view in degrees at which a height h at the distance z fills the picture: 2 atan(h / 2z).
 * Error < 0.52 LSB. 0 if h is not more than 0. */
fx_t ph_fov_of(fx_t height, fx_t distance);

/* The distance at which a height h fills the picture at a vertical field of view in degrees, h / 2 cot(fov / 2), within
 * 0.5 LSB and h 2^-22; it saturates. 0: an angle that ph_projection_perspective() refuses. LMU Munich, tutorial 4, task
 * 4: dollyZoomDist, where h is 2. */
fx_t ph_distance_of(fx_t height, fx_t fov_deg);

/*
 * Projection from the origin onto the plane n.p + d = 0, with the unit vector n in Q2.30: Q = [dE 0; -n^T 0].
 * Projecting twice is projecting once: Q Q = d Q. Source: K. Juenemann, HAW Hamburg, chapter 9.
 */
struct ph_mat4 ph_matrix_plane(struct fx_vec3 normal_q30, fx_t d);

/* ---- scene graph ------------------------------------------------------------------------------------------------ */

/* A node of a scene graph. A camera is a node, too (ph_view_of_node). Parents come before their children. */
struct ph_node {
    int32_t parent; /* index, or -1 */
    struct ph_xform local;
};

/* world[i] = world[parent] local[i]. Errors: PH_ERR_INVAL: a parent does not come before its child. */
int ph_nodes_world(const struct ph_node *nodes, uint32_t count, struct ph_xform *world);

/*
 * seen[i] is node i in the coordinates of node `camera`: draw it with ph_xform_identity as the view. Common ancestors
 * cancel: moving an ancestor of both changes no bit of the picture. The camera and its ancestors must be rigid.
 * Errors: PH_ERR_INVAL: a parent does not come before its child, or there is no such camera.
 */
int ph_nodes_seen(const struct ph_node *nodes, uint32_t count, uint32_t camera, struct ph_xform *seen);

#ifdef __cplusplus
}
#endif

#endif
