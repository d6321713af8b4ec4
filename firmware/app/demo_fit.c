/* demo_fit: see demo_scene.h. */
#include "demo_scene.h"

#define SCALE_40_Q20  2880910 /* 1 / tan(20 degrees) */
#define SIN_ELEVATION 22415   /* 20 degrees */
#define COS_ELEVATION 61584

/* What all points need: the camera's distance, and where the scene begins and ends as seen from the centre. */
struct extent {
    fx_t distance, front, back, radius, bottom;
};

static fx_t larger(fx_t a, fx_t b)
{
    return a > b ? a : b;
}

/*
 * A point at height y, rho from the axis, sweeps a circle. Seen from `elevation` above at distance d, its front and
 * back lie at heights y c -+ rho s and depths d - y s -+ rho c; sideways it reaches furthest where the view touches the
 * circle. Each must stay inside the cone: |height| <= depth / scale.
 */
static void extend(struct extent *e, fx_t y, fx_t rho, fx_t scale_y, fx_t side)
{
    const fx_t up = fx_mul_sat(y, COS_ELEVATION);
    const fx_t lift = fx_mul_sat(y, SIN_ELEVATION);
    const fx_t tilt = fx_mul_sat(rho, SIN_ELEVATION);
    const fx_t reach = fx_mul_sat(rho, COS_ELEVATION);
    const fx_t front = fx_add_sat(lift, reach);
    const fx_t back = fx_sub_sat(reach, lift);
    const fx_t for_front = fx_add_sat(fx_mul_sat(fx_abs_sat(fx_sub_sat(up, tilt)), scale_y), front);
    const fx_t for_back = fx_sub_sat(fx_mul_sat(fx_abs_sat(fx_add_sat(up, tilt)), scale_y), back);
    const fx_t for_side = fx_add_sat(fx_mul_sat(rho, side), lift);
    e->distance = larger(e->distance, larger(for_side, larger(for_front, for_back)));
    e->front = larger(e->front, front);
    e->back = larger(e->back, back);
    e->radius = larger(e->radius, rho);
    e->bottom = y < e->bottom ? y : e->bottom;
}

static struct extent measure(const struct ph_projection *projection, const struct ph_mesh *meshes, uint32_t mesh_count,
                             struct fx_vec3 centre)
{
    const fx_t scale_x = projection->scale_x_q20 >> 4;
    const fx_t scale_y = projection->scale_y_q20 >> 4;
    const fx_t cos_square = fx_mul_sat(COS_ELEVATION, COS_ELEVATION);
    const fx_t side = fx_sqrt(fx_add_sat(fx_mul_sat(scale_x, scale_x), cos_square));
    struct extent e = {.distance = 0};
    for (uint32_t m = 0; m < mesh_count; m++) {
        for (uint32_t i = 0; i < meshes[m].vertex_count; i++) {
            const struct fx_vec3 p = fx_vec3_sub_sat(meshes[m].positions[i], centre);
            extend(&e, p.y, fx_vec3_length_sat((struct fx_vec3){p.x, 0, p.z}), scale_y, side);
        }
    }
    return e;
}

struct demo_fit demo_fit(const struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                         struct fx_vec3 centre)
{
    struct ph_projection projection = demo_perspective(context, SCALE_40_Q20, FX_ONE, FX_INT(2));
    const struct extent e = measure(&projection, meshes, mesh_count, centre);
    const fx_t margin = e.distance / 16 + 1;
    const fx_t distance = fx_add_sat(e.distance, margin);
    /* Depth from the lowest circle's front to its back too: something may lie under the meshes, as wide as they are. */
    const fx_t drop = fx_mul_sat(e.bottom, SIN_ELEVATION);
    const fx_t reach = fx_mul_sat(e.radius, COS_ELEVATION);
    const fx_t clear = distance - larger(e.front, fx_add_sat(reach, drop)) - margin / 2;
    projection.near_z = larger(clear, margin / 2 + 1);
    projection.far_z = fx_add_sat(fx_add_sat(distance, margin), larger(e.back, fx_sub_sat(reach, drop)));

    const struct fx_vec3 eye = {0, fx_mul_sat(distance, SIN_ELEVATION), fx_mul_sat(distance, COS_ELEVATION)};
    const struct ph_xform view = ph_view_look_at(eye, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
    return (struct demo_fit){view, projection, e.radius, e.bottom};
}
