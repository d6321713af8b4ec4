/*
 * animation: the memory that it says is what it takes, to the byte; vertices go where rig, clip, skin and morph targets
 * lead them, by sums in double precision; and the number of the frame goes on where its 32 bits begin anew.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "animation.h"
#include "assert_near.h"
#include "demo_stage.h"
#include "models.h"

#include <stdlib.h>
#include <string.h>

#define ONE_Q24 (1 << 24)
#define MESHES  3

/* A root 1 to the right, and a node 2 above it, which a clip of 2 s moves to the front: to z = 3 in its first second,
 * and back to z = 1 in the next. */
static const struct ph_rig_node nodes[] = {
    {-1, {{FX_Q30_ONE, 0, 0, 0}, {ONE_Q24, 0, 0}, {ONE_Q24, ONE_Q24, ONE_Q24}}},
    {0, {{FX_Q30_ONE, 0, 0, 0}, {0, 2 * ONE_Q24, 0}, {ONE_Q24, ONE_Q24, ONE_Q24}}}};
static const fx_t times[] = {0, FX_ONE, 2 * FX_ONE};
static const int16_t keys[][3] = {{0, 8192, 0}, {0, 8192, 12288}, {0, 8192, 4096}};
static const struct ph_track track = {.node = 1,
                                      .path = PH_PATH_TRANSLATION,
                                      .interpolation = PH_KEYS_LINEAR,
                                      .width = 3,
                                      .frac = 12,
                                      .key_count = 3,
                                      .times = times,
                                      .keys = keys[0]};
static const struct ph_clip clip = {.tracks = &track, .track_count = 1, .duration = 2 * FX_ONE};

static const int16_t places[4][3] = {{4096, 0, -8192}, {2048, 6144, 1024}};
static const int16_t upright[4][3] = {{0, 0, 16384}, {16384, 0, 0}};
static const int16_t morphed_by[4][3] = {{8192, 0, 0}, {0, -4096, 2048}};
static const int16_t turned_by[4][3] = {{0, 16384, 0}, {0, 0, 16384}};
static const uint16_t upper[] = {1}, lower[] = {0, 0, 1, 1, 0};
static const int32_t rest_weights[] = {7 * ONE_Q24, ONE_Q24 / 2};

/* The first one follows the upper node; the other the lower one, half of its target added. */
static const struct animation_mesh moving[] = {
    {.mesh = 2,
     .bound = {.positions = places, .normals = upright, .vertex_count = 4, .frac = 12},
     .skin = {.nodes = upper, .joint_count = 1}},
    {.mesh = 0,
     .bound = {.positions = places, .normals = upright, .vertex_count = 4, .frac = 12},
     .skin = {.nodes = lower, .joint_count = 5},
     .morph = {.positions = places,
               .normals = upright,
               .d_positions = morphed_by,
               .d_normals = turned_by,
               .vertex_count = 4,
               .target_count = 1},
     .first_weight = 1}};
static const struct animation scene = {
    .rig = {nodes, 2},
    .root = {{{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}}, {0, 0, 5 * ONE_Q24}},
    .clip = &clip,
    .meshes = moving,
    .mesh_count = 2,
    .weight_count = 2,
    .rest_weights = rest_weights};
static const struct ph_mesh meshes[MESHES] = {{.vertex_count = 4}, {.vertex_count = 77}, {.vertex_count = 4}};

/* ---- memory ------------------------------------------------------------------------------------------------------ */

static struct animation_mesh mesh_of(uint32_t joints, uint32_t targets, uint32_t morphed, bool normals,
                                     uint32_t vertices)
{
    return (struct animation_mesh){
        .bound = {.vertex_count = vertices},
        .skin = {.joint_count = joints},
        .morph = {.target_count = targets, .vertex_count = morphed, .d_normals = normals ? turned_by : NULL}};
}

static void what_meshes_need_together_is_what_the_largest_of_them_needs(void **state)
{
    (void)state;
    const struct animation_mesh added[] = {mesh_of(3, 1, 50, false, 10), mesh_of(9, 0, 900, true, 10),
                                           mesh_of(5, 2, 20, true, 10), mesh_of(1, 1, 4, true, 10)};
    for (uint32_t turn = 0; turn < 4; turn++) { /* whichever comes first */
        struct animation_need need = {0};
        for (uint32_t i = 0; i < 4; i++) {
            animation_add(&need, &added[(i + turn) % 4]);
        }
        assert_int_equal(need.joints, 9);
        assert_int_equal(need.morphed, 50); /* the one of 900 has no target */
        assert_int_equal(need.morphed_normals, 20);
        assert_int_equal(need.vertex_bytes, 4 * (120 + 64)); /* 12 bytes a place; 6 a normal, to a multiple of 8 */
    }
}

static void without_targets_for_normals_no_room_is_needed_for_them(void **state)
{
    (void)state;
    struct animation_need need = {0};
    const struct animation_mesh mesh = mesh_of(1, 1, 8, false, 8);
    animation_add(&need, &mesh);
    assert_int_equal(need.morphed, 8);
    assert_int_equal(need.morphed_normals, 0);
}

static void what_an_animation_needs_is_what_its_meshes_need(void **state)
{
    (void)state;
    const struct animation_need need = animation_need(&scene);
    assert_int_equal(need.joints, 5);
    assert_int_equal(need.morphed, 4);
    assert_int_equal(need.morphed_normals, 4);
    assert_int_equal(need.vertex_bytes, 2 * (48 + 24));
}

static void it_takes_the_bytes_that_it_says_and_does_without_none(void **state)
{
    (void)state;
    static uint64_t room[512];
    const struct animation_need need = animation_need(&scene);
    struct animation several = scene;
    size_t bytes[3];
    for (uint32_t clips = 0; clips < 3; clips++) {
        several.clip_count = clips;
        bytes[clips] = animation_bytes(&need, &several, MESHES, false);
        struct demo_arena arena = {(uint8_t *)room, sizeof room, 0};
        assert_non_null(animation_begin(&arena, &several, meshes, MESHES));
        assert_int_equal((arena.used + 7) / 8 * 8, bytes[clips]);
        for (size_t size = 0; size < bytes[clips]; size += 8) {
            struct demo_arena small = {(uint8_t *)room, size, 0};
            assert_null(animation_begin(&small, &several, meshes, MESHES));
        }
    }
    assert_int_equal(bytes[1], bytes[0]);
    assert_int_equal(bytes[2], bytes[0] + 2 * 40 + 2 * 4); /* a pose and the weights of the clip that fades in */
}

/* The rest of it is of integers: 2 poses of 40 bytes, 2 places and 5 matrices of 48, 2 weights, 4 x 6 bytes twice. */
static void a_32_bit_target_takes_less_for_pointers(void **state)
{
    (void)state;
    const struct animation_need need = animation_need(&scene);
    assert_int_equal(animation_bytes(&need, &scene, MESHES, true),
                     88 + (MESHES * 52 + 7) / 8 * 8 + 2 * 40 + 2 * 48 + 5 * 48 + 8 + 2 * 24 + need.vertex_bytes);
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

static uint64_t memory[1024];

static struct animation_stage *begin(const struct animation *a)
{
    struct demo_arena arena = {(uint8_t *)memory, sizeof memory, 0};
    struct animation_stage *const s = animation_begin(&arena, a, meshes, MESHES);
    assert_non_null(s);
    return s;
}

static void expect_at(const struct ph_mesh *mesh, uint32_t vertex, double x, double y, double z)
{
    const struct fx_vec3 p = mesh->positions[vertex];
    assert_near(p.x / 65536.0, x, 3e-5);
    assert_near(p.y / 65536.0, y, 3e-5);
    assert_near(p.z / 65536.0, z, 3e-5);
}

static void vertices_begin_in_the_bind_pose_with_any_fraction(void **state)
{
    (void)state;
    for (uint8_t frac = 12; frac <= 20; frac++) {
        struct animation_mesh mesh = moving[0];
        struct animation one = scene;
        mesh.bound.frac = frac;
        one.meshes = &mesh;
        one.mesh_count = 1;
        const struct animation_stage *const s = begin(&one);
        const double unit = 1.0 / (1 << frac);
        expect_at(&s->meshes[2], 0, 4096 * unit, 0, -8192 * unit);
        expect_at(&s->meshes[2], 1, 2048 * unit, 6144 * unit, 1024 * unit);
        assert_memory_equal(s->meshes[2].normals, upright, sizeof upright);
        assert_int_equal(s->meshes[1].vertex_count, 77); /* the others are copied as they are */
        assert_null(s->meshes[1].positions);
    }
}

/* Frame f is at f/30 s. */
static void a_clip_moves_what_follows_its_node_and_repeats(void **state)
{
    (void)state;
    static const uint64_t rounds[] = {0, 60, 60ULL * 71582788, (1ULL << 36) / 60 * 60 - 60};
    const struct animation_stage *const s = begin(&scene);
    for (size_t i = 0; i < sizeof rounds / sizeof rounds[0]; i++) {
        for (uint32_t frame = 0; frame < 60; frame++) {
            const double z = frame < 30 ? 3 * frame / 30.0 : 3 - 2 * (frame - 30) / 30.0;
            animation_move(s, NULL, rounds[i] + frame);
            const struct fx_vec3 p = s->meshes[2].positions[0];
            assert_near(p.x / 65536.0, 2, 1e-4);
            assert_near(p.y / 65536.0, 2, 1e-4);
            assert_near(p.z / 65536.0, -2 + 5 + z, 3e-4);
        }
    }
}

/* A clip of seven seconds: 2^32 frames are no whole number of rounds, neither in seconds nor in frames. */
static void a_longer_clip_holds_its_last_key_and_repeats_too(void **state)
{
    (void)state;
    static const uint64_t rounds[] = {0, 210, 210ULL * 20452226, 210ULL * 40904451, (1ULL << 36) / 210 * 210 - 210};
    struct ph_clip seven = clip;
    struct animation longer = scene;
    seven.duration = 7 * FX_ONE;
    longer.clip = &seven;
    const struct animation_stage *const s = begin(&longer);
    for (size_t i = 0; i < sizeof rounds / sizeof rounds[0]; i++) {
        for (uint32_t frame = 0; frame < 210; frame += 13) {
            const double z = frame < 30 ? 3 * frame / 30.0 : frame < 60 ? 3 - 2 * (frame - 30) / 30.0 : 1;
            animation_move(s, NULL, rounds[i] + frame);
            assert_near(s->meshes[2].positions[0].z / 65536.0, -2 + 5 + z, 3e-4);
        }
    }
}

static void a_morph_target_is_added_by_its_own_weight(void **state)
{
    (void)state;
    const struct animation_stage *const s = begin(&scene);
    animation_move(s, NULL, 17); /* the clip does not reach its node */
    expect_at(&s->meshes[0], 0, 1 + 1 + 1, 0, 5 - 2);
    expect_at(&s->meshes[0], 1, .5 + 1, 1.5 - .5, 5 + .25 + .25);
    const int16_t(*const normals)[3] = s->meshes[0].normals;
    const double half = 16384 * 0.4472135955, whole = 16384 * 0.894427191; /* (0, 1/2, 1) of length one */
    assert_near(normals[0][1], half, 4);
    assert_near(normals[0][2], whole, 4);
    assert_near(normals[1][0], whole, 4);
    assert_near(normals[1][2], half, 4);
    assert_memory_equal(s->weights, rest_weights, sizeof rest_weights);
}

static void without_targets_for_normals_the_normals_stay(void **state)
{
    (void)state;
    struct animation_mesh mesh = moving[1];
    struct animation one = scene;
    mesh.morph.d_normals = NULL;
    one.meshes = &mesh;
    one.mesh_count = 1;
    const struct animation_stage *const s = begin(&one);
    animation_move(s, NULL, 0);
    expect_at(&s->meshes[0], 0, 3, 0, 3);
    assert_near(s->meshes[0].normals[0][2], 16384, 2);
    assert_near(s->meshes[0].normals[1][0], 16384, 2);
}

static void without_a_clip_it_rests(void **state)
{
    (void)state;
    struct animation still = scene;
    still.clip = NULL;
    const struct animation_stage *const s = begin(&still);
    for (uint32_t frame = 0; frame < 60; frame += 29) {
        animation_move(s, NULL, frame);
        expect_at(&s->meshes[2], 0, 2, 2, 3);
    }
}

static void a_clip_of_no_length_stands(void **state)
{
    (void)state;
    const struct ph_clip moment = {.tracks = &track, .track_count = 1, .duration = 0};
    struct animation still = scene;
    still.clip = &moment;
    const struct animation_stage *const s = begin(&still);
    animation_move(s, NULL, 12345);
    expect_at(&s->meshes[2], 0, 2, 2, 3);
}

/* ---- several clips ----------------------------------------------------------------------------------------------- */

/* Clips of one key: at z = 0, 1 and 2; the second lasts 2 s and goes on to z = 3, and has half of the first weight,
 * too. */
static const int16_t stands[][3] = {{0, 8192, 0}, {0, 8192, 4096}, {0, 8192, 12288}, {0, 8192, 8192}};
static const int16_t halves[] = {4096, 4096};
static const fx_t ends[] = {0, 2 * FX_ONE};
#define PLACE(count, from)                                                                                             \
    {                                                                                                                  \
        1, PH_PATH_TRANSLATION, PH_KEYS_LINEAR, 3, 12, count, ends, stands[from]                                       \
    }
static const struct ph_track stand_tracks[] = {
    PLACE(1, 0), PLACE(2, 1), {0, PH_PATH_WEIGHTS, PH_KEYS_LINEAR, 1, 13, 2, ends, halves}, PLACE(1, 3)};
static const struct ph_clip three[] = {{"low", stand_tracks, 1, FX_ONE},
                                       {"rises", stand_tracks + 1, 2, 2 * FX_ONE},
                                       {"high", stand_tracks + 3, 1, FX_ONE}};

static struct demo_context selects = {.width = 1};

static struct animation_stage *begin_three(struct animation *a, uint32_t first, fx_t fade)
{
    *a = scene;
    a->clip = &three[first];
    a->clips = three;
    a->clip_count = 3;
    a->cross_fade = fade;
    struct animation_stage *const s = begin(a);
    selects.state = s;
    selects.clip = NULL;
    return s;
}

static double z_at(struct animation_stage *s, double seconds)
{
    const struct demo_clock clock = {.seconds = (uint32_t)seconds,
                                     .part = (uint16_t)((seconds - (uint32_t)seconds) * 65536)};
    if (s->starts) { /* as a frame does */
        s->layers[s->layer_count - 1].since = clock;
        s->starts = false;
    }
    animation_move_at(s, NULL, clock);
    return s->pose[1].t.z / (double)ONE_Q24;
}

static void select_goes_through_all_clips_and_ends_before_the_first(void **state)
{
    (void)state;
    struct animation a;
    for (uint32_t first = 0; first < 3; first++) {
        begin_three(&a, first, FX_ONE);
        for (uint32_t i = 1; i < 3; i++) {
            assert_true(animation_select(&selects));
            assert_string_equal(selects.clip, three[(first + i) % 3].name);
        }
        assert_false(animation_select(&selects));
        assert_false(animation_select(&selects));
    }
    selects.state = begin(&scene);
    assert_false(animation_select(&selects)); /* its clip plays alone */
}

/* A fade of half a second; the clip that comes plays from its beginning, while it fades in. */
static void a_clip_fades_in_from_its_beginning(void **state)
{
    (void)state;
    struct animation a;
    struct animation_stage *const s = begin_three(&a, 0, FX_HALF);
    assert_near(z_at(s, 7), 0, 1e-4);
    assert_true(animation_select(&selects));
    assert_near(z_at(s, 7.25), 0, 1e-4);
    assert_int_equal(s->weights[0], 7 * ONE_Q24);
    assert_near(z_at(s, 7.5), .5 * (1 + .25), 1e-3);
    assert_near(s->weights[0] / (double)ONE_Q24, 7 - .5 * 6.5, 1e-3);
    assert_near(s->weights[1] / (double)ONE_Q24, .5, 1e-6);
    assert_near(z_at(s, 7.625), .75 * (1 + .375), 1e-3);
    assert_near(z_at(s, 7.75), 1.5, 1e-3);
    assert_near(z_at(s, 8.75), 2.5, 1e-3);
    assert_near(z_at(s, 9.75), 1.5, 1e-3); /* it repeats */
    assert_near(s->weights[0] / (double)ONE_Q24, .5, 1e-6);
    assert_near(z_at(s, 7.5), .5 * (1 + .25), 1e-3); /* a frame may come again */
    assert_near(z_at(s, 1), 0, 1e-4);                /* or one before it */
}

static void without_a_fade_the_next_clip_is_there_at_once(void **state)
{
    (void)state;
    struct animation a;
    struct animation_stage *const s = begin_three(&a, 0, 0);
    assert_near(z_at(s, 3), 0, 1e-4);
    assert_true(animation_select(&selects));
    assert_near(z_at(s, 3.5), 1, 1e-4);
}

/* A fade longer than 2^15 / 2^16 s, of which the share is divided by more than 16 bits. */
static void a_long_fade_takes_its_time(void **state)
{
    (void)state;
    struct animation a;
    struct animation_stage *const s = begin_three(&a, 1, 20 * FX_ONE);
    z_at(s, 0);
    assert_true(animation_select(&selects));
    z_at(s, 4);
    assert_near(z_at(s, 8), .8 * 1 + .2 * 2, 1e-3);
    assert_near(z_at(s, 22), .1 * 1 + .9 * 2, 1e-3);
    assert_near(z_at(s, 23.5), .025 * 2.5 + .975 * 2, 1e-3);
    assert_near(z_at(s, 24), 2, 1e-3);
    assert_near(z_at(s, 70000), 2, 1e-3);
}

/* Nothing leaps where a clip is chosen while another one still fades in; what a press passes over is not seen. */
static void a_second_press_fades_on_from_where_it_is(void **state)
{
    (void)state;
    struct animation a;
    struct animation_stage *s = begin_three(&a, 0, FX_ONE);
    z_at(s, 0);
    assert_true(animation_select(&selects));
    z_at(s, 10);
    const double before = z_at(s, 10.5);
    assert_true(animation_select(&selects));
    assert_near(z_at(s, 10.5), before, 1e-4);
    assert_near(z_at(s, 10.75), .75 * (.75 * 1.75) + .25 * 2, 1e-3);
    assert_near(z_at(s, 11.25), .25 * 2.25 + .75 * 2, 1e-3);
    assert_near(z_at(s, 11.5), 2, 1e-3);
    s = begin_three(&a, 0, FX_ONE);
    assert_true(animation_select(&selects) && animation_select(&selects)); /* before a frame */
    z_at(s, 20);
    assert_near(z_at(s, 20.25), .25 * 2, 1e-3);
}

/* A fourth clip within one fade: the first one no longer shows, the others do. */
static void the_oldest_of_four_clips_is_gone(void **state)
{
    static const struct ph_clip four[] = {{"a", stand_tracks, 1, FX_ONE},
                                          {"b", stand_tracks + 3, 1, FX_ONE},
                                          {"c", stand_tracks, 1, FX_ONE},
                                          {"d", stand_tracks + 3, 1, FX_ONE}};
    (void)state;
    struct animation a;
    begin_three(&a, 0, FX_ONE);
    a.clip = a.clips = four;
    a.clip_count = 4;
    struct animation_stage *const s = begin(&a);
    selects.state = s;
    for (uint32_t i = 0; i < 3; i++) {
        assert_true(animation_select(&selects));
        z_at(s, 5 + .25 * i);
    }
    assert_near(z_at(s, 5.75), 2 * .5 * .75 + 2 * .25, 1e-3);
    assert_near(z_at(s, 6.5), 2, 1e-3);
}

/* ---- as a demo --------------------------------------------------------------------------------------------------- */

static const struct animation nodes_alone = {
    .rig = {nodes, 2},
    .root = {{{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}}, {0, 0, 0}},
    .clip = &clip};

static int cube_init(struct demo_context *context)
{
    struct ph_mesh *const mesh = demo_alloc(&context->arena, sizeof *mesh);
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xffff};
    assert_int_equal(model_cube(&context->arena, mesh), PH_OK);
    assert_int_equal(model_material(&context->arena, mesh, &material), PH_OK);
    return animation_init(context, &nodes_alone, mesh, 1, NULL);
}

static const struct demo cube = {.name = "a cube",
                                 .loop_frames = 256,
                                 .arena_bytes = 16384,
                                 .vertex_max = 24 + DEMO_TURNTABLE_VERTICES,
                                 .triangle_max = 12 + DEMO_TURNTABLE_TRIANGLES,
                                 .init = cube_init,
                                 .frame = animation_frame};

/* 2^32 frames are 16 frames more than a whole number of rounds of 60. */
static void expect_round(struct demo_stage *s, uint32_t frame, uint32_t wraps)
{
    demo_stage_frame(s, frame);
    const struct animation_stage *const stage = s->context.state;
    const uint32_t in_clip = (uint32_t)((frame % 60 + wraps * 16ULL) % 60);
    const double z = in_clip < 30 ? 3 * in_clip / 30.0 : 3 - 2 * (in_clip - 30) / 30.0;
    assert_near(stage->pose[1].t.z / (double)ONE_Q24, z, 4e-4);
}

static void frames_go_on_where_their_count_begins_anew(void **state)
{
    (void)state;
    static const struct {
        uint32_t frame, wraps;
    } steps[] = {{0, 0},          {0xFFFFFFFF, 0}, /* back from the first frame there is nothing */
                 {0, 1},          {0xFFFFFFFF, 0}, {5, 1},          {0x40000000, 1}, {0x80000000, 1},
                 {3, 1}, /* a jump of half of the count */
                 {0xBFFFFFFF, 1}, {7, 1},          {0x7FFFFFFF, 1}, {0xC0000000, 1}, {0x3FFFFFFF, 2},
                 {0xC0000001, 1}, {0x40000000, 1}, {0xC0000000, 1}, {0xFFFFFFF0, 1}, {20, 2}};
    struct demo_stage s = demo_stage_open(&cube, 32, 32);
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        expect_round(&s, steps[i].frame, steps[i].wraps);
    }
    demo_stage_close(&s);
}

/* Frame 90 is at 3 s, where the clip that begins has its first key; with a fade of one second. */
static void a_clip_that_is_selected_begins_with_the_next_frame(void **state)
{
    (void)state;
    static const struct ph_clip two[] = {{"low", stand_tracks, 1, FX_ONE}, {"rises", stand_tracks + 1, 1, 2 * FX_ONE}};
    static const struct animation both = {
        .rig = {nodes, 2}, .clip = two, .clips = two, .clip_count = 2, .cross_fade = FX_ONE};
    struct demo_stage s = demo_stage_open(&cube, 32, 32);
    struct animation_stage *const stage = s.context.state;
    stage->animation = &both;
    stage->layers[0].clip = two;
    struct ph_pose next[2];
    stage->next_pose = next;
    demo_stage_frame(&s, 80);
    assert_true(animation_select(&s.context));
    demo_stage_frame(&s, 90);
    assert_near(stage->pose[1].t.z / (double)ONE_Q24, 0, 1e-4);
    demo_stage_frame(&s, 105);
    assert_near(stage->pose[1].t.z / (double)ONE_Q24, .5 * 1.5, 1e-3);
    demo_stage_frame(&s, 135);
    assert_near(stage->pose[1].t.z / (double)ONE_Q24, 2.5, 1e-3);
    demo_stage_close(&s);
}

/* ---- in turn ----------------------------------------------------------------------------------------------------- */

static void a_round_ends_when_the_last_clip_begins_to_end(void **state)
{
    (void)state;
    struct animation a = {.clips = three, .clip_count = 3, .cross_fade = FX_ONE / 4};
    assert_int_equal(animation_round(&a), 3 * FX_ONE + FX_ONE / 4);
    a.cross_fade = 0;
    assert_int_equal(animation_round(&a), 4 * FX_ONE);
    a.cross_fade = FX_ONE - 1; /* the first and the last are shorter than two fades */
    assert_int_equal(animation_round(&a), 3 * (FX_ONE - 1) + 2);
    a.cross_fade = INT32_MAX;
    assert_int_equal(animation_round(&a), INT32_MAX);
}

/* A frame is 1/8 s, and a fade takes two. In a round of 26 frames the clips begin in frames 0, 6 and 20; within a fade
 * the clip before plays on, and half of each shows in its second frame. */
static double z_in_turn(uint32_t frame)
{
    const uint32_t f = frame % 26;
    return frame < 6 ? 0
           : f == 0  ? 2
           : f == 1  ? 1
           : f < 7   ? 0
           : f == 7  ? .5 * 1.125
           : f < 21  ? 1 + (f - 6) / 8.
           : f == 21 ? .5 * (2.875 + 2)
                     : 2;
}

static struct demo_stage open_in_turn(const struct animation *a, struct ph_pose next[2])
{
    struct demo_stage s = demo_stage_open(&cube, 32, 32);
    struct animation_stage *const stage = s.context.state;
    stage->animation = a;
    stage->next_pose = next;
    s.context.clip_fps = 8;
    return s;
}

static double z_of_frame(struct demo_stage *s, uint32_t frame)
{
    demo_stage_frame(s, frame);
    const struct animation_stage *const stage = s->context.state;
    return stage->pose[1].t.z / (double)ONE_Q24;
}

static void clips_in_turn_fade_into_each_other_while_they_end(void **state)
{
    static const struct ph_clip places_alone[] = {{"low", stand_tracks, 1, FX_ONE},
                                                  {"rises", stand_tracks + 1, 1, 2 * FX_ONE},
                                                  {"high", stand_tracks + 3, 1, FX_ONE}};
    (void)state;
    const struct animation a = {.rig = {nodes, 2},
                                .clip = &places_alone[1],
                                .clips = places_alone,
                                .clip_count = 3,
                                .cross_fade = FX_ONE / 4,
                                .in_turn = true};
    struct ph_pose next[2];
    struct demo_stage s = open_in_turn(&a, next);
    for (uint32_t i = 0; i < 80; i++) {
        const uint32_t frame = i * 37 % 80; /* in any order */
        assert_near(z_of_frame(&s, frame), z_in_turn(frame), 1e-3);
        const uint32_t late = 26u * 123456789 + frame;
        assert_near(z_of_frame(&s, late), z_in_turn(late), 1e-3);
    }
    assert_false(animation_select(&s.context));
    assert_null(s.context.clip);
    demo_stage_close(&s);
}

/* Clips of no length show for as long as a fade takes; without fades the last of them shows. */
static void clips_of_no_length_take_turns_too(void **state)
{
    static const struct ph_clip two[] = {{"low", stand_tracks, 1, 0}, {"high", stand_tracks + 3, 1, 0}};
    (void)state;
    struct animation a = {
        .rig = {nodes, 2}, .clip = two, .clips = two, .clip_count = 2, .cross_fade = FX_ONE / 2, .in_turn = true};
    struct ph_pose next[2];
    struct demo_stage s = open_in_turn(&a, next);
    for (uint32_t frame = 0; frame < 40; frame++) {
        const uint32_t f = frame % 8;
        assert_near(z_of_frame(&s, frame), frame < 4 ? 0 : f < 4 ? 2 - f / 2. : (f - 4) / 2., 1e-3);
    }
    a.cross_fade = 0;
    assert_near(z_of_frame(&s, 0), 2, 1e-3);
    assert_near(z_of_frame(&s, 33), 2, 1e-3);
    demo_stage_close(&s);
}

/* A stage of one clip has no room for the pose of another. */
static void one_clip_has_none_to_take_turns_with(void **state)
{
    (void)state;
    const struct animation a = {
        .rig = {nodes, 2}, .clip = &clip, .clips = &clip, .clip_count = 1, .cross_fade = FX_ONE / 4, .in_turn = true};
    struct demo_stage s = open_in_turn(&a, NULL);
    assert_near(z_of_frame(&s, 4), 1.5, 1e-3);
    assert_near(z_of_frame(&s, 15), 1.25, 1e-3);
    assert_near(z_of_frame(&s, 20), 1.5, 1e-3);
    demo_stage_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_meshes_need_together_is_what_the_largest_of_them_needs),
        cmocka_unit_test(without_targets_for_normals_no_room_is_needed_for_them),
        cmocka_unit_test(what_an_animation_needs_is_what_its_meshes_need),
        cmocka_unit_test(it_takes_the_bytes_that_it_says_and_does_without_none),
        cmocka_unit_test(a_32_bit_target_takes_less_for_pointers),
        cmocka_unit_test(vertices_begin_in_the_bind_pose_with_any_fraction),
        cmocka_unit_test(a_clip_moves_what_follows_its_node_and_repeats),
        cmocka_unit_test(a_longer_clip_holds_its_last_key_and_repeats_too),
        cmocka_unit_test(a_morph_target_is_added_by_its_own_weight),
        cmocka_unit_test(without_targets_for_normals_the_normals_stay),
        cmocka_unit_test(without_a_clip_it_rests),
        cmocka_unit_test(a_clip_of_no_length_stands),
        cmocka_unit_test(select_goes_through_all_clips_and_ends_before_the_first),
        cmocka_unit_test(a_clip_fades_in_from_its_beginning),
        cmocka_unit_test(without_a_fade_the_next_clip_is_there_at_once),
        cmocka_unit_test(a_long_fade_takes_its_time),
        cmocka_unit_test(a_second_press_fades_on_from_where_it_is),
        cmocka_unit_test(the_oldest_of_four_clips_is_gone),
        cmocka_unit_test(a_round_ends_when_the_last_clip_begins_to_end),
        cmocka_unit_test(clips_in_turn_fade_into_each_other_while_they_end),
        cmocka_unit_test(clips_of_no_length_take_turns_too),
        cmocka_unit_test(one_clip_has_none_to_take_turns_with),
        cmocka_unit_test(a_clip_that_is_selected_begins_with_the_next_frame),
        cmocka_unit_test(frames_go_on_where_their_count_begins_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
