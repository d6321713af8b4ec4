/*
 * Joints of a glTF skin: a triangle whose vertices follow up to eight joints, which are numbers of 16 bits. The weights
 * that stay are worked out by hand.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the buffer has, behind one another. */
struct data {
    float positions[3][3];
    uint16_t joints[2][3][4];
    float weights[2][3][4];
    float times[2], keys[2][3];
};

static const struct data good = {
    .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
    .joints = {{{0, 1, 2, 3}, {0, 1, 2, 3}, {5, 0, 0, 0}}, {{4, 0, 0, 0}, {4, 5, 0, 0}, {0, 0, 0, 0}}},
    .weights = {{{.25f, 0, .125f, .125f}, {.0625f, .1875f, 0, .25f}, {1, 0, 0, 0}},
                {{.5f, 0, 0, 0}, {.25f, .25f, 0, 0}, {0, 0, 0, 0}}},
    .times = {0, 1},
    .keys = {{0, 0, 0}, {1, 0, 0}},
};

#define VIEW(at, n) "{\"buffer\":0,\"byteOffset\":" at ",\"byteLength\":" n "}"
#define ACCESSOR(view, type, count, kind)                                                                              \
    "{\"bufferView\":" view ",\"componentType\":" type ",\"count\":" count ",\"type\":\"" kind "\"}"

/* Writes a file with these attributes beside the positions. */
static const char *write_file(const struct data *data, const char *attributes)
{
    char text[4096];
    char *base64 = file_base64((const uint8_t *)data, sizeof *data);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,4,5,6]}],"
             "\"nodes\":[{},{},{},{},{},{},{\"mesh\":0,\"skin\":0}],\"skins\":[{\"joints\":[0,1,2,3,4,5]}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s}}]}],"
             "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s\"}],"
             "\"bufferViews\":[" VIEW("0", "36") "," VIEW("36", "24") "," VIEW("60", "24") "," VIEW("84", "48") "," VIEW("132", "48") "," VIEW("180", "8") "," VIEW("188", "24") "],\"accessors\":[" ACCESSOR(
                 "0", "5126", "3",
                 "VEC3") "," ACCESSOR("1", "5123", "3",
                                      "VEC4") "," ACCESSOR("2", "5123", "3",
                                                           "VEC4") "," ACCESSOR("3", "5126", "3",
                                                                                "VEC4") "," ACCESSOR("4", "5126", "3",
                                                                                                     "VEC4") "," ACCESSOR("5",
                                                                                                                          "5126",
                                                                                                                          "2",
                                                                                                                          "SCALAR") "," ACCESSOR("6",
                                                                                                                                                 "5126",
                                                                                                                                                 "2",
                                                                                                                                                 "VEC3") "],\"animations\":[{\"samplers\":[{\"input\":5,\"output\":6}],"
                                                                                                                                                         "\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}]}]}",
             attributes, sizeof *data, base64);
    free(base64);
    return file_text("joints.gltf", text);
}

#define FOUR  ",\"JOINTS_0\":1,\"WEIGHTS_0\":3"
#define EIGHT FOUR ",\"JOINTS_1\":2,\"WEIGHTS_1\":4"

/* The share of a joint in what a vertex of the model follows, in 1/32768. */
static unsigned share_of(const struct model *model, int vertex, unsigned joint)
{
    const struct ph_influence *in = &model->motion->animation.meshes->bound.influences[vertex];
    unsigned sum = 0;
    for (int k = 0; k < 4; k++) {
        sum += in->joints[k] == joint ? in->weights[k] : 0;
    }
    return sum;
}

/* The vertex of the model at x, y of the file. */
static int vertex_at(const struct model *model, double x, double y)
{
    const struct model_motion *m = model->motion;
    const struct ph_bound *bound = &m->animation.meshes->bound;
    for (int i = 0; i < 3; i++) {
        if (fabs(ldexp(bound->positions[i][0], -bound->frac) - (x - m->centre[0]) * model->scale) < .01 &&
            fabs(ldexp(bound->positions[i][1], -bound->frac) - (y - m->centre[1]) * model->scale) < .01) {
            return i;
        }
    }
    fail_msg("no vertex is at %g, %g", x, y);
    return 0;
}

static void the_four_joints_with_the_largest_weights_count(void **state)
{
    struct model *model = open_good(write_file(&good, EIGHT));
    const int four = vertex_at(model, 0, 0), five = vertex_at(model, 1, 0), one = vertex_at(model, 0, 1);
    (void)state;
    assert_string_equal(model->note, "of more than four joints of a vertex the four with the largest weights count");
    /* 1/4, 1/8, 1/8 and 1/2 of the second set */
    assert_true(share_of(model, four, 0) == 8192 && share_of(model, four, 1) == 0);
    assert_true(share_of(model, four, 2) == 4096 && share_of(model, four, 3) == 4096);
    assert_true(share_of(model, four, 4) == 16384);
    /* 1/16 is lost: 3/16, 1/4, 1/4 and 1/4 of 15/16 are 1/5 and three times 4/15 */
    assert_int_equal(share_of(model, five, 0), 0);
    assert_true(abs((int)share_of(model, five, 1) - 6554) <= 2);
    for (unsigned joint = 3; joint < 6; joint++) {
        assert_true(abs((int)share_of(model, five, joint) - 8738) <= 2);
    }
    assert_int_equal(share_of(model, one, 5), 32768);
    model_close(model);
}

static void nothing_is_said_where_no_joint_is_lost(void **state)
{
    struct data data = good;
    (void)state;
    data.weights[0][1][0] = 0;
    struct model *model = open_good(write_file(&data, EIGHT));
    assert_null(model->note);
    model_close(model);
    model = open_good(write_file(&good, FOUR));
    assert_null(model->note);
    model_close(model);
}

static void a_joint_that_is_not_there_is_refused_in_any_set(void **state)
{
    struct data data = good;
    struct model *model;
    char said[1024];
    (void)state;
    data.joints[1][0][0] = 6;
    assert_int_equal(open_caught(&model, write_file(&data, EIGHT), said), COMPLAINED);
    assert_non_null(strstr(said, "a vertex follows a joint that is not there"));
}

static void a_set_has_joints_and_weights(void **state)
{
    static const char *const halves[] = {FOUR ",\"JOINTS_1\":2", FOUR ",\"WEIGHTS_1\":4"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct model *model;
        char said[1024];
        assert_int_equal(open_caught(&model, write_file(&good, halves[i]), said), COMPLAINED);
        assert_non_null(strstr(said, "a primitive has only one of JOINTS_1 and WEIGHTS_1"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_four_joints_with_the_largest_weights_count),
        cmocka_unit_test(nothing_is_said_where_no_joint_is_lost),
        cmocka_unit_test(a_joint_that_is_not_there_is_refused_in_any_set),
        cmocka_unit_test(a_set_has_joints_and_weights),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
