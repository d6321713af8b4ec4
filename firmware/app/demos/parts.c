/* Memory, cameras, materials and text of the demos: see demo_scene.h. */
#include "demo_scene.h"
#include "fx_math.h"
#include "hal.h"
#include "overlay.h"

#include <string.h>

const struct ph_scene_light demo_daylight = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL,
                .intensity = FX_ONE,
                .to_light_q30 = {-536870912, 759250125, 536870912}}}, /* (-1, sqrt 2, 1) / 2 */
};

struct ph_material demo_lit(uint16_t ramp[PH_RAMP_SIZE], const struct ph_shading *shading, uint8_t red, uint8_t green,
                            uint8_t blue)
{
    ph_material_ramp(ramp, red, green, blue, 0);
    return (struct ph_material){.shading = shading,
                                .ambient = FX_ONE / 4,
                                .diffuse = FX_ONE * 3 / 4,
                                .colour = ph_rgb565(red, green, blue),
                                .ramp = ramp};
}

struct ph_material demo_unlit(uint8_t red, uint8_t green, uint8_t blue)
{
    return (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(red, green, blue)};
}

struct ph_xform demo_look(fx_t eye_x, fx_t eye_y, fx_t eye_z, fx_t target_x, fx_t target_y, fx_t target_z)
{
    return ph_view_look_at((struct fx_vec3){eye_x, eye_y, eye_z}, (struct fx_vec3){target_x, target_y, target_z},
                           (struct fx_vec3){0, FX_ONE, 0});
}

struct ph_xform demo_place(fx_t x, fx_t y, fx_t z, uint32_t turn32)
{
    struct ph_xform at = ph_xform_rotate_y(turn32);
    at.t = (struct fx_vec3){x, y, z};
    return at;
}

fx_t demo_swing(uint32_t frame, uint32_t loop)
{
    int32_t s, c;
    fx_sincos_q30((frame % loop) * (uint32_t)(((uint64_t)1 << 32) / loop), &s, &c);
    return (FX_ONE - (c >> 14)) / 2;
}

bool demo_has_view(const struct demo *demo, const char *view)
{
    bool found = false;
    for (uint32_t i = 0; demo->views && demo->views[i]; i++) {
        found = found || strcmp(demo->views[i], view) == 0;
    }
    return found;
}

bool demo_view_is(const struct demo_context *context, const struct demo *demo, uint32_t i)
{
    return context->view ? strcmp(context->view, demo->views[i]) == 0 : i == 0;
}

void demo_input(struct demo_context *context, uint32_t buttons)
{
    const uint32_t step = 1u << 24;
    const fx_t further = FX_ONE / 64;
    context->buttons = buttons;
    context->orbit += (buttons & HAL_BUTTON_RIGHT ? step : 0) - (buttons & HAL_BUTTON_LEFT ? step : 0);
    context->dolly += (buttons & HAL_BUTTON_DOWN ? further : 0) - (buttons & HAL_BUTTON_UP ? further : 0);
    context->dolly = context->dolly > DEMO_DOLLY_MAX ? DEMO_DOLLY_MAX : context->dolly;
    context->dolly = context->dolly < -DEMO_DOLLY_MAX ? -DEMO_DOLLY_MAX : context->dolly;
}

/* How far the camera may tilt of what is asked for. */
static uint32_t tilt_within(const struct ph_xform *view, int32_t tilt)
{
    const int32_t lowest = 65536 / 120, highest = 65536 / 4 - 65536 / 120; /* 3 and 87 degrees */
    const fx_t up = fx_asin(view->r[2][1] >> 14), wanted = up + (tilt >> 16);
    const fx_t least = up < lowest ? up : lowest, most = up > highest ? up : highest;
    return (uint32_t)((wanted < least ? least : wanted > most ? most : wanted) - up) << 16;
}

void demo_orbit(const struct demo_context *context, struct ph_xform *view, struct ph_projection *projection)
{
    if (context->tilt != 0) { /* around what the camera looks at, which may come nearer then */
        const struct ph_xform tilt = ph_xform_rotate_x(tilt_within(view, context->tilt));
        const struct fx_vec3 at = view->t;
        *view = ph_xform_mul(&tilt, view);
        view->t = at;
        projection->near_z /= 2;
        projection->far_z += projection->near_z;
    }
    if (context->orbit != 0) {
        const struct ph_xform turn = ph_xform_rotate_y(0u - context->orbit);
        *view = ph_xform_mul(view, &turn);
    }
    const fx_t away = fx_mul_sat(-view->t.z, context->dolly), nearest = projection->near_z / 4 + 1;
    view->t.z -= away;
    projection->near_z = projection->near_z + away > nearest ? projection->near_z + away : nearest;
    projection->far_z += away;
}

int demo_camera(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
                const struct ph_projection *projection)
{
    const struct demo_camera *const user = &context->camera;
    return ph_frame_camera(r, user->view_set ? &user->view : view,
                           user->projection_set ? &user->projection : projection);
}

size_t demo_scratch_bytes(const struct demo *demo, uint16_t width, uint16_t band_height)
{
    return demo->blur_radius ? PH_BLUR_BYTES(width, band_height, demo->blur_radius) : 0;
}

uint32_t demo_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t band,
                        uint16_t *pixels)
{
    return demo->band ? demo->band(context, r, band, pixels) : ph_draw_band(r, band, pixels);
}

void *demo_alloc(struct demo_arena *arena, size_t n)
{
    const size_t start = (arena->used + 7) & ~(size_t)7;
    if (start > arena->size || n > arena->size - start) {
        return NULL;
    }
    arena->used = start + n;
    return arena->base + start;
}

struct ph_projection demo_perspective(const struct demo_context *context, int32_t scale_q20, fx_t near_z, fx_t far_z)
{
    const int32_t w = context->width, h = context->height;
    struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = near_z, .far_z = far_z};
    p.scale_x_q20 = scale_q20;
    p.scale_y_q20 = scale_q20;
    if (w >= h) {
        p.scale_x_q20 = (int32_t)((fx_mul_wide(scale_q20, h) + w / 2) / w);
    } else {
        p.scale_y_q20 = (int32_t)((fx_mul_wide(scale_q20, w) + h / 2) / h);
    }
    return p;
}

struct demo_context demo_half(const struct demo_context *context)
{
    struct demo_context half = *context;
    uint16_t *const side = half.height > half.width ? &half.height : &half.width;
    *side = *side > 1 ? *side / 2 : 1; /* a single pixel has no half */
    return half;
}

struct ph_projection demo_in_half(const struct demo_context *context, struct ph_projection lens, bool second)
{
    const fx_t shift = second ? -FX_HALF : FX_HALF;
    if (context->height > context->width) {
        lens.scale_y_q20 /= 2;
        lens.shift_y = lens.shift_y / 2 - shift;
    } else {
        lens.scale_x_q20 /= 2;
        lens.shift_x = shift;
    }
    return lens;
}

int demo_begin(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
               const struct ph_projection *projection, const struct ph_scene_light *light, uint16_t background)
{
    const struct demo_camera *const user = &context->camera;
    return ph_frame_begin(r, user->view_set ? &user->view : view, user->projection_set ? &user->projection : projection,
                          light, background);
}

// NOLINTNEXTLINE(readability-non-const-parameter): the pixels are written through the struct
void demo_text(const struct ph_renderer *r, uint32_t band, uint32_t lines, uint16_t *pixels, int32_t middle, int32_t y,
               const char *text)
{
    const struct ph_overlay_band over = {pixels, (uint16_t)(r->config.width >> r->samples_log2),
                                         (int32_t)(band * (r->config.band_height >> r->samples_log2)), (int32_t)lines};
    static const struct ph_overlay_style style = {0xffff, 0, 1}; /* white on black in RGB565 */
    ph_overlay_text(&over, middle - ph_overlay_width(text, 1) / 2, y, text, &style);
}

bool demo_may_be_round(const struct demo_context *context)
{
    return context->width == context->height && context->height >= 200;
}

int32_t demo_text_inset(const struct demo_context *context)
{
    return demo_may_be_round(context) ? context->height / 8 + 2 : 2;
}

int32_t demo_strip(const struct demo_context *context, int32_t lines)
{
    return demo_text_inset(context) + lines * DEMO_TEXT_LINE;
}

struct ph_projection demo_below(struct ph_projection lens, int32_t height, int32_t strip)
{
    const int32_t rest = strip < height ? height - strip : height; /* without room, all */
    lens.scale_x_q20 = (int32_t)(fx_mul_wide(lens.scale_x_q20, rest) / height);
    lens.scale_y_q20 = (int32_t)(fx_mul_wide(lens.scale_y_q20, rest) / height);
    lens.shift_y = (fx_t)((fx_mul_wide(lens.shift_y, rest) + fx_mul_wide(FX_ONE, height - rest)) / height);
    return lens;
}

int32_t demo_half_text_y(const struct demo_context *context, bool second, int32_t line)
{
    const int32_t w = context->width, h = context->height;
    return (second && h > w ? h / 2 : 0) + demo_text_inset(context) + line * DEMO_TEXT_LINE;
}

void demo_half_text(const struct demo_context *context, const struct ph_renderer *r, uint32_t band, uint32_t lines,
                    uint16_t *pixels, bool second, int32_t line, const char *text)
{
    const int32_t w = context->width, h = context->height;
    const int32_t aside = h > w ? 0 : demo_may_be_round(context) ? w * 3 / 16 : w / 4;
    demo_text(r, band, lines, pixels, w / 2 + (second ? aside : -aside) + 1, demo_half_text_y(context, second, line),
              text);
}

char *demo_add_text(char *to, const char *more)
{
    for (; *more != '\0'; more++) {
        *to++ = *more;
    }
    *to = '\0';
    return to;
}

bool demo_is_small(const struct demo_context *context)
{
    return context->width <= 64 || context->height <= 64;
}

uint16_t demo_sky(const struct demo_context *context, uint8_t red, uint8_t green, uint8_t blue)
{
    return demo_is_small(context) ? 0 : ph_rgb565(red, green, blue);
}

struct ph_material demo_tile(const struct demo_context *context, uint8_t red, uint8_t green, uint8_t blue)
{
    const uint8_t share = demo_is_small(context) ? 4 : 1;
    return demo_unlit(red / share, green / share, blue / share);
}

/* A figure's red, green or blue. */
static uint8_t bright(const struct demo_context *context, uint8_t value)
{
    return demo_is_small(context) ? (uint8_t)((value + 2 * 255) / 3) : value;
}

struct ph_material demo_figure(const struct demo_context *context, uint16_t ramp[PH_RAMP_SIZE], uint8_t red,
                               uint8_t green, uint8_t blue)
{
    struct ph_material m =
        demo_lit(ramp, PH_SHADE_GOURAUD, bright(context, red), bright(context, green), bright(context, blue));
    if (demo_is_small(context)) { /* its dark side, too, is brighter than the ground */
        m.ambient = m.diffuse = FX_HALF;
    }
    return m;
}
