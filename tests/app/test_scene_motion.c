/* scene_motion: each number of what moves in a binary scene, at its bounds and just outside of them; and what is made
 * of a scene, against the asset that it was written from. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "made_asset.h"
#include "scene_motion.h"

#include <string.h>

static uint8_t bytes[1 << 16] __attribute__((aligned(16)));
static struct scene_file_head *const head = (struct scene_file_head *)(void *)bytes;
static struct asset *asset;
static struct scene_file_motion *motion;
static struct scene_file_clip *clips;
static struct scene_file_track *tracks;             /* of clip 1 */
static struct scene_file_moving *skinned, *morphed; /* of meshes 0 and 2 */
static struct ph_rig_node *nodes;

static void *at(uint32_t offset)
{
    return bytes + offset;
}

static struct scene_file_mesh *mesh_of(uint32_t i)
{
    return (struct scene_file_mesh *)at(sizeof *head) + i;
}

static int fresh(void **state)
{
    (void)state;
    asset = made_asset(true);
    assert_in_range(asset_scene(asset, NULL), 1, sizeof bytes);
    asset_scene(asset, bytes);
    motion = at(head->motion);
    clips = at(motion->clips);
    tracks = at(clips[1].tracks);
    nodes = at(motion->nodes);
    skinned = at(mesh_of(0)->moving);
    morphed = at(mesh_of(2)->moving);
    assert_true(scene_motion_right(head));
    return 0;
}

/* The scene with another number in one place is right or wrong. */
#define EXPECT(is_right, place, number)                                                                                \
    do {                                                                                                               \
        __typeof__(place) kept = (place);                                                                              \
        (place) = (number);                                                                                            \
        assert_int_equal(scene_motion_right(head), is_right);                                                          \
        (place) = kept;                                                                                                \
    } while (0)

/* An offset is a multiple of 4, behind the head, and what it names ends before the scene does. */
#define EXPECT_OFFSET(place, size)                                                                                     \
    do {                                                                                                               \
        EXPECT(false, place, (place) + 2);                                                                             \
        EXPECT(false, place, 4);                                                                                       \
        EXPECT(false, place, (head->bytes - (size)) / 4 * 4 + 4);                                                      \
        EXPECT(false, place, head->bytes + 4);                                                                         \
    } while (0)

static void offsets_stay_inside(void **state)
{
    (void)state;
    EXPECT_OFFSET(head->motion, sizeof *motion);
    EXPECT_OFFSET(motion->nodes, MADE_NODES * 44);
    EXPECT_OFFSET(motion->rest_weights, MADE_WEIGHTS * 4);
    EXPECT_OFFSET(motion->clips, MADE_CLIPS * sizeof *clips);
    EXPECT_OFFSET(clips[1].tracks, clips[1].track_count * sizeof *tracks);
    for (uint32_t i = 0; i < clips[1].track_count; i++) {
        const uint32_t parts = tracks[i].interpolation == PH_KEYS_CUBIC ? 3 : 1;
        EXPECT_OFFSET(tracks[i].times, tracks[i].key_count * 4u);
        EXPECT_OFFSET(tracks[i].keys, tracks[i].key_count * parts * tracks[i].width * 2);
        EXPECT(true, tracks[i].keys, (head->bytes - tracks[i].key_count * parts * tracks[i].width * 2) / 4 * 4);
    }
    EXPECT_OFFSET(mesh_of(0)->moving, sizeof *skinned);
    EXPECT_OFFSET(skinned->joints, 3 * 2);
    EXPECT_OFFSET(skinned->inverse_bind, 3 * 48);
    EXPECT_OFFSET(skinned->influences, 3 * 12);
    EXPECT_OFFSET(morphed->targets, 2 * 5 * 6);
    EXPECT_OFFSET(morphed->target_normals, 2 * 5 * 6);
    EXPECT(true, skinned->influences, 0);
    EXPECT(true, morphed->target_normals, 0);
}

static void counts_and_numbers_keep_their_bounds(void **state)
{
    (void)state;
    EXPECT(true, motion->playing, MADE_CLIPS - 1);
    EXPECT(false, motion->playing, MADE_CLIPS);
    EXPECT(true, motion->cross_fade, INT32_MAX);
    EXPECT(false, motion->cross_fade, -1);
    EXPECT(false, motion->node_count, 32768);
    EXPECT(false, motion->clip_count, head->bytes);
    EXPECT(false, motion->weight_count, head->bytes);
    EXPECT(true, nodes[1].parent, -1);
    EXPECT(true, nodes[1].parent, 0);
    EXPECT(false, nodes[1].parent, 1);
    EXPECT(false, nodes[1].parent, -2);
    EXPECT(false, nodes[0].parent, 0);
    EXPECT(true, clips[1].duration, 0);
    EXPECT(false, clips[1].duration, -1);
    EXPECT(false, clips[1].name[SCENE_FILE_NAME - 1], 'x');
    EXPECT(true, skinned->frac, 12);
    EXPECT(false, skinned->frac, 11);
    EXPECT(true, skinned->frac, 24);
    EXPECT(false, skinned->frac, 25);
    EXPECT(false, skinned->joint_count, 0);
    EXPECT(false, morphed->joint_count, 0);
    EXPECT(true, skinned->first_weight, MADE_WEIGHTS);
    EXPECT(false, skinned->first_weight, MADE_WEIGHTS + 1);
    EXPECT(true, morphed->first_weight, MADE_WEIGHTS - 2);
    EXPECT(false, morphed->first_weight, MADE_WEIGHTS - 1);
    EXPECT(false, morphed->target_count, 257);
    uint16_t *const joints = at(skinned->joints);
    EXPECT(true, joints[2], MADE_NODES - 1);
    EXPECT(false, joints[2], MADE_NODES);
    struct ph_influence *const influences = at(skinned->influences);
    for (int k = 0; k < 4; k++) {
        EXPECT(true, influences[2].joints[k], 2);
        EXPECT(false, influences[2].joints[k], 3);
    }
    EXPECT(false, head->motion, 0); /* meshes that move have nothing to move by */
}

static void tracks_keep_their_bounds(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < clips[1].track_count; i++) {
        struct scene_file_track *const t = &tracks[i];
        EXPECT(true, t->frac, 8);
        EXPECT(false, t->frac, 7);
        EXPECT(true, t->frac, 24);
        EXPECT(false, t->frac, 25);
        EXPECT(false, t->path, PH_PATH_WEIGHTS + 1);
        EXPECT(false, t->interpolation, PH_KEYS_CUBIC + 1);
        EXPECT(false, t->width, t->path == PH_PATH_WEIGHTS ? MADE_WEIGHTS + 1 : t->width + 1);
        EXPECT(false, t->node, t->path == PH_PATH_WEIGHTS ? MADE_WEIGHTS - t->width + 1 : MADE_NODES);
        EXPECT(true, t->node, t->path == PH_PATH_WEIGHTS ? MADE_WEIGHTS - t->width : MADE_NODES - 1);
    }
}

static void what_cannot_be_meant_is_told(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < MADE_NODES; i++) { /* the test's asset has numbers of any kind there */
        nodes[i].rest.r = fx_quat_identity;
    }
    for (uint32_t m = 0; m < MADE_MESHES; m++) {
        struct scene_file_moving *const moving = mesh_of(m)->moving != 0 ? at(mesh_of(m)->moving) : NULL;
        struct ph_influence *const influences =
            moving != NULL && moving->influences != 0 ? at(moving->influences) : NULL;
        for (uint32_t v = 0; influences != NULL && v < mesh_of(m)->vertex_count; v++) {
            influences[v] = (struct ph_influence){{0}, {20000, 12000, 700, 68}};
        }
    }
    for (uint32_t c = 0; c < MADE_CLIPS; c++) {
        struct scene_file_track *const of = at(clips[c].tracks);
        for (uint32_t t = 0; t < clips[c].track_count; t++) {
            fx_t *const times = at(of[t].times);
            for (uint16_t k = 0; k < of[t].key_count; k++) {
                times[k] = k / 2; /* equal times are a jump */
            }
        }
    }
    assert_true(scene_motion_can_move(head));
    const uint32_t last = tracks[0].key_count - 1u;
    fx_t *const times = at(tracks[0].times);
    times[last]--;
    assert_int_equal(scene_motion_can_move(head), times[last] >= times[last - 1]);
    times[last] = 0, times[0] = 1;
    assert_false(scene_motion_can_move(head));
    times[0] = 0;
    struct ph_influence *const influences = at(skinned->influences);
    influences[2].weights[3]++;
    assert_false(scene_motion_can_move(head));
    influences[2].weights[0]--;
    assert_true(scene_motion_can_move(head));
    /* The square of the length may be 1/64 off: 1.0077 and .9922 of the length are, .996 is not. */
    nodes[2].rest.r.w = (int32_t)(FX_Q30_ONE * .996);
    assert_true(scene_motion_can_move(head));
    nodes[2].rest.r.w = (int32_t)(FX_Q30_ONE * .992);
    assert_false(scene_motion_can_move(head));
    nodes[2].rest.r.w = (int32_t)(FX_Q30_ONE * 1.008);
    assert_false(scene_motion_can_move(head));
    nodes[2].rest.r = (struct fx_quat){FX_Q30_ONE / 2, -FX_Q30_ONE / 2, FX_Q30_ONE / 2, -FX_Q30_ONE / 2};
    assert_true(scene_motion_can_move(head));
}

/* ---- what is made ------------------------------------------------------------------------------------------------ */

static struct demo_arena arena_of(size_t size)
{
    static uint8_t memory[8192] __attribute__((aligned(8)));
    assert_true(size <= sizeof memory);
    return (struct demo_arena){.base = memory, .size = size};
}

/* What is made has the clip without its tracks, and samples it where it lies: at any time as the clip that was written.
 */
static void expect_clip(const struct animation *a, uint32_t i, const struct ph_clip *from)
{
    const struct ph_clip *const clip = &a->clips[i];
    assert_string_equal(clip->name, from->name);
    assert_true(clip->track_count == from->track_count && clip->duration == from->duration);
    for (fx_t time = 0; time <= from->duration; time += from->duration / 16) {
        struct ph_pose pose[2][MADE_NODES] = {{{.t = {0, 0, 0}}}};
        int32_t weights[2][MADE_WEIGHTS + 8] = {{0}};
        a->sample(a, clip, time, pose[0], weights[0]);
        ph_clip_sample(from, time, pose[1], weights[1]);
        assert_memory_equal(pose[0], pose[1], sizeof pose[0]);
        assert_memory_equal(weights[0], weights[1], sizeof weights[0]);
    }
}

static void the_head_says_whether_clips_take_turns(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 2; i++) {
        struct demo_arena arena = arena_of(8192);
        assert_int_equal(scene_motion_make(head, &arena)->in_turn, i);
        head->flags ^= SCENE_FILE_IN_TURN;
    }
}

static void what_is_made_is_what_was_written(void **state)
{
    (void)state;
    const struct animation *const from = &asset->model.motion->animation;
    for (uint32_t playing = 0; playing < MADE_CLIPS; playing++) {
        struct demo_arena arena = arena_of(8192);
        scene_motion_play(head, playing);
        const struct animation *const a = scene_motion_make(head, &arena);
        assert_true(a != NULL && a->mesh_count == MADE_MOVING && a->weight_count == MADE_WEIGHTS);
        assert_memory_equal(&a->root, &from->root, sizeof a->root);
        assert_memory_equal(a->rig.nodes, from->rig.nodes, MADE_NODES * sizeof *a->rig.nodes);
        assert_memory_equal(a->rest_weights, from->rest_weights, MADE_WEIGHTS * sizeof *a->rest_weights);
        assert_true(a->clip_count == MADE_CLIPS && a->clip == &a->clips[playing] && a->cross_fade == 12345);
        for (uint32_t i = 0; i < MADE_CLIPS; i++) {
            expect_clip(a, i, &from->clips[i]);
        }
        for (uint32_t i = 0; i < MADE_MOVING; i++) {
            const struct animation_mesh *const m = &a->meshes[i], *const n = &from->meshes[i];
            const uint32_t targets = n->morph.target_count, vertices = n->bound.vertex_count;
            assert_true(m->mesh == n->mesh && m->first_weight == n->first_weight && m->bound.frac == n->bound.frac);
            assert_true(m->bound.vertex_count == vertices &&
                        m->morph.vertex_count == (targets > 0 ? vertices : m->morph.vertex_count));
            assert_true(m->skin.joint_count == n->skin.joint_count && m->morph.target_count == targets);
            assert_memory_equal(m->skin.nodes, n->skin.nodes, m->skin.joint_count * 2);
            assert_memory_equal(m->skin.inverse_bind, n->skin.inverse_bind, m->skin.joint_count * 48);
            assert_memory_equal(m->bound.positions, n->bound.positions, vertices * 6);
            assert_int_equal(m->bound.influences != NULL, n->bound.influences != NULL);
            assert_int_equal(targets > 0 && m->morph.d_normals != NULL, n->morph.d_normals != NULL);
            if (targets > 0) {
                assert_memory_equal(m->morph.d_positions, n->morph.d_positions, targets * vertices * 6);
            }
        }
    }
}

/* On a 32-bit target: 112 bytes of tables, 64 a mesh, 16 a clip; here what is taken of an arena. */
static void what_is_taken_is_what_was_said(void **state)
{
    (void)state;
    const struct animation *const from = &asset->model.motion->animation;
    const struct animation_need need = animation_need(from);
    struct demo_arena arena = arena_of(8192);
    assert_non_null(scene_motion_make(head, &arena));
    const size_t tables = scene_motion_table_bytes(MADE_MOVING, MADE_CLIPS, false);
    assert_true(arena.used <= tables && arena.used + 8 > tables);
    for (size_t size = 0; size < arena.used; size += 8) {
        struct demo_arena small = arena_of(size);
        assert_null(scene_motion_make(head, &small));
    }
    assert_int_equal(scene_motion_table_bytes(3, 5, true), 112 + 3 * 64 + 5 * 16);
    assert_int_equal(scene_motion_bytes(head, false), tables + animation_bytes(&need, from, MADE_MESHES, false));
    assert_int_equal(scene_motion_bytes(head, true),
                     112 + 3 * 64 + MADE_CLIPS * 16 + animation_bytes(&need, from, MADE_MESHES, true));
    asset_scene(made_asset(false), bytes);
    assert_int_equal(scene_motion_bytes(head, false), 0);
    assert_true(scene_motion_right(head));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(offsets_stay_inside, fresh),
        cmocka_unit_test_setup(counts_and_numbers_keep_their_bounds, fresh),
        cmocka_unit_test_setup(tracks_keep_their_bounds, fresh),
        cmocka_unit_test_setup(what_cannot_be_meant_is_told, fresh),
        cmocka_unit_test_setup(the_head_says_whether_clips_take_turns, fresh),
        cmocka_unit_test_setup(what_is_made_is_what_was_written, fresh),
        cmocka_unit_test_setup(what_is_taken_is_what_was_said, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
