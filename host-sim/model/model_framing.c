/* See model_framing.h. Draws the model in a small picture, and counts the pixels that are not background. */
#include "model_framing.h"

#include "model_stage.h"

#include <stdlib.h>

#define WIDTH           160
#define HEIGHT_LEAST    40 /* of a camera's picture, which has the shape that the camera says */
#define HEIGHT_MOST     320
#define LOOKS           8 /* frames that are drawn: of the clip, or of a turn */
#define CAMERA_LEAST    5 /* percent of the picture */
#define TURNTABLE_LEAST 1

static uint16_t height_of(const struct model *model)
{
    const int64_t x = model->camera.lens.scale_x_q20, y = model->camera.lens.scale_y_q20;
    const int64_t height = model->has_camera && x > 0 ? WIDTH * x / y : WIDTH * 3 / 4;
    return (uint16_t)(height < HEIGHT_LEAST ? HEIGHT_LEAST : height < HEIGHT_MOST ? height : HEIGHT_MOST);
}

/* Frames from one look to the next. */
static uint32_t step_of(const struct model *model)
{
    const uint32_t clip = model_clip_frames(model), turn = model->has_camera ? 0 : model_demo(model).loop_frames;
    return (clip > 0 ? clip : turn) / LOOKS;
}

/* The pixels of a frame that show the model; negative: an error. */
static int32_t count_covered(struct model_stage *s, uint32_t frame)
{
    const uint32_t pixels = (uint32_t)s->context.width * s->context.height;
    int32_t count = s->demo.frame(&s->context, &s->r, frame);
    if (count != 0) {
        return count;
    }
    ph_frame_bands(&s->r);
    demo_draw_band(&s->demo, &s->context, &s->r, 0, s->pixels);
    for (uint32_t i = 0; i < pixels; i++) {
        count += s->pixels[i] != DEMO_MODEL_BACKGROUND;
    }
    return count;
}

/* The most percent of a picture that show the model, in 1/100; negative: an error. */
static int32_t measure(struct model *model)
{
    struct model_stage stage;
    struct demo demo = model_demo(model);
    const uint16_t height = height_of(model);
    const struct model_stage_size size = {WIDTH, height, height, demo.triangle_max};
    const uint32_t step = step_of(model);
    demo.arena_bytes -= model->has_camera ? 0 : DEMO_TURNTABLE_BYTES - DEMO_TURNTABLE_BARE_BYTES; /* no platter */
    int32_t most = model_stage_open(&stage, &demo, model, &size);
    for (uint32_t look = 0; look < LOOKS && most >= 0 && (look == 0 || step > 0); look++) {
        const int32_t count = count_covered(&stage, look * step);
        most = count < 0 || count > most ? count : most;
    }
    free(stage.memory);
    return most > 0 ? (int32_t)((int64_t)most * 10000 / (WIDTH * height)) : most;
}

void model_framing_check(struct model_shared *shared)
{
    struct model *const model = &shared->model;
    int32_t share = measure(model);
    if (model->has_camera && share >= 0 && share < CAMERA_LEAST * 100) {
        model_shared_note(
            shared, "the file's camera shows the model in %d.%02d %% of its picture, so it is shown on the turntable",
            share / 100, share % 100);
        model->has_camera = false;
        share = measure(model);
    }
    if (!model->has_camera && share >= 0 && share < TURNTABLE_LEAST * 100) {
        model_shared_note(shared, "it covers %d.%02d %% of the picture on the turntable", share / 100, share % 100);
    }
}
