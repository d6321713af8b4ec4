/*
 * hitchcock: the zoom of Vertigo (source: LMU Munich, computer graphics, summer 2020, tutorial 4, task 4). The camera
 * rolls away from a spinning top on its own axis and narrows its field of view, so that the top keeps its size on the
 * screen to the pixel while the colonnade behind it swells. As there, the way is 1000 equal steps forth and 1000 back.
 *
 * The top stands in the plane through the origin. Its two tips lie on its axis, so its projected height is the axis's:
 * TOP_HEIGHT / distance / (2 tan(fov / 2)) = TOP_HEIGHT / VIEW_HEIGHT of the picture.
 *
 * zoom: the two halves of it, side by side (source: K. Juenemann, HAW Hamburg, chapter 9). Zooming changes the field of
 * view and keeps the place; dollying changes the place and keeps the field of view. The top has the same size in both
 * pictures; what is behind it has not, because perspective depends on the place alone.
 */
#include "camera.h"
#include "demo_scene.h"
#include "fx_math.h"
#include "models.h"

#define LOOP_FRAMES   2048 /* it rests at the far end for 48 */
#define STEPS         1000
#define VIEW_HEIGHT   (FX_ONE * 7 / 2) /* seen at the distance of the top */
#define NEAREST       (FX_ONE * 5 / 2) /* 70 degrees */
#define FURTHEST      FX_INT(18)       /* 11 degrees */
#define EYE_HEIGHT    (FX_ONE * 6 / 5)
#define TOP_SIDES     16
#define TOP_KIT       12 /* sides of the top and of columns where the picture is small */
#define COLUMN_KIT    6
#define FAR_SIDES     5 /* there: of the columns behind NEAR_PAIRS, and how many of them the camera sees */
#define FAR_SEEN      2
#define NEAR_PAIRS    1
#define LEFT_TURN     2576980378u /* 3/5 and 1/2 of a turn: the seen sides face the camera */
#define RIGHT_TURN    2147483648u
#define TOP_FEW       8 /* sides, columns' sides and cells where memory is small */
#define COLUMN_FEW    4
#define CELLS_FEW     7
#define TOP_STRIPES   4
#define COLUMN_SIDES  8
#define COLUMN_POINTS 8
#define PAIRS         7
#define CELLS         14
#define FLOOR_SCALE   (FX_ONE * 195 / 100)
#define FLOOR_MIDDLE  (FX_ONE * -5 / 2)

#define ZOOM_LOOP  256
#define ZOOM_AT    FX_INT(9)         /* the place of the camera that zooms */
#define DOLLY_FOV  FX_INT(60)        /* the field of view of the one that moves */
#define SEEN_LEAST (FX_ONE * 16 / 5) /* at the top's distance, in both */
#define SEEN_MOST  (FX_ONE * 9 / 2)
#define WALK       9 /* pieces of floor, of 2 x 2 cells */
#define ZOOM_PAIRS 6
#define ZOOM_FEW   3
#define SHOT_TEXT  (4 + FX_TEXT_SIZE + 4 + FX_TEXT_SIZE)

static const struct model_point top_profile[] = {
    {0, 0},
    {FX_ONE / 10, FX_ONE / 4},
    {FX_ONE * 6 / 10, FX_ONE * 8 / 10},
    {FX_ONE * 72 / 100, FX_ONE * 11 / 10},
    {FX_ONE * 6 / 10, FX_ONE * 135 / 100},
    {FX_ONE * 2 / 10, FX_ONE * 155 / 100},
    {FX_ONE / 10, FX_ONE * 17 / 10},
    {FX_ONE / 9, FX_ONE * 21 / 10},
    {0, FX_ONE * 24 / 10},
};
#define TOP_POINTS (sizeof(top_profile) / sizeof(top_profile[0]))

static const struct model_point column_profile[COLUMN_POINTS] = {
    {FX_ONE * 45 / 100, 0},
    {FX_ONE * 45 / 100, FX_ONE / 4},
    {FX_ONE * 33 / 100, FX_ONE / 3},
    {FX_ONE * 33 / 100, FX_ONE / 3},
    {FX_ONE * 28 / 100, FX_ONE * 34 / 10},
    {FX_ONE * 28 / 100, FX_ONE * 34 / 10},
    {FX_ONE * 48 / 100, FX_ONE * 37 / 10},
    {FX_ONE * 48 / 100, FX_INT(4)},
};

struct hitchcock {
    struct ph_mesh top, column, far_column, floor;
    fx_t floor_scale;
    int32_t near_pairs;
    int32_t pairs; /* of columns in zoom */
    struct ph_material stripes[TOP_STRIPES], stone, tiles[2];
    uint16_t ramps[TOP_STRIPES + 1][PH_RAMP_SIZE];
};

/* How finely a scene is modelled. */
struct fineness {
    uint8_t top, column, cells; /* sides; the floor has cells x cells cells */
    uint8_t near_pairs;         /* of columns; those behind them have FAR_SIDES sides */
    uint8_t zoom_pairs;
};

#define ARENA(sides, column, cells)                                                                                    \
    (MODEL_ROUND8(sizeof(struct hitchcock)) + MODEL_LATHE_BYTES(sides, TOP_POINTS, TOP_STRIPES) +                      \
     MODEL_LATHE_BYTES(column, COLUMN_POINTS, 1) + MODEL_FLOOR_BYTES(cells))
#define ARENA_FINE ARENA(TOP_SIDES, COLUMN_SIDES, CELLS)
#define ARENA_KIT  (ARENA(TOP_KIT, COLUMN_KIT, CELLS) + MODEL_LATHE_ARC_BYTES(FAR_SEEN, COLUMN_POINTS))
#define ARENA_FEW  ARENA(TOP_FEW, COLUMN_FEW, CELLS_FEW)

#define ZOOM_ARENA_FINE ARENA(TOP_SIDES, COLUMN_SIDES, 2)
#define ZOOM_ARENA_KIT  ARENA(TOP_KIT, COLUMN_KIT, 2)
#define ZOOM_ARENA_FEW  ARENA(TOP_FEW, COLUMN_FEW, 2)

static int make_columns(struct demo_arena *arena, struct hitchcock *h, const struct fineness *f)
{
    const int status = model_lathe(arena, &h->column, column_profile, COLUMN_POINTS, f->column, 1, &h->stone);
    return status != PH_OK || f->near_pairs == PAIRS
               ? status
               : model_lathe_arc(arena, &h->far_column, column_profile, COLUMN_POINTS, FAR_SIDES, FAR_SEEN, &h->stone);
}

static int make_scene(struct demo_context *context, const struct fineness *f)
{
    static const uint8_t colours[TOP_STRIPES][3] = {{235, 60, 50}, {250, 200, 60}, {60, 130, 230}, {245, 240, 225}};
    struct demo_arena *const arena = &context->arena;
    struct hitchcock *const h = demo_alloc(arena, sizeof(*h));
    if (!h) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < TOP_STRIPES; i++) {
        h->stripes[i] = demo_figure(context, h->ramps[i], colours[i][0], colours[i][1], colours[i][2]);
    }
    h->stone = demo_lit(h->ramps[TOP_STRIPES], PH_SHADE_GOURAUD, 225, 205, 175);
    h->tiles[0] = demo_tile(context, 92, 72, 78);
    h->tiles[1] = demo_tile(context, 140, 112, 104);
    h->floor_scale = f->cells == CELLS_FEW ? FLOOR_SCALE * CELLS / CELLS_FEW : FLOOR_SCALE;
    h->near_pairs = f->near_pairs;
    h->pairs = f->zoom_pairs;
    context->state = h;
    if (model_lathe(arena, &h->top, top_profile, TOP_POINTS, f->top, TOP_STRIPES, h->stripes) != PH_OK ||
        make_columns(arena, h, f) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return model_floor(arena, &h->floor, f->cells, h->tiles);
}

static int hitchcock_init(struct demo_context *context)
{
    static const struct fineness fine = {TOP_SIDES, COLUMN_SIDES, CELLS, PAIRS, 0},
                                 kit = {TOP_KIT, COLUMN_KIT, CELLS, NEAR_PAIRS, 0},
                                 few = {TOP_FEW, COLUMN_FEW, CELLS_FEW, PAIRS, 0};
    const size_t size = context->arena.size;
    return make_scene(context, size >= ARENA_FINE ? &fine : size >= ARENA_KIT ? &kit : &few);
}

/* The camera's distance: it starts near, rolls away and comes back. */
static fx_t distance_at(uint32_t frame)
{
    const uint32_t phase = frame % LOOP_FRAMES, step = phase < LOOP_FRAMES / 2 ? phase : LOOP_FRAMES - phase;
    return NEAREST + (fx_t)((int64_t)(FURTHEST - NEAREST) * (step < STEPS ? step : STEPS) / STEPS);
}

/* The lens with that field of view across the smaller side of a picture. */
static int lens_of(const struct demo_context *context, fx_t fov, fx_t distance, struct ph_projection *lens)
{
    struct ph_projection square;
    const int status = ph_projection_perspective(&square, fov, FX_ONE, FX_HALF, FX_INT(60));
    *lens = demo_perspective(context, square.scale_y_q20, FX_HALF, distance + FX_INT(40));
    return status;
}

static int hitchcock_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct ph_projection lens;
    const fx_t distance = distance_at(frame);
    const struct ph_xform view = ph_xform_translate(0, -EYE_HEIGHT, -distance);
    const int status = lens_of(context, ph_fov_of(VIEW_HEIGHT, distance), distance, &lens);
    if (context->width < 64 || context->height < 64) {
        lens = demo_below(lens, context->height, demo_strip(context, 1));
    }
    return status ? status : demo_begin(context, r, &view, &lens, &demo_daylight, demo_sky(context, 150, 190, 225));
}

static int hitchcock_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct hitchcock *const h = context->state;
    const struct ph_xform spin = ph_xform_rotate_y(frame << 26); /* 8 turns a loop */
    context->frame = frame;
    int status = hitchcock_camera(context, r, frame);
    status = status == PH_OK ? ph_draw_mesh(r, &h->top, &spin) : status;
    for (int32_t i = 0; i < 2 * PAIRS && status == PH_OK; i++) {
        const bool near = i >> 1 < h->near_pairs;
        struct ph_xform place = near ? ph_xform_identity : ph_xform_rotate_y(i & 1 ? RIGHT_TURN : LEFT_TURN);
        place.t = (struct fx_vec3){(i & 1 ? FX_ONE : -FX_ONE) * 17 / 10, 0, (i >> 1) * (FX_ONE * -5 / 2) - FX_ONE};
        status = ph_draw_mesh(r, near ? &h->column : &h->far_column, &place);
    }
    struct ph_xform below = ph_xform_scale(h->floor_scale);
    below.t.z = FLOOR_MIDDLE;
    return status ? status : ph_draw_mesh(r, &h->floor, &below);
}

/* The angle, in the gap of sky above the top; where that is narrow without its name, and not where it is narrower. */
static uint32_t hitchcock_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    const int32_t w = context->width, h = context->height, smaller = w < h ? w : h, y = 2 + smaller / 64;
    if (smaller >= 40 && demo_text_reaches(r, band, lines, y)) {
        char text[4 + FX_TEXT_SIZE] = "FOV ";
        fx_to_text_rounded(ph_fov_of(VIEW_HEIGHT, distance_at(context->frame)), 0, text + 4);
        demo_text(r, band, lines, pixels, (w + 1) / 2, y, smaller >= 128 ? text : text + 4);
    }
    return lines;
}

#define VERTICES(sides, column, far, cells)                                                                            \
    (MODEL_GROUND_VERTICES(cells) + MODEL_LATHE_VERTICES(sides, TOP_POINTS) +                                          \
     2 * (PAIRS - (far)) * MODEL_LATHE_VERTICES(column, COLUMN_POINTS) +                                               \
     2 * (far)*MODEL_LATHE_ARC_VERTICES(FAR_SEEN, COLUMN_POINTS))

/* For pictures of kits, which are narrower, and for little memory. */
static const struct demo_level coarser[] = {
    {.arena_bytes = ARENA_FINE,
     .vertex_max = VERTICES(TOP_SIDES, COLUMN_SIDES, 0, CELLS),
     .triangle_max = 848,
     .enough_px = 135},
    {.arena_bytes = ARENA_KIT,
     .vertex_max = VERTICES(TOP_KIT, COLUMN_KIT, PAIRS - NEAR_PAIRS, CELLS),
     .triangle_max = 620,
     .enough_px = 135},
    {.arena_bytes = ARENA_FEW, .vertex_max = VERTICES(TOP_FEW, COLUMN_FEW, 0, CELLS_FEW), .triangle_max = 440},
};

/* ---- zoom ------------------------------------------------------------------------------------------------------ */

static int zoom_init(struct demo_context *context)
{
    static const struct fineness fine = {TOP_SIDES, COLUMN_SIDES, 2, PAIRS, ZOOM_PAIRS},
                                 kit = {TOP_KIT, COLUMN_KIT, 2, PAIRS, ZOOM_PAIRS},
                                 few = {TOP_FEW, COLUMN_FEW, 2, PAIRS, ZOOM_FEW};
    const size_t size = context->arena.size;
    return make_scene(context, size >= ZOOM_ARENA_FINE ? &fine : size >= ZOOM_ARENA_KIT ? &kit : &few);
}

struct shot {
    fx_t fov, distance; /* degrees, units */
};

static struct shot shot_at(uint32_t frame, bool dolly)
{
    const fx_t seen = fx_lerp_sat(SEEN_LEAST, SEEN_MOST, demo_swing(frame, ZOOM_LOOP));
    return dolly ? (struct shot){DOLLY_FOV, ph_distance_of(seen, DOLLY_FOV)}
                 : (struct shot){ph_fov_of(seen, ZOOM_AT), ZOOM_AT};
}

/* A walk so narrow, between columns so low that each half of the picture holds all of it. */
static int draw_walk(struct ph_renderer *r, const struct hitchcock *h, uint32_t frame)
{
    const struct ph_xform spin = ph_xform_rotate_y(frame << 26);
    int status = ph_draw_mesh(r, &h->top, &spin);
    for (int32_t i = 0; i < 2 * h->pairs && status == PH_OK; i++) {
        struct ph_xform place = ph_xform_scale(FX_ONE * 7 / 10);
        place.t = (struct fx_vec3){(i & 1 ? FX_ONE : -FX_ONE) * 14 / 10, 0, (i >> 1) * (FX_ONE * -5 / 2) - FX_INT(2)};
        status = ph_draw_mesh(r, &h->column, &place);
    }
    for (int32_t i = 0; i < WALK && status == PH_OK; i++) {
        struct ph_xform place = ph_xform_scale(FX_ONE * 7 / 5);
        place.t.z = FX_ONE * -11 / 10 - i * (FX_ONE * 14 / 5);
        status = ph_draw_mesh(r, &h->floor, &place);
    }
    return status;
}

static int zoom_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct demo_context half = demo_half(context);
    int status = PH_OK;
    context->frame = frame;
    for (uint32_t dolly = 0; dolly < 2 && status == PH_OK; dolly++) {
        const struct shot shot = shot_at(frame, dolly);
        const struct ph_xform view = ph_xform_translate(0, -EYE_HEIGHT, -shot.distance);
        struct ph_projection lens;
        status = lens_of(&half, shot.fov, shot.distance, &lens);
        lens = demo_in_half(context, demo_below(lens, half.height, demo_strip(context, 2)), dolly);
        status = status  ? status
                 : dolly ? demo_camera(context, r, &view, &lens)
                         : demo_begin(context, r, &view, &lens, &demo_daylight, demo_sky(context, 150, 190, 225));
        status = status ? status : draw_walk(r, context->state, frame);
    }
    return status;
}

/* Degrees and distance, "FOV 24 AT 9.0", as far as there is room; in the smallest halves one after the other. */
static void write_shot(const struct demo_context *context, bool dolly, char text[SHOT_TEXT])
{
    const struct shot shot = shot_at(context->frame, dolly);
    const uint16_t width = demo_half(context).width;
    const bool tiny = width < 60;
    if (!tiny || context->frame % (ZOOM_LOOP / 2) < ZOOM_LOOP / 4) {
        text = demo_add_text(text, width >= 84 ? "FOV " : tiny ? "FOV" : "");
        text += fx_to_text_rounded(shot.fov, 0, text);
    }
    if (!tiny || context->frame % (ZOOM_LOOP / 2) >= ZOOM_LOOP / 4) {
        text = demo_add_text(text, tiny ? "AT" : " AT ");
        fx_to_text_rounded(shot.distance, 1, text);
    }
}

static uint32_t zoom_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    for (uint32_t dolly = 0; dolly < 2; dolly++) {
        demo_half_text(context, r, band, lines, pixels, dolly, 0, dolly ? "DOLLY" : "ZOOM");
        if (demo_text_reaches(r, band, lines, demo_half_text_y(context, dolly, 1))) { /* the angle takes many sines */
            char text[SHOT_TEXT];
            write_shot(context, dolly, text);
            demo_half_text(context, r, band, lines, pixels, dolly, 1, text);
        }
    }
    return lines;
}

#define ZOOM_VERTICES(sides, column, pairs)                                                                            \
    (2 * (9 * WALK + MODEL_LATHE_VERTICES(sides, TOP_POINTS) + 2 * (pairs)*MODEL_LATHE_VERTICES(column, COLUMN_POINTS)))

/* For pictures of kits, of which each half is narrower still, and for little memory. */
static const struct demo_level zoom_coarser[] = {
    {.arena_bytes = ZOOM_ARENA_KIT,
     .vertex_max = ZOOM_VERTICES(TOP_KIT, COLUMN_KIT, ZOOM_PAIRS),
     .triangle_max = 1130,
     .enough_px = 135},
    {.arena_bytes = ZOOM_ARENA_FEW, .vertex_max = ZOOM_VERTICES(TOP_FEW, COLUMN_FEW, ZOOM_FEW), .triangle_max = 520},
};

const struct demo demo_zoom = {
    .name = "zoom",
    .summary = "zoom beside dolly: the same size of the top, another perspective",
    .loop_frames = ZOOM_LOOP,
    .arena_bytes = ZOOM_ARENA_FINE,
    .vertex_max = ZOOM_VERTICES(TOP_SIDES, COLUMN_SIDES, ZOOM_PAIRS),
    .triangle_max = 1400,
    .coarser = zoom_coarser,
    .coarser_count = sizeof zoom_coarser / sizeof zoom_coarser[0],
    .init = zoom_init,
    .frame = zoom_frame,
    .band = zoom_band,
};

const struct demo demo_hitchcock = {
    .name = "hitchcock",
    .summary = "dolly out, zoom in: the top keeps its size, the columns behind it do not",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ARENA_FINE,
    .vertex_max = VERTICES(TOP_SIDES, COLUMN_SIDES, 0, CELLS),
    .triangle_max = 1000,
    .corner_max = 40,
    .coarser = coarser,
    .coarser_count = sizeof coarser / sizeof coarser[0],
    .init = hitchcock_init,
    .frame = hitchcock_frame,
    .band = hitchcock_band,
};
