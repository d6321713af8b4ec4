/* demo_fit: see demo_scene.h. */
#include "demo_scene.h"

#define SCALE_40_Q20  2880910 /* 1 / tan(20 degrees) */
#define SIN_ELEVATION 22415   /* 20 degrees */
#define COS_ELEVATION 61584

/* What all points together need: the camera's distance, and where the scene begins and ends as seen from the centre. */
struct extent {
    fx_t distance, front, back, radius, bottom;
};

static fx_t larger(fx_t a, fx_t b)
{
    return a > b ? a : b;
}

/*
 * A point at height y and at distance rho from the axis moves on a circle. Seen from the elevation at distance d, the
 * circle's front and back have heights up -+ tilt and depths d - front, d + back.
 */
struct swing {
    fx_t up, tilt, lift, front, back;
};

static struct swing swing_of(fx_t y, fx_t rho)
{
    struct swing w;
    const fx_t reach = fx_mul_sat(rho, COS_ELEVATION);
    w.up = fx_mul_sat(y, COS_ELEVATION);
    w.tilt = fx_mul_sat(rho, SIN_ELEVATION);
    w.lift = fx_mul_sat(y, SIN_ELEVATION);
    w.front = fx_add_sat(w.lift, reach);
    w.back = fx_sub_sat(reach, w.lift);
    return w;
}

/*
 * The circle must stay inside the view: |height| <= depth / scale at its front, and sideways where the view touches it,
 * rho sqrt(scale_x^2 + cos^2) before the axis. Its back needs nothing more, because scale_y <= 1 / tan(elevation).
 */
static void extend(struct extent *e, fx_t y, fx_t rho, fx_t scale_y, fx_t side)
{
    const struct swing w = swing_of(y, rho);
    const fx_t for_front = fx_add_sat(fx_mul_sat(fx_abs_sat(fx_sub_sat(w.up, w.tilt)), scale_y), w.front);
    const fx_t for_side = fx_add_sat(fx_mul_sat(rho, side), w.lift);
    e->distance = larger(e->distance, larger(for_side, for_front));
    e->front = larger(e->front, w.front);
    e->back = larger(e->back, w.back);
    e->radius = larger(e->radius, rho);
    e->bottom = y < e->bottom ? y : e->bottom;
}

static struct extent measure(const struct ph_projection *projection, const struct ph_mesh *meshes, uint32_t mesh_count,
                             struct fx_vec3 centre)
{
    const fx_t scale_x = projection->scale_x_q20 >> 4, scale_y = projection->scale_y_q20 >> 4;
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

/* How high any point comes in the picture, at most; 1 is the upper edge. */
static fx_t highest(fx_t scale_y, fx_t distance, const struct ph_mesh *meshes, uint32_t mesh_count,
                    struct fx_vec3 centre)
{
    fx_t top = -FX_ONE;
    for (uint32_t m = 0; m < mesh_count; m++) {
        for (uint32_t i = 0; i < meshes[m].vertex_count; i++) {
            const struct fx_vec3 p = fx_vec3_sub_sat(meshes[m].positions[i], centre);
            const struct swing w = swing_of(p.y, fx_vec3_length_sat((struct fx_vec3){p.x, 0, p.z}));
            const fx_t front = fx_div_sat(fx_sub_sat(w.up, w.tilt), fx_sub_sat(distance, w.front));
            const fx_t back = fx_div_sat(fx_add_sat(w.up, w.tilt), fx_add_sat(distance, w.back));
            top = larger(top, fx_mul_sat(larger(front, back), scale_y));
        }
    }
    return top;
}

struct demo_fit demo_fit(const struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                         struct fx_vec3 centre)
{
    struct ph_projection projection = demo_perspective(context, SCALE_40_Q20, FX_ONE, FX_INT(2));
    const struct extent e = measure(&projection, meshes, mesh_count, centre);
    const fx_t margin = e.distance / 16 + 1, distance = fx_add_sat(e.distance, margin);
    /* something as wide as the meshes may lie below them; the depth range includes it */
    const struct swing under = swing_of(e.bottom, e.radius);
    const fx_t clear = distance - larger(e.front, under.front) - margin / 2;
    projection.near_z = larger(clear, margin / 2 + 1);
    projection.far_z = fx_add_sat(fx_add_sat(distance, margin), larger(e.back, under.back));

    /* If there is room above, the picture moves up to show it, until both margins are the same. */
    const fx_t scale_y = projection.scale_y_q20 >> 4;
    const fx_t top = highest(scale_y, distance, meshes, mesh_count, centre);
    const fx_t low = fx_div_sat(fx_sub_sat(under.up, under.tilt), fx_sub_sat(distance, under.front));
    const fx_t middle = (top + larger(fx_mul_sat(low, scale_y), -2 * FX_ONE)) / 2;
    const fx_t room = FX_ONE - FX_ONE / 16 - top, move = -middle < room ? -middle : room;
    projection.shift_y = move > 0 ? -move : 0;

    const struct fx_vec3 eye = {0, fx_mul_sat(distance, SIN_ELEVATION), fx_mul_sat(distance, COS_ELEVATION)};
    const struct ph_xform view = ph_view_look_at(eye, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
    return (struct demo_fit){view, projection, e.radius, e.bottom};
}
