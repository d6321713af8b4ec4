/*
 * parallel: rails and a car on them under both projections, side by side, in upright pictures one above the other
 * (source: K. Juenemann, HAW Hamburg, chapter 9; S.-E. Yoon, Rendering, KAIST, ch. 4). Parallel lines stay parallel in
 * the orthographic picture; in the perspective one they meet in the vanishing point, which is where the camera would
 * see the rails' direction: there stands the cross.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES  256
#define GAUGE        FX_HALF /* from the middle to a rail */
#define RAILS_FRONT  (FX_ONE * -14 / 10)
#define RAILS_BACK   (FX_ONE * -104 / 10)
#define RAILS_MIDDLE ((RAILS_FRONT + RAILS_BACK) / 2)
#define SLEEPERS     13
#define EYE_HEIGHT   (FX_ONE * 19 / 10)
#define AWAY         FX_INT(200) /* from the eye to the cross */
#define SKY          FX_INT(220)

struct parallel {
    struct ph_mesh car, sleeper;
    struct ph_material colours, wood, line, mark, frame;
    uint16_t ramps[2][PH_RAMP_SIZE];
};

static int parallel_init(struct demo_context *context)
{
    struct demo_arena *const arena = &context->arena;
    struct parallel *const p = demo_alloc(arena, sizeof(*p));
    if (!p) {
        return PH_ERR_NOMEM;
    }
    p->colours = demo_lit(p->ramps[0], PH_SHADE_FLAT, 240, 150, 50);
    p->wood = demo_lit(p->ramps[1], PH_SHADE_FLAT, 120, 90, 70);
    p->line = demo_unlit(DEMO_RAIL_COLOUR);
    p->mark = demo_unlit(DEMO_MARK_COLOUR);
    p->frame = demo_unlit(70, 84, 110);
    if (model_box(arena, &p->car, FX_ONE * 45 / 100, FX_ONE * 45 / 100, FX_ONE * 45 / 100) != PH_OK ||
        model_material(arena, &p->car, &p->colours) != PH_OK ||
        model_box(arena, &p->sleeper, FX_ONE * 8 / 10, FX_ONE / 32, FX_ONE / 8) != PH_OK ||
        model_material(arena, &p->sleeper, &p->wood) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    context->state = p;
    return PH_OK;
}

static int draw_railway(struct ph_renderer *r, const struct parallel *p, uint32_t frame)
{
    int status = PH_OK;
    for (int32_t i = 0; i < SLEEPERS && status == PH_OK; i++) {
        const struct ph_xform place =
            ph_xform_translate(0, -FX_ONE / 16, RAILS_FRONT - FX_ONE / 3 - i * (FX_ONE * 7 / 10));
        status = ph_draw_mesh(r, &p->sleeper, &place);
    }
    for (int32_t side = -1; side <= 1; side += 2) {
        ph_draw_line(r, (struct fx_vec3){side * GAUGE, 0, RAILS_FRONT}, (struct fx_vec3){side * GAUGE, 0, RAILS_BACK},
                     &p->line);
    }
    const fx_t z = fx_lerp_sat(FX_ONE * -26 / 10, FX_ONE * -96 / 10, demo_swing(frame + LOOP_FRAMES / 8, LOOP_FRAMES));
    const struct ph_xform place = ph_xform_translate(0, FX_ONE * 47 / 100, z);
    return status ? status : ph_draw_mesh(r, &p->car, &place);
}

/* Draws a cross that is far away from the eye in the direction of the rails. */
static void draw_mark(struct ph_renderer *r, const struct parallel *p)
{
    const fx_t arm = FX_INT(7);
    const struct fx_vec3 at = {0, EYE_HEIGHT, -AWAY};
    ph_draw_line(r, (struct fx_vec3){-arm, at.y, at.z}, (struct fx_vec3){arm, at.y, at.z}, &p->mark);
    ph_draw_line(r, (struct fx_vec3){0, at.y - arm, at.z}, (struct fx_vec3){0, at.y + arm, at.z}, &p->mark);
}

/* An orthographic projection 2.2 units wide and 5.8 high; one of them is more if the half picture's shape needs it. */
static struct ph_projection all_rails(const struct demo_context *half)
{
    const int32_t w = half->width, h = half->height;
    const int32_t across = w * 29 < h * 11 ? w * 29 : h * 11; /* pixels a unit, times 63.8 */
    return (struct ph_projection){.kind = PH_ORTHOGRAPHIC,
                                  .shift_y = FX_ONE / 16,
                                  .scale_x_q20 = (int32_t)(((int64_t)across << 20) * 10 / 319 / w),
                                  .scale_y_q20 = (int32_t)(((int64_t)across << 20) * 10 / 319 / h),
                                  .near_z = FX_HALF,
                                  .far_z = FX_INT(30)};
}

/* Begins a frame with a camera that looks down from high above, for the left half. */
static int begin_from_above(struct demo_context *context, struct ph_renderer *r)
{
    const struct demo_context half = demo_half(context);
    struct ph_projection flat = demo_below(all_rails(&half), half.height, demo_strip(context, 1));
    const struct ph_xform view = demo_look(0, FX_INT(5), RAILS_MIDDLE + FX_ONE * 83 / 10, 0, FX_ONE / 4, RAILS_MIDDLE);
    flat = demo_in_half(context, flat, false);
    return demo_begin(context, r, &view, &flat, &demo_daylight, ph_rgb565(14, 20, 34));
}

/* Goes on with a camera that stands on the rails, for the right half. */
static int go_on_from_the_rails(struct demo_context *context, struct ph_renderer *r)
{
    const struct demo_context half = demo_half(context);
    struct ph_projection deep = demo_perspective(&half, DEMO_SCALE_60_Q20, FX_HALF, SKY);
    const struct ph_xform view = demo_look(0, EYE_HEIGHT, 0, 0, EYE_HEIGHT - FX_ONE / 4, -FX_ONE);
    deep = demo_in_half(context, demo_below(deep, half.height, demo_strip(context, 1)), true);
    return demo_camera(context, r, &view, &deep);
}

static int parallel_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct parallel *const p = context->state;
    int status = begin_from_above(context, r);
    status = status ? status : draw_railway(r, p, frame);
    status = status ? status : go_on_from_the_rails(context, r);
    status = status ? status : draw_railway(r, p, frame);
    if (status == PH_OK) {
        draw_mark(r, p);
    }
    return status;
}

static uint32_t parallel_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    const bool narrow = demo_half(context).width < 72;
    demo_half_text(context, r, band, lines, pixels, false, 0, narrow ? "ORTHO" : "PARALLEL");
    demo_half_text(context, r, band, lines, pixels, true, 0, narrow ? "PERSP" : "PERSPECTIVE");
    return lines;
}

const struct demo demo_parallel = {
    .name = "parallel",
    .summary = "rails under both projections: parallel, and meeting in the vanishing point",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = MODEL_ROUND8(sizeof(struct parallel)) + 2 * (MODEL_ROUND8(sizeof(struct ph_part)) + MODEL_BOX_BYTES),
    .vertex_max = 672,
    .triangle_max = 160,
    .corner_max = 64,
    .init = parallel_init,
    .frame = parallel_frame,
    .band = parallel_band,
};
