/*
 * Mesa draws a torus above a ground from random cameras of gluLookAt, gluPerspective, glFrustum and glOrtho. Our
 * cameras with the same numbers draw the same picture, within stated bounds: 320 x 240 pixels, 40 cameras each. Prints
 * what it measured.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <GL/osmesa.h>
#include <GL/glu.h>

#include "mesa.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>

#define WIDTH   320
#define HEIGHT  240
#define PIXELS  (WIDTH * HEIGHT)
#define CAMERAS 40
#define BOUND   5e-5  /* share of the pixels; measured: 1.2e-5. The demand is 5e-4. */
#define STEP    1e-4F /* of Mesa's window depth between neighbours: enough to ask which is nearer */

enum { TORUS, GROUND, MESHES };
enum { PERSPECTIVE, FRUSTUM, ORTHO, KINDS };

static const char *const names[KINDS] = {"gluPerspective", "glFrustum", "glOrtho"};
static const uint8_t colours[MESHES][3] = {{255, 0, 0}, {0, 255, 0}};

struct difference {
    double covered, differ, both, other, pairs, turned;
};

static struct difference table[KINDS];
static struct mesa gl;
static struct rig rig;
static struct rig_mesh meshes[MESHES];
static float mesa_depth[PIXELS];
static uint8_t mesa_rgb[PIXELS][3];

static double real(fx_t v)
{
    return v / 65536.;
}

static fx_t random_q16(double low, double high)
{
    return ref_q16(ref_uniform(low, high));
}

static struct fx_vec3 random_vec(double x, double y_low, double y_high, double z)
{
    return (struct fx_vec3){random_q16(-x, x), random_q16(y_low, y_high), random_q16(-z, z)};
}

/* ---- the same camera for both --------------------------------------------------------------------------------- */

static struct ph_xform look_at(void)
{
    const struct fx_vec3 eye = random_vec(6, .5, 5, 6), target = random_vec(1, -1, 1, 1),
                         up = random_vec(.4, .8, 1, .4);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    gluLookAt(real(eye.x), real(eye.y), real(eye.z), real(target.x), real(target.y), real(target.z), real(up.x),
              real(up.y), real(up.z));
    return ph_view_look_at(eye, target, up);
}

static struct ph_projection projection(int kind)
{
    struct ph_projection p;
    const fx_t n = random_q16(.3, 1.5), f = random_q16(15, 60), fov = random_q16(25, 100), aspect = ref_q16(4. / 3);
    const fx_t size = kind == FRUSTUM ? n : ref_q16(4), l = -(fx_t)(real(size) * random_q16(.3, 1)),
               r = (fx_t)(real(size) * random_q16(.3, 1)), b = -(fx_t)(real(size) * random_q16(.3, 1)),
               t = (fx_t)(real(size) * random_q16(.3, 1));
    int status;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (kind == PERSPECTIVE) {
        gluPerspective(real(fov), real(aspect), real(n), real(f));
        status = ph_projection_perspective(&p, fov, aspect, n, f);
    } else if (kind == FRUSTUM) {
        glFrustum(real(l), real(r), real(b), real(t), real(n), real(f));
        status = ph_projection_frustum(&p, l, r, b, t, n, f);
    } else {
        glOrtho(real(l), real(r), real(b), real(t), real(n), real(f));
        status = ph_projection_ortho(&p, l, r, b, t, n, f);
    }
    assert_int_equal(status, PH_OK);
    return p;
}

/* ---- drawing -------------------------------------------------------------------------------------------------- */

static struct ph_xform place(int mesh)
{
    struct ph_xform m = ph_xform_identity; /* the torus lies: quarter turns are exact */
    if (mesh == TORUS) {
        m = ph_xform_rotate_x(0x40000000);
    }
    m.t.y = mesh == TORUS ? 0 : FX_INT(-1);
    return m;
}

static void gl_mesh(const struct ph_mesh *mesh, const struct ph_xform *at)
{
    glBegin(GL_TRIANGLES);
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        const struct fx_vec3 v = ph_xform_point(at, mesh->positions[mesh->triangles[i / 3][i % 3]]);
        glVertex3d(real(v.x), real(v.y), real(v.z));
    }
    glEnd();
}

static void draw_both(int kind)
{
    const struct ph_xform view = look_at();
    const struct ph_projection p = projection(kind);
    assert_int_equal(ph_frame_begin(&rig.r, &view, &p, NULL, 0), PH_OK);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (int k = 0; k < MESHES; k++) {
        const struct ph_xform at = place(k);
        glColor3ubv(colours[k]);
        gl_mesh(&meshes[k].mesh, &at);
        assert_int_equal(ph_draw_mesh(&rig.r, &meshes[k].mesh, &at), PH_OK);
    }
    assert_true(rig_finish(&rig));
    mesa_read(&gl, mesa_depth, mesa_rgb);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

/* ---- comparing ------------------------------------------------------------------------------------------------ */

/* Compares the order in depth of two neighbours that are drawn in both pictures and lie on the same mesh in both. */
static void compare_order(struct difference *t, int a, int b)
{
    if (rig.depth[a] == 0 || rig.depth[b] == 0 || mesa_depth[a] >= 1 || mesa_depth[b] >= 1 ||
        fabsf(mesa_depth[a] - mesa_depth[b]) < STEP) {
        return;
    }
    t->pairs++;
    t->turned += (mesa_depth[a] < mesa_depth[b]) != (rig.depth[a] > rig.depth[b]);
}

static void compare(struct difference *t)
{
    for (int i = 0; i < PIXELS; i++) {
        const bool in_mesa = mesa_depth[i] < 1, here = rig.depth[i] != 0;
        t->covered += in_mesa;
        t->differ += in_mesa != here;
        if (in_mesa && here) { /* which mesh is in front */
            t->both++;
            t->other += rig.pixels[i] != ph_rgb565(mesa_rgb[i][0], mesa_rgb[i][1], mesa_rgb[i][2]);
        }
        if (i % WIDTH > 0) {
            compare_order(t, i - 1, i);
        }
    }
}

static int measure_all(void **state)
{
    static const enum ref_scene_id ids[MESHES] = {REF_TORUS, REF_GROUND};
    (void)state;
    if (!mesa_open(&gl, WIDTH, HEIGHT)) {
        return -1;
    }
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, PH_DEPTH_FIXED16, 4096, 16384);
    for (int k = 0; k < MESHES; k++) {
        struct ref_scene scene;
        ref_scene_build(&scene, ids[k]);
        rig_mesh_build(&meshes[k], &scene);
        ref_scene_free(&scene);
        meshes[k].materials[0].shading = PH_SHADE_UNLIT;
        meshes[k].materials[0].colour = ph_rgb565(colours[k][0], colours[k][1], colours[k][2]);
    }
    ref_seed(41);
    for (int kind = 0; kind < KINDS; kind++) {
        struct difference *t = &table[kind];
        for (int i = 0; i < CAMERAS; i++) {
            draw_both(kind);
            compare(t);
        }
        printf("%-15s %9.0f pixels a picture, coverage differs %.4f %%, front %.4f %%, order of neighbours %.4f %%\n",
               names[kind], t->covered / CAMERAS, 100 * t->differ / t->covered, 100 * t->other / t->both,
               100 * t->turned / t->pairs);
    }
    rig_close(&rig);
    return 0;
}

static int release(void **state)
{
    (void)state;
    rig_mesh_free(&meshes[TORUS]);
    rig_mesh_free(&meshes[GROUND]);
    mesa_close(&gl);
    return 0;
}

/* ---- tests ---------------------------------------------------------------------------------------------------- */

static void mesa_drew_pictures_worth_comparing(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        assert_true(table[kind].covered > .25 * PIXELS * CAMERAS);
        assert_true(table[kind].pairs > .1 * table[kind].covered);
    }
}

static void coverage_differs_by_at_most_five_thousandths_of_a_percent(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        assert_true(table[kind].differ <= BOUND * table[kind].covered);
    }
}

/* The mesh in front is another only on outlines that differ in coverage, too. */
static void depth_order_is_that_of_mesa(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        assert_true(table[kind].other <= BOUND * table[kind].both);
        assert_true(table[kind].turned <= BOUND * table[kind].pairs);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mesa_drew_pictures_worth_comparing),
        cmocka_unit_test(coverage_differs_by_at_most_five_thousandths_of_a_percent),
        cmocka_unit_test(depth_order_is_that_of_mesa),
    };
    return cmocka_run_group_tests(tests, measure_all, release);
}
