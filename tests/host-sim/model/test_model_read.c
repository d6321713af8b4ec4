/* model_read: which reader a name chooses, which way is up, and what is counted and refused before meshes are made. All
 * around it is played by the test. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "model_assimp.h"
#include "model_gltf.h"
#include "model_meshes.h"
#include "model_obj.h"
#include "model_ply.h"
#include "model_read.h"
#include "model_rig.h"
#include "model_stl.h"

#include <string.h>

static struct model_shared shared;
static const char *reader; /* that was called */
static struct model_mesh meshes[3];
static struct model_node nodes[2];
static float root[3][4]; /* with which meshes are made */
static bool texture_fails, reader_fails, rig_fails, meshes_fail;
static const char *outside;

static int fresh(void **state)
{
    (void)state;
    memset(&shared, 0, sizeof shared);
    memset(root, 0, sizeof root);
    texture_fails = reader_fails = rig_fails = meshes_fail = false;
    reader = outside = NULL;
    for (int i = 0; i < 3; i++) {
        meshes[i] = (struct model_mesh){.triangle_count = 1U << 4 * i};
    }
    nodes[0] =
        (struct model_node){.parent = MODEL_NONE, .child = MODEL_NONE, .next = 1, .first_mesh = 1, .mesh_count = 2};
    nodes[1] = (struct model_node){.parent = MODEL_NONE, .child = MODEL_NONE, .next = MODEL_NONE, .first_mesh = 0};
    return 0;
}

static bool read_as(const char *name, struct model_scene *scene)
{
    reader = name;
    scene->nodes = nodes, scene->node_count = 2, scene->first_node = 0;
    scene->meshes = meshes, scene->mesh_count = 3;
    if (outside != NULL) {
        strcpy(shared.folder.outside, outside);
    }
    return !reader_fails;
}

#define READER(function, name)                                                                                         \
    bool function(struct model_shared *s, struct model_scene *scene)                                                   \
    {                                                                                                                  \
        assert_ptr_equal(s, &shared);                                                                                  \
        return read_as(name, scene);                                                                                   \
    }
READER(model_gltf_read, "glTF")
READER(model_obj_read, "OBJ")
READER(model_stl_read, "STL")
READER(model_ply_read, "PLY")
READER(model_assimp_read, "assimp")

bool model_surface_take_texture(struct model_shared *s)
{
    return !texture_fails || model_shared_failed(s, "texture");
}

bool model_rig_find(struct model_shared *s, struct model_scene *scene)
{
    (void)s;
    (void)scene;
    return !rig_fails;
}

bool model_meshes_read(struct model_shared *s, const struct model_scene *scene)
{
    memcpy(root, scene->root, sizeof root);
    return !meshes_fail || model_shared_failed(s, "meshes");
}

static void a_name_chooses_reader_and_axis(void **state)
{
    static const struct {
        const char *name, *up, *reader;
        bool is_turned;
    } cases[] = {{"a.gltf", NULL, "glTF", false}, {"a.glb", NULL, "glTF", false}, {"b/a.OBJ", NULL, "OBJ", false},
                 {"a.stl", NULL, "STL", true},    {"a.STL", "y", "STL", false},   {"a.stl", "z", "STL", true},
                 {"a.ply", NULL, "PLY", false},   {"a.ply", "z", "PLY", true},    {"a.dae", NULL, "assimp", false},
                 {"stl", NULL, "assimp", false},  {"a.glt", "z", "assimp", true}};
    static const float upright[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    static const float turned[3][4] = {
        {1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}; /* z becomes y, y comes forward as -z */
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        shared.options.up = cases[i].up;
        shared.options.allow_outside = i % 2 == 0;
        assert_true(model_read(&shared, cases[i].name));
        assert_string_equal(reader, cases[i].reader);
        assert_memory_equal(root, cases[i].is_turned ? turned : upright, sizeof root);
        assert_true(shared.folder.model == cases[i].name && shared.folder.allow_outside == (i % 2 == 0));
    }
}

/* Node 0 shows meshes of 16 and 256 triangles, node 1 one more of 1. */
static void triangles_of_all_nodes_are_counted(void **state)
{
    static const struct {
        uint32_t last, more;
        const char *error; /* NULL: it is read */
    } cases[] = {{256, 0, NULL},
                 {MODEL_TRIANGLES_MAX - 16, 0, NULL},
                 {MODEL_TRIANGLES_MAX - 15, 0, "has more than 4000000 triangles, the limit"},
                 {MODEL_TRIANGLES_MAX - 16, 1, "has more than 4000000 triangles, the limit"},
                 {MODEL_TRIANGLES_MAX - 17, 1, NULL},
                 {UINT32_MAX, 0, "has more than 4000000 triangles, the limit"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        meshes[2].triangle_count = cases[i].last;
        nodes[1].mesh_count = cases[i].more;
        assert_int_equal(model_read(&shared, "a.obj"), cases[i].error == NULL);
        assert_string_equal(shared.error, cases[i].error != NULL ? cases[i].error : "");
    }
    meshes[1].triangle_count = meshes[2].triangle_count = 0;
    nodes[1].mesh_count = 0;
    assert_false(model_read(&shared, "a.obj"));
    assert_string_equal(shared.error, "has no triangles");
}

static void each_step_that_fails_ends_it(void **state)
{
    static const struct {
        bool *fails;
        const char *error;
    } cases[] = {{&texture_fails, "texture"},
                 {&reader_fails, ""},
                 {&rig_fails, "needs too much memory"},
                 {&meshes_fail, "meshes"}};
    (void)state;
    for (int i = 0; i < 4; i++) {
        fresh(NULL);
        *cases[i].fails = true;
        assert_false(model_read(&shared, "a.obj"));
        assert_string_equal(shared.error, cases[i].error);
        assert_int_equal(reader != NULL, i > 0);
        assert_true(root[0][0] == (i == 3 ? 1 : 0)); /* nothing follows */
    }
}

/* Whether the reader went on or not. */
static void what_lies_outside_is_named(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        fresh(NULL);
        outside = "../secret.png";
        reader_fails = i == 1;
        assert_false(model_read(&shared, "a.obj"));
        assert_string_equal(shared.error,
                            "names ../secret.png, which is outside of its folder; --allow-outside reads it");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_name_chooses_reader_and_axis),
        cmocka_unit_test(triangles_of_all_nodes_are_counted),
        cmocka_unit_test(each_step_that_fails_ends_it),
        cmocka_unit_test(what_lies_outside_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
