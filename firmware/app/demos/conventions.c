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
#define LINE_SIZE   32
#define NEAR_Z      FX_ONE
#define FAR_Z       FX_INT(12)
#define SCALE_Q20   (DEMO_SCALE_60_Q20 * 5 / 2) /* across the smaller side of a quarter */

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

/* Lines of text of a quarter. All stand in a strip along the middle of the picture, the pots above and below it. */
static int32_t text_lines(const struct demo_context *context)
{
    return context->height >= 200 ? 3 : context->height >= 96 ? 2 : 1;
}

/* The whole picture's projection for one of its quarters. Its height is as many sixteenths of the picture's as the
 * strip leaves, so that the shift has no rounding and all pots get the same pixels. */
static struct ph_projection in_quarter(const struct demo_context *context, uint32_t i, fx_t near_z, fx_t far_z)
{
    const int32_t w = context->width, h = context->height, free_px = h / 2 - DEMO_TEXT_LINE * text_lines(context) - 1;
    const int32_t sixteenths = free_px > 0 ? free_px * 16 / h : 8; /* without room, half of the picture */
    const int32_t high = h * sixteenths / 16, wide = w / 3, less = high < wide ? high : wide;
    const int32_t across = less > 0 ? less : 1;
    return (struct ph_projection){.kind = PH_PERSPECTIVE,
                                  .scale_x_q20 = (int32_t)(fx_mul_wide(SCALE_Q20, across) / w),
                                  .scale_y_q20 = (int32_t)(fx_mul_wide(SCALE_Q20, across) / h),
                                  .shift_x = i & 1 ? -FX_HALF : FX_HALF,
                                  .shift_y = (16 - sixteenths) * (i & 2 ? FX_ONE / 16 : -FX_ONE / 16),
                                  .near_z = near_z,
                                  .far_z = far_z};
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
    c->china = demo_figure(context, c->ramp, 235, 150, 70);
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
        status = i == 0 ? demo_begin(context, r, &camera->view, &camera->projection, &demo_daylight,
                                     demo_sky(context, 24, 32, 48))
                        : demo_camera(context, r, &camera->view, &camera->projection);
        status = status ? status : ph_draw_mesh(r, &c->pot, &turn);
    }
    return status;
}

/* Writes a line of a quarter's text. In low pictures the first line has the name and depth, or, if it is the only one,
 * half of the time the signs in place of depth; narrow ones have name and depth one after the other. */
static void write_line(const struct demo_context *context, uint32_t i, int32_t line, char text[LINE_SIZE])
{
    static const char *const names[QUARTERS][2] = {{"GL", "GL"}, {"D3D", "D3D"}, {"LMU", "LMU"}, {"REVERSED", "REV"}};
    const struct conventions *const c = context->state;
    const int32_t count = text_lines(context);
    const bool second = context->frame % LOOP_FRAMES >= LOOP_FRAMES / TEXTS, narrow = context->width < 120;
    char *end = text;
    if (line > 0) {
        demo_add_text(text, c->texts[i][line - 1]);
        return;
    }
    if (count == 3 || !narrow || !second) {
        end = demo_add_text(end, names[i][count < 3]);
        end = count < 3 && !narrow ? demo_add_text(end, " ") : end;
    }
    if (count < 3 && (!narrow || second)) {
        demo_add_text(end, c->texts[i][count == 1 && second && !narrow ? 0 : 1]);
    }
}

static uint32_t conventions_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    const int32_t count = text_lines(context), middle = context->height / 2;
    for (uint32_t i = 0; i < QUARTERS; i++) {
        const int32_t x = context->width * (i & 1 ? 3 : 1) / 4, top = middle + (i & 2 ? 2 : -count * DEMO_TEXT_LINE);
        for (int32_t k = 0; k < count; k++) {
            char text[LINE_SIZE];
            write_line(context, i, k, text);
            demo_text(r, band, lines, pixels, x, top + k * DEMO_TEXT_LINE, text);
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
