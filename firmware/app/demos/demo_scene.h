/* demo_scene: what the demos share. The demos themselves are found through demo_list (demo.h). */
#ifndef DEMO_SCENE_H
#define DEMO_SCENE_H

#include "demo.h"
#include "overlay.h"

#ifndef DEMOS_MORE /* those of make's DEMO_DIR */
#define DEMOS_MORE(D)
#endif

/* The demos, in the order of the select button. */
/* clang-format off */
#define DEMOS_EACH(D) \
    D(turntable) D(testcard) D(torus) D(cube) D(fill) D(icosphere) D(ground) D(wireframe) D(solar) D(snake) \
    D(ball) D(hitchcock) D(parallel) D(shadow) D(fisheye) D(focus) D(conventions) D(zfight) D(zoom) D(pinhole) \
    D(materials) D(character) D(yard) DEMOS_MORE(D)
/* clang-format on */

#define DEMOS_DECLARE(name) extern const struct demo demo_##name;
DEMOS_EACH(DEMOS_DECLARE)

/*
 * A perspective with an angle across the smaller side of the picture (in square and landscape pictures: vertically);
 * the larger side shows more in proportion. scale_q20 is 1 / tan(half the angle) in Q12.20: 1 / tan(30 degrees) for 60.
 */
#define DEMO_SCALE_60_Q20 1816187
struct ph_projection demo_perspective(const struct demo_context *context, int32_t scale_q20, fx_t near_z, fx_t far_z);

/*
 * The camera that just sees everything that turns about the vertical axis through `centre`, which becomes the origin.
 * It looks down from 20 degrees above, with 40 degrees across the smaller side. Also: how far the meshes reach from the
 * axis and downwards.
 */
struct demo_fit {
    struct ph_xform view;
    struct ph_projection projection;
    fx_t radius, bottom;
};

struct demo_fit demo_fit(const struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                         struct fx_vec3 centre);

/*
 * A picture of two halves: left and right, in upright pictures upper and lower. demo_half() has the size of one.
 * demo_in_half() is the projection for the whole picture that puts `lens` into the middle of a half.
 */
struct demo_context demo_half(const struct demo_context *context);
struct ph_projection demo_in_half(const struct demo_context *context, struct ph_projection lens, bool second);

/*
 * Labels stand in a strip that the scene leaves free: above it, or above each half. They keep 2 pixels from the edge of
 * the glass. A square picture of 200 lines or more may be a round glass, the inscribed circle. There the strip begins
 * further down, and the labels of halves stand nearer to each other: up to 77 pixels of 240 wide they are on the glass.
 */
bool demo_may_be_round(const struct demo_context *context);

/* Rows of the picture above the first line of text: 2, or what a round glass needs. */
int32_t demo_text_inset(const struct demo_context *context);

/* Makes a lens for a picture `height` rows high one that draws only below a strip of `strip` rows at the top. */
struct ph_projection demo_below(struct ph_projection lens, int32_t height, int32_t strip);

/* Rows that so many lines of text take at the top of a picture, or of a half. */
#define DEMO_TEXT_LINE (PH_FONT_HEIGHT + 1)
int32_t demo_strip(const struct demo_context *context, int32_t lines);

/* Draws line number `line` of a half's strip. */
void demo_half_text(const struct demo_context *context, const struct ph_renderer *r, uint32_t band, uint32_t lines,
                    uint16_t *pixels, bool second, int32_t line, const char *text);

/* The row of the picture in which line `line` of a half begins; it is PH_FONT_HEIGHT rows high, and has an outline of
 * one. */
int32_t demo_half_text_y(const struct demo_context *context, bool second, int32_t line);

/* Writes `more` at `to` with its final 0. Returns where that is: the place for what follows. */
char *demo_add_text(char *to, const char *more);

/*
 * A picture of up to 64 lines or columns is mostly on glass of one bit a pixel, or a few: there figures are told from
 * what is behind them by brightness alone. So the sky is black there, what lies on the ground has a quarter of its
 * brightness, and figures are mixed with white and lit on their dark sides. In all other pictures the colours are as
 * given.
 */
bool demo_is_small(const struct demo_context *context);
uint16_t demo_sky(const struct demo_context *context, uint8_t red, uint8_t green, uint8_t blue);
struct ph_material demo_tile(const struct demo_context *context, uint8_t red, uint8_t green, uint8_t blue); /* unlit */
struct ph_material demo_figure(const struct demo_context *context, uint16_t ramp[PH_RAMP_SIZE], uint8_t red,
                               uint8_t green, uint8_t blue); /* demo_lit(), Gouraud */

/* Calls ph_frame_begin with the user's camera if there is one, else with the demo's. */
int demo_begin(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
               const struct ph_projection *projection, const struct ph_scene_light *light, uint16_t background);

/*
 * Draws a list of meshes, all at one place. Those through which something is seen come last, the farthest first by the
 * middle of their boxes, as viewers do; if more than 64 are seen through they come in the list's order.
 */
int demo_draw_meshes(struct ph_renderer *r, const struct ph_mesh *meshes, uint32_t count, const struct ph_xform *place);

/* Sets another camera for everything that is drawn from now on, in the same way. */
int demo_camera(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
                const struct ph_projection *projection);

/*
 * Moves a camera that looks at the origin as context->orbit, tilt and dolly say; the near and the far plane move with
 * it. It stays 3 degrees above the ground and below the zenith, or where the demo has it, if that is beyond.
 */
void demo_orbit(const struct demo_context *context, struct ph_xform *view, struct ph_projection *projection);

/* Whether the demo's view number `i` is asked for (0: also if no view is named). */
bool demo_view_is(const struct demo_context *context, const struct demo *demo, uint32_t i);

/* A camera at eye that looks at target, y up. */
struct ph_xform demo_look(fx_t eye_x, fx_t eye_y, fx_t eye_z, fx_t target_x, fx_t target_y, fx_t target_z);

/* The transform that turns about y and then moves to (x, y, z). */
struct ph_xform demo_place(fx_t x, fx_t y, fx_t z, uint32_t turn32);

/* The ball's way from its start to the wall that turns it back, and its size (ball.c). */
#define DEMO_BALL_RADIUS (FX_ONE / 2)
#define DEMO_BALL_LEGS   5

struct demo_ball_leg {
    struct fx_vec3 from;  /* the ball's centre in the eye's coordinates */
    int32_t direction[3]; /* -1, 0, 1 */
    fx_t begin;           /* the way of the legs before */
};

struct demo_ball_way {
    struct demo_ball_leg legs[DEMO_BALL_LEGS];
    fx_t whole;
};

void demo_ball_run(struct demo_ball_way *way);

/* The ball's centre in that frame. */
struct fx_vec3 demo_ball_position(const struct demo_ball_way *way, uint32_t frame);

/* The colours of the rails and of the cross at the vanishing point (parallel.c). */
#define DEMO_RAIL_COLOUR 210, 225, 245
#define DEMO_MARK_COLOUR 255, 70, 90

/* A smooth wave of `loop` frames (a power of two): 0 at frame 0, FX_ONE half way. */
fx_t demo_swing(uint32_t frame, uint32_t loop);

/* A lit material: a quarter ambient, the rest diffuse. It fills the ramp. */
struct ph_material demo_lit(uint16_t ramp[PH_RAMP_SIZE], const struct ph_shading *shading, uint8_t red, uint8_t green,
                            uint8_t blue);
struct ph_material demo_unlit(uint8_t red, uint8_t green, uint8_t blue);

/* Ambient light and one lamp far away, up on the left behind the viewer. */
extern const struct ph_scene_light demo_daylight;

/* A key light from the upper left, and a weak one from the right that shows the far side. */
extern const struct ph_scene_light demo_two_lamps;

/* What lights a model and what is behind it: as context->studio says. */
struct ph_scene_light demo_studio_light(const struct demo_context *context);
uint16_t demo_studio_background(const struct demo_context *context);

/* Whether band number `band`, of that many lines, holds a row of a text at row y of the picture, or of its outline. */
static inline bool demo_text_reaches(const struct ph_renderer *r, uint32_t band, uint32_t lines, int32_t y)
{
    const int32_t y0 = (int32_t)(band * (r->config.band_height >> r->samples_log2));
    return y - 1 < y0 + (int32_t)lines && y + PH_FONT_HEIGHT >= y0;
}

/* Draws what band number `band` has of a text that is centred at column `middle` and has its top in row y. */
void demo_text(const struct ph_renderer *r, uint32_t band, uint32_t lines, uint16_t *pixels, int32_t middle, int32_t y,
               const char *text);

#endif
