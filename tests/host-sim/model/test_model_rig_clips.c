/* model_rig_clips: keys as 16-bit numbers with the most bits of fraction, times in steps of 2^(shift - 16) s, tangents
 * times the time between their keys. The numbers were worked out by hand. */
#include "model_rig_clips.h"
#include "model_rig_nodes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static uint8_t memory[1 << 14];
static struct model_shared shared;
static struct model_motion motion;
static struct model_scene scene;
static struct model_rig rig;
static const struct ph_clip *clip;

/* Node 1 has no parent; node 0 is its child. */
static struct model_node nodes[2] = {{.parent = 1}, {.parent = MODEL_NONE}};
static double ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};
static struct model_rig_node rig_nodes[2] = {
    {.length = {64, 64, 64}, .most_weights = ones, .number = 5, .first_weight = 9},
    {.length = {8, 8, 8}, .most_weights = ones, .number = 3, .first_weight = 2}};
static const struct model_fit fit = {.scale = .5};

static bool make(struct model_clip *clips, uint32_t n)
{
    memset(&shared, 0, sizeof shared);
    memset(&motion, 0, sizeof motion);
    scene = (struct model_scene){.nodes = nodes, .clips = clips, .node_count = 2, .clip_count = n};
    rig = (struct model_rig){.scene = &scene, .nodes = rig_nodes};
    shared.rig = &rig;
    shared.model.motion = &motion;
    shared.arena = (struct demo_arena){.base = memory, .size = sizeof memory};
    const bool done = model_rig_clips_make(&shared, &motion, &fit);
    clip = motion.animation.clips;
    return done;
}

/* Makes a clip of one track; the numbers are copied, because they are changed. */
static const struct ph_track *make_one(struct model_track track, const float *numbers, size_t n)
{
    static float copy[64];
    memcpy(copy, numbers, n * sizeof *copy);
    track.numbers = copy;
    struct model_clip one = {.tracks = &track, .count = 1};
    assert_true(make(&one, 1));
    assert_int_equal(clip->track_count, 1);
    assert_int_equal(clip->tracks->width, track.width);
    assert_int_equal(clip->tracks->key_count, track.keys);
    assert_int_equal(clip->tracks->path, track.path);
    assert_int_equal(clip->tracks->interpolation, track.interpolation);
    return clip->tracks;
}

static float half[2] = {0, .5f};

/* The unit is a half; a child's is its parent's length, 4. Scales are divided by what became length. */
static void numbers_are_in_the_units_of_the_model(void **state)
{
    static const struct {
        uint8_t path, node;
        uint32_t width;
        float numbers[8];
        int number, frac;
        double keys[8];
    } cases[] = {
        {PH_PATH_TRANSLATION, 1, 3, {1, -2, .25f, 3, 0, 0}, 3, 14, {.5, -1, .125, 1.5}},
        {PH_PATH_TRANSLATION, 0, 3, {1, 0, -.5f, 0, 2, 0}, 5, 11, {4, 0, -2, 0, 8}},
        {PH_PATH_SCALE, 1, 3, {8, 1, 1, 1, 2, 4}, 3, 14, {1, .125, .125, .125, .25, .5}}, /* .5 / 4 */
        {PH_PATH_SCALE, 0, 3, {8, 8, 16, 8, 8, 8}, 5, 13, {1, 1, 2, 1, 1, 1}},            /* 4 / 32 */
        {PH_PATH_WEIGHTS, 0, 2, {1, 0, 0, .5f}, 9, 14, {1, 0, 0, .5}},
        {PH_PATH_WEIGHTS, 1, 1, {0, .25f}, 2, 16, {0, .25}},
        {PH_PATH_WEIGHTS, 1, 1, {0, 0}, 2, 24, {0, 0}},
        {PH_PATH_WEIGHTS, 1, 1, {0, 32767 / 65536.f}, 2, 16, {0, 32767 / 65536.}},
        {PH_PATH_WEIGHTS, 1, 1, {0, 65534 / 65536.f}, 2, 15, {0, 65534 / 65536.}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct ph_track *t = make_one((struct model_track){.node = cases[i].node,
                                                                 .path = cases[i].path,
                                                                 .interpolation = PH_KEYS_LINEAR,
                                                                 .times = half,
                                                                 .keys = 2,
                                                                 .width = cases[i].width},
                                            cases[i].numbers, 8);
        assert_true(t->node == cases[i].number && t->frac == cases[i].frac);
        for (uint32_t k = 0; k < 2 * cases[i].width; k++) {
            assert_true(t->keys[k] == cases[i].keys[k] * (1 << cases[i].frac));
        }
        assert_true(motion.rounding.translation == 0 && motion.rounding.scale == 0 && motion.rounding.weight == 0);
        assert_true(motion.rounding.rotation == 0);
    }
}

/* Translations count from the middle of the model where a node stands in no other, and weights as shares of the
 * largest. 120 times the unit has room. */
static void what_has_no_room_is_refused(void **state)
{
    static const float away[6] = {0, -240, 0, 0, 0, 240}, further[6] = {0, -240, 0, 0, 0, 240.5f};
    struct model_track track = {.node = 1, .path = PH_PATH_TRANSLATION, .times = half, .keys = 2, .width = 3};
    float copy[6];
    (void)state;
    assert_int_equal(make_one(track, away, 6)->keys[1], -120 * 256);
    memcpy(copy, further, sizeof copy);
    track.numbers = copy;
    assert_false(make(&(struct model_clip){.tracks = &track, .count = 1}, 1));
    assert_string_equal(shared.error,
                        "cannot be shown: a clip has a translation in radii of the model of 120.2 at node "
                        "1, and at most 120 is possible");
}

/* Numbers of .6 and .8 become shares of the greatest, which is 32767; its sign does not matter. */
static void rotations_use_all_bits(void **state)
{
    static const float q[8] = {0, 0, .6f, .8f, 0, -.05f, 0, .1f};
    static const int keys[8] = {0, 0, 24575, 32767, 0, -2048, 0, 4096};
    (void)state;
    const struct ph_track *t =
        make_one((struct model_track){.path = PH_PATH_ROTATION, .times = half, .keys = 2, .width = 4}, q, 8);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(t->keys[i], keys[i]);
    }
    assert_int_equal(t->node, 5);
    const double off = 2 * (atan2(.6, .8) - atan2(24575, 32767)), off_y = 2 * (atan2(.05, .1) - atan2(2048, 4096));
    assert_true(fabs(motion.rounding.rotation - fmax(fabs(off), fabs(off_y)) * 180 / 3.14159265358979) < 2e-5);
    assert_true(motion.rounding.rotation > 4e-4);
}

/* Keys at 0, 1 and 3 s: the tangents before and behind them are multiplied by 1 and by 2 s; those outside are nothing.
 */
static void tangents_are_multiplied_by_the_time_between_keys(void **state)
{
    static float times[3] = {0, 1, 3};
    static const float numbers[18] = {1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6};
    static const double keys[18] = {0, 0, 3, 4, 5, 6, 1, 2, 3, 4, 10, 12, 2, 4, 3, 4, 0, 0};
    (void)state;
    const struct ph_track *t = make_one(
        (struct model_track){
            .path = PH_PATH_WEIGHTS, .interpolation = PH_KEYS_CUBIC, .times = times, .keys = 3, .width = 2},
        numbers, 18);
    assert_int_equal(t->frac, 11); /* 12 * 2^11 = 24576 */
    for (int i = 0; i < 18; i++) {
        assert_true(t->keys[i] == keys[i] * 2048);
    }
}

static void times_count_steps_of_16_bits_of_a_second(void **state)
{
    static const struct {
        float times[3];
        uint32_t duration;
        int steps[3];
        double error;
    } cases[] = {{{0, .25f, .5f}, 32768, {0, 16384, 32768}, 0},
                 {{0, 1 / 65536.f, 1}, 65536, {0, 1, 65536}, 0},
                 {{-1, 3 / 65536.f, 3}, 196608, {0, 3, 196608}, 1},
                 {{0, 5 / 262144.f, 1000}, 65536000, {0, 1, 65536000}, 1 / 262144.},
                 {{0, 4, 40000}, 2147418112, {0, 262144, 2147418112}, 40000 - 32767}};
    static const float numbers[3] = {1, 2, 3};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        float times[3];
        memcpy(times, cases[i].times, sizeof times);
        const struct ph_track *t =
            make_one((struct model_track){.path = PH_PATH_WEIGHTS, .times = times, .keys = 3, .width = 1}, numbers, 3);
        assert_int_equal(clip->duration, cases[i].duration);
        for (int k = 0; k < 3; k++) {
            assert_int_equal(t->times[k], cases[i].steps[k]);
        }
        assert_true(motion.rounding.time == cases[i].error);
    }
}

/* A third has 16 bits of fraction, and is a third of their last one off. */
static void the_greatest_error_of_each_property_is_kept(void **state)
{
    static const float third[6] = {0, 1 / 3.f, 0, .125f, 0, 0}, cubic[9] = {1 / 3.f, .25f, 1 / 3.f, 0, .25f, 0};
    struct model_track t = {.node = 1, .times = half, .keys = 2, .width = 3};
    (void)state;
    t.path = PH_PATH_SCALE; /* times an eighth: 19 bits */
    make_one(t, third, 6);
    assert_true(fabs(motion.rounding.scale * (1 << 19) - 1 / 3.) < .01 && motion.rounding.translation == 0);
    assert_true(motion.rounding.rotation == 0);
    t.path = PH_PATH_TRANSLATION; /* a half: 17 bits */
    make_one(t, third, 6);
    assert_true(fabs(motion.rounding.translation * (1 << 17) - 1 / 3.) < .01 && motion.rounding.weight == 0);
    t.path = PH_PATH_WEIGHTS;
    make_one(t, third, 6);
    assert_true(fabs(motion.rounding.weight * (1 << 16) - 1 / 3.) < .01 && motion.rounding.scale == 0);
    t.width = 1;
    make_one(t, third + 1, 2);
    assert_true(fabs(motion.rounding.weight * (1 << 16) - 1 / 3.) < .01);
    t.interpolation = PH_KEYS_CUBIC, t.width = 1; /* tangents do not count */
    make_one(t, cubic, 6);
    assert_true(motion.rounding.weight == 0);
}

static void clips_are_named_and_last_as_long_as_their_longest_track(void **state)
{
    static const float long_time[2] = {.125f, .25f};
    float numbers[16] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, .5f}, more[2] = {1, 1};
    struct model_track tracks[2] = {{.path = PH_PATH_WEIGHTS, .times = half, .numbers = numbers, .keys = 2, .width = 8},
                                    {.path = PH_PATH_WEIGHTS,
                                     .times = (float *)(void *)(uintptr_t)long_time,
                                     .numbers = more,
                                     .keys = 2,
                                     .width = 1}};
    struct model_clip clips[4] = {{.name = "walk", .tracks = tracks, .count = 2},
                                  {.name = NULL},
                                  {.name = "", .tracks = tracks + 1, .count = 1},
                                  {.name = "0123456789012345678901234567890123456789012345678901234567890123456789"}};
    (void)state;
    assert_true(make(clips, 4));
    assert_int_equal(motion.animation.clip_count, 4);
    assert_ptr_equal(motion.animation.clip, clip);
    assert_int_equal(motion.animation.cross_fade, FX_ONE / 4);
    shared.options.cross_fade_ms = 1500;
    assert_true(model_rig_clips_make(&shared, &motion, &fit));
    assert_int_equal(motion.animation.cross_fade, 3 * FX_HALF);
    assert_string_equal(clip[0].name, "walk");
    assert_string_equal(clip[1].name, "clip 1");
    assert_string_equal(clip[2].name, "clip 2");
    assert_string_equal(clip[3].name, "012345678901234567890123456789012345678901234567890123456789");
    assert_true(clip[0].track_count == 2 && clip[0].duration == 32768);
    assert_true(clip[1].track_count == 0 && clip[1].duration == 0);
    assert_true(clip[2].track_count == 1 && clip[2].duration == 16384);
    assert_int_equal(clip[0].tracks[1].times[0], 8192);
    clips[0].tracks[1].times = half;
    assert_true(make(clips, 4));
    assert_ptr_equal(clip[0].tracks[1].times, clip[0].tracks[0].times); /* they are the same */
    clips[0].tracks[1].keys = 1;
    assert_true(make(clips, 4));
    assert_ptr_not_equal(clip[0].tracks[1].times, clip[0].tracks[0].times);
    clips[0].tracks[1].keys = 2;
    clips[0].tracks[1].times = (float *)(void *)(uintptr_t)long_time;
    assert_int_equal(clip[0].tracks[0].keys[12], 16384); /* the next track does not lie on it */
    assert_int_equal(clip[0].tracks[0].keys[15], 8192);
    assert_true(make(clips, 3));
    const size_t used = shared.arena.used;
    for (size_t size = 0; size < used; size += 8) { /* the arena may end anywhere */
        memset(&motion, 0, sizeof motion);
        shared.arena = (struct demo_arena){.base = memory, .size = size};
        assert_false(model_rig_clips_make(&shared, &motion, &fit));
        assert_non_null(strstr(shared.error, "too much memory"));
    }
    assert_true(make(clips, 0));
    assert_true(motion.animation.clip_count == 0 && motion.animation.clip == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_in_the_units_of_the_model),
        cmocka_unit_test(what_has_no_room_is_refused),
        cmocka_unit_test(rotations_use_all_bits),
        cmocka_unit_test(tangents_are_multiplied_by_the_time_between_keys),
        cmocka_unit_test(times_count_steps_of_16_bits_of_a_second),
        cmocka_unit_test(the_greatest_error_of_each_property_is_kept),
        cmocka_unit_test(clips_are_named_and_last_as_long_as_their_longest_track),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
