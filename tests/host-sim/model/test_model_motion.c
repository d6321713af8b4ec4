/* model_motion: the clip that a name chooses, what is said where there is none, and which animation moves a mesh. */
#include "complain.h"
#include "model.h"
#include "scene_file.h"
#include "stderr_capture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static struct ph_clip clips[4];
static const struct animation_mesh meshes[] = {{.mesh = 4}, {.mesh = 0}, {.mesh = 7}};
static struct model_motion motion;
static struct model model;

static int fresh(void **state)
{
    static const struct ph_clip of_file[] = {{.name = "walk", .duration = FX_ONE},
                                             {.name = "run", .duration = 2 * FX_ONE},
                                             {.name = "jump", .duration = 4 * FX_ONE},
                                             {.name = "run", .duration = 8 * FX_ONE}};
    (void)state;
    memcpy(clips, of_file, sizeof clips);
    motion = (struct model_motion){
        .animation = {.clip = &clips[2], .clips = clips, .clip_count = 3, .meshes = meshes, .mesh_count = 2}};
    model = (struct model){.motion = &motion};
    return 0;
}

static void a_name_chooses_the_clip(void **state)
{
    (void)state;
    assert_int_equal(model_play(&model, NULL), 0);
    assert_ptr_equal(motion.animation.clip, &clips[2]);
    assert_int_equal(model_play(&model, "walk"), 0);
    assert_ptr_equal(motion.animation.clip, &clips[0]);
    motion.animation.clip_count = 4;
    assert_int_equal(model_play(&model, "run"), 0);
    assert_ptr_equal(motion.animation.clip, &clips[1]);
}

static void check_refusal(const char *name, const char *line)
{
    struct stderr_capture said;
    stderr_capture_begin(&said);
    const int status = model_play(&model, name);
    stderr_capture_end(&said);
    assert_int_equal(status, PH_ERR_INVAL);
    assert_int_equal(stderr_capture_lines(&said), 1);
    assert_non_null(strstr(said.text, line));
}

static void a_name_that_is_not_there_is_told_with_those_that_are(void **state)
{
    (void)state;
    check_refusal("wall", "--clip 'wall': the model has no such clip; did you mean walk? it has walk, run, jump");
    check_refusal("", "--clip '': the model has no such clip; it has walk, run, jump");
    assert_ptr_equal(motion.animation.clip, &clips[2]);
    motion.animation.clip_count = 0;
    check_refusal("walk", "--clip 'walk': the model has no such clip; it has none");
    model.motion = NULL;
    check_refusal("walk", "the model has no such clip; it has none");
    assert_int_equal(model_play(&model, NULL), 0);
}

static void names_with_commas_keep_their_clips_alone_in_turn(void **state)
{
    (void)state;
    motion.animation.clip_count = 4;
    assert_int_equal(model_play(&model, "jump,walk,run"), 0);
    assert_true(motion.animation.in_turn && motion.animation.clip_count == 3 && motion.animation.clip == clips);
    assert_string_equal(clips[0].name, "jump");
    assert_string_equal(clips[1].name, "walk");
    assert_true(clips[0].duration == 4 * FX_ONE && clips[1].duration == FX_ONE);
    assert_int_equal(model_clip_frames(&model), 30 * (4 + 1 + clips[2].duration / FX_ONE)); /* either `run` */
    assert_int_equal(model_play(&model, "walk"), 0);
    assert_true(!motion.animation.in_turn && motion.animation.clip_count == 3 && motion.animation.clip == &clips[1]);
}

/* A clip of that very name is meant by a name with a comma, before those of its parts. */
static void a_name_may_have_a_comma(void **state)
{
    (void)state;
    clips[2].name = "walk,run";
    assert_int_equal(model_play(&model, "walk,run"), 0);
    assert_true(!motion.animation.in_turn && motion.animation.clip == &clips[2]);
}

static void a_wrong_name_of_several_is_told_alone(void **state)
{
    (void)state;
    check_refusal("walk,runn", "--clip 'runn': the model has no such clip; did you mean run? it has walk, run, jump");
    check_refusal("ru,walk", "--clip 'ru': the model has no such clip; did you mean run? it has walk, run, jump");
    check_refusal("walk,", "--clip '': the model has no such clip; it has");
    check_refusal("run,run", "--clip 'run,run': names 'run' twice");
    assert_false(motion.animation.in_turn);
    model.motion = NULL;
    check_refusal("walk,run", "--clip 'walk': the model has no such clip; it has none");
}

/* A list has room for 199 letters. */
static void a_long_list_is_cut(void **state)
{
    char name[201], line[220];
    const struct ph_clip two[] = {{.name = name}, {.name = "n"}};
    (void)state;
    memset(name, 'n', 200), name[200] = 0;
    snprintf(line, sizeof line, "it has %.199s\n", name);
    motion.animation.clips = two, motion.animation.clip_count = 2;
    check_refusal("walk", line);
    name[100] = 0;
    snprintf(line, sizeof line, "it has %s, n\n", name);
    check_refusal("walk", line);
    memset(name, 'n', 198), name[198] = 0;
    snprintf(line, sizeof line, "it has %s,\n", name);
    check_refusal("walk", line);
    name[1] = 0, motion.animation.clip_count = 1;
    check_refusal("walk", "it has n\n");
}

/* A binary scene keeps which clips play in its own bytes, behind the head. */
static void a_binary_scene_is_told_which_clips_play(void **state)
{
    static struct {
        struct scene_file_head head;
        struct scene_file_motion motion;
        struct scene_file_clip clips[3];
    } file;
    file.head.motion = (uint32_t)((char *)&file.motion - (char *)&file);
    file.motion.clips = (uint32_t)((char *)file.clips - (char *)&file);
    file.motion.clip_count = 3;
    (void)state;
    for (uint32_t i = 0; i < 3; i++) {
        strcpy(file.clips[i].name, clips[i].name);
        file.clips[i].duration = clips[i].duration;
        clips[i].name = file.clips[i].name;
    }
    model.scene = &file;
    assert_int_equal(model_play(&model, "run"), 0);
    assert_true(file.motion.playing == 1 && file.motion.clip_count == 3 && file.head.flags == 0);
    check_refusal("hop", "no such clip");
    assert_int_equal(file.motion.playing, 1);
    file.head.flags = SCENE_FILE_CAMERA;
    assert_int_equal(model_play(&model, "jump,walk"), 0);
    assert_true(file.motion.playing == 0 && file.motion.clip_count == 2);
    assert_int_equal(file.head.flags, SCENE_FILE_CAMERA | SCENE_FILE_IN_TURN);
    static const char *const order[] = {"jump", "walk"};
    for (uint32_t i = 0; i < 2; i++) {
        assert_string_equal(file.clips[i].name, order[i]);
        assert_string_equal(clips[i].name, order[i]);
        assert_int_equal(file.clips[i].duration, clips[i].duration);
    }
    assert_int_equal(clips[0].duration, 4 * FX_ONE);
    assert_int_equal(model_play(&model, "walk"), 0);
    assert_true(file.motion.playing == 1 && file.motion.clip_count == 2 && file.head.flags == SCENE_FILE_CAMERA);
}

static void a_mesh_moves_if_the_animation_names_it(void **state)
{
    (void)state;
    assert_ptr_equal(model_moving(&model, 4), &meshes[0]);
    assert_ptr_equal(model_moving(&model, 0), &meshes[1]);
    assert_null(model_moving(&model, 1));
    assert_null(model_moving(&model, 7)); /* behind the last */
    model.motion = NULL;
    assert_null(model_moving(&model, 4));
}

static void a_clip_has_thirty_frames_a_second(void **state)
{
    const struct ph_clip clip = {.duration = FX_ONE * 5 / 2 - 1};
    (void)state;
    assert_int_equal(model_clip_frames(&model), 120);
    motion.animation.clip = &clip;
    assert_int_equal(model_clip_frames(&model), 74); /* 2.5 seconds less 2^-16 */
    motion.animation.clip = NULL;
    assert_int_equal(model_clip_frames(&model), 0);
    model.motion = NULL;
    assert_int_equal(model_clip_frames(&model), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_name_chooses_the_clip, fresh),
        cmocka_unit_test_setup(a_name_that_is_not_there_is_told_with_those_that_are, fresh),
        cmocka_unit_test_setup(a_long_list_is_cut, fresh),
        cmocka_unit_test_setup(names_with_commas_keep_their_clips_alone_in_turn, fresh),
        cmocka_unit_test_setup(a_name_may_have_a_comma, fresh),
        cmocka_unit_test_setup(a_wrong_name_of_several_is_told_alone, fresh),
        cmocka_unit_test_setup(a_binary_scene_is_told_which_clips_play, fresh),
        cmocka_unit_test_setup(a_mesh_moves_if_the_animation_names_it, fresh),
        cmocka_unit_test_setup(a_clip_has_thirty_frames_a_second, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
