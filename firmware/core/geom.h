/*
 * geom: vectors, quaternions, rigid (and uniformly scaled) transforms, projections.
 *
 * Coordinates are right-handed, y points up, and the camera looks along -z, as in OpenGL:
 *
 *        y                Positions are Q16.16, rotations and directions Q2.30.
 *        |                Every sum of products is accumulated in 64 bits and rounded once.
 *        o--- x           Results saturate.
 *       /
 *      z  (towards the viewer)
 *
 * A position whose coordinates are within 18918 of the origin fits Q16.16 after any rotation.
 */
#ifndef GEOM_H
#define GEOM_H

#include "fx.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A vector or a position, in Q16.16 where its function does not say otherwise. */
struct fx_vec3 {
    fx_t x, y, z;
};

/* Sum, difference, product with a number, a + (b - a) t, cross product. */
struct fx_vec3 fx_vec3_add_sat(struct fx_vec3 a, struct fx_vec3 b);
struct fx_vec3 fx_vec3_sub_sat(struct fx_vec3 a, struct fx_vec3 b);
struct fx_vec3 fx_vec3_scale_sat(struct fx_vec3 a, fx_t s);
struct fx_vec3 fx_vec3_lerp_sat(struct fx_vec3 a, struct fx_vec3 b, fx_t t);
struct fx_vec3 fx_vec3_cross_sat(struct fx_vec3 a, struct fx_vec3 b);

/* Dot product. */
fx_t fx_vec3_dot_sat(struct fx_vec3 a, struct fx_vec3 b);

/* Length, error <= 0.5 LSB. */
fx_t fx_vec3_length_sat(struct fx_vec3 a);

/*
 * Direction of a as a unit vector in Q2.30, each component within 8 LSB (2^-27) of the exact one. The zero vector has
 * no direction: the result is (0, 0, 0), and false is returned.
 */
bool fx_vec3_direction_q30(struct fx_vec3 a, struct fx_vec3 *unit_q30);

/* Quaternion in Q2.30; a rotation has length one. */
struct fx_quat {
    int32_t w, x, y, z;
};

/* The rotation by no angle. */
extern const struct fx_quat fx_quat_identity;

/*
 * Rotation about an axis of any length; the zero axis gives the identity. The angle turn32 is in 2^-32 turn, so
 * 0x40000000 is a quarter turn and angles wrap by themselves. It is counter-clockwise seen from the tip of the axis.
 */
struct fx_quat fx_quat_axis(struct fx_vec3 axis, uint32_t turn32);

/* The rotation a after b, normalised. */
struct fx_quat fx_quat_mul(struct fx_quat a, struct fx_quat b);

/* q scaled to length one; the zero quaternion gives the identity. */
struct fx_quat fx_quat_normalise(struct fx_quat q);

/* Normalised linear interpolation from a to b along the shorter arc, t = 0 .. FX_ONE. */
struct fx_quat fx_quat_nlerp(struct fx_quat a, struct fx_quat b, fx_t t);

/* A transform p -> r p + t. r is in Q2.30 (elements from -2 to 2), rows first; t is in Q16.16. */
struct ph_xform {
    int32_t r[3][3];
    struct fx_vec3 t;
};

/* The transform that changes nothing. */
extern const struct ph_xform ph_xform_identity;

/* A rotation about an axis (as fx_quat_axis), a translation, a scale, a rotation with a translation after it. */
struct ph_xform ph_xform_rotate_x(uint32_t turn32);
struct ph_xform ph_xform_rotate_y(uint32_t turn32);
struct ph_xform ph_xform_rotate_z(uint32_t turn32);
struct ph_xform ph_xform_translate(fx_t x, fx_t y, fx_t z);
struct ph_xform ph_xform_scale(fx_t s); /* |s| < 2, saturates */
struct ph_xform ph_xform_quat(struct fx_quat q, struct fx_vec3 t);

/* The transform a after b: p -> a(b(p)). */
struct ph_xform ph_xform_mul(const struct ph_xform *a, const struct ph_xform *b);

/* Inverse of a rigid transform, whose r is orthonormal: r^T, -r^T t. */
struct ph_xform ph_xform_inverse_rigid(const struct ph_xform *a);

/* r p + t; saturates. */
struct fx_vec3 ph_xform_point(const struct ph_xform *a, struct fx_vec3 p);

/* Rotates a direction in Q2.30; the translation has no effect on it. */
struct fx_vec3 ph_xform_direction_q30(const struct ph_xform *a, struct fx_vec3 d_q30);

/*
 * World-to-view transform of a camera at eye that looks at target, as gluLookAt gives it. It is defined for every
 * input: if eye = target, the camera looks along -z; if up is zero or parallel to the view, y takes its place, or z
 * where y is parallel too. The rows of r have length one, and are at right angles within 2^-15: up to so much where up
 * is nearly parallel to the view, which it is within 2^-14. Source: S.-E. Yoon, Rendering, KAIST, ch. 4, eq. 4.6.
 */
struct ph_xform ph_view_look_at(struct fx_vec3 eye, struct fx_vec3 target, struct fx_vec3 up);

struct ph_curved_lens; /* draws through a lens that bends straight lines; see fisheye.h of the renderer */

enum ph_projection_kind { PH_PERSPECTIVE, PH_ORTHOGRAPHIC, PH_FISHEYE };

/*
 * A view volume. In x, scale_x is 2n/(r-l) for a perspective and 2/(r-l) for an orthographic projection, and shift_x is
 * (r+l)/(r-l); likewise in y. These are elements of the OpenGL matrix, with their signs there.
 * A fisheye has no matrix. It is equidistant: a point at the angle theta from the view direction lies f theta from the
 * centre, with the same f on both axes. Its scales are half heights of the picture per radian. Its depth, near_z and
 * far_z are distances from the eye. See fisheye.c.
 * A program that calls ph_projection_fisheye() links what draws with it; no other program does.
 */
struct ph_projection {
    enum ph_projection_kind kind;
    int32_t scale_x_q20, scale_y_q20; /* Q12.20 */
    fx_t shift_x, shift_y;
    fx_t near_z, far_z; /* distances along the view (fisheye: from the eye); a perspective's are positive */
    const struct ph_curved_lens *curved; /* fisheye: set by ph_projection_fisheye(); else NULL */
};

/*
 * Set *p to a view volume. A perspective's scale_y is cot(fov / 2) within 0.501 LSB, its scale_x scale_y / aspect
 * within 0.5 LSB more. Errors: PH_ERR_INVAL: the volume is impossible, and *p stays as it was. That is near <= 0
 * (perspective), far <= near, left >= right, bottom >= top, fov outside 0 .. 180 degrees, aspect <= 0, or a scale that
 * does not fit Q12.20.
 */
int ph_projection_perspective(struct ph_projection *p, fx_t fov_y_deg, fx_t aspect, fx_t near_z, fx_t far_z);
int ph_projection_frustum(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z,
                          fx_t far_z);
int ph_projection_ortho(struct ph_projection *p, fx_t left, fx_t right, fx_t bottom, fx_t top, fx_t near_z, fx_t far_z);

/*
 * Sets *p to a fisheye that sees fov_deg, 10 .. 240 degrees, from the top of the picture to its bottom. A wider picture
 * sees proportionally more to the sides. Nothing is drawn within 10 degrees of straight backwards.
 * Errors: PH_ERR_INVAL: fov_deg is out of its range, near_z <= 0, or far_z <= near_z.
 * Cost:   drawing takes 4 KiB of stack on 32 bits, and many triangles: a room of six walls becomes 1200 at 180 degrees,
 *         2400 at 240.
 */
int ph_projection_fisheye(struct ph_projection *p, fx_t fov_deg, fx_t near_z, fx_t far_z);

#ifdef __cplusplus
}
#endif

#endif
