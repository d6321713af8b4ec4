/*
 * geom: vectors, quaternions, rigid (and uniformly scaled) transforms, projections.
 *
 * Right-handed, y up, the camera looks along -z (OpenGL's convention):
 *
 *        y                Positions are Q16.16, rotations and directions Q2.30.
 *        |                Every sum of products is accumulated in 64 bits and rounded once.
 *        o--- x           Results saturate.
 *       /
 *      z  (towards the viewer)
 *
 * World range: within 18918 of the origin along each axis every rotated position fits Q16.16.
 */
#ifndef GEOM_H
#define GEOM_H

#include "fx.h"

#include <stdbool.h>

struct fx_vec3 {
    fx_t x, y, z;
};

struct fx_vec3 fx_vec3_add_sat(struct fx_vec3 a, struct fx_vec3 b);
struct fx_vec3 fx_vec3_sub_sat(struct fx_vec3 a, struct fx_vec3 b);
struct fx_vec3 fx_vec3_scale_sat(struct fx_vec3 a, fx_t s);
struct fx_vec3 fx_vec3_lerp_sat(struct fx_vec3 a, struct fx_vec3 b, fx_t t);
struct fx_vec3 fx_vec3_cross_sat(struct fx_vec3 a, struct fx_vec3 b);

/* Rounded once; saturates. */
fx_t fx_vec3_dot_sat(struct fx_vec3 a, struct fx_vec3 b);

/* Length, error <= 0.5 LSB; saturates. */
fx_t fx_vec3_length_sat(struct fx_vec3 a);

/*
 * Direction of a as a unit vector in Q2.30, each component within 8 LSB (2^-27) of the exact direction.
 * The zero vector has no direction: the result is (0, 0, 0) and false is returned.
 */
bool fx_vec3_direction_q30(struct fx_vec3 a, struct fx_vec3 *unit_q30);

/* Quaternion in Q2.30; a rotation has length one. */
struct fx_quat {
    int32_t w, x, y, z;
};

extern const struct fx_quat fx_quat_identity;

/*
 * Rotation about axis (any length; the zero axis gives the identity) by turn32: an angle in 2^-32 of a turn, so that
 * 0x40000000 is a quarter and angles wrap by themselves; counter-clockwise seen from the tip of the axis.
 */
struct fx_quat fx_quat_axis(struct fx_vec3 axis, uint32_t turn32);

/* a after b, normalised. */
struct fx_quat fx_quat_mul(struct fx_quat a, struct fx_quat b);

/* Same direction, length one; the zero quaternion gives the identity. */
struct fx_quat fx_quat_normalise(struct fx_quat q);

/* From a to b along the shorter arc, t 0 .. FX_ONE, normalised linear interpolation. */
struct fx_quat fx_quat_nlerp(struct fx_quat a, struct fx_quat b, fx_t t);

/* p -> r p + t; r in Q2.30 (each element in -2 .. 2), rows first; t in Q16.16. */
struct ph_xform {
    int32_t r[3][3];
    struct fx_vec3 t;
};

extern const struct ph_xform ph_xform_identity;

struct ph_xform ph_xform_rotate_x(uint32_t turn32);
struct ph_xform ph_xform_rotate_y(uint32_t turn32);
struct ph_xform ph_xform_rotate_z(uint32_t turn32);
struct ph_xform ph_xform_translate(fx_t x, fx_t y, fx_t z);
struct ph_xform ph_xform_scale(fx_t s); /* |s| < 2; saturates there */
struct ph_xform ph_xform_quat(struct fx_quat q, struct fx_vec3 t);

/* a after b: p -> a(b(p)). */
struct ph_xform ph_xform_mul(const struct ph_xform *a, const struct ph_xform *b);

/* Inverse of a rotation and translation (r must be orthonormal): r^T, -r^T t. */
struct ph_xform ph_xform_inverse_rigid(const struct ph_xform *a);

struct fx_vec3 ph_xform_point(const struct ph_xform *a, struct fx_vec3 p);

/* r times a direction in Q2.30 (no translation). */
struct fx_vec3 ph_xform_direction_q30(const struct ph_xform *a, struct fx_vec3 d_q30);

/*
 * World-to-view transform of a camera at eye that looks at target; as gluLookAt (source: S.-E. Yoon,
 * Rendering, KAIST, ch. 4). Defined for every input: eye = target looks along -z; up parallel to the view, or zero, is
 * replaced by the coordinate axis (y, else z) that is not.
 */
struct ph_xform ph_view_look_at(struct fx_vec3 eye, struct fx_vec3 target, struct fx_vec3 up);

enum ph_projection_kind { PH_PERSPECTIVE, PH_ORTHOGRAPHIC, PH_FISHEYE };

/*
 * A view volume. scale_x = 2n/(r-l) for a perspective, 2/(r-l) for an orthographic projection, in Q12.20;
 * shift_x = (r+l)/(r-l) in Q16.16 likewise in y (the elements of the OpenGL matrix, their signs as there).
 * A fisheye (which has no matrix) is equidistant: a point at the angle theta from the view direction lies at the
 * distance f theta from the centre, both axes with the same f. Its scales are half heights of the picture per radian;
 * its depth, near_z and far_z are distances from the eye in all directions. See fisheye.c.
 */
struct ph_projection {
    enum ph_projection_kind kind;
    int32_t scale_x_q20, scale_y_q20;
    fx_t shift_x, shift_y;
    fx_t near_z, far_z; /* distances along the view, both positive for a perspective; fisheye: from the eye */
};

/*
 * All return 0, or PH_ERR_INVAL and leave *p alone for an impossible volume: near <= 0 (perspective), far <= near,
 * left = right, bottom = top, fov outside 0 .. 180 degrees, aspect <= 0, or a scale that does not fit Q12.20.
 */
int ph_projection_perspective(struct ph_projection *p, fx_t fov_y_deg, fx_t aspect, fx_t near_z, fx_t far_z);
int ph_projection_frustum(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z,
                          fx_t far_z);
int ph_projection_ortho(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z, fx_t far_z);

/*
 * A fisheye that sees fov_deg, 10 .. 240 degrees, from the top of the picture to its bottom; a wider picture sees in
 * proportion more to the sides. Nothing is drawn within 10 degrees of the direction straight backwards (which only
 * pictures much wider than high show). Drawing takes 4 KiB of stack on 32 bits, and many triangles: a room of six
 * walls becomes 1200 at 180 degrees, 2400 at 240. PH_ERR_INVAL: fov_deg out of its range, near_z <= 0, far_z <= near_z.
 */
int ph_projection_fisheye(struct ph_projection *p, fx_t fov_deg, fx_t near_z, fx_t far_z);

#endif
