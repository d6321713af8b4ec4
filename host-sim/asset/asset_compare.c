/* See asset_compare.h. */
#include "asset_compare.h"

#include "complain.h"
#include "model_stage.h"
#include "wire_colour.h"

#include <stdlib.h>

/* The demo that shows a model on the turntable, without the platter. */
static int open(struct model_stage *stage, struct model *on_turntable, uint16_t width, uint16_t height)
{
    on_turntable->has_camera = false;
    struct demo demo = model_demo(on_turntable);
    demo.arena_bytes -= DEMO_TURNTABLE_BYTES - DEMO_TURNTABLE_BARE_BYTES;
    const struct model_stage_size size = {width, height, height, demo.triangle_max};
    return model_stage_open(stage, &demo, on_turntable, &size);
}

/* Draws one side. 0, or the renderer's error. */
static int draw(struct model_stage *s, uint32_t side, uint32_t frames)
{
    const uint32_t frame = (uint32_t)((uint64_t)side * frames / ASSET_SIDES);
    s->context.orbit = side * (UINT32_MAX / ASSET_SIDES + 1) + (frame << 24); /* takes back what it turns meanwhile */
    const int status = s->demo.frame(&s->context, &s->r, frame);
    if (status == 0) {
        ph_frame_bands(&s->r);
        demo_draw_band(&s->demo, &s->context, &s->r, 0, s->pixels);
    }
    return status;
}

static bool is_off(uint16_t a, uint16_t b)
{
    uint8_t x[3], y[3];
    wire_colour(a, x);
    wire_colour(b, y);
    return abs(x[0] - y[0]) > ASSET_OFF || abs(x[1] - y[1]) > ASSET_OFF || abs(x[2] - y[2]) > ASSET_OFF;
}

int asset_compare(const struct asset *asset, const struct model *model, uint16_t width, uint16_t height, double *share)
{
    struct model after = asset->model, before = *model;
    struct model_stage s[2];
    int status = open(&s[0], &before, width, height);
    const int other = open(&s[1], &after, width, height);
    uint64_t shown = 0, off = 0;
    const uint16_t background = model->studio != NULL ? model->studio->background : DEMO_MODEL_BACKGROUND;
    status = status != 0 ? status : other;
    for (uint32_t side = 0; side < ASSET_SIDES && status == 0; side++) {
        const uint32_t frames = model_clip_frames(model);
        status = draw(&s[0], side, frames);
        status = status == 0 ? draw(&s[1], side, frames) : status;
        for (uint32_t i = 0; i < (uint32_t)width * height && status == 0; i++) {
            const uint16_t a = s[0].pixels[i], b = s[1].pixels[i];
            shown += a != background || b != background;
            off += is_off(a, b);
        }
    }
    free(s[0].memory);
    free(s[1].memory);
    *share = shown > 0 ? (double)off / (double)shown : 0;
    return status == 0 ? 0 : complain("the model cannot be drawn beside what is left of it (%d)", status);
}
