/* Light of a vertex and the material's ramp against the textbook formulas in double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "pipeline.h"
#include "wire.h"

#include <math.h>
#include <stdlib.h>

#define Q30 (1.0 / (1 << 30))

static uint32_t seed = 2463534242u;

static double random_unit(void) /* -1 .. 1 */
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed / 2147483648.0 - 1;
}

static fx_t fx(double v)
{
    return (fx_t)lrint(v * 65536);
}

struct vec {
    double x, y, z;
};

static struct vec unit(struct vec v)
{
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > 0 ? (struct vec){v.x / length, v.y / length, v.z / length} : v;
}

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vec rotate(const struct ph_xform *m, struct vec v)
{
    const struct vec rows[3] = {{m->r[0][0] * Q30, m->r[0][1] * Q30, m->r[0][2] * Q30},
                                {m->r[1][0] * Q30, m->r[1][1] * Q30, m->r[1][2] * Q30},
                                {m->r[2][0] * Q30, m->r[2][1] * Q30, m->r[2][2] * Q30}};
    return (struct vec){dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

static struct vec random_direction(void)
{
    return unit((struct vec){random_unit(), random_unit(), random_unit() + 1e-3});
}

/* One vertex under the renderer's lights, in the double's way: everything in world space. */
static double expected(const struct ph_renderer *r, const struct ph_xform *to_world, const struct ph_material *material,
                       struct vec normal, struct vec position)
{
    const struct vec n = unit(rotate(to_world, normal)), turned = rotate(to_world, position);
    const struct vec p = {turned.x + to_world->t.x / 65536.0, turned.y + to_world->t.y / 65536.0,
                          turned.z + to_world->t.z / 65536.0};
    const struct vec viewer = {r->view.r[2][0] * Q30, r->view.r[2][1] * Q30, r->view.r[2][2] * Q30};
    double diffuse = r->light.ambient / 65536.0 * material->ambient / 65536.0, specular = 0;
    for (uint32_t i = 0; i < r->light.count; i++) {
        const struct ph_light *light = &r->light.lights[i];
        const struct vec offset = {light->position.x / 65536.0 - p.x, light->position.y / 65536.0 - p.y,
                                   light->position.z / 65536.0 - p.z};
        const bool point = light->kind == PH_LIGHT_POINT;
        const struct vec towards = unit(point ? offset
                                              : (struct vec){light->to_light_q30.x * Q30, light->to_light_q30.y * Q30,
                                                             light->to_light_q30.z * Q30});
        const double distance = sqrt(dot(offset, offset)), reach = light->reach / 65536.0;
        const double falls = point && reach > 0 ? 1 / (1 + distance * distance / reach / reach) : 1;
        const double strength = falls * light->intensity / 65536.0;
        const struct vec half = unit((struct vec){towards.x + viewer.x, towards.y + viewer.y, towards.z + viewer.z});
        if (dot(n, towards) > 0) {
            diffuse += dot(n, towards) * strength * material->diffuse / 65536.0;
            specular +=
                pow(fmax(dot(n, half), 0), 1 << material->shininess_log2) * strength * material->specular / 65536.0;
        }
    }
    return fmin(fmin(diffuse, 1) + specular, 1 + material->specular / 65536.0);
}

static double got(const struct ph_renderer *r, const struct ph_xform *to_world, const struct ph_material *material,
                  struct vec normal, struct vec position)
{
    struct ph_local_lights local;
    ph_light_prepare(&local, r, to_world, material);
    const int16_t n[3] = {(int16_t)lrint(normal.x * 16384), (int16_t)lrint(normal.y * 16384),
                          (int16_t)lrint(normal.z * 16384)};
    const uint16_t light = ph_light_vertex(&local, n, (struct fx_vec3){fx(position.x), fx(position.y), fx(position.z)});
    return ((double)light - PH_LIGHT_ZERO) / PH_LIGHT_SPAN * (1 + material->specular / 65536.0);
}

static void set_light(struct ph_light *light, bool point)
{
    const struct vec d = random_direction();
    *light = (struct ph_light){
        .kind = point ? PH_LIGHT_POINT : PH_LIGHT_DIRECTIONAL,
        .intensity = fx(.6 + .4 * random_unit()),
        .to_light_q30 = {(int32_t)lrint(d.x / Q30 * .999999), (int32_t)lrint(d.y / Q30 * .999999),
                         (int32_t)lrint(d.z / Q30 * .999999)},
        .position = {fx(4 * d.x), fx(4 * d.y), fx(4 * d.z)},
        .reach = random_unit() > 0 ? fx(5) : 0,
    };
}

/* Random lights on a random pose, with and without scale; `tolerance` in units of full light. */
static void compare(uint32_t lights, bool point, double specular, double tolerance)
{
    for (int i = 0; i < 3000; i++) {
        struct ph_renderer r = {.view = ph_view_look_at((struct fx_vec3){fx(3 * random_unit()), fx(2), fx(5)},
                                                        (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0})};
        r.light.ambient = fx(.1);
        r.light.count = lights;
        for (uint32_t k = 0; k < lights; k++) {
            set_light(&r.light.lights[k], point);
        }
        const struct vec a = random_direction();
        const struct fx_quat q = fx_quat_axis((struct fx_vec3){fx(a.x), fx(a.y), fx(a.z)}, seed);
        const struct ph_xform turn = ph_xform_quat(q, (struct fx_vec3){fx(random_unit()), 0, fx(random_unit())});
        const struct ph_xform scale = ph_xform_scale(fx(i % 2 == 0 ? 1 : .5 + .25 * random_unit()));
        const struct ph_xform to_world = ph_xform_mul(&turn, &scale);
        const struct ph_material material = {
            .ambient = FX_ONE, .diffuse = fx(.7), .specular = fx(specular), .shininess_log2 = (uint8_t)(i % 5)};
        const struct vec normal = random_direction();
        const struct vec position = {random_unit(), random_unit(), random_unit()};
        const double want = expected(&r, &to_world, &material, normal, position);
        const double have = got(&r, &to_world, &material, normal, position);
        if (fabs(want - have) > tolerance) {
            fail_msg("case %d: light %.5f, expected %.5f", i, have, want);
        }
    }
}

static void ambient_light_is_the_product_of_scene_and_material(void **state)
{
    (void)state;
    compare(0, false, 0, .0002);
}

static void directional_lights_follow_the_cosine(void **state)
{
    (void)state;
    compare(1, false, 0, .0005);
    compare(4, false, 0, .001);
}

static void point_lights_follow_the_cosine_and_fall_off(void **state)
{
    (void)state;
    compare(1, true, 0, .001);
    compare(4, true, 0, .002);
}

static void highlights_follow_the_half_vector(void **state)
{
    (void)state;
    compare(1, false, .5, .004);
    compare(3, true, .8, .008);
}

static void zero_normals_and_a_light_at_the_vertex_are_dark_and_harmless(void **state)
{
    (void)state;
    struct ph_renderer r = {.view = ph_xform_identity};
    r.light.count = 1;
    r.light.lights[0] = (struct ph_light){.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .reach = 1};
    const struct ph_material material = {.diffuse = FX_ONE, .specular = FX_ONE, .shininess_log2 = 7};
    assert_true(got(&r, &ph_xform_identity, &material, (struct vec){0, 0, 0}, (struct vec){1, 1, 1}) == 0);
    assert_true(got(&r, &ph_xform_identity, &material, (struct vec){0, 0, 1}, (struct vec){0, 0, 0}) == 0);
    const struct ph_xform nothing = {{{0}}, {0, 0, 0}};
    assert_true(got(&r, &nothing, &material, (struct vec){0, 0, 1}, (struct vec){0, 0, 0}) == 0);
}

/* The ramp's 120 steps are colour * t, and from 1 on a fade to white, each channel rounded to RGB565. */
static void ramp_goes_from_black_through_the_colour_to_white(void **state)
{
    (void)state;
    static const uint8_t colour[3] = {255, 160, 64};
    static const int top[3] = {31, 63, 31};
    for (int s = 0; s <= 2; s++) {
        uint16_t ramp[PH_RAMP_SIZE];
        ph_material_ramp(ramp, colour[0], colour[1], colour[2], fx(s * .5));
        for (int i = 0; i < PH_RAMP_SIZE; i++) {
            const double t = fmin(fmax(i - 4, 0), 119) / 119 * (1 + s * .5);
            const uint16_t c = ph_wire16(ramp[i]);
            const int have[3] = {c >> 11, c >> 5 & 63, c & 31};
            for (int k = 0; k < 3; k++) {
                const double want = t <= 1 ? colour[k] * t : colour[k] + (255 - colour[k]) * (t - 1);
                assert_true(fabs(have[k] - want * top[k] / 255) < .65); /* rounded to 8 bits first, then to 5 or 6 */
            }
        }
    }
    const uint8_t *bytes = (const uint8_t *)&(uint16_t){ph_rgb565(255, 0, 0)};
    assert_int_equal(bytes[0], 0xf8); /* red first, on every machine */
    assert_int_equal(bytes[1], 0x00);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ambient_light_is_the_product_of_scene_and_material),
        cmocka_unit_test(directional_lights_follow_the_cosine),
        cmocka_unit_test(point_lights_follow_the_cosine_and_fall_off),
        cmocka_unit_test(highlights_follow_the_half_vector),
        cmocka_unit_test(zero_normals_and_a_light_at_the_vertex_are_dark_and_harmless),
        cmocka_unit_test(ramp_goes_from_black_through_the_colour_to_white),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
