/*
 * pinhole: the camera that all others imitate (sources: K. Juenemann, HAW Hamburg, chapter 9; course 4600, notes 4.1).
 *
 *   camera   a house before a box with a hole. Light goes straight through the hole, so the image on the wall behind it
 *            is upside down. On a plane as far before the hole it is upright, and otherwise the same: that is where
 *            graphics puts it. Both images are the house times a projection onto a plane: [dE 0; -n^T 0] with d for the
 *            plane in front, and with the negative distance -d for the wall behind.
 *
 *   plane    the plane before the hole turns, and the same light draws another image on it: [dE 0; -n^T 0] with its
 *            normal n. Rays go on through the same points of house and image, however the plane stands.
 *
 *   depth    why depth is a + b/z. Four straight lines between near and far plane, seen from the side in normalized
 *            device coordinates: on the left z stays as it is, and they become curves; on the right it is a + b/z, and
 *            they stay straight. The thin lines are the chords.
 *
 * The view `all` shows them one after the other. Between the house and the curves a shutter closes and opens.
 */
#include "camera.h"
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES 1024
#define VIEW_FRAMES 256
#define DEPTH_FROM  384 /* of `all`: the first frame of depth, and the first after it */
#define DEPTH_TO    (DEPTH_FROM + VIEW_FRAMES)
#define SHUTTER     12 /* frames in which it closes, and opens */
#define FOCAL       (FX_ONE * 3 / 2)
#define HOUSE_Z     (FX_ONE * -16 / 5)
#define CORNERS     15
#define TRIANGLES   7
#define COLOURS     3 /* wall, roof, door */
#define BACKGROUND  ph_rgb565(16, 22, 36)
#define BOX         (FX_ONE * 4 / 5) /* half the size of the box, and of the plane */
#define CURVES      4
#define SAMPLES     16
#define NEAR_Z      FX_ONE
#define FAR_Z       FX_INT(8)

enum { VIEW_ALL, VIEW_CAMERA, VIEW_PLANE, VIEW_DEPTH };
enum { LINE_BOX, LINE_PLANE, LINE_RAY, LINE_CHORD, LINES };

/* The house's corners in sixteenths: the wall, the chimney, the roof, and the door, which lies on the wall. */
static const int8_t house[CORNERS][2] = {{-14, -14}, {14, -14}, {14, 4},   {-14, 4}, {8, 12},
                                         {12, 9},    {12, 18},  {8, 18},   {-18, 4}, {18, 4},
                                         {0, 18},    {-9, -14}, {-2, -14}, {-2, -3}, {-9, -3}};
static const uint16_t triangles[TRIANGLES][3] = {{0, 1, 2},  {0, 2, 3},    {4, 5, 6},   {4, 6, 7},
                                                 {8, 9, 10}, {11, 12, 13}, {11, 13, 14}};
static const struct ph_part parts[COLOURS] = {{0, 4, 0}, {4, 1, 1}, {5, 2, 2}};
static const uint8_t rays[] = {0, 1, 10};

struct pinhole {
    struct ph_material colours[COLOURS], lines[LINES], curves[CURVES];
    uint16_t edges[SAMPLES][2]; /* of a curve */
    struct fx_vec3 points[SAMPLES + 1];
    fx_t across[2][SAMPLES + 1]; /* where its points are from left to right: z as it is, and a + b/z */
    struct fx_vec3 corners[CORNERS], image[CORNERS]; /* of the house */
    struct ph_xform view;                            /* of the camera's box */
    struct ph_projection lens, halves[2];            /* for it, and for depth */
    struct ph_mat4 device;                           /* to clip coordinates, for depth */
};

/* Box and house are side by side: they need the width, and are half as high. */
static int32_t scale_of(const struct demo_context *context)
{
    const int32_t w = context->width, h = context->height, wide = 2 * w > 3 * h ? 3 * h / 2 : w;
    return FX_ONE * 16 * 27 / 10 / h * (wide > h ? wide : h);
}

/* How far point k of a curve is from near to far: points are denser where the curve bends. */
static fx_t curve_share(int32_t k)
{
    return k * k * FX_ONE / (SAMPLES * SAMPLES);
}

static struct ph_vec4 clip_place(const struct ph_mat4 *device, fx_t y, int32_t k)
{
    return ph_mat4_apply(device, (struct ph_vec4){0, y, -fx_lerp_sat(NEAR_Z, FAR_Z, curve_share(k)), FX_ONE});
}

/* Depth goes from left to right, and is the same in all curves. */
static void make_across(struct pinhole *p)
{
    for (int32_t k = 0; k <= SAMPLES; k++) {
        const fx_t z = fx_lerp_sat(NEAR_Z, FAR_Z, curve_share(k));
        const struct ph_vec4 v = clip_place(&p->device, 0, k);
        p->across[0][k] = fx_div_sat(2 * z - FAR_Z - NEAR_Z, FAR_Z - NEAR_Z);
        p->across[1][k] = fx_div_sat(v.z, v.w);
    }
}

/* The cameras, which stand still. */
static void make_cameras(const struct demo_context *context, struct pinhole *p)
{
    static const struct ph_projection seen = {PH_PERSPECTIVE, 1 << 20, 1 << 20, 0, 0, NEAR_Z, FAR_Z, NULL};
    const struct ph_xform look = demo_look(FX_ONE * 26 / 5, FX_INT(2), FX_ONE * 26 / 5, 0, 0, 0);
    const struct ph_xform back = ph_xform_translate(0, 0, FX_ONE * 9 / 10);
    const struct demo_context half = demo_half(context);
    struct ph_projection flat = demo_perspective(&half, FX_ONE * 16 * 4 / 5, FX_HALF, FX_INT(4));
    flat.kind = PH_ORTHOGRAPHIC;
    flat = demo_below(flat, half.height, demo_strip(context, 1));
    p->view = ph_xform_mul(&look, &back);
    p->lens = demo_perspective(context, scale_of(context), FX_HALF, FX_INT(20));
    p->halves[0] = demo_in_half(context, flat, false);
    p->halves[1] = demo_in_half(context, flat, true);
    ph_matrix_projection(&p->device, &seen, PH_GL);
    make_across(p);
}

static int pinhole_init(struct demo_context *context)
{
    static const uint8_t curves[CURVES][3] = {{255, 150, 60}, {250, 220, 90}, {120, 230, 120}, {110, 180, 255}};
    struct pinhole *const p = context->state = demo_alloc(&context->arena, sizeof(*p));
    if (!p) {
        return PH_ERR_NOMEM;
    }
    p->colours[0] = demo_unlit(245, 225, 180);
    p->colours[1] = demo_unlit(225, 70, 50);
    p->colours[2] = demo_unlit(60, 110, 200);
    p->colours[0].two_sided = p->colours[1].two_sided = p->colours[2].two_sided = 1;
    p->colours[2].depth_bias_slope = 8;
    p->colours[2].depth_bias = 16;
    p->lines[LINE_BOX] = demo_unlit(150, 165, 190);
    p->lines[LINE_PLANE] = demo_unlit(110, 220, 160);
    p->lines[LINE_RAY] = demo_unlit(235, 200, 70);
    p->lines[LINE_CHORD] = demo_unlit(90, 100, 125);
    for (uint32_t i = 0; i < CURVES; i++) {
        p->curves[i] = demo_unlit(curves[i][0], curves[i][1], curves[i][2]);
        p->curves[i].shading = PH_SHADE_WIRE;
    }
    for (uint16_t i = 0; i < SAMPLES; i++) {
        p->edges[i][0] = i;
        p->edges[i][1] = i + 1;
    }
    make_cameras(context, p);
    return PH_OK;
}

/* ---- the camera ------------------------------------------------------------------------------------------------ */

/* The house in the world; it turns a little about its axis. */
static void make_house(struct fx_vec3 corners[CORNERS], uint32_t frame)
{
    const uint32_t sway = (uint32_t)fx_sin((fx_t)((frame + VIEW_FRAMES / 8) << 8)) << 12; /* 22 degrees either way */
    const struct ph_xform place = demo_place(0, 0, HOUSE_Z, sway);
    for (uint32_t i = 0; i < CORNERS; i++) {
        corners[i] =
            ph_xform_point(&place, (struct fx_vec3){house[i][0] * (FX_ONE / 16), house[i][1] * (FX_ONE / 16), 0});
    }
}

/* Projects through the origin onto the plane that goes through (0, 0, -distance), with its normal along the turned z.
 */
static void project(struct fx_vec3 to[CORNERS], const struct fx_vec3 from[CORNERS], const struct ph_xform *turn,
                    fx_t distance)
{
    const struct fx_vec3 normal_q30 = {turn->r[0][2], turn->r[1][2], turn->r[2][2]};
    const struct ph_mat4 onto =
        ph_matrix_plane(normal_q30, (fx_t)((fx_mul_wide(distance, normal_q30.z) + (1 << 29)) >> 30));
    for (uint32_t i = 0; i < CORNERS; i++) {
        const struct ph_vec4 v = ph_mat4_apply(&onto, (struct ph_vec4){from[i].x, from[i].y, from[i].z, FX_ONE});
        to[i] = (struct fx_vec3){fx_div_sat(v.x, v.w), fx_div_sat(v.y, v.w), fx_div_sat(v.z, v.w)};
    }
}

static int draw_house(struct ph_renderer *r, const struct pinhole *p, const struct fx_vec3 corners[CORNERS])
{
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = triangles,
                                 .parts = parts,
                                 .materials = p->colours,
                                 .vertex_count = CORNERS,
                                 .triangle_count = TRIANGLES,
                                 .part_count = COLOURS};
    return ph_draw_mesh(r, &mesh, &ph_xform_identity);
}

/* Corner i of a square at z. */
static struct fx_vec3 square(uint32_t i, fx_t half, fx_t z)
{
    return (struct fx_vec3){(i + 1) & 2 ? half : -half, i & 2 ? half : -half, z};
}

/* How the plane before the hole stands: 20 degrees to either side, and 13 up and down twice as often. */
static struct ph_xform plane_turn(const struct demo_context *context, uint32_t frame)
{
    const uint32_t phase = frame % LOOP_FRAMES;
    const bool far_from_depth = phase < VIEW_FRAMES || phase >= LOOP_FRAMES - VIEW_FRAMES;
    const bool turns = demo_view_is(context, &demo_pinhole, VIEW_PLANE) ||
                       (far_from_depth && demo_view_is(context, &demo_pinhole, VIEW_ALL));
    const uint32_t at = turns ? frame : 0;
    const struct ph_xform yaw = ph_xform_rotate_y((uint32_t)fx_sin((fx_t)(at << 8)) * 3640);
    const struct ph_xform pitch = ph_xform_rotate_x((uint32_t)fx_sin((fx_t)(at << 9)) * 2366);
    return ph_xform_mul(&yaw, &pitch);
}

static void draw_plane(struct ph_renderer *r, const struct pinhole *p, const struct ph_xform *turn)
{
    struct fx_vec3 at[4];
    for (uint32_t i = 0; i < 4; i++) {
        at[i] = ph_xform_point(turn, square(i, BOX, 0));
        at[i].z -= FOCAL;
    }
    for (uint32_t i = 0; i < 4; i++) {
        ph_draw_line(r, at[i], at[(i + 1) % 4], &p->lines[LINE_PLANE]);
    }
}

static void draw_box(struct ph_renderer *r, const struct pinhole *p)
{
    const struct ph_material *const line = &p->lines[LINE_BOX];
    for (uint32_t i = 0; i < 4; i++) {
        ph_draw_line(r, square(i, BOX, 0), square(i + 1, BOX, 0), line);
        ph_draw_line(r, square(i, BOX, FOCAL), square(i + 1, BOX, FOCAL), line);
        ph_draw_line(r, square(i, BOX, 0), square(i, BOX, FOCAL), line);
        ph_draw_line(r, square(i, BOX / 16, 0), square(i + 1, BOX / 16, 0), line);
    }
}

static int draw_camera(const struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct pinhole *const p = context->state;
    struct fx_vec3 *const corners = p->corners, *const image = p->image;
    const struct ph_xform turn = plane_turn(context, frame);
    int status = demo_begin(context, r, &p->view, &p->lens, NULL, BACKGROUND);
    make_house(corners, frame);
    status = status ? status : draw_house(r, p, corners);
    project(image, corners, &turn, FOCAL);
    status = status ? status : draw_house(r, p, image);
    project(image, corners, &ph_xform_identity, -FOCAL);
    status = status ? status : draw_house(r, p, image);
    if (status == PH_OK) {
        draw_box(r, p);
        draw_plane(r, p, &turn);
        for (uint32_t i = 0; i < sizeof(rays); i++) {
            ph_draw_line(r, corners[rays[i]], image[rays[i]], &p->lines[LINE_RAY]);
        }
    }
    return status;
}

/* ---- depth ----------------------------------------------------------------------------------------------------- */

/* A straight line from y0 at the near plane to y1 at the far plane, and its chord, in normalized device coordinates. */
static int draw_curve(struct ph_renderer *r, struct pinhole *p, uint32_t i, fx_t y0, fx_t y1, bool naive)
{
    static const struct ph_part all = {0, 0, 0};
    struct fx_vec3 *const points = p->points;
    const struct ph_mesh mesh = {.positions = points,
                                 .edges = p->edges,
                                 .parts = &all,
                                 .materials = &p->curves[i],
                                 .vertex_count = SAMPLES + 1,
                                 .edge_count = SAMPLES,
                                 .part_count = 1};
    for (int32_t k = 0; k <= SAMPLES; k++) {
        const struct ph_vec4 v = clip_place(&p->device, fx_lerp_sat(y0, y1, curve_share(k)), k);
        points[k] = (struct fx_vec3){p->across[naive ? 0 : 1][k], fx_div_sat(v.y, v.w), 0};
    }
    const int status = ph_draw_mesh(r, &mesh, &ph_xform_identity);
    ph_draw_line(r, points[0], points[SAMPLES], &p->lines[LINE_CHORD]); /* at the same depth: it hides no curve */
    return status;
}

static int draw_curves(struct ph_renderer *r, struct pinhole *p, uint32_t frame, bool naive)
{
    const fx_t spread = FX_ONE + 5 * demo_swing(frame, VIEW_FRAMES);
    int status = PH_OK;
    for (int32_t i = 0; i < CURVES && status == PH_OK; i++) {
        const fx_t y0 = (2 * i - 3) * (FX_ONE * 3 / 10);
        status = draw_curve(r, p, (uint32_t)i, y0, fx_mul_sat(y0, spread) - FX_ONE, naive);
    }
    for (uint32_t i = 0; i < 4; i++) {
        ph_draw_line(r, square(i, FX_ONE, 0), square(i + 1, FX_ONE, 0), &p->lines[LINE_BOX]);
    }
    return status;
}

static int draw_depth(const struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct pinhole *const p = context->state;
    const struct ph_xform view = ph_xform_translate(0, 0, -FX_ONE);
    int status = demo_begin(context, r, &view, &p->halves[0], NULL, BACKGROUND);
    status = status ? status : draw_curves(r, p, frame, true);
    status = status ? status : demo_camera(context, r, &view, &p->halves[1]);
    return status ? status : draw_curves(r, p, frame, false);
}

/* ---- one after the other --------------------------------------------------------------------------------------- */

static bool is_depth(const struct demo_context *context, uint32_t frame)
{
    const uint32_t phase = frame % LOOP_FRAMES;
    return demo_view_is(context, &demo_pinhole, VIEW_ALL) ? phase >= DEPTH_FROM && phase < DEPTH_TO
                                                          : demo_view_is(context, &demo_pinhole, VIEW_DEPTH);
}

static int pinhole_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    context->frame = frame;
    return is_depth(context, frame) ? draw_depth(context, r, frame) : draw_camera(context, r, frame);
}

/* Lines that the shutter covers from above, and as many from below. */
static int32_t shut_lines(const struct demo_context *context)
{
    const int32_t phase = (int32_t)(context->frame % LOOP_FRAMES);
    const int32_t away = phase < (DEPTH_FROM + DEPTH_TO) / 2 ? DEPTH_FROM - phase : DEPTH_TO - phase;
    const int32_t closed = SHUTTER - (away < 0 ? -away : away);
    const bool shows = demo_view_is(context, &demo_pinhole, VIEW_ALL) && closed > 0;
    return shows ? (context->height + 1) / 2 * closed / SHUTTER : 0;
}

static void shut(const struct demo_context *context, int32_t first, uint32_t lines, uint16_t *pixels)
{
    const int32_t covered = shut_lines(context);
    for (int32_t i = 0; i < (int32_t)lines; i++) {
        const bool open = first + i >= covered && first + i < context->height - covered;
        for (int32_t x = 0; x < context->width && !open; x++) {
            pixels[i * context->width + x] = BACKGROUND;
        }
    }
}

static uint32_t pinhole_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    if (is_depth(context, context->frame)) {
        const bool narrow = demo_half(context).width < 60;
        demo_half_text(context, r, band, lines, pixels, false, 0, narrow ? "Z" : "Z KEPT");
        demo_half_text(context, r, band, lines, pixels, true, 0, narrow ? "A+B/Z" : "A + B/Z");
    }
    shut(context, (int32_t)(band * (uint32_t)(r->config.band_height >> r->samples_log2)), lines, pixels);
    return lines;
}

static const char *const views[] = {
    [VIEW_ALL] = "all", [VIEW_CAMERA] = "camera", [VIEW_PLANE] = "plane", [VIEW_DEPTH] = "depth", NULL};

const struct demo demo_pinhole = {
    .name = "pinhole",
    .summary = "a pinhole camera: its image upside down behind the hole, upright on any plane before it",
    .views = views,
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = sizeof(struct pinhole),
    .vertex_max = 2 * CURVES * (SAMPLES + 1),
    .triangle_max = 214,
    .corner_max = 100,
    .init = pinhole_init,
    .frame = pinhole_frame,
    .band = pinhole_band,
};
