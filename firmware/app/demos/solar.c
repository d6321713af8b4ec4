/*
 * solar: sun, earth and moon as a scene graph; the camera is one of its nodes (source: K. Juenemann, HAW Hamburg,
 * chapter 9, the sun-earth-moon example).
 *
 *   outside   looks down on all of it
 *   sun, moon from the earth's centre to the sun, to the moon
 *   fixed     from the earth's centre to the point (1, 0, 0) of the earth's own frame: it turns with the earth
 *
 * From its own centre the earth is invisible, because its surface faces away.
 */
#include "camera.h"
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES 1024 /* a year of 8 months and 32 days */
#define MONTHS      8
#define DAYS        32
#define STARS       96
#define STARS_FEW   48 /* and coarser spheres, where memory is small */
#define ORBIT_STEPS 48
#define EARTH_ORBIT FX_INT(4)
#define MOON_ORBIT  (FX_ONE * 9 / 10)
#define SKY         FX_INT(40)

enum { SUN, YEAR, EARTH, DAY, MONTH, MOON, NODES };
enum { VIEW_OUTSIDE, VIEW_SUN, VIEW_MOON, VIEW_FIXED };

struct solar {
    struct ph_mesh sphere, sun, earth, moon, stars;
    struct ph_material sun_colour, earth_colours[2], moon_colour, star, orbit;
    struct ph_part earth_parts[2], star_part;
    uint16_t ramps[4][PH_RAMP_SIZE];
    struct fx_vec3 star_corners[3 * STARS];
    uint16_t star_triangles[STARS][3];
    uint16_t earth_triangles[MODEL_ICOSPHERE_TRIANGLES(2)][3];
};

/* Sunlight and no other light; the sun itself shines by its ambient share. */
static const struct ph_scene_light sunlight = {
    .ambient = FX_ONE, .count = 1, .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE * 12 / 10}}};

/* First the triangles whose middle is on land, then those in the sea. */
static void make_continents(struct solar *s)
{
    uint32_t count = 0;
    for (uint32_t pass = 0; pass < 2; pass++) {
        const uint32_t first = count;
        for (uint32_t i = 0; i < s->sphere.triangle_count; i++) {
            const uint16_t *const t = s->sphere.triangles[i];
            const struct fx_vec3 p = s->sphere.positions[t[0]];
            const fx_t hills = fx_sin(p.x * 2 / 5 + p.y / 2) + fx_cos(p.z * 3 / 5 - p.y / 3) + fx_sin(p.y * 2 / 3);
            if ((hills > FX_ONE / 2) == (pass == 0)) {
                s->earth_triangles[count][0] = t[0];
                s->earth_triangles[count][1] = t[1];
                s->earth_triangles[count][2] = t[2];
                count++;
            }
        }
        s->earth_parts[pass] = (struct ph_part){first, count - first, (uint16_t)pass};
    }
    s->earth = s->sphere;
    s->earth.triangles = (const uint16_t(*)[3])s->earth_triangles;
    s->earth.parts = s->earth_parts;
    s->earth.part_count = 2;
    s->earth.materials = s->earth_colours;
}

/* Small triangles all over the sky, and some larger ones; all face the middle. */
static void make_stars(struct solar *s, uint32_t count)
{
    uint32_t random = 12345;
    for (uint32_t i = 0; i < count; i++) {
        struct fx_vec3 p;
        struct fx_vec3 unit;
        fx_t *const axes[3] = {&p.x, &p.y, &p.z};
        for (uint32_t k = 0; k < 3; k++) {
            random = random * 1664525u + 1013904223u;
            *axes[k] = (fx_t)(random >> 15) - FX_ONE;
        }
        fx_vec3_direction_q30(p, &unit);
        const struct fx_vec3 at = fx_vec3_scale_sat((struct fx_vec3){unit.x >> 14, unit.y >> 14, unit.z >> 14}, SKY);
        const struct ph_xform face = ph_object_look_at(at, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
        const fx_t size = FX_ONE / 7 + (fx_t)(random >> 18);
        s->star_corners[3 * i] = ph_xform_point(&face, (struct fx_vec3){-size, -size / 2, 0});
        s->star_corners[3 * i + 1] = ph_xform_point(&face, (struct fx_vec3){size, -size / 2, 0});
        s->star_corners[3 * i + 2] = ph_xform_point(&face, (struct fx_vec3){0, size, 0});
        for (uint32_t k = 0; k < 3; k++) {
            s->star_triangles[i][k] = (uint16_t)(3 * i + k);
        }
    }
    s->star_part = (struct ph_part){0, count, 0};
    s->stars = (struct ph_mesh){.positions = s->star_corners,
                                .triangles = (const uint16_t(*)[3])s->star_triangles,
                                .parts = &s->star_part,
                                .materials = &s->star,
                                .vertex_count = 3 * count,
                                .triangle_count = count,
                                .part_count = 1};
}

static void solar_colours(struct solar *s)
{
    s->sun_colour = demo_lit(s->ramps[0], PH_SHADE_GOURAUD, 255, 215, 70);
    s->sun_colour.ambient = FX_ONE;
    s->earth_colours[0] = demo_lit(s->ramps[1], PH_SHADE_GOURAUD, 90, 180, 80);
    s->earth_colours[1] = demo_lit(s->ramps[2], PH_SHADE_GOURAUD, 50, 110, 225);
    s->moon_colour = demo_lit(s->ramps[3], PH_SHADE_GOURAUD, 200, 200, 190);
    s->earth_colours[0].ambient = s->earth_colours[1].ambient = s->moon_colour.ambient = FX_ONE / 10;
    s->star = demo_unlit(200, 210, 235);
    s->star.two_sided = 1;
    s->orbit = demo_unlit(50, 66, 100);
}

#define ARENA(n)                                                                                                       \
    (MODEL_ROUND8(sizeof(struct solar)) + MODEL_ROUND8(sizeof(struct ph_part)) +                                       \
     MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(n), MODEL_ICOSPHERE_TRIANGLES(n)))

static int solar_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct solar *const s = demo_alloc(arena, sizeof(*s));
    if (!s) {
        return PH_ERR_NOMEM;
    }
    solar_colours(s);
    const bool fine = arena->size >= ARENA(2);
    if (model_icosphere(arena, &s->sphere, fine ? 2 : 1) != PH_OK ||
        model_material(arena, &s->sphere, &s->sun_colour) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    s->sun = s->moon = s->sphere;
    s->moon.materials = &s->moon_colour;
    make_continents(s);
    make_stars(s, fine ? STARS : STARS_FEW);
    context->state = s;
    return PH_OK;
}

/* YEAR and MONTH only turn. The earth leans by 23.4 degrees, and DAY turns it about that axis. */
static int solar_nodes(uint32_t frame, struct ph_xform world[NODES])
{
    const uint32_t year = frame << 22;
    struct ph_node nodes[NODES] = {
        [SUN] = {-1, ph_xform_identity},
        [YEAR] = {-1, ph_xform_rotate_y(year)},
        [EARTH] = {YEAR, ph_xform_translate(EARTH_ORBIT, 0, 0)},
        [DAY] = {EARTH, ph_xform_rotate_z(279172874)}, /* 23.4 degrees */
        [MONTH] = {EARTH, ph_xform_rotate_y(year * (MONTHS - 1))},
        [MOON] = {MONTH, ph_xform_translate(MOON_ORBIT, 0, 0)},
    };
    const struct ph_xform spin = ph_xform_rotate_y(year * (DAYS - 1));
    nodes[DAY].local = ph_xform_mul(&nodes[DAY].local, &spin);
    return ph_nodes_world(nodes, NODES, world);
}

/* The view from the earth's centre towards another node, or along x of the turning earth. */
static struct ph_xform view_from_earth(const struct demo_context *context, const struct ph_xform world[NODES])
{
    const struct fx_vec3 up = {0, FX_ONE, 0};
    struct fx_vec3 target = world[SUN].t;
    if (demo_view_is(context, &demo_solar, VIEW_MOON)) {
        target = world[MOON].t;
    } else if (demo_view_is(context, &demo_solar, VIEW_FIXED)) {
        target = ph_xform_point(&world[DAY], (struct fx_vec3){FX_ONE, 0, 0});
    }
    return ph_view_look_at(world[EARTH].t, target, up);
}

static int solar_camera(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform world[NODES])
{
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_ONE / 4, FX_INT(60));
    struct ph_xform view;
    if (demo_view_is(context, &demo_solar, VIEW_OUTSIDE)) {
        view = demo_look(0, FX_ONE * 26 / 5, FX_ONE * 37 / 5, 0, 0, 0);
        demo_orbit(context, &view, &projection);
    } else {
        view = view_from_earth(context, world);
    }
    return demo_begin(context, r, &view, &projection, &sunlight, ph_rgb565(4, 5, 14));
}

static void draw_orbit(struct ph_renderer *r, const struct ph_xform *around, fx_t radius,
                       const struct ph_material *material)
{
    struct fx_vec3 from = ph_xform_point(around, (struct fx_vec3){radius, 0, 0});
    for (uint32_t i = 1; i <= ORBIT_STEPS; i++) {
        const fx_t turns = (fx_t)(i * 65536 / ORBIT_STEPS);
        const struct fx_vec3 on = {fx_mul_sat(radius, fx_cos(turns)), 0, fx_mul_sat(radius, fx_sin(turns))};
        const struct fx_vec3 to = ph_xform_point(around, on);
        ph_draw_line(r, from, to, material);
        from = to;
    }
}

static int draw_sphere(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *node, fx_t radius)
{
    const struct ph_xform size = ph_xform_scale(radius);
    const struct ph_xform to_world = ph_xform_mul(node, &size);
    return ph_draw_mesh(r, mesh, &to_world);
}

static int solar_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct solar *const s = context->state;
    struct ph_xform world[NODES];
    int status = solar_nodes(frame, world);
    status = status ? status : solar_camera(context, r, world);
    status = status ? status : draw_sphere(r, &s->sun, &world[SUN], FX_ONE);
    status = status ? status : draw_sphere(r, &s->earth, &world[DAY], FX_HALF);
    status = status ? status : draw_sphere(r, &s->moon, &world[MOON], FX_ONE / 6);
    if (status != PH_OK) {
        return status;
    }
    if (demo_view_is(context, &demo_solar, VIEW_OUTSIDE)) {
        draw_orbit(r, &world[SUN], EARTH_ORBIT, &s->orbit);
        draw_orbit(r, &world[EARTH], MOON_ORBIT, &s->orbit);
    }
    return ph_draw_mesh(r, &s->stars, &ph_xform_identity);
}

static const char *const views[] = {"outside", "sun", "moon", "fixed", NULL};

#define VERTICES(stars, n) (3 * (stars) + 3 * MODEL_ICOSPHERE_VERTICES(n))

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {DEMO_ARENA(ARENA(2), 12304), .vertex_max = VERTICES(STARS, 2), .triangle_max = 656, .corner_max = 200},
    {DEMO_ARENA(ARENA(1), 8704), .vertex_max = VERTICES(STARS_FEW, 1), .triangle_max = 280, .corner_max = 200},
};

const struct demo demo_solar = {
    .name = "solar",
    .summary = "sun, earth and moon as a scene graph, also seen from the earth's centre",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    DEMO_ARENA(ARENA(2), 12304),
    .vertex_max = VERTICES(STARS, 2),
    .triangle_max = 720,
    .corner_max = 200,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = solar_init,
    .frame = solar_frame,
};
