/* Further ways to state views, placements and projections: see camera.h. */
#include "camera.h"
#include "tier.h"

PH_TIER(seldom) static struct fx_vec3 opposite(struct fx_vec3 v)
{
    return (struct fx_vec3){fx_neg_sat(v.x), fx_neg_sat(v.y), fx_neg_sat(v.z)};
}

PH_TIER(seldom) int ph_camera_from(enum ph_convention convention, struct ph_xform *view, fx_t *near_z, fx_t *far_z)
{
    if (convention == PH_LMU) {
        if (*near_z >= 0 || *far_z >= *near_z || *far_z == FX_MIN) { /* 32768 does not fit */
            return PH_ERR_INVAL;
        }
        *near_z = fx_neg_sat(*near_z);
        *far_z = fx_neg_sat(*far_z);
    } else if (*near_z <= 0 || *far_z <= *near_z) {
        return PH_ERR_INVAL;
    }
    if (convention == PH_D3D) {
        for (int j = 0; j < 3; j++) {
            view->r[2][j] = fx_neg_sat(view->r[2][j]);
        }
        view->t.z = fx_neg_sat(view->t.z);
    }
    return PH_OK;
}

/* The view of a camera at `position`: t = -r position. */
PH_TIER(seldom) static struct ph_xform view_from(const struct ph_xform *rotation, struct fx_vec3 position)
{
    struct ph_xform view = *rotation;
    view.t = opposite(ph_xform_direction_q30(rotation, position));
    return view;
}

PH_TIER(seldom) struct ph_xform ph_view_quat(struct fx_quat orientation, struct fx_vec3 position)
{
    const struct ph_xform camera = ph_xform_quat(fx_quat_normalise(orientation), position);
    return ph_xform_inverse_rigid(&camera);
}

PH_TIER(seldom) struct ph_xform ph_view_rotate_translate(struct fx_vec3 axis, uint32_t turn32, struct fx_vec3 position)
{
    return ph_view_quat(fx_quat_axis(axis, turn32), position);
}

PH_TIER(seldom)
struct ph_xform ph_view_yaw_pitch_roll(struct fx_vec3 position, uint32_t yaw, uint32_t pitch, uint32_t roll)
{
    const struct fx_quat y = fx_quat_axis((struct fx_vec3){0, FX_ONE, 0}, yaw);
    const struct fx_quat x = fx_quat_axis((struct fx_vec3){FX_ONE, 0, 0}, pitch);
    const struct fx_quat z = fx_quat_axis((struct fx_vec3){0, 0, FX_ONE}, roll);
    return ph_view_quat(fx_quat_mul(fx_quat_mul(y, x), z), position);
}

PH_TIER(seldom) struct ph_xform ph_view_phigs(struct fx_vec3 vrp, struct fx_vec3 vpn, struct fx_vec3 vup)
{
    const struct fx_vec3 origin = {0, 0, 0};
    const struct ph_xform at_origin = ph_view_look_at(origin, opposite(vpn), vup);
    return view_from(&at_origin, vrp);
}

PH_TIER(seldom) struct ph_xform ph_object_look_at(struct fx_vec3 position, struct fx_vec3 target, struct fx_vec3 up)
{
    /* An object's +z is a camera's -z: the camera that gives its axes stands at the target and looks back. */
    const struct ph_xform view = ph_view_look_at(target, position, up);
    struct ph_xform placed = ph_xform_inverse_rigid(&view);
    placed.t = position;
    return placed;
}

PH_TIER(seldom) struct ph_xform ph_view_of_node(const struct ph_xform *world)
{
    struct ph_xform rotation = ph_xform_identity;
    for (int j = 0; j < 3; j++) { /* the node's axes, scaled to length one, are the rows of the view */
        const struct fx_vec3 axis = {world->r[0][j], world->r[1][j], world->r[2][j]};
        struct fx_vec3 unit;
        if (fx_vec3_direction_q30(axis, &unit)) {
            rotation.r[j][0] = unit.x;
            rotation.r[j][1] = unit.y;
            rotation.r[j][2] = unit.z;
        }
    }
    return view_from(&rotation, world->t);
}

PH_TIER(seldom)
int ph_projection_pinhole(struct ph_projection *p, fx_t focal, fx_t width, fx_t height, fx_t near_z, fx_t far_z)
{
    if (focal <= 0 || width <= 0 || height <= 0 || near_z <= 0 || far_z <= near_z) {
        return PH_ERR_INVAL;
    }
    const int64_t twice = (int64_t)focal << 21;
    const int64_t x = (twice + width / 2) / width, y = (twice + height / 2) / height;
    if (x <= 0 || x > INT32_MAX || y <= 0 || y > INT32_MAX) {
        return PH_ERR_INVAL;
    }
    *p = (struct ph_projection){PH_PERSPECTIVE, (int32_t)x, (int32_t)y, 0, 0, near_z, far_z, NULL};
    return PH_OK;
}

PH_TIER(seldom) int ph_projection_fit(struct ph_projection *p, fx_t width, fx_t height)
{
    if (p->kind == PH_FISHEYE || width <= 0 || height <= 0 || p->scale_y_q20 <= 0) {
        return PH_ERR_INVAL;
    }
    const int64_t x = (fx_mul_wide(p->scale_y_q20, height) + width / 2) / width;
    if (x <= 0 || x > INT32_MAX) {
        return PH_ERR_INVAL;
    }
    p->scale_x_q20 = (int32_t)x;
    return PH_OK;
}

PH_TIER(seldom) int ph_projection_resize(struct ph_projection *p, fx_t aspect)
{
    return ph_projection_fit(p, aspect, FX_ONE);
}

PH_TIER(seldom) static fx_t size_at(int32_t scale_q20, int64_t twice_z)
{
    if (scale_q20 <= 0) { /* not a valid volume */
        return FX_MAX;
    }
    const int64_t size = ((twice_z << 20) + scale_q20 / 2) / scale_q20;
    return size > FX_MAX ? FX_MAX : (fx_t)size;
}

PH_TIER(seldom) void ph_projection_size_at(const struct ph_projection *p, fx_t z, fx_t *width, fx_t *height)
{
    const int64_t twice = p->kind == PH_PERSPECTIVE ? 2 * (int64_t)(z > 0 ? z : 0) : 2 * (int64_t)FX_ONE;
    *width = size_at(p->scale_x_q20, twice);
    *height = size_at(p->scale_y_q20, twice);
}

/*
 * Twice the angle of (2 distance, height). The 16 bits of fx_atan2 are too few, so the point is turned back by them.
 * The angle that is left is at most 2^-16 turn, so it is its tangent, across / along.
 */
PH_TIER(seldom) fx_t ph_fov_of(fx_t height, fx_t distance)
{
    if (height <= 0) {
        return 0;
    }
    const bool doubles = distance <= FX_MAX / 2 && distance >= FX_MIN / 2;
    const fx_t near = fx_atan2(doubles ? height : height / 2, doubles ? 2 * distance : distance);
    int32_t s, c;
    fx_sincos_q30((uint32_t)near << 16, &s, &c);
    int64_t across = fx_mul_wide(height, c) - 2 * fx_mul_wide(distance, s);
    int64_t along = fx_mul_wide(height, s) + 2 * fx_mul_wide(distance, c);
    if (along >> 54 != 0) { /* the product below shall not overflow */
        across >>= 9;
        along >>= 9;
    }
    const int64_t two_radians = 7509872; /* in degrees */
    return near * 2 * 360 + (fx_t)((across * two_radians + (across > 0 ? along : -along) / 2) / along);
}

PH_TIER(seldom) fx_t ph_distance_of(fx_t height, fx_t fov_deg)
{
    struct ph_projection p;
    if (ph_projection_perspective(&p, fov_deg, FX_ONE, FX_ONE, FX_INT(2)) != PH_OK) {
        return 0;
    }
    return fx_sat64((fx_mul_wide(height, p.scale_y_q20) + (1 << 20)) >> 21);
}

PH_TIER(seldom) static bool parent_is_before(const struct ph_node *nodes, uint32_t i)
{
    return nodes[i].parent < (int32_t)i && nodes[i].parent >= -1;
}

PH_TIER(seldom) int ph_nodes_world(const struct ph_node *nodes, uint32_t count, struct ph_xform *world)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!parent_is_before(nodes, i)) {
            return PH_ERR_INVAL;
        }
        world[i] = nodes[i].parent < 0 ? nodes[i].local : ph_xform_mul(&world[nodes[i].parent], &nodes[i].local);
    }
    return PH_OK;
}

PH_TIER(seldom) int ph_nodes_seen(const struct ph_node *nodes, uint32_t count, uint32_t camera, struct ph_xform *seen)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!parent_is_before(nodes, i) || camera >= count) {
            return PH_ERR_INVAL;
        }
        seen[i] = (struct ph_xform){{{0}}, {0, 0, 0}}; /* marks it as not known yet: no rotation has a row of zeros */
    }
    struct ph_xform up = ph_xform_identity; /* from the camera through its ancestors to the world */
    for (int32_t i = count > 0 ? (int32_t)camera : -1; i >= 0; i = nodes[i].parent) {
        const struct ph_xform inverse = ph_xform_inverse_rigid(&nodes[i].local);
        seen[i] = up;
        up = ph_xform_mul(&up, &inverse);
    }
    for (uint32_t i = 0; i < count; i++) {
        if ((seen[i].r[0][0] | seen[i].r[0][1] | seen[i].r[0][2]) == 0) {
            seen[i] = ph_xform_mul(nodes[i].parent < 0 ? &up : &seen[nodes[i].parent], &nodes[i].local);
        }
    }
    return PH_OK;
}
