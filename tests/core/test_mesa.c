/*
 * Mesa's software renderer (OSMesa) draws the five benchmark scenes from the reference's geometry. Our coverage, depth
 * and texels agree with it within stated bounds. This is a second opinion, by other people, on the camera, the formulas
 * and the reference itself. It takes means over the frames 0, 8, .. 56 at 320x240 and prints what it measured.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <GL/osmesa.h>

#include "mesa.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define WIDTH  320
#define HEIGHT 240
#define PIXELS (WIDTH * HEIGHT)
#define LAST   56
#define STEP   8
#define SMOOTH .01 /* change of window depth over 3x3 pixels */

/*
 * About twice what was measured with llvmpipe of Mesa 22.3: .0022, .0007, 0, .0007, 0 %; 4.6e-6, 4.6e-6, 7.0e-6,
 * 4.6e-6, 9.9e-6; .50 %. (Both have 8 sub-pixel bits but round vertices differently: now and then a pixel on an
 * outline.)
 */
static const struct {
    double coverage_percent, depth_rms, texel_percent;
} bounds[REF_SCENES] = {{.005, 8e-6, 0}, {.003, 8e-6, .6}, {0, 1e-5, 0}, {.003, 8e-6, 0}, {.002, 1.5e-5, 0}};

struct picture {
    float depth[PIXELS]; /* window depth, 1 where nothing was drawn; rows from the top */
    uint8_t rgb[PIXELS][3];
};

struct difference {
    double covered, differ, smooth, depth_square, texels, wrong;
};

static struct difference table[REF_SCENES];
static struct mesa gl;

/* ---- Mesa --------------------------------------------------------------------------------------------------- */

static void gl_texture(void)
{
    static uint8_t texels[REF_TEXTURE_SIZE * REF_TEXTURE_SIZE][3];
    for (int i = 0; i < REF_TEXTURE_SIZE * REF_TEXTURE_SIZE; i++) {
        uint32_t rgb = ref_texel(i % REF_TEXTURE_SIZE, i / REF_TEXTURE_SIZE);
        for (int k = 0; k < 3; k++) {
            texels[i][k] = (uint8_t)(rgb >> (16 - 8 * k));
        }
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, REF_TEXTURE_SIZE, REF_TEXTURE_SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
}

static void gl_camera(const struct ref_scene *scene, int frame)
{
    double n = ref_benchmark.near_z, top = n * tan(ref_benchmark.fov_y / 2), right = top * WIDTH / HEIGHT;
    double pose[3][4], columns[16] = {[15] = 1};
    ref_scene_pose(scene, frame, pose);
    for (int i = 0; i < 12; i++) {
        columns[4 * (i % 4) + i / 4] = pose[i / 4][i % 4];
    }
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-right, right, -top, top, n, ref_benchmark.far_z);
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixd(columns);
}

static void mesa_draw(const struct ref_scene *scene, int frame, struct picture *out)
{
    gl_camera(scene, frame);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    (scene->id == REF_CUBE ? glEnable : glDisable)(GL_TEXTURE_2D);
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 3 * scene->triangle_count; i++) {
        const struct ref_vertex *v = &scene->vertices[scene->triangles[i / 3][i % 3]];
        glTexCoord2dv(v->uv);
        glVertex3dv(v->p);
    }
    glEnd();
    mesa_read(&gl, out->depth, out->rgb);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

/* ---- comparing ---------------------------------------------------------------------------------------------- */

/* All nine pixels are drawn in both pictures, on one smooth surface. */
static bool is_smooth(const struct rig *rig, const struct picture *mesa, int x, int y)
{
    float low = 1, high = 0;
    for (int v = y - 1; v <= y + 1; v++) {
        for (int u = x - 1; u <= x + 1; u++) {
            if (u < 0 || v < 0 || u >= WIDTH || v >= HEIGHT || rig->depth[v * WIDTH + u] == 0) {
                return false;
            }
            low = fminf(low, mesa->depth[v * WIDTH + u]);
            high = fmaxf(high, mesa->depth[v * WIDTH + u]);
        }
    }
    return high < 1 && high - low < SMOOTH;
}

static void compare(const struct rig *rig, const struct picture *mesa, enum ref_scene_id id)
{
    struct difference *t = &table[id];
    for (int i = 0; i < PIXELS; i++) {
        bool in_mesa = mesa->depth[i] < 1;
        t->covered += in_mesa;
        t->differ += in_mesa != (rig->depth[i] != 0);
        if (!is_smooth(rig, mesa, i % WIDTH, i / WIDTH)) {
            continue;
        }
        double z = rig_distance(rig, rig->depth[i], ref_benchmark.near_z, ref_benchmark.far_z);
        double off = ref_window_depth(&ref_benchmark, z) - mesa->depth[i];
        t->smooth++;
        t->depth_square += off * off;
        if (id == REF_CUBE) {
            t->texels++;
            t->wrong += rig->pixels[i] != ph_rgb565(mesa->rgb[i][0], mesa->rgb[i][1], mesa->rgb[i][2]);
        }
    }
}

static int measure_all(void **state)
{
    static struct picture mesa;
    struct rig rig;
    (void)state;
    if (!mesa_open(&gl, WIDTH, HEIGHT)) {
        return -1;
    }
    gl_texture();
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, PH_DEPTH_FIXED16, 4096, 8192);
    printf("%s\n%-10s %10s %10s %9s\n", (const char *)glGetString(GL_RENDERER), "scene", "coverage", "depth RMS",
           "texels");
    for (int id = 0; id < REF_SCENES; id++) {
        struct ref_scene scene;
        struct rig_mesh mesh;
        ref_scene_build(&scene, (enum ref_scene_id)id);
        rig_mesh_build(&mesh, &scene);
        for (int frame = 0; frame <= LAST; frame += STEP) {
            struct ph_xform pose = rig_pose(&scene, frame);
            mesa_draw(&scene, frame, &mesa);
            rig_begin(&rig);
            assert_int_equal(ph_draw_mesh(&rig.r, &mesh.mesh, &pose), PH_OK);
            assert_true(rig_finish(&rig));
            compare(&rig, &mesa, scene.id);
        }
        const struct difference *t = &table[id];
        printf("%-10s %8.4f %% %10.2e %7.3f %%\n", scene.name, 100 * t->differ / t->covered,
               sqrt(t->depth_square / t->smooth), t->texels > 0 ? 100 * t->wrong / t->texels : 0);
        rig_mesh_free(&mesh);
        ref_scene_free(&scene);
    }
    rig_close(&rig);
    return 0;
}

static int release(void **state)
{
    (void)state;
    mesa_close(&gl);
    return 0;
}

/* ---- tests -------------------------------------------------------------------------------------------------- */

static void mesa_drew_the_scenes(void **state)
{
    static const double covered[REF_SCENES] = {22390, 36919, 76800, 16929, 57839};
    (void)state;
    for (int id = 0; id < REF_SCENES; id++) {
        assert_true(fabs(table[id].covered / 8 - covered[id]) < 10);
        assert_true(table[id].smooth > .5 * table[id].covered);
    }
}

static void coverage_is_that_of_mesa(void **state)
{
    (void)state;
    for (int id = 0; id < REF_SCENES; id++) {
        assert_true(100 * table[id].differ / table[id].covered <= bounds[id].coverage_percent);
    }
}

static void depth_is_that_of_mesa(void **state)
{
    (void)state;
    for (int id = 0; id < REF_SCENES; id++) {
        assert_true(sqrt(table[id].depth_square / table[id].smooth) <= bounds[id].depth_rms);
    }
}

static void texels_are_those_of_mesa(void **state)
{
    (void)state;
    assert_true(100 * table[REF_CUBE].wrong / table[REF_CUBE].texels <= bounds[REF_CUBE].texel_percent);
}

/* Asked by LeakSanitizer: Mesa keeps some memory until the process ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa\n";
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mesa_drew_the_scenes),
        cmocka_unit_test(coverage_is_that_of_mesa),
        cmocka_unit_test(depth_is_that_of_mesa),
        cmocka_unit_test(texels_are_those_of_mesa),
    };
    return cmocka_run_group_tests(tests, measure_all, release);
}
