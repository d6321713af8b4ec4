/* turntable: the teapot, or a model of the user, turns on a platter under two lamps. */
#include "demo_scene.h"
#include "models.h"

#include <string.h>

#define LOOP_FRAMES 256
#define SEGMENTS    5

#define SIDES             32
#define PLATTER_VERTICES  (1 + 4 * SIDES)
#define PLATTER_TRIANGLES (5 * SIDES)

/* The disc below the meshes: a hub and four rings around it. Coordinates are those of the meshes minus their centre. */
struct platter {
    struct ph_mesh mesh;
    struct ph_part part;
    struct ph_material material;
    uint16_t ramp[PH_RAMP_SIZE];
    struct fx_vec3 positions[PLATTER_VERTICES];
    int16_t normals[PLATTER_VERTICES][3];
    uint16_t triangles[PLATTER_TRIANGLES][3];
};

struct turntable {
    const struct ph_mesh *meshes;
    uint32_t mesh_count;
    struct fx_vec3 centre;
    struct demo_fit camera;
    struct platter *platter; /* NULL: there was no room for it */
};

#define BARE_BYTES MODEL_ROUND8(sizeof(struct turntable))
#define FULL_BYTES (BARE_BYTES + MODEL_ROUND8(sizeof(struct platter)))
_Static_assert(FULL_BYTES <= DEMO_TURNTABLE_BYTES, "DEMO_TURNTABLE_BYTES is too small");
_Static_assert(BARE_BYTES <= DEMO_TURNTABLE_BARE_BYTES, "DEMO_TURNTABLE_BARE_BYTES is too small");
_Static_assert(sizeof(struct platter) > DEMO_TURNTABLE_BARE_BYTES, "DEMO_TURNTABLE_BARE_BYTES is too large");

struct pot {
    struct ph_mesh mesh;
    struct ph_material material;
    uint16_t ramp[PH_RAMP_SIZE];
};

const struct ph_scene_light demo_two_lamps = {
    .ambient = FX_ONE,
    .count = 2,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL,
                .intensity = FX_ONE,
                .to_light_q30 = {-536870912, 759250125, 536870912}}, /* (-1, sqrt 2, 1) / 2 */
               {.kind = PH_LIGHT_DIRECTIONAL,
                .intensity = FX_ONE * 3 / 10,
                .to_light_q30 = {966367642, 214748365, -414691770}}}, /* (.9, .2, -.386) */
};

/* Makes ring number `ring` of the platter: radius, height and normal (outwards, upwards). */
static void platter_ring(struct platter *p, uint32_t ring, fx_t radius, fx_t y, int32_t outwards, int32_t upwards)
{
    for (uint32_t i = 0; i < SIDES; i++) {
        const uint32_t v = 1 + ring * SIDES + i;
        const fx_t turns = (fx_t)(i * (65536 / SIDES)), c = fx_cos(turns), s = fx_sin(turns);
        p->positions[v] = (struct fx_vec3){fx_mul_sat(radius, c), y, -fx_mul_sat(radius, s)};
        p->normals[v][0] = (int16_t)fx_mul_sat(outwards, c);
        p->normals[v][1] = (int16_t)upwards;
        p->normals[v][2] = (int16_t)-fx_mul_sat(outwards, s);
    }
}

/*
 * The normals of the hub and the inner ring point away from every light. So the disc is dark below the meshes and
 * brightens towards its edge, as if the meshes threw a soft shadow.
 */
static void make_platter(struct platter *p, fx_t radius, fx_t y)
{
    uint32_t n = 0;
    p->positions[0] = (struct fx_vec3){0, y, 0};
    p->normals[0][0] = p->normals[0][2] = 0;
    p->normals[0][1] = -16384;
    platter_ring(p, 0, fx_mul_sat(radius, FX_ONE * 2 / 5), y, 0, -16384);
    platter_ring(p, 1, radius, y, 0, 16384);
    platter_ring(p, 2, radius, y, 16384, 0);
    platter_ring(p, 3, radius, fx_sub_sat(y, radius / 16), 16384, 0);
    for (uint32_t i = 0; i < SIDES; i++) {
        const uint16_t a = (uint16_t)(1 + i), b = (uint16_t)(1 + (i + 1) % SIDES);
        const uint16_t corners[5][3] = {
            {0, a, b},
            {a, (uint16_t)(a + SIDES), (uint16_t)(b + SIDES)},
            {a, (uint16_t)(b + SIDES), b},
            {(uint16_t)(a + 2 * SIDES), (uint16_t)(a + 3 * SIDES), (uint16_t)(b + 3 * SIDES)},
            {(uint16_t)(a + 2 * SIDES), (uint16_t)(b + 3 * SIDES), (uint16_t)(b + 2 * SIDES)},
        };
        memcpy(p->triangles[n], corners, sizeof(corners));
        n += 5;
    }
    ph_material_ramp(p->ramp, 96, 112, 140, 0);
    p->material = (struct ph_material){
        .shading = PH_SHADE_GOURAUD, .ambient = FX_ONE / 4, .diffuse = FX_ONE * 3 / 4, .ramp = p->ramp};
    p->part = (struct ph_part){0, PLATTER_TRIANGLES, 0};
    p->mesh = (struct ph_mesh){.positions = p->positions,
                               .normals = (const int16_t(*)[3])p->normals,
                               .triangles = (const uint16_t(*)[3])p->triangles,
                               .parts = &p->part,
                               .materials = &p->material,
                               .vertex_count = PLATTER_VERTICES,
                               .triangle_count = PLATTER_TRIANGLES,
                               .part_count = 1};
}

/* Makes the turntable for meshes. camera: around all that has to be in the picture. gap: between the lowest point and
 * the platter, in radii of the meshes. */
static int stand(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count, struct fx_vec3 centre,
                 struct demo_fit camera, fx_t gap)
{
    struct turntable *const t = demo_alloc(&context->arena, sizeof(*t));
    if (!t) {
        return PH_ERR_NOMEM;
    }
    t->meshes = meshes;
    t->mesh_count = mesh_count;
    t->centre = centre;
    t->camera = camera;
    t->platter = demo_alloc(&context->arena, sizeof(*t->platter));
    if (t->platter) {
        make_platter(t->platter, fx_mul_sat(t->camera.radius, FX_ONE * 9 / 10),
                     fx_sub_sat(t->camera.bottom, fx_mul_sat(t->camera.radius, gap)));
    }
    context->state = t;
    return PH_OK;
}

/* A flat floor of the meshes is nearer than the platter by more than any depth format mistakes. */
int demo_turntable_init(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                        struct fx_vec3 centre)
{
    return stand(context, meshes, mesh_count, centre, demo_fit(context, meshes, mesh_count, centre), FX_ONE / 64);
}

int demo_turntable_around(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                          const struct fx_vec3 *points, uint32_t point_count)
{
    const struct fx_vec3 centre = {0, 0, 0};
    const struct ph_mesh around = {.positions = points, .vertex_count = point_count};
    return stand(context, meshes, mesh_count, centre, demo_fit(context, &around, 1, centre), FX_ONE / 64);
}

int demo_turntable_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct turntable *const t = context->state;
    const struct ph_xform to_axis = ph_xform_translate(-t->centre.x, -t->centre.y, -t->centre.z);
    const struct ph_xform turn = ph_xform_rotate_y((frame << 24) - (1u << 28));
    const struct ph_xform to_world = ph_xform_mul(&turn, &to_axis);
    struct demo_fit camera = t->camera;
    demo_orbit(context, &camera.view, &camera.projection);
    const struct ph_scene_light light = demo_studio_light(context);
    int status = demo_begin(context, r, &camera.view, &camera.projection, &light, demo_studio_background(context));
    status = status ? status : demo_draw_meshes(r, t->meshes, t->mesh_count, &to_world);
    return status || !t->platter ? status : ph_draw_mesh(r, &t->platter->mesh, &turn);
}

/* Makes the finest teapot for which the arena has room. The coarsest may stand without the platter. */
static int turntable_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct pot *const pot = demo_alloc(arena, sizeof(*pot));
    const struct demo_arena rest = *arena;
    const struct fx_vec3 centre = {0, 0, 0};
    if (!pot) {
        return PH_ERR_NOMEM;
    }
    pot->material = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                         .shininess_log2 = 4,
                                         .ambient = FX_ONE * 15 / 100,
                                         .diffuse = FX_ONE * 85 / 100,
                                         .specular = FX_ONE * 8 / 10,
                                         .colour = ph_rgb565(224, 104, 52),
                                         .ramp = pot->ramp};
    ph_material_ramp(pot->ramp, 224, 104, 52, pot->material.specular);
    for (uint32_t segments = SEGMENTS; segments >= 2; segments--) {
        *arena = rest;
        if (model_teapot(arena, &pot->mesh, segments) == PH_OK &&
            model_material(arena, &pot->mesh, &pot->material) == PH_OK &&
            stand(context, &pot->mesh, 1, centre, demo_fit(context, &pot->mesh, 1, centre), 0) == PH_OK) {
            return PH_OK;
        }
    }
    return PH_ERR_NOMEM;
}

#define ARENA(n, around)                                                                                               \
    (MODEL_ROUND8(sizeof(struct pot)) + (around) + MODEL_ROUND8(sizeof(struct ph_part)) +                              \
     MODEL_BYTES(MODEL_TEAPOT_VERTICES(n), MODEL_TEAPOT_TRIANGLES(n)))
#define LISTED(n) (MODEL_TEAPOT_TRIANGLES(n) * 5 / 8)
#define WITH_PLATTER(n)                                                                                                \
    .vertex_max = MODEL_TEAPOT_VERTICES(n) + DEMO_TURNTABLE_VERTICES,                                                  \
    .triangle_max = LISTED(n) + DEMO_TURNTABLE_TRIANGLES

static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA(4, FULL_BYTES), WITH_PLATTER(4), .enough_px = 170},
    {.arena_bytes = ARENA(3, FULL_BYTES), WITH_PLATTER(3), .enough_px = 135},
    {.arena_bytes = ARENA(2, FULL_BYTES), WITH_PLATTER(2)},
    {.arena_bytes = ARENA(2, BARE_BYTES), .vertex_max = MODEL_TEAPOT_VERTICES(2), .triangle_max = LISTED(2)},
};

const struct demo demo_turntable = {
    .name = "turntable",
    .summary = "the teapot, slowly turning in the light",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA(SEGMENTS, FULL_BYTES),
    WITH_PLATTER(SEGMENTS),
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = turntable_init,
    .frame = demo_turntable_frame,
};
