/*
 * The quality of the pictures of the five benchmark scenes is measured against the double-precision reference (ref.h),
 * at 320x240 in the frames 0, 8, .. 56. Prints a table and compares it with the bars below. Every scene is measured
 * twice: with the reference's own geometry, quantised to a mesh, and as the demo that ships.
 *
 * Definitions:
 * - coverage: pixels drawn by one and not by the other, in % of the pixels that the reference covers;
 * - twice, holes: triangle by triangle draws a pixel more or less often than the reference, at pixels where the
 *   reference's count is constant over 5x5;
 * - depth: a pixel is smooth if its 3x3 neighbours are all covered in both pictures and the reference's window depth
 *   changes by less than SMOOTH over them; RMS of the difference of window depths (fixed16), of the relative
 *   difference of distances (float16);
 * - texels: wrong colours among pixels whose 5x5 neighbours show the same face;
 * - colour: RMS of the difference to the exact, perspective-correct intensity, in 1/255, smooth pixels.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo.h"
#include "option_text.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH  320
#define HEIGHT 240
#define PIXELS (WIDTH * HEIGHT)
#define STEP   8 /* frames */
#define LAST   56
#define SMOOTH .01

enum source { OWN_MESH, DEMO, SOURCES };

struct quality {
    double frames, covered, differ, twice, holes;
    double smooth, depth_square, distance_square, colour_square;
    double texels, wrong;
};

#define FORMATS (PH_DEPTH_FORMATS - 1) /* 1 .. FORMATS are measured */

static struct quality table[SOURCES][REF_SCENES][PH_DEPTH_FORMATS];

/* ---- measuring one picture ------------------------------------------------------------------------------ */

static bool drawn(const struct rig *rig, int x, int y)
{
    return rig->depth[y * WIDTH + x] != 0;
}

static bool is_smooth(const struct rig *rig, const struct ref_picture *ref, int x, int y)
{
    double low = 1, high = 0;
    for (int v = y - 1; v <= y + 1; v++) {
        for (int u = x - 1; u <= x + 1; u++) {
            struct ref_pixel pixel = ref_at(ref, u, v);
            if (pixel.triangle < 0 || !drawn(rig, u, v)) {
                return false;
            }
            double d = ref_window_depth(&ref->camera, pixel.z);
            low = fmin(low, d);
            high = fmax(high, d);
        }
    }
    return high - low < SMOOTH;
}

static bool inside_face(const struct ref_scene *scene, const struct ref_picture *ref, int x, int y)
{
    int middle = ref_at(ref, x, y).triangle;
    for (int v = y - 2; v <= y + 2; v++) {
        for (int u = x - 2; u <= x + 2; u++) {
            int triangle = ref_at(ref, u, v).triangle;
            if (middle < 0 || triangle < 0 || scene->faces[triangle] != scene->faces[middle]) {
                return false;
            }
        }
    }
    return true;
}

static uint16_t exact_texel(const struct ref_pixel *pixel)
{
    int x = (int)floor(pixel->uv[0] * REF_TEXTURE_SIZE), y = (int)floor(pixel->uv[1] * REF_TEXTURE_SIZE);
    uint32_t rgb = ref_texel(x & (REF_TEXTURE_SIZE - 1), y & (REF_TEXTURE_SIZE - 1));
    return ph_rgb565((uint8_t)(rgb >> 16), (uint8_t)(rgb >> 8), (uint8_t)rgb);
}

static void measure_smooth(const struct rig *rig, const struct ref_pixel *pixel, int x, int y, struct quality *q)
{
    static const double base[3] = {255, 160, 64};
    double z = rig_distance(rig, rig->depth[y * WIDTH + x], ref_benchmark.near_z, ref_benchmark.far_z), rgb[3];
    double window = ref_window_depth(&ref_benchmark, z) - ref_window_depth(&ref_benchmark, pixel->z);
    q->smooth++;
    q->depth_square += window * window;
    q->distance_square += (z / pixel->z - 1) * (z / pixel->z - 1);
    rig_rgb(rig, x, y, rgb);
    for (int k = 0; k < 3; k++) {
        double difference = rgb[k] - base[k] * fmin(pixel->intensity, 1);
        q->colour_square += difference * difference / 3;
    }
}

/* Its place in ph_depth_formats. */
static int number_of(const struct ph_depth_format *format)
{
    int number = 0;
    while (ph_depth_formats[number] != format) {
        number++;
    }
    return number;
}

static void measure(const struct rig *rig, const struct ref_scene *scene, const struct ref_picture *ref,
                    enum source source)
{
    struct quality *q = &table[source][scene->id][number_of(rig->r.stats.depth_format)];
    q->frames++;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            struct ref_pixel pixel = ref_at(ref, x, y);
            q->covered += pixel.triangle >= 0;
            q->differ += (pixel.triangle >= 0) != drawn(rig, x, y);
            if (is_smooth(rig, ref, x, y)) {
                measure_smooth(rig, &pixel, x, y, q);
            }
            if (scene->id == REF_CUBE && inside_face(scene, ref, x, y)) {
                q->texels++;
                q->wrong += rig->pixels[y * WIDTH + x] != exact_texel(&pixel);
            }
            if (scene->id == REF_FILL && source == OWN_MESH) {
                q->texels++;
                q->wrong += rig->pixels[y * WIDTH + x] != rig_fill_colour(scene->faces[pixel.triangle]);
            }
        }
    }
}

/* ---- triangle by triangle ------------------------------------------------------------------------------- */

/* A mesh triangle by triangle: how often each pixel is drawn. */
static void count_draws(struct rig *rig, const struct rig_mesh *mesh, const struct ph_xform *pose, uint8_t *count)
{
    struct rig_one one;
    memset(count, 0, PIXELS);
    for (int i = 0; i < (int)mesh->mesh.triangle_count; i++) {
        rig_one_triangle(&one, &mesh->mesh, i);
        rig_begin(rig);
        assert_int_equal(ph_draw_mesh(&rig->r, &one.mesh, pose), PH_OK);
        if (rig->r.stats.triangles_drawn == 0) {
            continue;
        }
        assert_true(rig_finish(rig));
        for (int p = 0; p < PIXELS; p++) {
            count[p] = (uint8_t)(count[p] + (rig->depth[p] != 0));
        }
    }
}

static void compare_counts(const struct ref_picture *ref, const uint8_t *count, struct quality *q)
{
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            int exact = ref_at(ref, x, y).count;
            bool constant = true;
            for (int v = y < 2 ? 0 : y - 2; v <= y + 2 && v < HEIGHT; v++) {
                for (int u = x < 2 ? 0 : x - 2; u <= x + 2 && u < WIDTH; u++) {
                    constant = constant && ref_at(ref, u, v).count == exact;
                }
            }
            q->twice += constant && count[y * WIDTH + x] > exact;
            q->holes += constant && count[y * WIDTH + x] < exact;
        }
    }
}

/* ---- the scenes ------------------------------------------------------------------------------------------- */

static const char *const demo_names[REF_SCENES] = {"torus", "cube", "fill", "icosphere", "ground"};

/* One scene in one depth format, drawn both ways. */
struct stage {
    struct rig own_rig, demo_rig;
    const struct demo *demo;
    struct demo_context context;
};

static void stage_open(struct stage *stage, const struct ref_scene *scene, const struct ph_depth_format *format)
{
    const struct demo *demo = demo_find(demo_names[scene->id]);
    assert_non_null(demo);
    *stage = (struct stage){.demo = demo, .context = {.width = WIDTH, .height = HEIGHT}};
    rig_open(&stage->own_rig, WIDTH, HEIGHT, HEIGHT, format, 4096, 8192);
    rig_open(&stage->demo_rig, WIDTH, HEIGHT, HEIGHT, format, (int)demo->vertex_max, (int)demo->triangle_max);
    stage->context.arena.base = calloc(1, demo->arena_bytes);
    stage->context.arena.size = demo->arena_bytes;
    assert_non_null(stage->context.arena.base);
    assert_int_equal(demo->init(&stage->context), PH_OK);
}

static void stage_close(struct stage *stage)
{
    free(stage->context.arena.base);
    rig_close(&stage->own_rig);
    rig_close(&stage->demo_rig);
}

static void finish(struct rig *rig)
{
    assert_int_equal(rig->r.stats.triangles_dropped, 0);
    assert_int_equal(rig->r.stats.vertices_dropped, 0);
    assert_true(rig_finish(rig));
}

static void measure_frame(struct stage *stage, const struct ref_scene *scene, const struct rig_mesh *mesh,
                          const struct ref_picture *ref, int frame, int format)
{
    struct ph_xform pose = rig_pose(scene, frame);
    rig_begin(&stage->own_rig);
    assert_int_equal(ph_draw_mesh(&stage->own_rig.r, &mesh->mesh, &pose), PH_OK);
    finish(&stage->own_rig);
    measure(&stage->own_rig, scene, ref, OWN_MESH);

    assert_int_equal(stage->demo->frame(&stage->context, &stage->demo_rig.r, (uint32_t)frame), PH_OK);
    finish(&stage->demo_rig);
    measure(&stage->demo_rig, scene, ref, DEMO);

    if (ph_depth_formats[format] == PH_DEPTH_FIXED16 && scene->id != REF_CUBE && scene->id != REF_FILL) {
        static uint8_t count[PIXELS];
        count_draws(&stage->own_rig, mesh, &pose, count);
        compare_counts(ref, count, &table[OWN_MESH][scene->id][format]);
    }
}

static void measure_scene(const struct ref_scene *scene)
{
    struct stage stages[PH_DEPTH_FORMATS];
    struct rig_mesh mesh;
    rig_mesh_build(&mesh, scene);
    for (int format = 1; format <= FORMATS; format++) {
        stage_open(&stages[format], scene, ph_depth_formats[format]);
    }
    for (int frame = 0; frame <= LAST; frame += STEP) {
        struct ref_picture ref;
        ref_draw(&ref, &ref_benchmark, scene, frame);
        for (int format = 1; format <= FORMATS; format++) {
            measure_frame(&stages[format], scene, &mesh, &ref, frame, format);
        }
        ref_picture_free(&ref);
    }
    for (int format = 1; format <= FORMATS; format++) {
        stage_close(&stages[format]);
    }
    rig_mesh_free(&mesh);
}

static int measure_all(void **state)
{
    (void)state;
    for (int id = 0; id < REF_SCENES; id++) {
        struct ref_scene scene;
        ref_scene_build(&scene, (enum ref_scene_id)id);
        measure_scene(&scene);
        ref_scene_free(&scene);
    }
    return 0;
}

/* ---- the table -------------------------------------------------------------------------------------------- */

static double coverage_percent(const struct quality *q)
{
    return 100 * q->differ / q->covered;
}

static double depth_rms(const struct quality *q)
{
    return sqrt(q->depth_square / q->smooth);
}

static double distance_rms(const struct quality *q)
{
    return sqrt(q->distance_square / q->smooth);
}

static double wrong_percent(const struct quality *q)
{
    return 100 * q->wrong / q->texels;
}

static int print_table(void **state)
{
    static const char *const names[REF_SCENES] = {"S1 torus", "S2 cube", "S3 fill", "S4 sphere", "S5 ground"};
    (void)state;
    printf("%-10s %-5s %-8s %10s %6s %6s %10s %10s %8s %7s\n", "scene", "mesh", "depth", "coverage", "twice", "holes",
           "depth RMS", "dist. RMS", "wrong", "colour");
    for (int i = 0; i < REF_SCENES * SOURCES * FORMATS; i++) {
        int scene = i / (SOURCES * FORMATS), source = i / FORMATS % SOURCES, format = 1 + i % FORMATS;
        const struct quality *q = &table[source][scene][format];
        char name[OPTION_DEPTH_NAME];
        printf("%-10s %-5s %-8s %8.4f %% %6.0f %6.0f %10.2e %10.2e %6.3f %% %7.2f\n", names[scene],
               source == DEMO ? "demo" : "own",
               option_text_depth_name((struct option_depth){ph_depth_formats[format], 0}, name), coverage_percent(q),
               q->twice, q->holes, depth_rms(q), distance_rms(q), q->texels > 0 ? wrong_percent(q) : 0,
               scene == REF_CUBE || scene == REF_FILL ? 0 : sqrt(q->colour_square / q->smooth));
    }
    return 0;
}

/* Asserts a measured value, telling both numbers where it fails. */
static void at_most(const char *what, int scene, double value, double bar)
{
    if (!(value <= bar)) {
        fail_msg("scene %d: %s is %g, the bar is %g", scene + 1, what, value, bar);
    }
}

/* What covers all pixels, every frame, cannot have been measured on an empty picture. */
static void all_frames_were_measured(void **state)
{
    static const double covered[REF_SCENES] = {22390, 36919, 76800, 16929, 57839};
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES * FORMATS; i++) {
        const struct quality *q = &table[i / FORMATS % SOURCES][i / (SOURCES * FORMATS)][1 + i % FORMATS];
        assert_true(q->frames == 8);
        assert_true(fabs(q->covered / 8 - covered[i / (SOURCES * FORMATS)]) < 1);
        assert_true(q->smooth > .5 * q->covered);
    }
}

static void coverage_is_that_of_the_reference(void **state)
{
    static const double bars[REF_SCENES] = {.02, .02, 0, .02, .005};
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES * FORMATS; i++) {
        int scene = i / (SOURCES * FORMATS);
        at_most("coverage %", scene, coverage_percent(&table[i / FORMATS % SOURCES][scene][1 + i % FORMATS]),
                bars[scene]);
    }
}

static void no_pixel_is_drawn_twice_or_left_out(void **state)
{
    (void)state;
    for (int scene = 0; scene < REF_SCENES; scene++) {
        at_most("drawn twice", scene, table[OWN_MESH][scene][number_of(PH_DEPTH_FIXED16)].twice, 0);
        at_most("holes", scene, table[OWN_MESH][scene][number_of(PH_DEPTH_FIXED16)].holes, 0);
    }
}

static void fixed16_depth_is_that_of_the_reference(void **state)
{
    static const double bars[REF_SCENES] = {1.5e-5, 1.5e-5, 1.5e-5, 1.5e-5, 2e-5};
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES; i++) {
        at_most("depth RMS", i / 2, depth_rms(&table[i % 2][i / 2][number_of(PH_DEPTH_FIXED16)]), bars[i / 2]);
    }
}

static void float16_distance_is_that_of_the_reference(void **state)
{
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES; i++) {
        at_most("distance RMS", i / 2, distance_rms(&table[i % 2][i / 2][number_of(PH_DEPTH_FLOAT16)]), 2e-4);
    }
}

/* What remains is the 1/256 px of the screen positions: on the ground, seen at a low angle, that is more. The quad that
 * fills the picture has one code, half of which it may be off: 2^-25. */
static void depth_of_24_bits_is_that_of_the_reference(void **state)
{
    static const double depth[REF_SCENES] = {2e-6, 2e-6, 3e-8, 2e-6, 1e-5};
    static const double distance[REF_SCENES] = {1e-5, 1e-5, 2e-7, 1e-5, 3e-5};
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES * 2; i++) {
        const int scene = i / 2 / SOURCES;
        const struct quality *q =
            &table[i / 2 % SOURCES][scene][number_of(i % 2 ? PH_DEPTH_FLOAT24 : PH_DEPTH_FIXED24)];
        at_most("depth RMS", scene, depth_rms(q), depth[scene]);
        at_most("distance RMS", scene, distance_rms(q), distance[scene]);
    }
}

/* The step of linear-w is 1.5 mm everywhere; distances begin at 0.5 (ground) or 2 (the others). */
static void linear_w_distance_is_that_of_the_reference(void **state)
{
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES; i++) {
        at_most("distance RMS", i / 2, distance_rms(&table[i % 2][i / 2][number_of(PH_DEPTH_LINEAR_W)]),
                i / 2 == REF_GROUND ? 5e-4 : 2.5e-4);
    }
}

static void texels_are_those_of_the_reference(void **state)
{
    (void)state;
    for (int i = 0; i < SOURCES * FORMATS; i++) {
        assert_true(table[i / FORMATS][REF_CUBE][1 + i % FORMATS].texels > 200000);
        at_most("wrong texels %", REF_CUBE, wrong_percent(&table[i / FORMATS][REF_CUBE][1 + i % FORMATS]), .6);
    }
}

static void nearest_quad_fills_the_picture(void **state)
{
    (void)state;
    at_most("wrong pixels", REF_FILL, table[OWN_MESH][REF_FILL][number_of(PH_DEPTH_FIXED16)].wrong, 0);
    at_most("wrong pixels", REF_FILL, table[OWN_MESH][REF_FILL][number_of(PH_DEPTH_FLOAT16)].wrong, 0);
}

/* Light is linear on the screen: on the ground's large triangles before the camera that differs from exact. */
static void gouraud_light_is_that_of_the_reference(void **state)
{
    static const int lit[3] = {REF_TORUS, REF_SPHERE, REF_GROUND};
    static const double bars[3] = {2.5, 2.5, 4.5};
    (void)state;
    for (int i = 0; i < 3 * SOURCES * FORMATS; i++) {
        const struct quality *q = &table[i / FORMATS % SOURCES][lit[i / (SOURCES * FORMATS)]][1 + i % FORMATS];
        at_most("colour RMS", lit[i / (SOURCES * FORMATS)], sqrt(q->colour_square / q->smooth),
                bars[i / (SOURCES * FORMATS)]);
    }
}

/*
 * A fifth over what the code reached when this was written (twice for coverage: it is a handful of pixels): tells of a
 * loss long before a bar is met.
 */
static void nothing_slipped_from_what_was_reached(void **state)
{
    static const struct {
        double coverage, depth, distance;
    } reached[REF_SCENES] = {{.0033, 4.7e-6, 5.2e-5},
                             {.0014, 4.6e-6, 5.2e-5},
                             {0, 7.1e-6, 5.7e-5},
                             {.0016, 4.7e-6, 3.9e-5},
                             {.0009, 9.9e-6, 5.5e-5}};
    (void)state;
    for (int i = 0; i < REF_SCENES * SOURCES; i++) {
        int scene = i / SOURCES;
        const struct quality *q = table[i % SOURCES][scene];
        at_most("coverage %", scene, coverage_percent(&q[number_of(PH_DEPTH_FIXED16)]), 2 * reached[scene].coverage);
        at_most("depth RMS", scene, depth_rms(&q[number_of(PH_DEPTH_FIXED16)]), 1.2 * reached[scene].depth);
        at_most("distance RMS", scene, distance_rms(&q[number_of(PH_DEPTH_FLOAT16)]), 1.2 * reached[scene].distance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_frames_were_measured),
        cmocka_unit_test(coverage_is_that_of_the_reference),
        cmocka_unit_test(no_pixel_is_drawn_twice_or_left_out),
        cmocka_unit_test(fixed16_depth_is_that_of_the_reference),
        cmocka_unit_test(float16_distance_is_that_of_the_reference),
        cmocka_unit_test(depth_of_24_bits_is_that_of_the_reference),
        cmocka_unit_test(linear_w_distance_is_that_of_the_reference),
        cmocka_unit_test(texels_are_those_of_the_reference),
        cmocka_unit_test(nearest_quad_fills_the_picture),
        cmocka_unit_test(gouraud_light_is_that_of_the_reference),
        cmocka_unit_test(nothing_slipped_from_what_was_reached),
    };
    return cmocka_run_group_tests(tests, measure_all, print_table);
}
