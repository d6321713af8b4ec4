/* model_scene: nodes in their order, products of matrices against the sums written out, and what counts as motion. */
#include "model_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

/* 0 has 1 and 4, 1 has 2 and 3; 5 stands beside 0. */
static void parents_come_first_and_children_in_their_order(void **state)
{
    struct model_node nodes[6] = {{.parent = MODEL_NONE, .child = 1, .next = 5},
                                  {.parent = 0, .child = 3, .next = 4},
                                  {.parent = 1, .child = MODEL_NONE, .next = MODEL_NONE},
                                  {.parent = 1, .child = MODEL_NONE, .next = 2},
                                  {.parent = 0, .child = MODEL_NONE, .next = MODEL_NONE},
                                  {.parent = MODEL_NONE, .child = MODEL_NONE, .next = MODEL_NONE}};
    static const uint32_t order[] = {0, 1, 3, 2, 4, 5, MODEL_NONE};
    struct model_scene scene = {.nodes = nodes, .node_count = 6, .first_node = 0};
    uint32_t node = MODEL_NONE;
    (void)state;
    for (int i = 0; i < 7; i++) {
        node = model_scene_next(&scene, node);
        assert_int_equal(node, order[i]);
    }
    scene.first_node = 4;
    assert_int_equal(model_scene_next(&scene, MODEL_NONE), 4);
}

static void skins_clips_and_targets_move(void **state)
{
    struct model_mesh meshes[2] = {0};
    struct model_scene scene = {.meshes = meshes, .mesh_count = 2};
    (void)state;
    assert_false(model_scene_moves(&scene));
    scene.skin_count = 1;
    assert_true(model_scene_moves(&scene));
    scene.skin_count = 0;
    scene.clip_count = 1;
    assert_true(model_scene_moves(&scene));
    scene.clip_count = 0;
    meshes[1].moved.target_count = 1;
    assert_true(model_scene_moves(&scene));
    scene.mesh_count = 1;
    assert_false(model_scene_moves(&scene));
}

static void the_one_node_shows_all_meshes_where_they_are(void **state)
{
    struct model_scene scene = {.mesh_count = 7, .first_node = 9};
    (void)state;
    assert_true(model_scene_one_node(&scene));
    const struct model_node *node = scene.nodes;
    assert_int_equal(scene.node_count, 1);
    assert_int_equal(scene.first_node, 0);
    assert_int_equal(node->first_mesh, 0);
    assert_int_equal(node->mesh_count, 7);
    assert_true(node->is_shown);
    assert_true(node->parent == MODEL_NONE && node->child == MODEL_NONE);
    assert_true(node->next == MODEL_NONE && node->skin == MODEL_NONE);
    for (int i = 0; i < 12; i++) {
        assert_true(node->m[i / 4][i % 4] == (i % 5 == 0 ? 1 : 0));
    }
    assert_int_equal(model_scene_next(&scene, 0), MODEL_NONE);
    free(scene.nodes);
}

/* A turn of a quarter about z and a move, times a scale and a move: sums by hand. */
static void a_product_applies_the_local_matrix_first(void **state)
{
    double parent[3][4] = {{0, -1, 0, 10}, {1, 0, 0, 20}, {0, 0, 1, 30}}, to[3][4];
    static const float local[3][4] = {{2, 0, 0, 1}, {0, 3, 5, 2}, {0, 0, 4, 3}};
    static const double expected[3][4] = {{0, -3, -5, 8}, {2, 0, 0, 21}, {0, 0, 4, 33}};
    (void)state;
    model_scene_multiply(to, parent, local);
    for (int i = 0; i < 12; i++) {
        assert_true(to[i / 4][i % 4] == expected[i / 4][i % 4]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parents_come_first_and_children_in_their_order),
        cmocka_unit_test(skins_clips_and_targets_move),
        cmocka_unit_test(the_one_node_shows_all_meshes_where_they_are),
        cmocka_unit_test(a_product_applies_the_local_matrix_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
