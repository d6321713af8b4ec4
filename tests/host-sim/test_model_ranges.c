/*
 * Models that a reader has to be careful with: nodes of scale 0 at rest, axes of very different lengths, morph targets
 * larger than the model, places far away. Each is a glTF file of cubes that the test writes, played by the firmware's
 * fixed point, and compared with the product of its matrices in double precision.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEAR   1e-3 /* radii of the model */
#define FRAMES 30   /* of a clip of one second */
#define CUBES  2    /* at most */

/* ---- files ------------------------------------------------------------------------------------------------------- */

static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint16_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/* A clip of two keys, at 0 and 1 s or at `times`, in up to two channels. */
struct file {
    const char *nodes, *scene; /* JSON */
    struct {
        const char *path;
        int node, width; /* numbers of a key; 1: a weight */
        float from[4], to[4];
    } channels[2];
    float target[3]; /* what morph target 0 adds to all corners above the middle; 0: there is none */
    float times[2];  /* 0, 0: 0 and 1 s */
};

static const char *type_of(int width)
{
    return width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
}

/* Writes the file; accessors: 0 positions, 1 indices, 2 the target, 3 times, 4 and 5 keys. */
static const char *write_file(const struct file *f)
{
    struct {
        float positions[8][3];
        uint16_t indices[36];
        float target[8][3], times[2], keys[2][8];
    } data = {.times = {0, 1}};
    static char text[8192];
    char *base64, *at = text;
    if (f->times[1] > 0) {
        memcpy(data.times, f->times, sizeof data.times);
    }
    memcpy(data.positions, corners, sizeof corners);
    memcpy(data.indices, faces, sizeof faces);
    for (int i = 0; i < 24; i++) {
        data.target[i / 3][i % 3] = corners[i / 3][1] > 0 ? f->target[i % 3] : 0;
    }
    const bool morphs = f->target[0] != 0 || f->target[1] != 0 || f->target[2] != 0;
    for (int c = 0; c < 2; c++) {
        const int width = f->channels[c].width;
        memcpy(data.keys[c], f->channels[c].from, (size_t)width * sizeof(float));
        memcpy(data.keys[c] + width, f->channels[c].to, (size_t)width * sizeof(float));
    }
    base64 = file_base64((const uint8_t *)&data, sizeof data);
    at += sprintf(at,
                  "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":%s}],\"nodes\":%s,"
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1%s}]}],"
                  "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s\"}],",
                  f->scene, f->nodes, morphs ? ",\"targets\":[{\"POSITION\":2}]" : "", sizeof data, base64);
    free(base64);
    at += sprintf(at,
                  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],\"accessors\":["
                  "{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
                  "{\"bufferView\":0,\"byteOffset\":96,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"},"
                  "{\"bufferView\":0,\"byteOffset\":168,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
                  "{\"bufferView\":0,\"byteOffset\":264,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"}",
                  sizeof data);
    for (int c = 0; c < 2 && f->channels[c].path != NULL; c++) {
        at += sprintf(at, ",{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5126,\"count\":2,\"type\":\"%s\"}",
                      272 + 32 * c, type_of(f->channels[c].width));
    }
    at += sprintf(at, "],\"animations\":[{\"name\":\"a\",\"samplers\":[{\"input\":3,\"output\":4}%s],\"channels\":[",
                  f->channels[1].path != NULL ? ",{\"input\":3,\"output\":5}" : "");
    for (int c = 0; c < 2 && f->channels[c].path != NULL; c++) {
        at += sprintf(at, "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}", c > 0 ? "," : "", c,
                      f->channels[c].node, f->channels[c].path);
    }
    sprintf(at, "]}]}");
    return file_text("ranges.gltf", text);
}

/* ---- what is right ----------------------------------------------------------------------------------------------- */

/* Where a corner of a cube is at a time, in the file's units. */
typedef void (*truth)(int cube, const double c[3], double t, double p[3]);

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

struct cloud {
    double points[CUBES * 8][3];
    int count;
};

static struct cloud true_cloud(const struct model *model, truth right, int cubes, double t)
{
    struct cloud cloud = {.count = 8 * cubes};
    for (int i = 0; i < cloud.count; i++) {
        const double c[3] = {(double)corners[i % 8][0], (double)corners[i % 8][1], (double)corners[i % 8][2]};
        double p[3];
        right(i / 8, c, t, p);
        for (int k = 0; k < 3; k++) {
            cloud.points[i][k] = (p[k] - model->motion->centre[k]) * model->scale;
        }
    }
    return cloud;
}

/* Whether every vertex is where a corner has to be, and every corner has a vertex; and all inside of the outline. */
static void expect_cloud(const struct ph_mesh *meshes, uint32_t count, const struct cloud *cloud,
                         const struct animation *a)
{
    bool found[CUBES * 8] = {false};
    for (uint32_t m = 0; m < count; m++) {
        for (uint32_t v = 0; v < meshes[m].vertex_count; v++) {
            const struct fx_vec3 *at = &meshes[m].positions[v];
            const double p[3] = {at->x / 65536., at->y / 65536., at->z / 65536.};
            double nearest = HUGE_VAL;
            for (int i = 0; i < cloud->count; i++) {
                const double off = distance(p, cloud->points[i]);
                nearest = fmin(nearest, off);
                found[i] = found[i] || off <= NEAR;
            }
            if (!(nearest <= NEAR)) {
                fail_msg("mesh %u, vertex %u: off by %g", m, v, nearest);
            }
            for (int k = 0; k <= 16; k++) {
                const double angle = (k - 8) * 3.14159265 / 16, x = cos(angle), y = sin(angle);
                double most = -HUGE_VAL;
                for (uint32_t i = 0; i < a->outline_count; i++) {
                    most = fmax(most, x * a->outline[i].x / 65536 + y * a->outline[i].y / 65536);
                }
                assert_true(x * hypot(p[0], p[2]) + y * p[1] < most + .01);
            }
        }
    }
    for (int i = 0; i < cloud->count; i++) {
        assert_true(found[i]);
    }
}

/* Whether the normals of a convex mesh are at right angles to the faces that they belong to, and look outwards. Returns
 * whether faces look inwards by the order of their corners. */
static bool expect_normals(const struct ph_mesh *mesh)
{
    double middle[3] = {0, 0, 0};
    bool is_mirrored = false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            middle[k] += (double)(&mesh->positions[i].x)[k] / mesh->vertex_count;
        }
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint16_t *t = mesh->triangles[i];
        const struct fx_vec3 *p = &mesh->positions[t[0]], *q = &mesh->positions[t[1]], *r = &mesh->positions[t[2]];
        const double u[3] = {q->x - p->x, q->y - p->y, q->z - p->z}, v[3] = {r->x - p->x, r->y - p->y, r->z - p->z};
        const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double out = n[0] * (p->x - middle[0]) + n[1] * (p->y - middle[1]) + n[2] * (p->z - middle[2]);
        const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (out < 0 ? -1 : 1);
        for (int k = 0; k < 3 && fabs(size) > 1e7;
             k++) { /* faces large enough that their own rounding does not count */
            assert_true(fabs(n[k] / size - mesh->normals[t[0]][k] / 16384.) < 1. / 64);
            is_mirrored = is_mirrored || size < 0;
        }
    }
    return is_mirrored;
}

static uint64_t memory[1 << 13];

/* Plays a file; moving: how many of its meshes move. */
static void plays(const struct file *file, truth right, int cubes, uint32_t moving)
{
    struct model *model = open_good(write_file(file));
    struct demo_arena arena = {.base = (uint8_t *)memory, .size = sizeof memory};
    const struct animation *a = &model->motion->animation;
    const struct animation_stage *stage = animation_begin(&arena, a, model->meshes, model->mesh_count);
    assert_non_null(stage);
    assert_int_equal(a->mesh_count, moving);
    bool is_mirrored[CUBES] = {false};
    const double begin = (double)file->times[0], end = file->times[1] > 0 ? (double)file->times[1] : 1;
    const uint32_t first = (uint32_t)(begin * FRAMES);
    for (uint32_t frame = first; frame < first + FRAMES; frame++) {
        const double time = fmod(frame / (double)FRAMES, end);
        const struct cloud cloud = true_cloud(model, right, cubes, fmax(0, (time - begin) / (end - begin)));
        animation_move(stage, NULL, frame);
        expect_cloud(stage->meshes, model->mesh_count, &cloud, a);
        for (uint32_t i = 0; i < model->mesh_count; i++) {
            is_mirrored[i] = expect_normals(&stage->meshes[i]) || is_mirrored[i];
        }
    }
    for (uint32_t i = 0; i < model->mesh_count; i++) { /* faces that turn over are drawn from both sides */
        assert_int_equal(model->meshes[i].materials->two_sided, is_mirrored[i]);
    }
    model_close(model);
}

/* ---- cases ------------------------------------------------------------------------------------------------------- */

static void grown(int cube, const double c[3], double t, double p[3])
{
    for (int k = 0; k < 3; k++) {
        p[k] = cube == 0 ? t * c[k] : c[k] + 3 * (k == 0);
    }
}

static void what_has_no_size_at_rest_grows(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"mesh\":0,\"scale\":[0,0,0]},{\"mesh\":0,\"translation\":[3,0,0]}]",
                         "[0,1]",
                         {{"scale", 0, 3, {0, 0, 0}, {1, 1, 1}}},
                         {0},
                         {0}},
          grown, 2, 1);
}

static void beside_a_floor(int cube, const double c[3], double t, double p[3])
{
    p[0] = cube == 0 ? 3 * c[0] : .5 * c[0] + 2 * t;
    p[1] = cube == 0 ? .05 * c[1] - 1.2 : .5 * c[1];
    p[2] = cube == 0 ? 3 * c[2] : .5 * c[2];
}

static void a_floor_stands_still_beside_what_moves(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"mesh\":0,\"scale\":[3,0.05,3],\"translation\":[0,-1.2,0]},"
                         "{\"mesh\":0,\"scale\":[0.5,0.5,0.5]}]",
                         "[0,1]",
                         {{"translation", 1, 3, {0, 0, 0}, {2, 0, 0}}},
                         {0},
                         {0}},
          beside_a_floor, 2, 1);
}

static void on_a_lift(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    p[0] = 3 * c[0];
    p[1] = .05 * c[1] + 10 * t;
    p[2] = 3 * c[2];
}

/* Its rest pose is 50 away from all that the clip shows. */
static void a_thin_floor_moves(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"mesh\":0,\"scale\":[3,0.05,3],\"translation\":[50,0,0]}]",
                         "[0]",
                         {{"translation", 0, 3, {0, 0, 0}, {0, 10, 0}}},
                         {0},
                         {0}},
          on_a_lift, 1, 1);
}

/* A turn about z of up to 120 degrees in a node that grows along y to 3, .25 beside its parent: see the file. */
static void stretched(int cube, const double c[3], double t, double p[3])
{
    const double angle = 2.0943951 * t, x = cos(angle) * c[0] - sin(angle) * c[1] + 1,
                 y = sin(angle) * c[0] + cos(angle) * c[1];
    (void)cube;
    p[0] = x;
    p[1] = y * (.125 + t * 2.875);
    p[2] = c[2];
}

static void what_turns_in_what_is_stretched_is_sheared(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"children\":[1]},{\"mesh\":0,\"translation\":[1,0,0]}]",
                         "[0]",
                         {{"scale", 0, 3, {1, .125f, 1}, {1, 3, 1}},
                          {"rotation", 1, 4, {0, 0, 0, 1}, {0, 0, .8660254f, .5f}}},
                         {0},
                         {0}},
          stretched, 1, 1);
}

static void turned_over(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    p[0] = c[0] * (1 - 2 * t);
    p[1] = c[1] * (1 + t);
    p[2] = c[2] * (.5 - t);
}

static void inside_out(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    for (int k = 0; k < 3; k++) {
        p[k] = c[k] * (k == 0 ? 1 - 3 * t : 1);
    }
}

/* Two axes that change their signs are a turn by half; one makes the mirror image. */
static void a_scale_may_change_its_sign(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"mesh\":0}]", "[0]", {{"scale", 0, 3, {1, 1, .5f}, {-1, 2, -.5f}}}, {0}, {0}}, turned_over,
          1, 1);
    plays(&(struct file){"[{\"mesh\":0}]", "[0]", {{"scale", 0, 3, {1, 1, 1}, {-2, 1, 1}}}, {0}, {0}}, inside_out, 1,
          1);
}

static void exchanged(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    for (int k = 0; k < 3; k++) {
        p[k] = c[k] * (.01 + t * .99) * (100 - t * 99) + 4 * (k == 0) * (.01 + t * .99);
    }
}

/* A node grows a hundredfold while what stands in it shrinks. */
static void scales_above_one_another_may_be_far_apart(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"children\":[1]},{\"mesh\":0,\"translation\":[4,0,0]}]",
                         "[0]",
                         {{"scale", 0, 3, {.01f, .01f, .01f}, {1, 1, 1}}, {"scale", 1, 3, {100, 100, 100}, {1, 1, 1}}},
                         {0},
                         {0}},
          exchanged, 1, 1);
}

static void morphed(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    p[0] = c[0];
    p[1] = c[1] + (c[1] > 0 ? 40 * t : 0);
    p[2] = c[2];
}

static void a_target_may_be_larger_than_the_mesh(void **state)
{
    (void)state;
    plays(&(struct file){"[{\"mesh\":0}]", "[0]", {{"weights", 0, 1, {0}, {1}}}, {0, 40, 0}, {0}}, morphed, 1, 1);
    plays(&(struct file){"[{\"mesh\":0}]", "[0]", {{"weights", 0, 1, {0}, {50}}}, {0, .8f, 0}, {0}}, morphed, 1, 1);
}

static void dashes(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    for (int k = 0; k < 3; k++) {
        p[k] = c[k] + (k == 0) * 40 * t;
    }
}

/* Four radii a second for half a second, at the end of a minute. */
static void a_long_clip_keeps_its_time(void **state)
{
    (void)state;
    plays(
        &(struct file){
            "[{\"mesh\":0}]", "[0]", {{"translation", 0, 3, {0, 0, 0}, {40, 0, 0}}}, {0}, {59.00048f, 59.49951f}},
        dashes, 1, 1);
}

static void far_away(int cube, const double c[3], double t, double p[3])
{
    (void)cube;
    for (int k = 0; k < 3; k++) {
        p[k] = c[k] + 16384 + (k == 2) * 2 * t;
    }
}

static void a_model_may_lie_far_from_the_origin(void **state)
{
    (void)state;
    plays(
        &(struct file){
            "[{\"mesh\":0}]", "[0]", {{"translation", 0, 3, {16384, 16384, 16384}, {16384, 16384, 16386}}}, {0}, {0}},
        far_away, 1, 1);
}

static void a_number_that_has_no_room_is_named(void **state)
{
    const struct file file = {"[{\"children\":[1]},{\"mesh\":0,\"translation\":[-1000,0,0]}]",
                              "[0]",
                              {{"translation", 0, 3, {1000, 0, 0}, {1001, 0, 0}}},
                              {0},
                              {0}};
    struct model *model = NULL;
    char said[1024];
    (void)state;
    assert_int_not_equal(open_caught(&model, write_file(&file), said), 0);
    assert_non_null(strstr(said, "cannot be shown: the translation in radii of the model of node 1 is"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_has_no_size_at_rest_grows),
        cmocka_unit_test(a_floor_stands_still_beside_what_moves),
        cmocka_unit_test(a_thin_floor_moves),
        cmocka_unit_test(what_turns_in_what_is_stretched_is_sheared),
        cmocka_unit_test(a_scale_may_change_its_sign),
        cmocka_unit_test(scales_above_one_another_may_be_far_apart),
        cmocka_unit_test(a_target_may_be_larger_than_the_mesh),
        cmocka_unit_test(a_long_clip_keeps_its_time),
        cmocka_unit_test(a_model_may_lie_far_from_the_origin),
        cmocka_unit_test(a_number_that_has_no_room_is_named),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
