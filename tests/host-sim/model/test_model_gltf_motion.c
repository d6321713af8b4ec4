/* model_gltf_motion: skins, weights and animations as glTF 2.0 (3.7.3, 3.11) has them, of nodes that are made here: 0
 * shows mesh 0 with two morph targets, 1 and 2 are its children, 3 is not shown. The numbers of the file count up. */
#include "files.h"
#include "model_gltf_motion.h"
#include "motion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct gltf_file file;
static struct model_folder folder;
static struct model_scene scene;
static struct model_node nodes[5]; /* the last one is behind the scene's */
static struct model_mesh meshes[1];

/* Accessors: two scalars from 0 on, then from 4 on what their names say. 65,536 and 65,535 keys are zeros. */
enum { TIMES, TWO_VEC3, TWO_VEC4, FOUR, SIX_VEC3, TWELVE, TWO_MAT4, ONE_MAT4, MANY, MANY_VEC3, MOST, MOST_VEC3 };
#define FLOATS(count, type)                                                                                            \
    ",{\"bufferView\":0,\"byteOffset\":16,\"componentType\":5126,\"count\":" count ",\"type\":\"" type "\"}"
#define ZEROS(count, type) ",{\"componentType\":5126,\"count\":" count ",\"type\":\"" type "\"}"
#define ACCESSORS                                                                                                      \
    "{\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"}" FLOATS("2", "VEC3")                    \
        FLOATS("2", "VEC4") FLOATS("4", "SCALAR") FLOATS("6", "VEC3") FLOATS("12", "SCALAR") FLOATS("2", "MAT4")       \
            FLOATS("1", "MAT4") ZEROS("65536", "SCALAR") ZEROS("65536", "VEC3") ZEROS("65535", "SCALAR")               \
                ZEROS("65535", "VEC3")

static void open_file(const char *members)
{
    float numbers[64];
    char *const text = malloc(16384);
    assert_non_null(text);
    for (int i = 0; i < 64; i++) {
        numbers[i] = (float)i;
    }
    char *const data = file_base64((const void *)numbers, sizeof numbers);
    snprintf(text, 16384,
             "{\"asset\":{\"version\":\"2.0\"},%s,\"accessors\":[" ACCESSORS
             "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":256}],"
             "\"buffers\":[{\"byteLength\":256,\"uri\":\"data:;base64,%s\"}]}",
             members, data);
    folder = (struct model_folder){.model = file_text("a.gltf", text)};
    free(data);
    free(text);
    file = (struct gltf_file){.folder = NULL};
    assert_true(gltf_file_open(&file, &folder));
    nodes[0] =
        (struct model_node){.parent = MODEL_NONE, .child = 1, .next = MODEL_NONE, .mesh_count = 1, .is_shown = true};
    nodes[1] = (struct model_node){.parent = 0, .child = MODEL_NONE, .next = 2, .is_shown = true};
    nodes[2] = (struct model_node){.parent = 0, .child = MODEL_NONE, .next = MODEL_NONE, .is_shown = true};
    nodes[3] = (struct model_node){.parent = MODEL_NONE, .child = MODEL_NONE, .next = MODEL_NONE};
    nodes[4].is_shown = true;
    meshes[0] = (struct model_mesh){.moved = {.target_count = 2}};
    scene = (struct model_scene){.nodes = nodes, .meshes = meshes, .node_count = 4, .mesh_count = 1};
}

/* ---- skins ------------------------------------------------------------------------------------------------------ */

static void open_skins(const char *nodes_text, const char *skins, const char *weights)
{
    char text[8192];
    snprintf(text, sizeof text, "\"nodes\":[%s],\"skins\":[%s],\"meshes\":[{\"weights\":[%s]}]", nodes_text, skins,
             weights);
    open_file(text);
}

static void a_skin_has_joints_and_their_matrices(void **state)
{
    (void)state;
    open_skins("{\"mesh\":0,\"skin\":1},{\"skin\":0},{}",
               "{\"joints\":[0]},{\"joints\":[2,0],\"inverseBindMatrices\":6}", "");
    assert_true(model_gltf_skins_read(&file, &scene));
    assert_int_equal(scene.skin_count, 2);
    assert_true(nodes[0].skin == 1 && nodes[1].skin == 0 && nodes[2].skin == MODEL_NONE);
    assert_null(scene.skins[0].joints); /* its node shows no mesh */
    assert_int_equal(scene.skins[1].count, 2);
    assert_true(scene.skins[1].joints[0] == 2 && scene.skins[1].joints[1] == 0);
    assert_true(scene.skins[1].bind[0] == 4 && scene.skins[1].bind[31] == 35);
    open_skins("{\"mesh\":0,\"skin\":0},{},{}", "{\"joints\":[1]}", "");
    assert_true(model_gltf_skins_read(&file, &scene));
    assert_null(scene.skins[0].bind);
}

static void two_nodes_may_have_one_skin(void **state)
{
    (void)state;
    open_skins("{\"mesh\":0,\"skin\":0},{\"mesh\":0,\"skin\":0},{}", "{\"joints\":[1,2]}", "");
    nodes[1].mesh_count = 1;
    assert_true(model_gltf_skins_read(&file, &scene));
    assert_true(scene.skins[0].count == 2 && nodes[1].skin == 0);
}

static void refuse_skin(const char *node, const char *skin, const char *reason)
{
    open_skins(node, skin, "");
    assert_false(model_gltf_skins_read(&file, &scene));
    assert_string_equal(file.error, reason);
}

static void skins_that_are_broken_are_refused(void **state)
{
    static const char joint[] = "a skin has a joint that is not in the scene, or more than 256",
                      node[] = "{\"mesh\":0,\"skin\":0}";
    static const char *const wrong[] = {"3", "4", "-1", "\"1\"", "1,9"};
    char text[2048] = "{\"joints\":[0";
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char one[64];
        snprintf(one, sizeof one, "{\"joints\":[%s]}", wrong[i]);
        refuse_skin(node, one, joint);
    }
    refuse_skin(node, "{\"joints\":[]}", "a skin has no joints");
    refuse_skin(node, "{}", "a skin has no joints");
    refuse_skin(node, "{\"joints\":[1,2],\"inverseBindMatrices\":7}", "a skin has 2 joints and 1 matrices");
    refuse_skin("{\"skin\":1}", "{\"joints\":[1]}", "node 0 has a skin that is not there");
    refuse_skin("{},{\"skin\":-1}", "{\"joints\":[1]}", "node 1 has a skin that is not there");
    for (int n = 1; n <= 256; n++) { /* of 256 and of 257 */
        strcat(text, ",1");
        if (n == 255) {
            char most[2064];
            snprintf(most, sizeof most, "%s]}", text);
            open_skins(node, most, "");
            assert_true(model_gltf_skins_read(&file, &scene));
            assert_int_equal(scene.skins[0].count, 256);
        }
    }
    strcat(text, "]}");
    refuse_skin(node, text, joint);
}

static void weights_at_rest_are_the_nodes_before_those_of_the_mesh(void **state)
{
    static const struct {
        const char *node, *mesh;
        double weights[2];
    } cases[] = {{"{\"mesh\":0,\"weights\":[0.25,0.5]}", "0.75,1", {.25, .5}},
                 {"{\"mesh\":0}", "0.75,1", {.75, 1}},
                 {"{\"mesh\":0,\"weights\":[0.25]}", "0.75,1", {.25, 0}},
                 {"{\"mesh\":0,\"weights\":[3,4,5]}", "", {3, 4}},
                 {"{\"mesh\":0}", "", {0, 0}}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        open_skins(cases[i].node, "", cases[i].mesh);
        assert_true(model_gltf_skins_read(&file, &scene));
        assert_int_equal(nodes[0].weight_count, 2);
        assert_true(nodes[0].weights[0] == cases[i].weights[0] && nodes[0].weights[1] == cases[i].weights[1]);
        assert_int_equal(nodes[1].weight_count, 0);
    }
}

/* ---- animations ------------------------------------------------------------------------------------------------- */

/* Opens an animation with this channel's target and sampler, and with one more that moves node 1. */
static bool open_clip(const char *target, const char *interpolation, int input, int output)
{
    char text[1024];
    snprintf(
        text, sizeof text,
        "\"animations\":[{\"name\":\"walk\",\"channels\":[{\"sampler\":1,\"target\":{%s}},{\"sampler\":0,\"target\":"
        "{\"node\":1,\"path\":\"scale\"}}],\"samplers\":[{\"input\":0,\"output\":1},{%s\"input\":%d,\"output\":%d}]}]",
        target, interpolation, input, output);
    open_file(text);
    nodes[0].weight_count = 2;
    return model_gltf_clips_read(&file, &scene);
}

#define WAY(name) "\"interpolation\":\"" name "\","

static void a_channel_has_the_keys_of_its_sampler(void **state)
{
    static const struct {
        const char *path, *way;
        int output, number, interpolation;
        uint32_t width;
    } cases[] = {{"translation", "", TWO_VEC3, PH_PATH_TRANSLATION, PH_KEYS_LINEAR, 3},
                 {"rotation", WAY("STEP"), TWO_VEC4, PH_PATH_ROTATION, PH_KEYS_STEP, 4},
                 {"scale", WAY("LINEAR"), TWO_VEC3, PH_PATH_SCALE, PH_KEYS_LINEAR, 3},
                 {"weights", WAY("LINEAR"), FOUR, PH_PATH_WEIGHTS, PH_KEYS_LINEAR, 2},
                 {"translation", WAY("CUBICSPLINE"), SIX_VEC3, PH_PATH_TRANSLATION, PH_KEYS_CUBIC, 3},
                 {"weights", WAY("CUBICSPLINE"), TWELVE, PH_PATH_WEIGHTS, PH_KEYS_CUBIC, 2}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char target[64];
        snprintf(target, sizeof target, "\"node\":0,\"path\":\"%s\"", cases[i].path);
        assert_true(open_clip(target, cases[i].way, TIMES, cases[i].output));
        assert_int_equal(scene.clip_count, 1);
        assert_string_equal(scene.clips[0].name, "walk");
        assert_int_equal(scene.clips[0].count, 2);
        const struct model_track *const t = scene.clips[0].tracks;
        assert_true(t->node == 0 && t->path == cases[i].number && t->interpolation == cases[i].interpolation);
        assert_true(t->keys == 2 && t->width == cases[i].width);
        assert_true(t->times[0] == 0 && t->times[1] == 1 && t->numbers[0] == 4 && t->numbers[3] == 7);
        assert_true(t[1].node == 1 && t[1].path == PH_PATH_SCALE && t[1].interpolation == PH_KEYS_LINEAR);
    }
}

static void what_moves_nothing_of_the_scene_is_left_out(void **state)
{
    static const char *const targets[] = {"\"node\":3,\"path\":\"scale\"", "\"node\":4,\"path\":\"scale\"",
                                          "\"path\":\"scale\"", "\"node\":0,\"path\":\"pointer\"", "\"node\":0"};
    (void)state;
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++) {
        assert_true(open_clip(targets[i], "", TIMES, TWO_VEC3));
        assert_int_equal(scene.clips[0].count, 1);
        assert_int_equal(scene.clips[0].tracks[0].node, 1);
    }
    open_file("\"animations\":[{},{\"channels\":[]}]");
    assert_true(model_gltf_clips_read(&file, &scene));
    assert_true(scene.clip_count == 2 && scene.clips[0].count == 0 && scene.clips[0].name == NULL);
}

static void animations_that_are_broken_are_refused(void **state)
{
    static const char count[] = "an animation has more than 65535 keys, or not a value for each",
                      sampler[] = "an animation has a sampler that is not there, or of another kind",
                      move[] = "\"node\":0,\"path\":\"translation\"", weights[] = "\"node\":0,\"path\":\"weights\"";
    static const struct {
        const char *target, *way;
        int input, output;
    } cases[] = {
        {move, "", TIMES, SIX_VEC3},  {move, WAY("CUBICSPLINE"), TIMES, TWO_VEC3}, {weights, "", TIMES, TIMES},
        {weights, "", TIMES, TWELVE}, {weights, WAY("CUBICSPLINE"), TIMES, FOUR},  {move, "", MANY, MANY_VEC3}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_false(open_clip(cases[i].target, cases[i].way, cases[i].input, cases[i].output));
        assert_string_equal(file.error, count);
    }
    assert_true(open_clip(move, "", MOST, MOST_VEC3));
    assert_int_equal(scene.clips[0].tracks[0].keys, 65535);
    assert_false(open_clip(move, "", TIMES, TWO_VEC4));
    assert_false(open_clip(move, "", 99, TWO_VEC3));
    assert_false(open_clip(move, WAY("SPLINE"), TIMES, TWO_VEC3));
    assert_string_equal(file.error, sampler);
    open_file(
        "\"animations\":[{\"channels\":[{\"sampler\":1,\"target\":{}}],\"samplers\":[{\"input\":0,\"output\":1}]}]");
    assert_false(model_gltf_clips_read(&file, &scene));
    assert_string_equal(file.error, sampler);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_skin_has_joints_and_their_matrices),
        cmocka_unit_test(two_nodes_may_have_one_skin),
        cmocka_unit_test(skins_that_are_broken_are_refused),
        cmocka_unit_test(weights_at_rest_are_the_nodes_before_those_of_the_mesh),
        cmocka_unit_test(a_channel_has_the_keys_of_its_sampler),
        cmocka_unit_test(what_moves_nothing_of_the_scene_is_left_out),
        cmocka_unit_test(animations_that_are_broken_are_refused),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
