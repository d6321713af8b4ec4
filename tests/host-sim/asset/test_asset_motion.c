/* asset_motion: what moves is picked by the vertices that remain, and its bytes of flash are counted as a 32-bit
 * compiler lays the tables out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"
#include "made_asset.h"

#include <string.h>

static uint8_t memory[16384] __attribute__((aligned(8)));

static struct demo_arena arena_of(size_t size)
{
    assert_true(size <= sizeof memory);
    memset(memory, 0x55, sizeof memory);
    return (struct demo_arena){.base = memory, .size = size};
}

static void equal_skins_are_found_by_what_they_hold(void **state)
{
    (void)state;
    const struct animation *const a = &made_asset(true)->model.motion->animation;
    uint16_t nodes[3];
    struct ph_xform binds[3];
    struct ph_skin *const skin = &made_moving(2)->skin;
    assert_int_equal(asset_first_skin(a, 0), 0);
    assert_int_equal(asset_first_skin(a, 1), 1);
    assert_int_equal(asset_first_skin(a, 2), 0);
    memcpy(nodes, skin->nodes, sizeof nodes);
    memcpy(binds, skin->inverse_bind, sizeof binds);
    skin->nodes = nodes;
    skin->inverse_bind = binds;
    nodes[2]++;
    assert_int_equal(asset_first_skin(a, 2), 2);
    nodes[2]--;
    binds[2].t.z++;
    assert_int_equal(asset_first_skin(a, 2), 2);
    skin->joint_count = 1; /* begins as that of 0 does */
    assert_int_equal(asset_first_skin(a, 2), 2);
}

/* Tracks of as many keys at the same place share it; a track without keys may lie where another begins. */
static void times_are_shared_by_tracks_that_name_them(void **state)
{
    static const fx_t times[4] = {0, 1, 2, 3};
    struct ph_track tracks[4] = {{.times = times, .key_count = 2},
                                 {.times = times + 1, .key_count = 2},
                                 {.times = times, .key_count = 3},
                                 {.times = times, .key_count = 2}};
    const struct ph_clip clip = {.tracks = tracks, .track_count = 4};
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        assert_int_equal(asset_first_times(&clip, i), i < 3 ? i : 0);
    }
}

static void a_cubic_key_has_two_tangents(void **state)
{
    (void)state;
    const struct ph_clip *const clips = made_asset(true)->model.motion->animation.clips;
    assert_int_equal(asset_key_numbers(&clips[0].tracks[0]), 3);
    assert_int_equal(asset_key_numbers(&clips[1].tracks[0]), 6);
    assert_int_equal(asset_key_numbers(&clips[1].tracks[1]), 2 * 4 * 3);
    assert_int_equal(asset_key_numbers(&clips[1].tracks[2]), 14);
}

/* Sizes of pointers and numbers of 4 bytes, rounded up to 4; two tracks share their times. */
static void flash_is_counted_table_by_table(void **state)
{
    (void)state;
    const uint64_t rig = 25 * 4 + 3 * 44 + 4 * (1 + MADE_WEIGHTS), meshes = MADE_MOVING * 16 * 4,
                   skins = (8 + 3 * 48) + (4 + 48), vertices = 3 * 12 + 5 * (2 * 2 * 6) + 3 * 6,
                   stand = 16 + 8 + (16 + 4 + 8), walk = 16 + 12 + (16 + 8 + 12) + (16 + 48) + (16 + 28 + 28);
    assert_int_equal(asset_motion_bytes(&made_asset(true)->model), rig + meshes + skins + vertices + stand + walk);
    assert_int_equal(asset_motion_bytes(&made_asset(false)->model), 0);
}

static void a_model_that_stands_needs_no_room(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(false)->model;
    struct demo_arena arena = arena_of(0);
    struct model to = {.motion = NULL};
    assert_int_equal(asset_motion_room(model, 100), 0);
    assert_true(asset_motion_begin(&arena, model, &to));
    assert_null(to.motion);
}

/* The most bytes of a vertex: position, normal, and two targets of both. */
static void room_grows_by_three_vertices_a_triangle(void **state)
{
    (void)state;
    const struct model *const model = &made_asset(true)->model;
    assert_int_equal(asset_motion_room(model, 51) - asset_motion_room(model, 50), 3 * 6 * 6);
    made_moving(1)->morph.d_normals = NULL;
    assert_int_equal(asset_motion_room(model, 51) - asset_motion_room(model, 50), 3 * 4 * 6);
    made_moving(0)->morph.target_count = 1; /* with influences */
    assert_int_equal(asset_motion_room(model, 51) - asset_motion_room(model, 50), 3 * (3 * 6 + 12));
}

/* Adds mesh i by vertices that were picked, into an asset in which it has number 9 - i. */
static bool add(struct demo_arena *arena, struct model *to, uint32_t i, const unsigned *sources, uint32_t count)
{
    static const int16_t normals[16][3];
    static struct ph_mesh meshes[10];
    meshes[9 - i] = (struct ph_mesh){.vertex_count = count, .normals = normals};
    to->meshes = meshes;
    return asset_motion_add(arena, made_moving(i), sources, to, 9 - i);
}

static void expect_picked(const int16_t (*to)[3], const int16_t (*from)[3], const unsigned *sources, uint32_t count)
{
    for (uint32_t v = 0; v < count; v++) {
        assert_memory_equal(to[v], from[sources[v]], 6);
    }
}

static void vertices_are_those_that_the_sources_name(void **state)
{
    (void)state;
    static const unsigned sources[] = {4, 1, 1, 0}, of_three[] = {2, 0, 2, 1};
    const struct model *const model = &made_asset(true)->model;
    struct demo_arena arena = arena_of(sizeof memory);
    struct model to = {.motion = NULL};
    assert_true(asset_motion_begin(&arena, model, &to));
    assert_ptr_not_equal(to.motion, model->motion);
    assert_int_equal(to.motion->animation.clip_count, MADE_CLIPS);
    assert_int_equal(to.motion->animation.mesh_count, 0);
    assert_true(add(&arena, &to, 0, of_three, 4));
    assert_true(add(&arena, &to, 1, sources, 4));
    assert_true(add(&arena, &to, 2, of_three, 4));
    assert_int_equal(to.motion->animation.mesh_count, 3);
    for (uint32_t i = 0; i < MADE_MOVING; i++) {
        const struct animation_mesh *const from = made_moving(i), *const got = &to.motion->animation.meshes[i];
        const unsigned *const by = i == 1 ? sources : of_three;
        assert_int_equal(got->mesh, 9 - i);
        assert_int_equal(got->bound.vertex_count, 4);
        assert_int_equal(got->morph.vertex_count, 4);
        assert_int_equal(got->first_weight, from->first_weight);
        assert_int_equal(got->bound.frac, from->bound.frac);
        assert_ptr_equal(got->bound.normals, to.meshes[9 - i].normals);
        assert_ptr_equal(got->morph.normals, got->bound.normals);
        assert_ptr_equal(got->morph.positions, got->bound.positions);
        expect_picked(got->bound.positions, from->bound.positions, by, 4);
        assert_int_equal(got->morph.d_positions != NULL, i > 0);
        assert_int_equal(got->morph.d_normals != NULL, i == 1);
        assert_int_equal(got->bound.influences != NULL, i == 0);
        for (uint32_t t = 0; t < from->morph.target_count; t++) {
            const size_t old = (size_t)from->bound.vertex_count * t, n = (size_t)4 * t;
            expect_picked(got->morph.d_positions + n, from->morph.d_positions + old, by, 4);
            if (i == 1) {
                expect_picked(got->morph.d_normals + n, from->morph.d_normals + old, by, 4);
            }
        }
    }
    for (uint32_t v = 0; v < 4; v++) {
        assert_memory_equal(&to.motion->animation.meshes[0].bound.influences[v],
                            &made_moving(0)->bound.influences[of_three[v]], sizeof(struct ph_influence));
    }
}

static bool add_all(size_t size)
{
    static const unsigned sources[] = {0, 1, 2};
    struct demo_arena arena = arena_of(size);
    struct model to = {.motion = NULL};
    bool is_done = asset_motion_begin(&arena, &made_asset(true)->model, &to);
    for (uint32_t i = 0; i < MADE_MOVING && is_done; i++) {
        is_done = add(&arena, &to, i, sources, 3);
    }
    return is_done;
}

/* A triangle a mesh, each with three vertices of its own; without any one of the arrays it is not done. */
static void the_room_that_is_said_is_enough_and_less_is_told(void **state)
{
    (void)state;
    size_t least = asset_motion_room(&made_asset(true)->model, MADE_MOVING) / 8 * 8;
    assert_true(add_all(least));
    while (add_all(least - 8)) {
        least -= 8;
    }
    /* tables, positions, influences, two targets with normals, one without, each on 8 bytes */
    const size_t tables =
        (sizeof(struct animation_mesh) * MADE_MOVING + 7) / 8 * 8 + (sizeof(struct model_motion) + 7) / 8 * 8;
    assert_int_equal(least, tables + 3 * 24 + 40 + 2 * 40 + 24);
    for (size_t size = 0; size < least; size += 8) {
        assert_false(add_all(size));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_skins_are_found_by_what_they_hold),
        cmocka_unit_test(times_are_shared_by_tracks_that_name_them),
        cmocka_unit_test(a_cubic_key_has_two_tangents),
        cmocka_unit_test(flash_is_counted_table_by_table),
        cmocka_unit_test(a_model_that_stands_needs_no_room),
        cmocka_unit_test(room_grows_by_three_vertices_a_triangle),
        cmocka_unit_test(vertices_are_those_that_the_sources_name),
        cmocka_unit_test(the_room_that_is_said_is_enough_and_less_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
