/*
 * The light of a vertex is compared with the textbook formula in double precision: ambient light, and directional and
 * point lights and spots by Lambert and Blinn with the viewer at infinity, for any rotation, uniform scale, position
 * and camera. Coloured lights are three such formulas. The colours of the ramp are their indices: intensity 0 is entry
 * 4, full intensity (1 + specular) is entry 123.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "ref_rig.h"
#include "surface_row.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE  8 /* pixels each way */
#define CASES 4000

typedef double vec[3];

/* A rigid motion with a uniform scale, and the same as the renderer gets it. */
struct motion {
    double r[3][3], t[3], scale;
    struct ph_xform fixed;
};

struct lighting {
    struct ph_scene_light scene;
    struct ph_material material;
    bool coloured; /* the light of each channel counts by itself */
};

static double dot(const vec a, const vec b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(vec v)
{
    double length = sqrt(dot(v, v));
    for (int k = 0; length > 0 && k < 3; k++) {
        v[k] /= length;
    }
}

static struct motion any_motion(double scale, double reach)
{
    struct motion m = {.scale = scale};
    ref_rotation(3.14, m.r);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            m.fixed.r[i][k] = ref_q30(scale * m.r[i][k]);
            m.r[i][k] = ldexp(m.fixed.r[i][k], -30);
        }
        m.t[i] = ref_q16(ref_uniform(-reach, reach)) / 65536.;
    }
    m.fixed.t = (struct fx_vec3){ref_q16(m.t[0]), ref_q16(m.t[1]), ref_q16(m.t[2])};
    return m;
}

static void backward(const struct motion *m, const vec p, vec out)
{
    for (int i = 0; i < 3; i++) {
        out[i] = 0;
        for (int k = 0; k < 3; k++) {
            out[i] += m->r[k][i] * (p[k] - m->t[k]) / (m->scale * m->scale);
        }
    }
}

/* ---- the formula -------------------------------------------------------------------------------------------- */

/* The share of a spot in the direction -l, both unit vectors. */
static double cone(const struct ph_light *light, const vec l, const vec axis)
{
    const double outer = light->cos_outer / 65536., inner = light->cos_inner / 65536.;
    const double share = (dot(l, axis) - outer) / (inner - outer);
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

/* Adds one light's diffuse and specular intensity, times `share`; all in world space. */
static void add_light(const struct ph_light *light, const struct ph_material *material, double share, const vec normal,
                      const vec position, const vec viewer, double *diffuse, double *specular)
{
    vec l = {light->to_light_q30.x, light->to_light_q30.y, light->to_light_q30.z}, half;
    vec axis = {l[0], l[1], l[2]};
    double strength = share * light->intensity / 65536., n_h;
    normalise(axis);
    if (light->kind != PH_LIGHT_DIRECTIONAL) {
        l[0] = light->position.x / 65536. - position[0];
        l[1] = light->position.y / 65536. - position[1];
        l[2] = light->position.z / 65536. - position[2];
        double ratio = light->reach > 0 ? sqrt(dot(l, l)) / (light->reach / 65536.) : 0;
        strength /= 1 + ratio * ratio;
    }
    normalise(l);
    if (dot(normal, l) <= 0) {
        return;
    }
    strength *= light->kind == PH_LIGHT_SPOT ? cone(light, l, axis) : 1;
    for (int k = 0; k < 3; k++) {
        half[k] = l[k] + viewer[k];
    }
    normalise(half);
    n_h = fmax(0, dot(normal, half));
    *diffuse += strength * material->diffuse / 65536. * dot(normal, l);
    *specular += strength * material->specular / 65536. * pow(n_h, 1 << material->shininess_log2);
}

/* Entry of the ramp: diffuse is white at 1, the highlight comes on top of it. */
static double exact_entry(const struct lighting *light, const vec normal, const vec position, const vec viewer)
{
    double diffuse = light->scene.ambient / 65536. * light->material.ambient / 65536., specular = 0;
    double most = 1 + light->material.specular / 65536.;
    for (uint32_t i = 0; i < light->scene.count; i++) {
        add_light(&light->scene.lights[i], &light->material, 1, normal, position, viewer, &diffuse, &specular);
    }
    return 4 + 119 * fmin(fmin(diffuse, 1) + specular, most) / most;
}

/* How many steps a pixel is off the lit colour: its own at full light, white with a highlight of 1. */
static double channel_error(const struct lighting *light, const vec normal, const vec position, const vec viewer,
                            int pixel)
{
    static const int from[3] = {11, 5, 0}, top[3] = {31, 63, 31};
    const int colour = (light->material.colour & 255) << 8 | light->material.colour >> 8;
    const int drawn = (pixel & 255) << 8 | pixel >> 8;
    double worst = 0;
    for (int k = 0; k < 3; k++) {
        double diffuse = light->scene.ambient / 65536. * light->material.ambient / 65536., specular = 0;
        for (uint32_t i = 0; i < light->scene.count; i++) {
            const struct ph_light *const l = &light->scene.lights[i];
            const double share = (k == 0 ? l->red : k == 1 ? l->green : l->blue) / 65536.;
            add_light(l, &light->material, share, normal, position, viewer, &diffuse, &specular);
        }
        const double total = fmin(fmin(diffuse, 1) + specular, 1 + light->material.specular / 65536.);
        const double base = colour >> from[k] & top[k], white = fmax(total - 1, 0);
        const double exact = base * fmin(total, 1) + (top[k] - base) * white;
        worst = fmax(worst, fabs((drawn >> from[k] & top[k]) - exact) * 31 / top[k]);
    }
    return worst;
}

/* ---- the renderer ------------------------------------------------------------------------------------------- */

static int drawn_entry(struct rig *rig, const struct lighting *light, const struct motion *to_world,
                       const struct motion *view, const struct fx_vec3 positions[3], const int16_t normals[3][3])
{
    static const uint16_t triangle[1][3] = {{0, 1, 2}};
    static const struct ph_part part = {0, 1, 0};
    struct ph_mesh mesh = {.positions = positions,
                           .normals = normals,
                           .triangles = triangle,
                           .parts = &part,
                           .materials = &light->material,
                           .vertex_count = 3,
                           .triangle_count = 1,
                           .part_count = 1};
    struct ph_projection projection;
    assert_int_equal(ph_projection_perspective(&projection, FX_INT(60), FX_ONE, FX_HALF, FX_INT(100)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &view->fixed, &projection, &light->scene, 0xffff), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &to_world->fixed), PH_OK);
    assert_true(rig_finish(rig));
    return rig->pixels[SIZE / 2 * SIZE + SIZE / 2];
}

/* One random case; returns by how many entries the renderer is off. `positions`: a triangle before the camera. */
static double case_error(struct rig *rig, struct lighting *light, double scale)
{
    static const double before_camera[3][3] = {{-4, -4, -5}, {4, -4, -5}, {0, 6, -5}};
    struct motion to_world = any_motion(scale, 3), view = any_motion(1, 3);
    struct fx_vec3 positions[3];
    int16_t normals[3][3];
    vec normal, world_normal, position, corner, viewer = {view.r[2][0], view.r[2][1], view.r[2][2]};
    uint16_t ramp[PH_RAMP_SIZE];
    for (int i = 0; i < 3; i++) {
        vec world;
        backward(&view, before_camera[i], world);
        backward(&to_world, world, corner);
        positions[i] = (struct fx_vec3){ref_q16(corner[0]), ref_q16(corner[1]), ref_q16(corner[2])};
        ref_direction(normal);
        for (int k = 0; k < 3; k++) {
            normals[i][k] = (int16_t)lrint(normal[k] * 16384);
        }
    }
    for (uint16_t i = 0; i < PH_RAMP_SIZE; i++) {
        ramp[i] = i;
    }
    backward(&view, before_camera[0], position);
    for (int k = 0; k < 3; k++) {
        normal[k] = normals[0][k] / 16384.;
    }
    for (int i = 0; i < 3; i++) {
        world_normal[i] = dot(to_world.r[i], normal) / scale;
    }
    light->material.ramp = ramp;
    int entry = drawn_entry(rig, light, &to_world, &view, positions, (const int16_t(*)[3])normals);
    return light->coloured ? channel_error(light, world_normal, position, viewer, entry)
                           : fabs(entry - exact_entry(light, world_normal, position, viewer));
}

static struct ph_light any_light(const struct ph_light_kind *kind)
{
    vec towards;
    ref_direction(towards);
    struct ph_light light = {.kind = kind, .intensity = ref_q16(ref_uniform(.1, 1))};
    light.to_light_q30 = (struct fx_vec3){ref_q30(towards[0]), ref_q30(towards[1]), ref_q30(towards[2])};
    light.position =
        (struct fx_vec3){ref_q16(ref_uniform(-9, 9)), ref_q16(ref_uniform(-9, 9)), ref_q16(ref_uniform(-9, 9))};
    light.reach = ref_uniform(0, 1) < .3 ? 0 : ref_q16(ref_uniform(1, 10));
    light.cos_outer = ref_q16(ref_uniform(-.5, .7));
    light.cos_inner = light.cos_outer + ref_q16(ref_uniform(.05, .3));
    return light;
}

/* Largest error of many random cases with `lights` lights of one kind. */
static double worst_of(const struct ph_light_kind *kind, uint32_t lights, double specular, uint8_t shininess_log2,
                       double scale, bool coloured)
{
    struct rig rig;
    double worst = 0;
    ref_seed(7);
    rig_open(&rig, SIZE, SIZE, SIZE, PH_DEPTH_FIXED16, 3, 4);
    for (int i = 0; i < CASES; i++) {
        struct lighting light = {.scene = {.ambient = ref_q16(ref_uniform(0, .5)), .count = lights}};
        for (uint32_t k = 0; k < lights; k++) {
            light.scene.lights[k] = any_light(kind);
            if (coloured) {
                light.scene.lights[k].red = ref_q16(ref_uniform(0, 1));
                light.scene.lights[k].green = ref_q16(ref_uniform(0, 1));
                light.scene.lights[k].blue = ref_q16(ref_uniform(0, 1));
            }
        }
        light.coloured = coloured;
        light.material = (struct ph_material){.shading = PH_SHADE_FLAT,
                                              .ambient = ref_q16(ref_uniform(0, 1)),
                                              .diffuse = ref_q16(ref_uniform(.2, 1)),
                                              .specular = ref_q16(specular),
                                              .shininess_log2 = shininess_log2,
                                              .colour = coloured ? (uint16_t)ref_uniform(0, 65536) : 0};
        worst = fmax(worst, case_error(&rig, &light, scale));
    }
    rig_close(&rig);
    return worst;
}

static double worst_error(const struct ph_light_kind *kind, uint32_t lights, double specular, uint8_t shininess_log2,
                          double scale)
{
    return worst_of(kind, lights, specular, shininess_log2, scale, false);
}

/* The entry is a whole number: half an entry of error is unavoidable. */
static void ambient_light_is_exact(void **state)
{
    (void)state;
    assert_true(
        surface_row("light: ambient", "most, of 119 entries", worst_error(PH_LIGHT_DIRECTIONAL, 0, 0, 0, 1), .52));
}

static void directional_light_follows_lambert(void **state)
{
    (void)state;
    assert_true(
        surface_row("light: directional", "most, of 119 entries", worst_error(PH_LIGHT_DIRECTIONAL, 1, 0, 0, 1), .55));
}

static void four_lights_add_up(void **state)
{
    (void)state;
    assert_true(surface_row("light: four directional", "most, of 119 entries",
                            worst_error(PH_LIGHT_DIRECTIONAL, 4, 0, 0, 1), .6));
}

static void light_does_not_depend_on_the_scale_of_a_mesh(void **state)
{
    (void)state;
    assert_true(surface_row("light: on scaled meshes", "most, of 119 entries",
                            worst_error(PH_LIGHT_DIRECTIONAL, 2, 0, 0, .25), .6));
    assert_true(surface_row("light: on scaled meshes", "most, of 119 entries",
                            worst_error(PH_LIGHT_DIRECTIONAL, 2, 0, 0, 1.9), .6));
}

static void point_light_falls_off_with_its_reach(void **state)
{
    (void)state;
    assert_true(surface_row("light: point", "most, of 119 entries", worst_error(PH_LIGHT_POINT, 1, 0, 0, 1), .6));
    assert_true(surface_row("light: point", "most, of 119 entries", worst_error(PH_LIGHT_POINT, 3, 0, 0, .5), .6));
    assert_true(surface_row("light: point", "most, of 119 entries", worst_error(PH_LIGHT_POINT, 2, 0, 0, 1.7), .6));
}

/* The power doubles the relative error with each step: n.h is known to 2^-13, at 2^7 to 1.5 %. */
static void highlights_follow_blinn(void **state)
{
    (void)state;
    for (uint8_t log2 = 0; log2 <= 7; log2++) {
        assert_true(surface_row("light: highlight, shininess 1 to 2^7", "most, of 119 entries",
                                worst_error(PH_LIGHT_DIRECTIONAL, 1, .8, log2, 1), .6 + .012 * (1 << log2)));
    }
    assert_true(surface_row("light: highlight of points", "most, of 119 entries",
                            worst_error(PH_LIGHT_POINT, 2, 1, 4, .7), .8));
}

/* The narrowest cone here goes from light to dark within .05: there 2^-13 of the cosine is 1/3 entry. */
static void spots_light_what_lies_in_their_cone(void **state)
{
    (void)state;
    assert_true(surface_row("light: spot", "most, of 119 entries", worst_error(PH_LIGHT_SPOT, 1, 0, 0, 1), .9));
    assert_true(surface_row("light: spots with highlights", "most, of 119 entries",
                            worst_error(PH_LIGHT_SPOT, 3, .5, 3, .6), 1));
}

static void coloured_lights_add_up_channel_by_channel(void **state)
{
    (void)state;
    assert_true(
        surface_row("light: one coloured", "most, of 31", worst_of(PH_LIGHT_DIRECTIONAL, 1, 0, 0, 1, true), .52));
    assert_true(surface_row("light: coloured", "most, of 31", worst_of(PH_LIGHT_DIRECTIONAL, 4, .8, 4, 1, true), .6));
    assert_true(surface_row("light: coloured", "most, of 31", worst_of(PH_LIGHT_POINT, 2, 0, 0, .7, true), .6));
    assert_true(surface_row("light: coloured", "most, of 31", worst_of(PH_LIGHT_SPOT, 3, .5, 2, 1.5, true), .8));
}

/* A renderer without PH_COLOURS draws a light of red 1, green 1/2 and blue 0 as a white one of half its intensity, and
 * refuses a mesh with colours. */
static void without_ph_colours_light_is_white_and_a_mesh_with_colours_is_refused(void **state)
{
    static const struct fx_vec3 positions[3] = {
        {FX_INT(-4), FX_INT(-4), FX_INT(-5)}, {FX_INT(4), FX_INT(-4), FX_INT(-5)}, {0, FX_INT(6), FX_INT(-5)}};
    static const int16_t normals[3][3] = {{0, 0, 16384}, {0, 0, 16384}, {0, 0, 16384}};
    static const uint16_t triangle[1][3] = {{0, 1, 2}}, colours[3] = {1, 2, 3};
    static const struct ph_part part = {0, 1, 0};
    const struct motion still = {.scale = 1, .fixed = ph_xform_identity};
    uint16_t ramp[PH_RAMP_SIZE];
    struct rig rig;
    (void)state;
    for (uint16_t i = 0; i < PH_RAMP_SIZE; i++) {
        ramp[i] = i;
    }
    struct lighting light = {
        .scene = {.count = 1,
                  .lights = {{.intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}, .red = FX_ONE, .green = FX_HALF}}},
        .material = {.shading = PH_SHADE_FLAT, .diffuse = FX_ONE, .ramp = ramp, .colour = 0xffff}};
    rig_open(&rig, SIZE, SIZE, SIZE, PH_DEPTH_FIXED16, 3, 4);
    const uint16_t coloured = drawn_entry(&rig, &light, &still, &still, positions, normals);
    assert_true(coloured >= PH_RAMP_SIZE); /* no entry of the ramp, but a colour */
    struct ph_config config = rig.r.config;
    config.colouring = NULL;
    assert_int_equal(ph_renderer_init(&rig.r, &config), PH_OK);
    assert_in_range(drawn_entry(&rig, &light, &still, &still, positions, normals), 63, 64); /* of 4 .. 123 */
    struct ph_mesh mesh = {.positions = positions,
                           .triangles = triangle,
                           .parts = &part,
                           .materials = &light.material,
                           .vertex_count = 3,
                           .triangle_count = 1,
                           .part_count = 1,
                           .colours = colours};
    struct ph_projection projection;
    assert_int_equal(ph_projection_perspective(&projection, FX_INT(60), FX_ONE, FX_HALF, FX_INT(100)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_ERR_INVAL);
    assert_int_equal(rig.r.stats.vertices, 0);
    mesh.colours = NULL;
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ambient_light_is_exact),
        cmocka_unit_test(directional_light_follows_lambert),
        cmocka_unit_test(four_lights_add_up),
        cmocka_unit_test(light_does_not_depend_on_the_scale_of_a_mesh),
        cmocka_unit_test(point_light_falls_off_with_its_reach),
        cmocka_unit_test(highlights_follow_blinn),
        cmocka_unit_test(spots_light_what_lies_in_their_cone),
        cmocka_unit_test(coloured_lights_add_up_channel_by_channel),
        cmocka_unit_test(without_ph_colours_light_is_white_and_a_mesh_with_colours_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
