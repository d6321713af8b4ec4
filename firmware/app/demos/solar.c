/*
 * solar: sun, earth and moon as a scene graph (source: K. Juenemann, HAW Hamburg, chapter 9, the sun-earth-moon
 * example). `outside` looks down on all of it. The other three cameras are nodes of the graph in the earth's centre,
 * and the view is the inverse of their world matrix. Each looks along its own -z:
 *
 *   sun     a child of the earth's place: the sun is always on its -x
 *   moon    a child of the month, whose x axis goes to the moon
 *   fixed   a child of the turning earth: it looks at the point (1, 0, 0) of the earth's own frame
 *
 * From its own centre the earth is invisible, because its surface faces away.
 */
#include "camera.h"
#include "demo_scene.h"
#include "models.h"

#include <string.h>

#define LOOP_FRAMES 1024 /* a year of 8 months and 32 days */
#define MONTHS      8
#define DAYS        32
#define STARS       224
#define STARS_FEW   80 /* and coarser spheres, where memory is small */
#define GLOW_SIDES  16
#define GLOW_FEW    12  /* in a small picture, where the sun is 13 pixels from its middle to its outline */
#define SMALL       135 /* pixels of the smaller side */
#define ORBIT_STEPS 48
#define EARTH_ORBIT FX_INT(4)
#define MOON_ORBIT  (FX_ONE * 9 / 10)
#define SKY         FX_INT(40)

enum { SUN, YEAR, EARTH, DAY, MONTH, MOON, EYE_SUN, EYE_MOON, EYE_FIXED, NODES };

struct solar {
    struct ph_mesh sphere, sun, earth, moon, far_moon, glow, orbit; /* far_moon: it has a few pixels */
    struct ph_material sun_colour, earth_colours[2], moon_colour, star, dim_star, orbit_colour, mark;
    struct ph_part earth_parts[2], far_moon_part, glow_part;
    uint16_t ramps[3][PH_RAMP_SIZE];
    struct ph_node nodes[NODES];
    struct ph_xform world[NODES];
    struct ph_scene_light light;
    uint32_t star_count;
    struct fx_vec3 stars[STARS];
    struct fx_vec3 glow_corners[3 * GLOW_SIDES];
    uint16_t glow_colours[3 * GLOW_SIDES], glow_triangles[4 * GLOW_SIDES][3];
    uint16_t earth_triangles[MODEL_ICOSPHERE_TRIANGLES(2)][3];
    uint16_t far_moon_triangles[MODEL_ICOSPHERE_TRIANGLES(1)][3];
    struct fx_vec3 orbit_corners[ORBIT_STEPS];
    uint16_t orbit_edges[ORBIT_STEPS][2];
};

/* Sunlight, and a weak light from the eye that shows the near side of what stands before the sun. */
static const struct ph_scene_light sunlight = {.ambient = FX_ONE,
                                               .count = 2,
                                               .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE * 12 / 10},
                                                          {.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE / 4}}};

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

/* The moon as the sphere of one level less: its vertices come first, and four triangles in turn are one of it. */
static void make_far_moon(struct solar *s)
{
    for (uint32_t i = 0; i < MODEL_ICOSPHERE_TRIANGLES(1); i++) {
        for (uint32_t k = 0; k < 3; k++) {
            s->far_moon_triangles[i][k] = s->sphere.triangles[4 * i + k][k];
        }
    }
    s->far_moon_part = (struct ph_part){0, MODEL_ICOSPHERE_TRIANGLES(1), 0};
    s->far_moon = s->moon;
    s->far_moon.triangles = (const uint16_t(*)[3])s->far_moon_triangles;
    s->far_moon.parts = &s->far_moon_part;
    s->far_moon.vertex_count = MODEL_ICOSPHERE_VERTICES(1);
    s->far_moon.triangle_count = MODEL_ICOSPHERE_TRIANGLES(1);
}

/* Points all over the sky. */
static void make_stars(struct solar *s, uint32_t count)
{
    uint32_t random = 12345;
    s->star_count = count;
    for (uint32_t i = 0; i < count; i++) {
        struct fx_vec3 p;
        struct fx_vec3 unit;
        fx_t *const axes[3] = {&p.x, &p.y, &p.z};
        for (uint32_t k = 0; k < 3; k++) {
            random = random * 1664525u + 1013904223u;
            *axes[k] = (fx_t)(random >> 15) - FX_ONE;
        }
        fx_vec3_direction_q30(p, &unit);
        s->stars[i] = fx_vec3_scale_sat((struct fx_vec3){unit.x >> 14, unit.y >> 14, unit.z >> 14}, SKY);
    }
}

/* Two rings around the sun's outline, from its colour to that of the sky; they face +z. */
static void make_glow(struct solar *s, uint32_t sides)
{
    const fx_t radii[3] = {FX_ONE * 18 / 20, FX_ONE * 27 / 20, FX_ONE * 38 / 20};
    const uint16_t colours[3] = {ph_rgb565(255, 170, 40), ph_rgb565(90, 45, 20), ph_rgb565(4, 5, 14)};
    for (uint32_t i = 0; i < 3 * sides; i++) {
        const fx_t turns = (fx_t)(i % sides * 65536 / sides), radius = radii[i / sides];
        s->glow_corners[i] = (struct fx_vec3){fx_mul_sat(radius, fx_cos(turns)), fx_mul_sat(radius, fx_sin(turns)), 0};
        s->glow_colours[i] = colours[i / sides];
    }
    for (uint32_t i = 0; i < 2 * sides; i++) {
        const uint16_t in = (uint16_t)i, next = (uint16_t)(i % sides == sides - 1 ? i + 1 - sides : i + 1);
        const uint16_t halves[6] = {in, (uint16_t)(in + sides),   (uint16_t)(next + sides),
                                    in, (uint16_t)(next + sides), next};
        memcpy(s->glow_triangles[2 * i], halves, sizeof(halves));
    }
    s->glow_part = (struct ph_part){0, 4 * sides, 0};
    s->glow = (struct ph_mesh){.positions = s->glow_corners,
                               .triangles = (const uint16_t(*)[3])s->glow_triangles,
                               .parts = &s->glow_part,
                               .materials = &s->sun_colour,
                               .colours = s->glow_colours,
                               .vertex_count = 3 * sides,
                               .triangle_count = 4 * sides,
                               .part_count = 1};
}

/* A circle of EARTH_ORBIT in the plane of x and z; a transform can make it smaller. */
static void make_orbit(struct solar *s)
{
    static const struct ph_part lines = {0, 0, 0};
    for (uint32_t i = 0; i < ORBIT_STEPS; i++) {
        const fx_t turns = (fx_t)(i * 65536 / ORBIT_STEPS);
        s->orbit_corners[i] =
            (struct fx_vec3){fx_mul_sat(EARTH_ORBIT, fx_cos(turns)), 0, fx_mul_sat(EARTH_ORBIT, fx_sin(turns))};
        s->orbit_edges[i][0] = (uint16_t)i;
        s->orbit_edges[i][1] = (uint16_t)((i + 1) % ORBIT_STEPS);
    }
    s->orbit = (struct ph_mesh){.positions = s->orbit_corners,
                                .edges = (const uint16_t(*)[2])s->orbit_edges,
                                .parts = &lines,
                                .materials = &s->orbit_colour,
                                .vertex_count = ORBIT_STEPS,
                                .edge_count = ORBIT_STEPS,
                                .part_count = 1};
}

static void solar_colours(struct solar *s)
{
    s->sun_colour = demo_unlit(255, 235, 150);
    s->earth_colours[0] = demo_lit(s->ramps[0], PH_SHADE_GOURAUD, 90, 180, 80);
    s->earth_colours[1] = demo_lit(s->ramps[1], PH_SHADE_GOURAUD, 50, 110, 225);
    s->moon_colour = demo_lit(s->ramps[2], PH_SHADE_GOURAUD, 200, 200, 190);
    s->earth_colours[0].ambient = s->earth_colours[1].ambient = s->moon_colour.ambient = FX_ONE / 10;
    s->star = demo_unlit(235, 240, 255);
    s->dim_star = demo_unlit(110, 120, 150);
    s->orbit_colour = demo_unlit(50, 66, 100);
    s->orbit_colour.shading = PH_SHADE_WIRE;
    s->mark = demo_unlit(DEMO_MARK_COLOUR);
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
    s->light = sunlight;
    const bool fine = arena->size >= ARENA(2), is_small = context->width <= SMALL || context->height <= SMALL;
    if (model_icosphere(arena, &s->sphere, fine ? 2 : 1) != PH_OK ||
        model_material(arena, &s->sphere, &s->sun_colour) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    s->sun = s->moon = s->sphere;
    s->moon.materials = &s->moon_colour;
    s->far_moon = s->moon;
    if (fine && is_small) {
        make_far_moon(s);
    }
    make_continents(s);
    make_stars(s, fine ? STARS : STARS_FEW);
    make_glow(s, is_small ? GLOW_FEW : GLOW_SIDES);
    make_orbit(s);
    context->state = s;
    return PH_OK;
}

/* YEAR and MONTH only turn. The earth leans by 23.4 degrees, and DAY turns it about that axis. */
static int solar_nodes(uint32_t frame, struct solar *s)
{
    const uint32_t year = frame << 22, quarter = 1u << 30;
    struct ph_node *const n = s->nodes;
    const struct ph_xform spin = ph_xform_rotate_y(year * (DAYS - 1)), lean = ph_xform_rotate_z(279172874);
    n[SUN] = (struct ph_node){-1, ph_xform_identity};
    n[YEAR] = (struct ph_node){-1, ph_xform_rotate_y(year)};
    n[EARTH] = (struct ph_node){YEAR, ph_xform_translate(EARTH_ORBIT, 0, 0)};
    n[DAY] = (struct ph_node){EARTH, ph_xform_mul(&lean, &spin)};
    n[MONTH] = (struct ph_node){EARTH, ph_xform_rotate_y(year * (MONTHS - 1))};
    n[MOON] = (struct ph_node){MONTH, ph_xform_translate(MOON_ORBIT, 0, 0)};
    n[EYE_SUN] = (struct ph_node){EARTH, ph_xform_rotate_y(quarter)};
    n[EYE_MOON] = (struct ph_node){MONTH, ph_xform_rotate_y(0u - quarter)};
    n[EYE_FIXED] = (struct ph_node){DAY, ph_xform_rotate_y(0u - quarter)};
    return ph_nodes_world(n, NODES, s->world);
}

static int solar_camera(const struct demo_context *context, struct ph_renderer *r)
{
    struct solar *const s = context->state;
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_ONE / 4, FX_INT(60));
    struct ph_xform view = demo_look(0, FX_ONE * 26 / 5, FX_ONE * 37 / 5, 0, 0, 0);
    if (demo_view_is(context, &demo_solar, 0)) {
        demo_orbit(context, &view, &projection);
    }
    for (uint32_t eye = EYE_SUN; eye < NODES; eye++) {
        if (demo_view_is(context, &demo_solar, eye - EYE_SUN + 1)) {
            view = ph_view_of_node(&s->world[eye]);
        }
    }
    s->light.lights[1].to_light_q30 = (struct fx_vec3){view.r[2][0], view.r[2][1], view.r[2][2]};
    return demo_begin(context, r, &view, &projection, &s->light, ph_rgb565(4, 5, 14));
}

/* A row of a rotation times a star, off by less than SKY / 512: of both 16 bits or fewer are taken, so that 32 do. */
static fx_t about_row_times(const int32_t row[3], const struct fx_vec3 *p)
{
    return ((row[0] >> 16) * (p->x >> 10) + (row[1] >> 16) * (p->y >> 10) + (row[2] >> 16) * (p->z >> 10)) >> 4;
}

/* Whether a star may be seen: false for most stars outside the picture, at a fiftieth of what a line there costs. */
static bool may_be_seen(const struct ph_renderer *r, const struct fx_vec3 *p)
{
    const struct ph_projection *const lens = &r->projection;
    if (lens->kind != PH_PERSPECTIVE || (lens->shift_x | lens->shift_y) != 0) {
        return true;
    }
    const struct ph_xform *const view = &r->view;
    const fx_t reach = fx_sub_sat(SKY / 16, fx_add_sat(view->t.z, about_row_times(view->r[2], p)));
    if (reach <= 0) {
        return false;
    }
    const fx_t x = fx_add_sat(view->t.x, about_row_times(view->r[0], p));
    const fx_t y = fx_add_sat(view->t.y, about_row_times(view->r[1], p));
    return fx_mul_sat(fx_abs_sat(x), lens->scale_x_q20 >> 4) < reach &&
           fx_mul_sat(fx_abs_sat(y), lens->scale_y_q20 >> 4) < reach;
}

/* Draws the stars as lines of about a pixel and a half. */
static void draw_stars(const struct demo_context *context, struct ph_renderer *r, const struct solar *s)
{
    const int32_t smaller = context->width < context->height ? context->width : context->height;
    const fx_t size = FX_INT(66) / smaller;
    for (uint32_t i = 0; i < s->star_count; i++) {
        const struct fx_vec3 p = s->stars[i];
        const bool steep = p.y > SKY * 2 / 3 || p.y < -SKY * 2 / 3;
        const struct fx_vec3 end = {p.x + (steep ? size : 0), p.y + (steep ? 0 : size), p.z};
        if (may_be_seen(r, &s->stars[i])) {
            ph_draw_line(r, p, end, i % 3 == 0 ? &s->star : &s->dim_star);
        }
    }
}

/* Draws the sun's glow behind the planets: half as far again as the sun, and as much larger. */
static int draw_glow(struct ph_renderer *r, const struct solar *s)
{
    const struct fx_vec3 eye = ph_xform_inverse_rigid(&r->view).t, middle = {0, 0, 0};
    const struct ph_xform facing = ph_object_look_at(middle, eye, (struct fx_vec3){0, FX_ONE, 0});
    const struct ph_xform size = ph_xform_scale(FX_ONE * 3 / 2);
    struct ph_xform at = ph_xform_mul(&facing, &size);
    at.t = (struct fx_vec3){-eye.x / 2, -eye.y / 2, -eye.z / 2};
    return ph_draw_mesh(r, &s->glow, &at);
}

/* Draws a sphere, or an orbit. */
static int draw_round(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *node, fx_t radius)
{
    const struct ph_xform size = ph_xform_scale(radius);
    const struct ph_xform to_world = ph_xform_mul(node, &size);
    return ph_draw_mesh(r, mesh, &to_world);
}

/* A cross on the ground above which the eye of `fixed` hangs in the earth: its place is that of the view's middle, and
 * the stars pass behind it. */
static void draw_mark(struct ph_renderer *r, const struct solar *s)
{
    const fx_t arm = FX_ONE / 48;
    for (uint32_t i = 0; i < 2; i++) {
        const fx_t up = i > 0 ? arm : 0, aside = i > 0 ? 0 : arm;
        const struct fx_vec3 from = {FX_HALF, -up, -aside}, to = {FX_HALF, up, aside};
        ph_draw_line(r, ph_xform_point(&s->world[DAY], from), ph_xform_point(&s->world[DAY], to), &s->mark);
    }
}

static int solar_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct solar *const s = context->state;
    const struct ph_xform *const world = s->world;
    int status = solar_nodes(frame, s);
    status = status ? status : solar_camera(context, r);
    status = status ? status : draw_round(r, &s->sun, &world[SUN], FX_ONE);
    status = status ? status : draw_round(r, &s->earth, &world[DAY], FX_HALF);
    const bool outside = demo_view_is(context, &demo_solar, 0);
    status = status ? status : draw_round(r, outside ? &s->far_moon : &s->moon, &world[MOON], FX_ONE / 6);
    if (outside) {
        status = status ? status : draw_round(r, &s->orbit, &world[SUN], FX_ONE);
        status = status ? status : draw_round(r, &s->orbit, &world[EARTH], MOON_ORBIT / (EARTH_ORBIT / FX_ONE));
    }
    if (status != PH_OK) {
        return status;
    }
    draw_stars(context, r, s);
    if (demo_view_is(context, &demo_solar, EYE_FIXED - EYE_SUN + 1)) {
        draw_mark(r, s);
    }
    return draw_glow(r, s);
}

static const char *const views[] = {"outside", "sun", "moon", "fixed", NULL};

#define VERTICES(n) (3 * GLOW_SIDES + 2 * ORBIT_STEPS + 3 * MODEL_ICOSPHERE_VERTICES(n))

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA(2), .vertex_max = VERTICES(2), .triangle_max = 656, .corner_max = 88},
    {.arena_bytes = ARENA(1), .vertex_max = VERTICES(1), .triangle_max = 300, .corner_max = 48},
};

const struct demo demo_solar = {
    .name = "solar",
    .summary = "sun, earth and moon as a scene graph, also seen from the earth's centre",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA(2),
    .vertex_max = VERTICES(2),
    .triangle_max = 720,
    .corner_max = 208,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = solar_init,
    .frame = solar_frame,
};
