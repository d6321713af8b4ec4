#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES   256
#define SCALE_40_Q20  2880910 /* 1 / tan(20 degrees) */
#define SIN_ELEVATION 22415   /* 20 degrees */
#define COS_ELEVATION 61584
#define SEGMENTS      5

struct turntable {
    const struct ph_mesh *meshes;
    uint32_t mesh_count;
    struct ph_xform view;
    struct fx_vec3 centre;
    struct ph_projection projection;
};

struct pot {
    struct ph_mesh mesh;
    struct ph_material material;
    uint16_t ramp[PH_RAMP_SIZE];
};

/* A key light from the upper left, a weak one from the right that shows the far side. */
static const struct ph_scene_light light = {
    .ambient = FX_ONE,
    .count = 2,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL,
                .intensity = FX_ONE,
                .to_light_q30 = {-536870912, 759250125, 536870912}}, /* (-1, sqrt 2, 1) / 2 */
               {.kind = PH_LIGHT_DIRECTIONAL,
                .intensity = FX_ONE * 3 / 10,
                .to_light_q30 = {966367642, 214748365, -414691770}}}, /* (.9, .2, -.386) */
};

/* How far the camera must be, and where the scene begins and ends as seen from the centre. */
struct extent {
    fx_t distance, front, back;
};

/*
 * A point at height y, rho from the axis, sweeps a circle. Seen from `elevation` above at distance d, its front and
 * back lie at heights y c -+ rho s and depths d - y s -+ rho c; sideways it reaches furthest where the view touches the
 * circle. Each must stay inside the cone: |height| <= depth / scale.
 */
static void extend(struct extent *e, fx_t y, fx_t rho, fx_t scale_y, fx_t side)
{
    const fx_t up = fx_mul_sat(y, COS_ELEVATION);
    const fx_t near_by = fx_mul_sat(y, SIN_ELEVATION);
    const fx_t tilt = fx_mul_sat(rho, SIN_ELEVATION);
    const fx_t reach = fx_mul_sat(rho, COS_ELEVATION);
    const fx_t front = fx_add_sat(near_by, reach);
    const fx_t back = fx_sub_sat(reach, near_by);
    const fx_t needs[3] = {
        fx_add_sat(fx_mul_sat(fx_abs_sat(fx_sub_sat(up, tilt)), scale_y), front),
        fx_sub_sat(fx_mul_sat(fx_abs_sat(fx_add_sat(up, tilt)), scale_y), back),
        fx_add_sat(fx_mul_sat(rho, side), near_by),
    };
    for (int i = 0; i < 3; i++) {
        e->distance = needs[i] > e->distance ? needs[i] : e->distance;
    }
    e->front = front > e->front ? front : e->front;
    e->back = back > e->back ? back : e->back;
}

static struct extent measure(const struct turntable *t)
{
    const fx_t scale_y = t->projection.scale_y_q20 >> 4;
    const fx_t scale_x = t->projection.scale_x_q20 >> 4;
    const fx_t side = fx_sqrt(fx_mul_sat(scale_x, scale_x) + fx_mul_sat(COS_ELEVATION, COS_ELEVATION));
    struct extent e = {0, 0, 0};
    for (uint32_t m = 0; m < t->mesh_count; m++) {
        const struct ph_mesh *const mesh = &t->meshes[m];
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            const struct fx_vec3 p = fx_vec3_sub_sat(mesh->positions[i], t->centre);
            extend(&e, p.y, fx_vec3_length_sat((struct fx_vec3){p.x, 0, p.z}), scale_y, side);
        }
    }
    return e;
}

int demo_turntable_init(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                        struct fx_vec3 centre)
{
    struct turntable *const t = demo_alloc(&context->arena, sizeof(*t));
    if (!t) {
        return PH_ERR_NOMEM;
    }
    t->meshes = meshes;
    t->mesh_count = mesh_count;
    t->centre = centre;
    t->projection = demo_perspective(context, SCALE_40_Q20, FX_ONE, FX_INT(2));
    const struct extent e = measure(t);
    const fx_t margin = e.distance / 16 + 1;
    const fx_t distance = fx_add_sat(e.distance, margin);
    const fx_t eye_y = fx_mul_sat(distance, SIN_ELEVATION);
    const fx_t eye_z = fx_mul_sat(distance, COS_ELEVATION);
    t->projection.near_z = distance - e.front > margin ? distance - e.front - margin / 2 : margin / 2 + 1;
    t->projection.far_z = fx_add_sat(distance, fx_add_sat(e.back, margin));
    t->view =
        ph_view_look_at((struct fx_vec3){0, eye_y, eye_z}, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
    context->state = t;
    return PH_OK;
}

int demo_turntable_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct turntable *const t = context->state;
    const struct ph_xform to_axis = ph_xform_translate(-t->centre.x, -t->centre.y, -t->centre.z);
    const struct ph_xform turn = ph_xform_rotate_y((frame << 24) - (1u << 28));
    const struct ph_xform to_world = ph_xform_mul(&turn, &to_axis);
    int status = demo_begin(context, r, &t->view, &t->projection, &light, ph_rgb565(28, 36, 52));
    for (uint32_t i = 0; i < t->mesh_count && status == PH_OK; i++) {
        status = ph_draw_mesh(r, &t->meshes[i], &to_world);
    }
    return status;
}

/* The finest teapot for which the arena has room. */
static int turntable_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct pot *const pot = demo_alloc(arena, sizeof(*pot));
    const struct demo_arena rest = *arena;
    if (!pot) {
        return PH_ERR_NOMEM;
    }
    pot->material = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                         .shininess_log2 = 5,
                                         .ambient = FX_ONE / 6,
                                         .diffuse = FX_ONE * 3 / 4,
                                         .specular = FX_ONE * 7 / 10,
                                         .colour = ph_rgb565(214, 96, 48),
                                         .ramp = pot->ramp};
    ph_material_ramp(pot->ramp, 214, 96, 48, pot->material.specular);
    for (uint32_t segments = SEGMENTS; segments >= 2; segments--) {
        *arena = rest;
        if (model_teapot(arena, &pot->mesh, segments) == PH_OK &&
            model_material(arena, &pot->mesh, &pot->material) == PH_OK &&
            demo_turntable_init(context, &pot->mesh, 1, (struct fx_vec3){0, 0, 0}) == PH_OK) {
            return PH_OK;
        }
    }
    return PH_ERR_NOMEM;
}

const struct demo demo_turntable = {
    .name = "turntable",
    .summary = "the teapot, slowly turning in the light",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = MODEL_ROUND8(sizeof(struct pot)) + MODEL_ROUND8(sizeof(struct turntable)) +
                   MODEL_ROUND8(sizeof(struct ph_part)) +
                   MODEL_BYTES(MODEL_TEAPOT_VERTICES(SEGMENTS), MODEL_TEAPOT_TRIANGLES(SEGMENTS)),
    .vertex_max = MODEL_TEAPOT_VERTICES(SEGMENTS),
    .triangle_max = MODEL_TEAPOT_TRIANGLES(SEGMENTS) * 5 / 8,
    .init = turntable_init,
    .frame = demo_turntable_frame,
};
