/* asset_order: a grid of quads whose vertices are doubled and in a bad order, and what is left of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 12, QUADS = SIDE * SIDE, CORNERS = QUADS * 6, PLACES = (SIDE + 1) * (SIDE + 1) };

/* Each corner of each triangle has a vertex of its own; equal places have equal data. */
static struct fx_vec3 positions[CORNERS + 1];
static int16_t normals[CORNERS + 1][3];
static fx_t uvs[CORNERS + 1][2];
static uint16_t colours[CORNERS + 1];
static unsigned indices[CORNERS], sources[CORNERS + 1];
static uint8_t memory[65536] __attribute__((aligned(8)));
static struct asset_shape shape;
static struct ph_mesh mesh;

static int fresh(void **state)
{
    static const int corner[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    (void)state;
    for (int i = 0; i < CORNERS; i++) {
        const int quad = i / 6 * 59 % QUADS; /* far from its neighbours */
        const int x = quad % SIDE + corner[i % 6][0], y = quad / SIDE + corner[i % 6][1];
        const int v = (i * 7 + 3) % CORNERS; /* 7 and the number of corners have no common divisor */
        positions[v] = (struct fx_vec3){x, y, 100 * x + y};
        normals[v][2] = (int16_t)(x + 50);
        uvs[v][0] = y - 7;
        colours[v] = (uint16_t)(x * y);
        sources[v] = 0;
        indices[i] = (unsigned)v;
    }
    shape = (struct asset_shape){.positions = positions,
                                 .normals = (const int16_t(*)[3])normals,
                                 .vertex_count = CORNERS + 1, /* the last one is of no triangle */
                                 .indices = indices,
                                 .index_count = CORNERS};
    memset(&mesh, 0, sizeof mesh);
    return 0;
}

static bool order(size_t size)
{
    struct demo_arena arena = {.base = memory, .size = size};
    return asset_order(&arena, &shape, &mesh);
}

static int compare(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(uint32_t));
}

/* The places of each triangle's corners, from its least one on, so that its side stays; sorted. */
static void list_triangles(uint32_t list[][3], const struct fx_vec3 *at, const unsigned *of, uint32_t count)
{
    for (uint32_t t = 0; t < count; t++) {
        uint32_t place[3];
        for (int i = 0; i < 3; i++) {
            const struct fx_vec3 *const p = &at[of[3 * t + (uint32_t)i]];
            place[i] = (uint32_t)(p->y * (SIDE + 1) + p->x);
        }
        const int least = place[0] < place[1] && place[0] < place[2] ? 0 : place[1] < place[2] ? 1 : 2;
        for (int i = 0; i < 3; i++) {
            list[t][i] = place[(least + i) % 3];
        }
    }
    qsort(list, count, sizeof list[0], compare);
}

static void expect_same_triangles(void)
{
    static uint32_t before[CORNERS / 3][3], after[CORNERS / 3][3];
    static unsigned got[CORNERS];
    assert_int_equal(mesh.triangle_count, CORNERS / 3);
    for (uint32_t i = 0; i < CORNERS; i++) {
        got[i] = mesh.triangles[i / 3][i % 3];
        assert_true(got[i] < mesh.vertex_count);
    }
    list_triangles(before, positions, indices, CORNERS / 3);
    list_triangles(after, mesh.positions, got, CORNERS / 3);
    assert_memory_equal(before, after, sizeof before);
}

static void equal_vertices_become_one_and_no_triangle_changes(void **state)
{
    (void)state;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES);
    assert_true(mesh.uvs == NULL && mesh.colours == NULL);
    expect_same_triangles();
    shape.uvs = (const fx_t(*)[2])uvs;
    shape.colours = colours;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES);
    expect_same_triangles();
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        const struct fx_vec3 p = mesh.positions[v];
        assert_int_equal(p.z, 100 * p.x + p.y);
        assert_int_equal(mesh.normals[v][2], p.x + 50);
        assert_int_equal(mesh.uvs[v][0], p.y - 7);
        assert_int_equal(mesh.colours[v], p.x * p.y);
    }
}

/* One vertex that is different in any one of its data stays apart; also one of another source. */
static void vertices_that_differ_stay_apart(void **state)
{
    (void)state;
    const unsigned v = indices[4]; /* a corner of two triangles at least */
    normals[v][0] = 1;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES + 1);
    normals[v][0] = 0;
    shape.uvs = (const fx_t(*)[2])uvs;
    uvs[v][1] = 1;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES + 1);
    uvs[v][1] = 0;
    shape.colours = colours;
    colours[v]++;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES + 1);
    colours[v]--;
    shape.sources = sources;
    sources[v] = 77;
    assert_true(order(sizeof memory));
    assert_int_equal(mesh.vertex_count, PLACES + 1);
    unsigned found = 0;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        found += sources[i] == 77 && mesh.positions[i].x == positions[v].x && mesh.positions[i].y == positions[v].y;
    }
    assert_int_equal(found, 1);
}

/* Of vertices that are not among the last 16 different ones, as a queue has them. */
static uint32_t fetches_of(const struct ph_mesh *m)
{
    uint32_t at[CORNERS + 1] = {0}, count = 0;
    for (uint32_t i = 0; i < 3 * m->triangle_count; i++) {
        uint32_t *const last = &at[m->triangles[i / 3][i % 3]];
        if (*last == 0 || count - *last >= 16) {
            *last = ++count;
        }
    }
    return count;
}

static void vertices_are_used_again_soon_and_come_in_the_order_of_their_use(void **state)
{
    (void)state;
    uint16_t corners[CORNERS / 3][3];
    for (int i = 0; i < CORNERS; i++) {
        corners[i / 3][i % 3] = (uint16_t)indices[i];
    }
    const struct ph_mesh before = {
        .triangles = (const uint16_t(*)[3])corners, .triangle_count = CORNERS / 3, .vertex_count = CORNERS};
    assert_int_equal((int)asset_fetches(&before), CORNERS);
    assert_true(order(sizeof memory));
    uint32_t next = 0;
    for (uint32_t i = 0; i < CORNERS; i++) {
        const uint32_t v = mesh.triangles[i / 3][i % 3];
        assert_true(v <= next);
        next += v == next;
    }
    assert_int_equal(next, mesh.vertex_count);
    assert_int_equal((int)asset_fetches(&mesh), fetches_of(&mesh));
    assert_in_range(fetches_of(&mesh), PLACES, CORNERS / 3 * 3 / 4);
}

static void an_arena_that_is_too_small_is_told(void **state)
{
    (void)state;
    shape.uvs = (const fx_t(*)[2])uvs;
    shape.colours = colours;
    /* 169 vertices of 12, 6, 8 and 2 bytes, and 288 triangles of 6, each on 8 bytes */
    const size_t least = 2032 + 1016 + 1352 + 344 + 1728;
    for (size_t size = 0; size < least; size += 8) {
        assert_false(order(size));
    }
    assert_true(order(least));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(equal_vertices_become_one_and_no_triangle_changes, fresh),
        cmocka_unit_test_setup(vertices_that_differ_stay_apart, fresh),
        cmocka_unit_test_setup(vertices_are_used_again_soon_and_come_in_the_order_of_their_use, fresh),
        cmocka_unit_test_setup(an_arena_that_is_too_small_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
