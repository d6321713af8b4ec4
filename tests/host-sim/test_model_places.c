/* model_places: where a tree of nodes shows meshes. Points by hand; normals against the face that they stand on. */
#include "model_places.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define NONE                                                                                                           \
    {                                                                                                                  \
        .parent = MODEL_NONE, .child = MODEL_NONE, .next = MODEL_NONE                                                  \
    }

/* A triangle in a plane that leans every way, and its normal: the product of its first two sides. */
static float triangle[3][3] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, normals[1][3] = {{6, 3, 2}};
static struct model_mesh meshes[3] = {{.positions = triangle, .normals = normals, .vertex_count = 3}};

static void set(struct model_node *node, const double *numbers)
{
    for (int i = 0; i < 12; i++) {
        node->m[i / 4][i % 4] = (float)numbers[i];
    }
}

static void assert_point(const double p[3], double x, double y, double z)
{
    assert_true(p[0] == x && p[1] == y && p[2] == z);
}

/* Node 1 hangs below node 0 and node 2 stands alone; node 3 is not in the tree. The root exchanges y and z. */
static void every_mesh_of_every_node_of_the_tree_has_its_place(void **state)
{
    static const double moved[12] = {1, 0, 0, 10, 0, 1, 0, 20, 0, 0, 1, 30};
    static const double scaled[12] = {2, 0, 0, 1, 0, 3, 0, 2, 0, 0, 4, 3};
    struct model_node nodes[4] = {NONE, NONE, NONE, NONE};
    struct model_scene scene = {.nodes = nodes,
                                .meshes = meshes,
                                .mesh_count = 3,
                                .node_count = 4,
                                .root = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0.5f}}};
    struct model_places places;
    double p[3];
    (void)state;
    for (int i = 0; i < 4; i++) {
        set(&nodes[i], i == 1 ? scaled : moved);
        nodes[i].first_mesh = 0;
        nodes[i].mesh_count = 1;
    }
    nodes[0].mesh_count = 0;
    nodes[0].child = 1;
    nodes[1].parent = 0;
    nodes[0].next = 2;
    nodes[2].first_mesh = 1;
    nodes[2].mesh_count = 2;
    meshes[1] = meshes[2] = meshes[0];
    assert_true(model_places_find(&scene, &places));
    assert_int_equal(places.count, 3);
    static const uint32_t node_of[3] = {1, 2, 2};
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(places.list[i].node, node_of[i]);
        assert_ptr_equal(places.list[i].mesh, &meshes[i]);
        assert_false(places.list[i].mirrors);
    }
    model_places_point(&places.list[0], 0, p); /* (1 0 0) -> (3 2 3) -> (13 22 33) -> (x z .5 - y) */
    assert_point(p, 13, 33, -21.5);
    model_places_point(&places.list[0], 1, p);
    assert_point(p, 11, 33, -27.5);
    model_places_point(&places.list[0], 2, p);
    assert_point(p, 11, 45, -21.5);
    model_places_point(&places.list[1], 2, p);
    assert_point(p, 10, 33, -19.5);
    assert_true(places.nodes[0][0][3] == 10 && places.nodes[0][1][3] == 30 && places.nodes[0][2][3] == -19.5);
    assert_true(places.nodes[1][0][0] == 2 && places.nodes[1][1][2] == 4 && places.nodes[1][2][1] == -3);
    free(places.list);
    free(places.nodes);
}

/* Whatever a matrix does, normals look out of the face that it has moved; a mirror turns the face's order over. */
static void normals_stand_on_the_faces_that_a_matrix_has_moved(void **state)
{
    static const struct {
        double m[12];
        bool mirrors;
    } cases[] = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, false},   {{2, 0, 0, 5, 0, 3, 0, 5, 0, 0, 4, 5}, false},
                 {{.5, 1, 0, 0, 0, .5, 0, 0, 0, 0, 1, 0}, false}, {{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0}, false},
                 {{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, true},   {{1, 2, 3, 4, 0, -1, 5, 6, 7, 0, 1, 8}, false},
                 {{1, 2, 3, 4, 0, 1, 5, 6, -7, 0, -1, 8}, true},  {{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0}, true}};
    struct model_node node = NONE;
    struct model_scene scene = {.nodes = &node,
                                .meshes = meshes,
                                .mesh_count = 1,
                                .node_count = 1,
                                .root = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    (void)state;
    node.mesh_count = 1;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct model_places places;
        double p[3][3], n[3];
        set(&node, cases[k].m);
        assert_true(model_places_find(&scene, &places));
        const double *m = cases[k].m;
        const double volume = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
                              m[2] * (m[4] * m[9] - m[5] * m[8]);
        assert_int_equal(volume < 0, cases[k].mirrors);
        assert_int_equal(places.list->mirrors, cases[k].mirrors);
        for (uint32_t i = 0; i < 3; i++) {
            model_places_point(places.list, i, p[i]);
        }
        model_places_normal(places.list, 0, n);
        for (int a = 0; a < 3; a++) { /* the product of the moved sides, turned over in a mirror */
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            const double face = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
            assert_true(n[a] == (cases[k].mirrors ? -face : face));
        }
        free(places.list);
        free(places.nodes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mesh_of_every_node_of_the_tree_has_its_place),
        cmocka_unit_test(normals_stand_on_the_faces_that_a_matrix_has_moved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
