/* asset_net: points, wedges and their numbers, for a folded square of two triangles that share an edge or only seem to.
 */
#include "asset_net.h"

#include "asset_quadric.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Triangle 0 1 2 lies in z = 0 and has an area of 2; triangle 3 4 5 stands on the edge from 1 to 2, also as large. */
static struct fx_vec3 positions[6];
static int16_t normals[6][3];
static fx_t uvs[6][2];
static uint16_t colours[6];
static uint16_t triangles[3][3] = {{0, 1, 2}, {3, 4, 5}, {1, 2, 4}};
static struct ph_mesh meshes[2];
static struct model model;
static struct model_motion motion;
static struct animation_mesh moving;
static struct ph_influence influences[6];
static struct asset_net net;

static int fresh(void **state)
{
    static const struct fx_vec3 places[6] = {
        {0, 0, 0},          {2 * FX_ONE, 0, 0},          {2 * FX_ONE, 2 * FX_ONE, 0},
        {2 * FX_ONE, 0, 0}, {2 * FX_ONE, 0, 2 * FX_ONE}, {2 * FX_ONE, 2 * FX_ONE, 0}};
    (void)state;
    memcpy(positions, places, sizeof positions);
    memset(normals, 0, sizeof normals);
    memset(uvs, 0, sizeof uvs);
    memset(colours, 0, sizeof colours);
    memset(influences, 0, sizeof influences);
    meshes[0] = (struct ph_mesh){.positions = positions,
                                 .normals = (const int16_t(*)[3])normals,
                                 .triangles = (const uint16_t(*)[3])triangles,
                                 .vertex_count = 6,
                                 .triangle_count = 2};
    model = (struct model){.meshes = meshes, .mesh_count = 1, .triangle_count = 2, .vertex_max = 6};
    return 0;
}

static int freed(void **state)
{
    (void)state;
    asset_net_free(&net);
    return 0;
}

static void expect(uint32_t points, uint32_t wedges, int dimensions)
{
    assert_true(asset_net_make(&net, &model));
    assert_int_equal(net.point_count, points);
    assert_int_equal(net.wedge_count, wedges);
    assert_int_equal(net.dimensions, dimensions);
    assert_int_equal(net.numbers, asset_quadric_numbers(dimensions));
}

static void what_is_equal_is_one_wedge(void **state)
{
    (void)state;
    expect(4, 4, 3); /* flat: normals do not count */
    assert_true(net.size == 2);
    assert_int_equal(net.triangle_count, 2);
    for (uint32_t corner = 0; corner < 6; corner++) {
        const uint32_t wedge = asset_net_wedge(&net, corner), vertex = triangles[corner / 3][corner % 3];
        const double *const x = asset_net_x(&net, wedge);
        assert_true(x[0] == positions[vertex].x / 2. / FX_ONE && x[1] == positions[vertex].y / 2. / FX_ONE &&
                    x[2] == positions[vertex].z / 2. / FX_ONE);
        assert_int_equal(net.wedges[wedge].source, vertex == 3 ? 1 : vertex == 5 ? 2 : vertex);
        uint32_t at_point = 0;
        for (uint32_t c = net.heads[asset_net_point(&net, corner)]; c != ASSET_NET_NONE; c = net.next[c]) {
            assert_int_equal(asset_net_point(&net, c), asset_net_point(&net, corner));
            at_point++;
        }
        assert_int_equal(at_point, vertex == 0 || vertex == 4 ? 1 : 2);
        assert_true(fabs(net.areas[wedge] - (at_point == 1 ? .5 : 1)) < 1e-12);
    }
}

static void each_thing_that_differs_makes_a_wedge(void **state)
{
    (void)state;
    meshes[0].uvs = (const fx_t(*)[2])uvs;
    expect(4, 4, 5);
    asset_net_free(&net);
    uvs[3][1] = 1;
    expect(4, 5, 5);
    asset_net_free(&net);
    meshes[0].colours = colours;
    colours[5] = 1;
    expect(4, 6, 8);
    asset_net_free(&net);
    fresh(NULL);
    normals[0][0] = 5; /* so it is not flat */
    expect(4, 4, 6);
    asset_net_free(&net);
    normals[3][2] = 5;
    expect(4, 5, 6);
}

static void meshes_and_joints_stay_apart_in_one_place(void **state)
{
    (void)state;
    meshes[1] = meshes[0];
    model.mesh_count = 2;
    model.triangle_count = 4;
    expect(4, 8, 3);
    assert_int_equal(net.triangle_count, 4);
    asset_net_free(&net);
    fresh(NULL);
    moving = (struct animation_mesh){.mesh = 0, .bound = {.influences = influences, .vertex_count = 6}};
    motion = (struct model_motion){.animation = {.meshes = &moving, .mesh_count = 1}};
    model.motion = &motion;
    expect(4, 4, 3);
    asset_net_free(&net);
    influences[3].joints[2] = 1;
    expect(4, 5, 3);
    asset_net_free(&net);
    influences[5].weights[0] = 1;
    expect(4, 6, 3);
    asset_net_free(&net);
    fresh(NULL);
    moving.morph.target_count = 1;
    model.motion = &motion;
    expect(4, 6, 3);
}

static void triangles_that_are_lines_are_left_out(void **state)
{
    (void)state;
    positions[4] = positions[5];
    expect(3, 3, 3);
    assert_int_equal(net.triangle_count, 1);
}

/* The value of the quadrics of a point, when it has moved; the net is half as large as the model. */
static double cost(uint32_t vertex, double x, double y, double z)
{
    double sum = 0, at[ASSET_DIMENSIONS_MAX];
    for (uint32_t w = 0; w < net.wedge_count; w++) {
        const double *const place = asset_net_x(&net, w);
        if (place[0] == positions[vertex].x / 2. / FX_ONE && place[1] == positions[vertex].y / 2. / FX_ONE &&
            place[2] == positions[vertex].z / 2. / FX_ONE) {
            memcpy(at, place, sizeof *at * (size_t)net.dimensions);
            at[0] += x, at[1] += y, at[2] += z;
            sum += asset_quadric_at(asset_net_quadric(&net, w), net.dimensions, at);
        }
    }
    return sum;
}

/* In the net a triangle has an area of 1/2; its edges have squares of 1 and 2. */
static void a_quadric_holds_planes_borders_and_seams(void **state)
{
    (void)state;
    expect(4, 4, 3);
    assert_true(fabs(cost(0, 0, 0, .1) - .5 * .01) < 1e-12);         /* off its plane */
    assert_true(fabs(cost(0, -.1, 0, 0) - 2 * 2 * .01 / 2) < 1e-12); /* along one border, across the other */
    const double before = cost(1, .1, 0, 0);
    asset_net_free(&net);
    meshes[0].uvs = (const fx_t(*)[2])uvs;
    uvs[3][0] = uvs[5][0] = FX_ONE;
    expect(4, 6, 5);
    assert_true(fabs(cost(1, .1, 0, 0) - before - 4 * .01) < 1e-9); /* the seam is upright on the first triangle */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_is_equal_is_one_wedge, fresh, freed),
        cmocka_unit_test_setup_teardown(each_thing_that_differs_makes_a_wedge, fresh, freed),
        cmocka_unit_test_setup_teardown(meshes_and_joints_stay_apart_in_one_place, fresh, freed),
        cmocka_unit_test_setup_teardown(triangles_that_are_lines_are_left_out, fresh, freed),
        cmocka_unit_test_setup_teardown(a_quadric_holds_planes_borders_and_seams, fresh, freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
