/*
 * conventions: one scene in each quarter of the picture. Its camera is written as OpenGL, Direct3D, the LMU tutorial
 * and reversed z write it. The quarters are the same to the last pixel (camera.h). What differs is written below: the
 * axis along which the camera looks, the sign of clip w, and depth from the near to the far plane. All three are taken
 * from the convention's matrix.
 */
#include "camera.h"
#include "demo_scene.h"
#include "fx_math.h"
#include "models.h"
#include "overlay.h"

#include <string.h>

#define LOOP_FRAMES 256
#define SEGMENTS    2
#define QUARTERS    4
#define TEXTS       2
#define NEAR_Z      FX_ONE
#define FAR_Z       FX_INT(12)

/* The camera as it comes out of a convention's own way to write it. */
struct taken_camera {
    struct ph_xform view;
    struct ph_projection projection; /* for its quarter of the picture */
};

struct conventions {
    struct taken_camera cameras[QUARTERS];
    char texts[QUARTERS][TEXTS][3 + 2 * FX_TEXT_SIZE];
    struct ph_mesh pot;
    struct ph_material china;
    uint16_t ramp[PH_RAMP_SIZE];
};

/* "-Z W>0" and "-1 TO 1": the sign of z in front of the camera and of w there; depth at the near and the far plane. */
static int describe(enum ph_convention convention, char texts[TEXTS][3 + 2 * FX_TEXT_SIZE])
{
    static const struct ph_projection p = {PH_PERSPECTIVE, 1 << 20, 1 << 20, 0, 0, NEAR_Z, FAR_Z, NULL};
    const fx_t sign = convention == PH_D3D ? 1 : -1;
    struct ph_mat4 m;
    const int status = ph_matrix_projection(&m, &p, convention);
    const struct ph_vec4 near = ph_mat4_apply(&m, (struct ph_vec4){0, 0, sign * NEAR_Z, FX_ONE}),
                         far = ph_mat4_apply(&m, (struct ph_vec4){0, 0, sign * FAR_Z, FX_ONE});
    memcpy(texts[0], sign < 0 ? "-Z W>0" : "+Z W>0", 7);
    texts[0][4] = near.w < 0 ? '<' : '>';
    const int length = fx_to_text_rounded(fx_div_sat(near.z, near.w), 0, texts[1]);
    memcpy(texts[1] + length, "..", 2);
    fx_to_text_rounded(fx_div_sat(far.z, far.w), 0, texts[1] + length + 2);
    return status;
}

/* The camera above the pot as each convention writes it. D3D looks along +z; LMU gives planes as coordinates. */
static int written_in(enum ph_convention convention, struct ph_xform *view, fx_t *near_z, fx_t *far_z)
{
    *view = demo_look(0, FX_ONE * 12 / 10, FX_ONE * 4, 0, 0, 0);
    *near_z = convention == PH_LMU ? -NEAR_Z : NEAR_Z;
    *far_z = convention == PH_LMU ? -FAR_Z : FAR_Z;
    if (convention == PH_D3D) { /* 4600 notes: rows right, up, forward */
        for (int k = 0; k < 3; k++) {
            view->r[2][k] = -view->r[2][k];
        }
        view->t.z = -view->t.z;
    }
    return ph_camera_from(convention, view, near_z, far_z);
}

/* The whole picture's projection for one of its quarters: half the scale, shifted by a quarter of the picture. */
static struct ph_projection in_quarter(const struct demo_context *context, uint32_t i, fx_t near_z, fx_t far_z)
{
    struct ph_projection p = demo_perspective(context, DEMO_SCALE_60_Q20 * 3 / 2, near_z, far_z);
    p.scale_x_q20 /= 2;
    p.scale_y_q20 /= 2;
    p.shift_x = i & 1 ? -FX_HALF : FX_HALF;
    p.shift_y = i & 2 ? FX_HALF : -FX_HALF;
    return p;
}

static int take_camera(const struct demo_context *context, uint32_t i, struct taken_camera *camera)
{
    fx_t near_z, far_z;
    const int status = written_in((enum ph_convention)i, &camera->view, &near_z, &far_z);
    camera->projection = in_quarter(context, i, near_z, far_z);
    return status;
}

static int conventions_init(struct demo_context *context)
{
    struct conventions *const c = demo_alloc(&context->arena, sizeof(*c));
    if (!c || model_teapot(&context->arena, &c->pot, SEGMENTS) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    c->china = demo_lit(c->ramp, PH_SHADE_GOURAUD, 235, 150, 70);
    context->state = c;
    for (uint32_t i = 0; i < QUARTERS; i++) {
        if (describe((enum ph_convention)i, c->texts[i]) != PH_OK || take_camera(context, i, &c->cameras[i]) != PH_OK) {
            return PH_ERR_INVAL;
        }
    }
    return model_material(&context->arena, &c->pot, &c->china);
}

static int conventions_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct conventions *const c = context->state;
    const struct ph_xform turn = ph_xform_rotate_y(frame << 24);
    int status = PH_OK;
    context->frame = frame;
    for (uint32_t i = 0; i < QUARTERS && status == PH_OK; i++) {
        const struct taken_camera *const camera = &c->cameras[i];
        status = i == 0
                     ? demo_begin(context, r, &camera->view, &camera->projection, &demo_daylight, ph_rgb565(24, 32, 48))
                     : demo_camera(context, r, &camera->view, &camera->projection);
        status = status ? status : ph_draw_mesh(r, &c->pot, &turn);
    }
    return status;
}

/* Draws a text around `middle`, if it reaches into the band. */
static void label(const struct ph_renderer *r, uint32_t band, uint32_t lines, uint16_t *pixels, int32_t middle,
                  int32_t y, const char *text)
{
    if (demo_text_reaches(r, band, lines, y)) {
        demo_text(r, band, lines, pixels, middle - ph_overlay_width(text, 1) / 2, y, text);
    }
}

static uint32_t conventions_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    static const char *const names[QUARTERS] = {"GL", "D3D", "LMU", "REVERSED"};
    const struct conventions *const c = context->state;
    const uint32_t lines = ph_draw_band(r, band, pixels);
    const int32_t inset = context->height / 8 - 6; /* so that a round glass shows the labels, too */
    const bool low = context->height < 96;         /* there is room for one line at a time */
    const int32_t y0 = (int32_t)(band * (r->config.band_height >> r->samples_log2)), half = context->height / 2;
    /* Quarters of the band; where halves have no room for their labels, all. */
    const bool roomy = context->height >= 32;
    const uint32_t from = roomy && y0 > half ? 2 : 0, end = roomy && y0 + (int32_t)lines < half ? 2 : QUARTERS;
    for (uint32_t i = from; i < end; i++) {
        const int32_t middle = context->width * (i & 1 ? 3 : 1) / 4;
        const int32_t top = (i & 2 ? context->height / 2 : 0) + (inset > 2 ? inset : 2);
        label(r, band, lines, pixels, middle, top, names[i]);
        const int32_t first = low ? (int32_t)(context->frame / (LOOP_FRAMES / TEXTS) % TEXTS) : 0,
                      least = low ? 1 : TEXTS;
        for (int32_t k = first; k < first + least; k++) {
            const int32_t bottom = (i & 2 ? context->height : context->height / 2) - (i & 2 && inset > 2 ? inset : 2);
            label(r, band, lines, pixels, middle, bottom - (least - k + first) * PH_FONT_HEIGHT, c->texts[i][k]);
        }
    }
    return lines;
}

const struct demo demo_conventions = {
    .name = "conventions",
    .summary = "one camera as OpenGL, Direct3D, LMU and reversed z write it: one picture",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = MODEL_ROUND8(sizeof(struct conventions)) + MODEL_ROUND8(sizeof(struct ph_part)) +
                   MODEL_BYTES(MODEL_TEAPOT_VERTICES(SEGMENTS), MODEL_TEAPOT_TRIANGLES(SEGMENTS)),
    .vertex_max = 4 * MODEL_TEAPOT_VERTICES(SEGMENTS),
    .triangle_max = 660,
    .init = conventions_init,
    .frame = conventions_frame,
    .band = conventions_band,
};
