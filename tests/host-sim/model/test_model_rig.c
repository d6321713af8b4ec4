/* model_rig: the order and the lengths of nodes, the pose at rest, inverse bind matrices, shares and morph targets, all
 * worked out by hand. Turns are quarters about z, so that every number is exact.
 *
 * A clip that holds node 0 where it is lets all that is below it move. Node 0 (scale 2, at 1, 2, 3) has the children 2
 * (a quarter turn, at 1, 0, 0) and 3 (scale 1, 2, 3); 4 (scale 4) is the child of 2. 1 has a skin of the joints 2
 * and 4. 5 is not shown. The model is a quarter of the file's size, around 1, 1, 1. */
#include "model_rig.h"
#include "model_rig_nodes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define Q24(x)     ((int32_t)((x) * (1 << 24)))
#define Q30(x)     ((int32_t)((x) * (1 << 30)))
#define Q14(x)     ((int)((x)*16384))
#define HALF_ROOT  .70710678118654752
#define NODE_COUNT 6

static uint8_t memory[1 << 14];
static struct model_shared shared;
static struct model_scene scene;
static struct ph_mesh drawn[4];
static uint32_t joints[2] = {2, 4};
static float bind[32] = {1,    0, 0, 0, 0, 1,    0, 0, 0, 0, 1,    0, -1, -1, 0, 1, /* moves by -1, -1, 0 */
                         .25f, 0, 0, 0, 0, .25f, 0, 0, 0, 0, .25f, 0, 1,  2,  3, 1};
static struct model_skin skins[1] = {{.joints = joints, .count = 2, .bind = bind}};
static double weights[3] = {.5, -.25, 200}, ones[2] = {1, 1};
static struct model_mesh meshes[9];
static float moment[1] = {0}, held[3];
static struct model_track track = {
    .node = 0, .path = PH_PATH_TRANSLATION, .times = moment, .numbers = held, .keys = 1, .width = 3};
static struct model_clip clips[1] = {{.tracks = &track, .count = 1}};
static const struct model_fit fit = {.centre = {1, 1, 1}, .scale = .25};

static void set_node(uint32_t i, uint32_t parent, const float m[3][4], const double t[3], const double s[3])
{
    struct model_node *const node = &scene.nodes[i];
    *node = (struct model_node){.q = {0, 0, 0, 1},
                                .parent = parent,
                                .child = MODEL_NONE,
                                .next = MODEL_NONE,
                                .skin = MODEL_NONE,
                                .is_shown = true};
    memcpy(node->m, m, sizeof node->m);
    memcpy(node->t, t, sizeof node->t);
    memcpy(node->s, s, sizeof node->s);
}

static int fresh(void **state)
{
    static const double none[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    static const float unit[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    (void)state;
    shared = (struct model_shared){.arena = {.base = memory, .size = sizeof memory}};
    scene = (struct model_scene){.nodes = calloc(NODE_COUNT, sizeof *scene.nodes),
                                 .skins = skins,
                                 .meshes = meshes,
                                 .mesh_count = 9,
                                 .clips = clips,
                                 .clip_count = 1,
                                 .skin_count = 1,
                                 .node_count = NODE_COUNT,
                                 .first_node = 1,
                                 .root = {{0, 0, 1, 0}, {1, 0, 0, 0}, {0, -1, 0, 0}}};
    assert_non_null(scene.nodes);
    set_node(0, MODEL_NONE, (const float[3][4]){{2, 0, 0, 1}, {0, 2, 0, 2}, {0, 0, 2, 3}}, (double[3]){1, 2, 3},
             (double[3]){2, 2, 2});
    set_node(1, MODEL_NONE, unit, none, one);
    set_node(2, 0, (const float[3][4]){{0, -1, 0, 1}, {1, 0, 0, 0}, {0, 0, 1, 0}}, (double[3]){1, 0, 0}, one);
    set_node(3, 0, (const float[3][4]){{1, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 3, 0}}, none, (double[3]){1, -2, 3});
    set_node(4, 2, (const float[3][4]){{4, 0, 0, 0}, {0, 4, 0, .5f}, {0, 0, 4, -.5f}}, (double[3]){0, .5, -.5},
             (double[3]){4, 4, 4});
    set_node(5, MODEL_NONE, unit, none, one);
    scene.nodes[0].child = 2, scene.nodes[1].next = 0, scene.nodes[2].next = 3, scene.nodes[2].child = 4;
    scene.nodes[2].q[2] = scene.nodes[2].q[3] = 3; /* of any length */
    scene.nodes[1].skin = 0, scene.nodes[1].first_mesh = 7, scene.nodes[1].mesh_count = 2;
    for (uint32_t i = 0; i < 5; i++) {
        scene.nodes[i].mesh_count = i == 1 ? 2 : 1;
    }
    memcpy(held, (const float[3]){1, 2, 3}, sizeof held);
    skins[0].bind = bind;
    memset(drawn, 0, sizeof drawn);
    shared.model.meshes = drawn;
    return 0;
}

static int gone(void **state)
{
    (void)state;
    if (shared.rig != NULL) {
        for (uint32_t k = 0; k < shared.rig->node_count; k++) {
            struct model_rig_node *const node = &shared.rig->nodes[shared.rig->order[k]];
            free(node->weights);
            free(node->most_weights != ones ? node->most_weights : NULL);
        }
        free(shared.rig->moments);
        free(shared.rig->nodes);
        free(shared.rig->order);
        free(shared.rig);
    }
    free(scene.nodes);
    return 0;
}

static void expect_matrix(const double (*m)[4], const double (*expected)[4])
{
    for (int i = 0; i < 12; i++) {
        assert_true(fabs(m[i / 4][i % 4] - expected[i / 4][i % 4]) < 1e-12);
    }
}

static void parents_come_first_and_places_are_products(void **state)
{
    static const uint32_t order[5] = {0, 1, 2, 3, 4};
    static const double second[3][4] = {{0, -2, 0, 3}, {2, 0, 0, 2}, {0, 0, 2, 3}},
                        fourth[3][4] = {{0, -8, 0, 2}, {8, 0, 0, 2}, {0, 0, 8, 2}};
    (void)state;
    assert_true(model_rig_find(&shared, &scene));
    assert_int_equal(shared.rig->node_count, 5);
    assert_memory_equal(shared.rig->order, order, sizeof order);
    for (uint32_t k = 0; k < 5; k++) {
        assert_int_equal(shared.rig->nodes[k].number, k);
        assert_int_equal(shared.rig->nodes[k].drawn, k == 1 ? 6 : k);
    }
    assert_int_equal(shared.rig->nodes[5].drawn, MODEL_NONE);
    expect_matrix((const double(*)[4])shared.rig->nodes[2].world, second);
    expect_matrix((const double(*)[4])shared.rig->nodes[4].world, fourth);
}

/* The place of node 2 after its bind matrix: a quarter turn of twice -1, -1, 0 is 2, -2, 0. */
static void a_node_of_its_own_draws_a_skin_where_the_first_joint_is(void **state)
{
    static const float m[3][4] = {{0, -2, 0, 5}, {2, 0, 0, 0}, {0, 0, 2, 3}},
                       rigid[3][4] = {{0, -2, 0, 3}, {2, 0, 0, 2}, {0, 0, 2, 3}};
    (void)state;
    assert_true(model_rig_find(&shared, &scene));
    assert_int_equal(scene.node_count, 7);
    assert_true(scene.nodes[1].next == 0 && scene.nodes[0].next == 6 && scene.nodes[6].next == MODEL_NONE);
    assert_true(scene.nodes[6].parent == MODEL_NONE && scene.nodes[6].child == MODEL_NONE &&
                scene.nodes[6].skin == MODEL_NONE);
    assert_true(scene.nodes[6].first_mesh == 7 && scene.nodes[6].mesh_count == 2 && scene.nodes[1].mesh_count == 0);
    assert_memory_equal(scene.nodes[6].m, m, sizeof m);
    gone(NULL);
    fresh(NULL);
    skins[0].bind = NULL;
    assert_true(model_rig_find(&shared, &scene));
    assert_memory_equal(scene.nodes[6].m, rigid, sizeof rigid);
    gone(NULL);
    fresh(NULL);
    scene.nodes[1].mesh_count = 0;
    assert_true(model_rig_find(&shared, &scene));
    assert_int_equal(scene.node_count, NODE_COUNT);
}

static void what_stands_still_has_no_rig(void **state)
{
    (void)state;
    scene.skin_count = scene.clip_count = 0;
    assert_true(model_rig_find(&shared, &scene));
    assert_null(shared.rig);
    assert_true(model_rig_begin(&shared, &fit, 1));
    assert_null(shared.model.motion);
    assert_int_equal(shared.arena.used, 0);
}

static void begin(void)
{
    assert_true(model_rig_find(&shared, &scene));
    shared.model.scale = fit.scale; /* as model_meshes sets it */
    assert_true(model_rig_begin(&shared, &fit, 4));
}

static void expect_vector(struct fx_vec3 v, double x, double y, double z)
{
    assert_true(v.x == Q24(x) && v.y == Q24(y) && v.z == Q24(z));
}

/* A node's own scale goes into the length of what is below it, along each axis where nothing is below it. Translations
 * count from the middle of the model, which is at 1, -1, 1 before the root turns. */
static void the_pose_at_rest_is_in_the_units_of_each_parent(void **state)
{
    static const double lengths[5][3] = {{2, 2, 2}, {1, 1, 1}, {2, 2, 2}, {2, 4, 6}, {8, 8, 8}};
    static const int parents[5] = {-1, -1, 0, 0, 2};
    (void)state;
    begin();
    const struct ph_rig_node *const nodes = shared.model.motion->animation.rig.nodes;
    assert_int_equal(shared.model.motion->animation.rig.node_count, 5);
    for (int k = 0; k < 5; k++) {
        assert_memory_equal(shared.rig->nodes[k].length, lengths[k], sizeof lengths[k]);
        assert_int_equal(nodes[k].parent, parents[k]);
    }
    expect_vector(nodes[0].rest.t, 0, .75, .5);
    expect_vector(nodes[1].rest.t, -.25, .25, -.25);
    expect_vector(nodes[0].rest.s, 1, 1, 1);
    expect_vector(nodes[2].rest.t, .5, 0, 0);
    expect_vector(nodes[3].rest.s, 1, -1, 1);
    expect_vector(nodes[4].rest.t, 0, .25, -.25);
    assert_true(nodes[2].rest.r.w == (int32_t)lround(HALF_ROOT * (1 << 30)) && nodes[2].rest.r.z == nodes[2].rest.r.w);
    assert_true(nodes[2].rest.r.x == 0 && nodes[2].rest.r.y == 0 && nodes[0].rest.r.w == 1 << 30);
}

static void the_root_turns_the_rig(void **state)
{
    static const int32_t turn[3][3] = {{0, 0, 1 << 30}, {1 << 30, 0, 0}, {0, -(1 << 30), 0}};
    (void)state;
    assert_true(model_rig_find(&shared, &scene));
    assert_true(model_rig_begin(&shared, &(struct model_fit){.centre = {1, -2, 40}, .scale = .5}, 1));
    const struct ph_xform *const root = &shared.model.motion->animation.root;
    assert_memory_equal(root->r, turn, sizeof turn);
    expect_vector(root->t, 0, 0, 0);
    gone(NULL);
    fresh(NULL);
    scene.clip_count = 0;
    assert_true(model_rig_find(&shared, &scene));
    assert_false(model_rig_begin(&shared, &(struct model_fit){.centre = {1, -2, 400}, .scale = .5}, 1));
    assert_string_equal(shared.error, "cannot be shown: the translation in radii of the model of node 0 is 201, and "
                                      "at most 120 is possible");
}

static void weights_stand_one_behind_the_other(void **state)
{
    (void)state;
    scene.nodes[0].weight_count = 2, scene.nodes[0].weights = weights;
    scene.nodes[2].weight_count = 1;
    scene.nodes[4].weight_count = 1, scene.nodes[4].weights = weights + 2;
    begin();
    const struct animation *const a = &shared.model.motion->animation;
    assert_int_equal(a->weight_count, 4);
    assert_true(a->rest_weights[0] == Q24(1) && a->rest_weights[1] == Q24(-1) && a->rest_weights[2] == 0);
    assert_int_equal(a->rest_weights[3], Q24(1)); /* of 200 */
    assert_true(shared.rig->nodes[0].most_weights[1] == .25 && shared.rig->nodes[4].most_weights[0] == 200);
    assert_true(shared.rig->nodes[1].first_weight == 2 && shared.rig->nodes[4].first_weight == 3);
    gone(NULL);
    fresh(NULL);
    scene.nodes[0].weight_count = 65536, scene.nodes[0].weights = NULL;
    assert_true(model_rig_find(&shared, &scene));
    shared.arena = (struct demo_arena){.base = malloc(1 << 20), .size = 1 << 20};
    assert_false(model_rig_begin(&shared, &fit, 1));
    assert_non_null(strstr(shared.error, "too many morph targets"));
    scene.nodes[0].weight_count = 65535;
    assert_true(model_rig_begin(&shared, &fit, 1));
    free(shared.arena.base);
}

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

static const struct fx_vec3 positions[2] = {{32768, -16384, 3}, {65536, 0, 1}};
static const int16_t normals[2][3] = {{0, 0, 16384}, {16384, 0, 0}};
static float vertex_joints[12] = {9, 9, 9, 9, 0, 1, 0, 0, 1, 0, 1, 0},
             shares[12] = {0, 0, 0, 0, 1, 3, 0, 0, 1, 1, 1, 0};
static uint32_t sources[3] = {0, 1, 2};
static float target[9] = {9, 9, 9, 1, 2, 3, .25f, 0, -.5f};
static float *targets[2] = {NULL, target};
static struct model_mesh mesh;
static struct model_place place;

/* Mesh 2 of the model has vertices 1 and 2 of a mesh, which the node shows at this place. */
static bool bind_at(uint32_t node, const double m[3][4])
{
    static const unsigned vertices[2] = {1, 2};
    drawn[2] = (struct ph_mesh){.positions = positions, .normals = normals, .vertex_count = 2};
    place.mesh = &mesh, place.node = node;
    memcpy(place.m, m, sizeof place.m);
    mesh.moved.sources = sources;
    return model_rig_bind(&shared, &place, &fit, vertices, 2);
}

static const double with_2[3][4] = {{0, -2, 0, 3}, {2, 0, 0, 2}, {0, 0, 2, 3}},
                    skinned[3][4] = {{0, -2, 0, 5}, {2, 0, 0, 0}, {0, 0, 2, 3}};

static int begun(void **state)
{
    fresh(state);
    mesh = (struct model_mesh){.vertex_count = 3};
    place = (struct model_place){.node = 0};
    begin();
    return 0;
}

static const struct animation_mesh *moving(void)
{
    assert_int_equal(shared.model.motion->animation.mesh_count, 1);
    return &shared.model.motion->animation.meshes[0];
}

static void expect_back(const struct ph_xform *x, double tx, double ty, double tz)
{
    static const int32_t turn[3][3] = {{0, 1 << 30, 0}, {-(1 << 30), 0, 0}, {0, 0, 1 << 30}};
    assert_memory_equal(x->r, turn, sizeof turn);
    expect_vector(x->t, tx, ty, tz);
}

/* The inverse of 1/4 (2 turn p + 2, 1, 2), in lengths of node 2, which are 1/2. */
static void a_mesh_follows_its_own_node(void **state)
{
    (void)state;
    assert_true(bind_at(2, with_2));
    const struct animation_mesh *const m = moving();
    assert_true(m->mesh == 2 && m->skin.joint_count == 1 && m->skin.nodes[0] == 2);
    expect_back(m->skin.inverse_bind, -.25, .5, -.5);
    assert_true(m->bound.vertex_count == 2 && m->bound.frac == 15 && m->bound.influences == NULL);
    assert_true(m->bound.positions[0][0] == 16384 && m->bound.positions[0][1] == -8192 &&
                m->bound.positions[0][2] == 2);
    assert_int_equal(m->bound.positions[1][0], 32767);
    assert_memory_equal(m->bound.normals, normals, sizeof normals);
    assert_true(shared.model.motion->rounding.position == 1 / 32768.); /* of what is 1 and becomes 32767 */
    assert_int_equal(m->morph.target_count, 0);
}

static void a_skin_follows_its_joints_by_their_bind_matrices(void **state)
{
    (void)state;
    mesh.moved.joints = vertex_joints, mesh.moved.weights = shares;
    assert_true(bind_at(6, skinned));
    const struct animation_mesh *const m = moving();
    assert_true(m->skin.joint_count == 2 && m->skin.nodes[0] == 2 && m->skin.nodes[1] == 4);
    expect_back(&m->skin.inverse_bind[0], -.25, .5, -.5);
    expect_back(&m->skin.inverse_bind[1], 2.25, 5, 5.5);
    const struct ph_influence *const i = m->bound.influences;
    assert_true(i[0].joints[0] == 1 && i[0].weights[0] == 24576 && i[0].joints[1] == 0 && i[0].weights[1] == 8192);
    assert_true(i[0].weights[2] == 0 && i[0].weights[3] == 0);
    assert_true(i[1].weights[0] == 10923 && i[1].weights[1] == 10923 && i[1].weights[2] == 10922 &&
                i[1].weights[3] == 0);
    assert_true(i[1].joints[0] == 1 && i[1].joints[1] == 0 && i[1].joints[2] == 1 && i[1].joints[3] == 0);
    assert_true(fabs(shared.model.motion->rounding.share - (10923 / 32768. - 1 / 3.)) < 1e-15);
}

static void shares_that_are_no_numbers_count_for_nothing(void **state)
{
    static const struct {
        float joints[4], shares[4];
        uint16_t first;
        uint8_t joint;
    } cases[] = {{{9, -1, 0, 0}, {0, 0, 0, 0}, 32768, 0},
                 {{9, 1, 2, -1}, {NAN, 2, -1, INFINITY}, 32768, 1},
                 {{0, 1, 0, 1}, {-5, 1e-6f, 0, 0}, 32768, 1}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        float j[12] = {0}, s[12] = {0};
        gone(NULL);
        begun(NULL);
        memcpy(j + 4, cases[k].joints, 16);
        memcpy(s + 4, cases[k].shares, 16);
        mesh.moved.joints = j, mesh.moved.weights = s;
        assert_true(bind_at(6, skinned));
        assert_true(moving()->bound.influences[0].weights[0] == cases[k].first);
        assert_true(moving()->bound.influences[0].joints[0] == cases[k].joint);
        assert_int_equal(moving()->bound.influences[0].weights[1], 0);
    }
}

static void joints_that_are_not_there_are_refused(void **state)
{
    static const float wrong[3] = {2, -1, NAN};
    (void)state;
    for (int k = 0; k < 3; k++) {
        float j[12] = {[5] = wrong[k]}, s[12] = {[5] = .1f};
        gone(NULL);
        begun(NULL);
        mesh.moved.joints = j, mesh.moved.weights = s;
        assert_false(bind_at(6, skinned));
        assert_string_equal(shared.error, "is broken: a vertex follows a joint that is not there");
    }
    gone(NULL);
    begun(NULL);
    assert_false(bind_at(6, skinned));
    assert_string_equal(shared.error, "is broken: a mesh with a skin names no joints");
}

/* The weights of node 2 get up to 1. */
static void take_ones(void)
{
    free(shared.rig->nodes[2].most_weights);
    shared.rig->nodes[2].most_weights = ones;
}

/* A quarter turn of 1, 2, 3 is -2, 1, 3; twice a quarter of it is half. */
static void targets_are_turned_and_scaled_with_the_model(void **state)
{
    (void)state;
    mesh.moved.target_count = 2, mesh.moved.targets = targets;
    scene.nodes[2].weight_count = 2;
    shared.rig->nodes[2].first_weight = 5;
    take_ones();
    assert_true(bind_at(2, with_2));
    const struct animation_mesh *const m = moving();
    assert_true(m->morph.target_count == 2 && m->morph.vertex_count == 2 && m->first_weight == 5);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(m->morph.d_positions[i / 3][i % 3], 0);
    }
    assert_int_equal(m->bound.frac, 14); /* 1.5 has room */
    assert_true(m->morph.d_positions[2][0] == Q14(-1) && m->morph.d_positions[2][1] == Q14(.5) &&
                m->morph.d_positions[2][2] == Q14(1.5));
    assert_true(m->morph.d_positions[3][0] == 0 && m->morph.d_positions[3][1] == Q14(.125) &&
                m->morph.d_positions[3][2] == Q14(-.25));
    assert_true(m->bound.positions[1][0] == Q14(1) && shared.model.motion->rounding.target == 0);
    ones[1] = 6; /* 6 (1, .5, 1.5) and 1/2, 1/4, 0 */
    assert_false(bind_at(2, with_2));
    ones[1] = 1;
    assert_string_equal(shared.error,
                        "cannot be shown: a vertex of node 2 can get 9 radii of the model away from where "
                        "it is bound, and at most 8 are possible");
    assert_null(m->morph.d_normals);
    assert_ptr_equal(m->morph.positions, m->bound.positions);
}

/* Cofactors turn by a quarter and multiply by 4: 1, 1/2, 0 becomes -2, 4, 0, and the normal, whose length is 8, divides
 * it. */
static void targets_of_normals_turn_as_the_normals_do(void **state)
{
    float own[3][3] = {{9, 9, 9}, {0, 0, 2}, {2, 0, 0}}, added[9] = {9, 9, 9, 1, .5f, 0, 0, 0, -8};
    float *target_normals[2] = {added, NULL};
    (void)state;
    for (int mirrors = 0; mirrors < 2; mirrors++) {
        gone(NULL);
        begun(NULL);
        mesh.normals = own;
        mesh.moved.target_count = 2, mesh.moved.targets = targets;
        mesh.moved.target_normals = target_normals, mesh.moved.has_normals = true;
        scene.nodes[2].weight_count = 2;
        take_ones();
        place.cofactors[0][1] = -4, place.cofactors[1][0] = 4, place.cofactors[2][2] = 4;
        place.mirrors = mirrors == 1;
        assert_true(bind_at(2, with_2));
        const struct ph_morph *const m = &moving()->morph;
        const int sign = mirrors == 1 ? -1 : 1;
        assert_true(m->d_normals[0][0] == sign * -4096 && m->d_normals[0][1] == sign * 8192 && m->d_normals[0][2] == 0);
        assert_true(m->d_normals[1][2] == sign * -32767 && m->d_normals[2][0] == 0 && m->d_normals[3][2] == 0);
        assert_ptr_equal(m->normals, moving()->bound.normals);
    }
}

static void what_cannot_follow_is_told_or_stands_still(void **state)
{
    static const double flat[3][4] = {{0, -2, 0, 3}, {2, 0, 0, 2}, {0, 0, 0, 3}};
    (void)state;
    assert_true(bind_at(5, with_2)); /* no node of the rig */
    assert_int_equal(shared.model.motion->animation.mesh_count, 0);
    assert_true(bind_at(2, flat));
    assert_int_equal(shared.model.motion->animation.mesh_count, 0);
    assert_string_equal(shared.note, "what a node flattens does not move");
    mesh.moved.target_count = 1, mesh.moved.targets = targets;
    assert_false(bind_at(2, with_2));
    assert_string_equal(shared.error, "is broken: parts of a mesh have different numbers of morph targets");
    shared.model.motion = NULL;
    assert_true(bind_at(2, with_2));
}

/* Elements of a matrix that 16 bits of a joint's length cannot hold saturate below 2. */
static void matrices_saturate(void **state)
{
    static const double small[3][4] = {{.25, 0, 0, 1}, {0, -.25, 0, 1}, {0, 0, 4, 1}};
    (void)state;
    assert_true(bind_at(0, small));
    const struct ph_xform *const x = moving()->skin.inverse_bind;
    assert_int_equal(x->r[0][0], (int32_t)lround(1.9999999 * (1 << 30)));
    assert_int_equal(x->r[1][1], -(int32_t)lround(1.9999999 * (1 << 30)));
    assert_int_equal(x->r[2][2], Q30(.5));
}

/* A matrix whose inverse has whole numbers; the length of node 0 is 1/2. */
static void any_matrix_is_inverted(void **state)
{
    static const double m[3][4] = {{32, 16, 16, 1}, {16, 16, 16, 1}, {16, 16, 32, 1}};
    static const int inverse[3][3] = {{1, -1, 0}, {-1, 3, -1}, {0, -1, 1}};
    (void)state;
    assert_true(bind_at(0, m));
    for (int i = 0; i < 9; i++) {
        assert_int_equal(moving()->skin.inverse_bind->r[i / 3][i % 3], inverse[i / 3][i % 3] * Q30(.125));
    }
}

static void an_arena_that_is_full_is_told(void **state)
{
    (void)state;
    mesh.moved.target_count = 2, mesh.moved.targets = targets;
    scene.nodes[2].weight_count = 2;
    take_ones();
    assert_true(bind_at(2, with_2));
    const size_t used = shared.arena.used;
    for (size_t size = 0; size < used; size += 8) {
        shared.arena = (struct demo_arena){.base = memory, .size = size};
        shared.model.motion = NULL;
        shared.error[0] = '\0';
        assert_false(model_rig_begin(&shared, &fit, 4) && bind_at(2, with_2));
        assert_non_null(strstr(shared.error, "too much memory"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(parents_come_first_and_places_are_products, fresh, gone),
        cmocka_unit_test_setup_teardown(a_node_of_its_own_draws_a_skin_where_the_first_joint_is, fresh, gone),
        cmocka_unit_test_setup_teardown(what_stands_still_has_no_rig, fresh, gone),
        cmocka_unit_test_setup_teardown(the_pose_at_rest_is_in_the_units_of_each_parent, fresh, gone),
        cmocka_unit_test_setup_teardown(the_root_turns_the_rig, fresh, gone),
        cmocka_unit_test_setup_teardown(weights_stand_one_behind_the_other, fresh, gone),
        cmocka_unit_test_setup_teardown(a_mesh_follows_its_own_node, begun, gone),
        cmocka_unit_test_setup_teardown(a_skin_follows_its_joints_by_their_bind_matrices, begun, gone),
        cmocka_unit_test_setup_teardown(shares_that_are_no_numbers_count_for_nothing, begun, gone),
        cmocka_unit_test_setup_teardown(joints_that_are_not_there_are_refused, begun, gone),
        cmocka_unit_test_setup_teardown(targets_are_turned_and_scaled_with_the_model, begun, gone),
        cmocka_unit_test_setup_teardown(targets_of_normals_turn_as_the_normals_do, begun, gone),
        cmocka_unit_test_setup_teardown(what_cannot_follow_is_told_or_stands_still, begun, gone),
        cmocka_unit_test_setup_teardown(matrices_saturate, begun, gone),
        cmocka_unit_test_setup_teardown(any_matrix_is_inverted, begun, gone),
        cmocka_unit_test_setup_teardown(an_arena_that_is_full_is_told, begun, gone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
