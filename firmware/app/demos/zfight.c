/*
 * zfight: pairs of parallel plates, a yellow one just before a blue one, at growing distances, each pair as large on
 * the screen as the others (source: K. Juenemann, HAW Hamburg, chapter 9, and course 4600, notes 4.1, on
 * z-fighting). Where blue shows through the yellow, the depth buffer can no longer tell
 * them apart. The plates tilt slowly, so that the pattern moves. The label says what the buffer holds; compare the
 * formats with the same frame.
 */
#include "demo_scene.h"
#include "models.h"
#include "overlay.h"

#define LOOP_FRAMES 256
#define PAIRS       6
#define COLUMNS     2
#define NEAR_Z      (FX_ONE / 4)
#define FAR_Z       FX_INT(200)
#define GAP         (FX_ONE / 64) /* between the plates of a pair */

static const uint8_t distances[PAIRS] = {2, 5, 10, 20, 50, 100};
static const char *const labels[PAIRS] = {"2", "5", "10", "20", "50", "100"};

struct zfight {
    struct ph_mesh plates[PAIRS][2];
    struct ph_material colours[2];
    struct ph_part part;
    struct fx_vec3 corners[PAIRS][2][4];
    uint16_t triangles[2][3];
};

/* Half the size of a plate and the distance between pairs, in shares of their distance, for this shape of picture. */
struct layout {
    fx_t half, step_x, step_y;
};

static struct layout layout_of(const struct demo_context *context)
{
    const fx_t tan_30 = 37837;
    const int32_t w = context->width, h = context->height, smaller = w < h ? w : h;
    const int32_t columns = w > h * 3 / 2 ? PAIRS / 2 : COLUMNS, rows = PAIRS / columns;
    struct layout l;
    l.step_x = (fx_t)(fx_mul_wide(tan_30, 2 * w) / (smaller * columns));
    l.step_y = (fx_t)(fx_mul_wide(tan_30, 2 * h) / (smaller * (rows + 1))); /* one more share above, for the label */
    l.half = (l.step_x < l.step_y ? l.step_x : l.step_y) * 2 / 5;
    return l;
}

static void make_plates(struct zfight *z, const struct layout *l)
{
    static const int8_t corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (uint32_t i = 0; i < PAIRS; i++) {
        for (uint32_t back = 0; back < 2; back++) {
            const fx_t half = l->half * distances[i] * (back ? 7 : 8) / 8;
            for (uint32_t k = 0; k < 4; k++) {
                z->corners[i][back][k] = (struct fx_vec3){corners[k][0] * half, corners[k][1] * half, back ? -GAP : 0};
            }
            z->plates[i][back] = (struct ph_mesh){.positions = z->corners[i][back],
                                                  .triangles = (const uint16_t(*)[3])z->triangles,
                                                  .parts = &z->part,
                                                  .materials = &z->colours[back],
                                                  .vertex_count = 4,
                                                  .triangle_count = 2,
                                                  .part_count = 1};
        }
    }
}

static int zfight_init(struct demo_context *context)
{
    static const uint16_t halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
    struct zfight *const z = demo_alloc(&context->arena, sizeof(*z));
    if (!z) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t k = 0; k < 6; k++) {
        z->triangles[k / 3][k % 3] = halves[k / 3][k % 3];
    }
    z->part = (struct ph_part){0, 2, 0};
    z->colours[0] = demo_unlit(250, 205, 60);
    z->colours[1] = demo_unlit(40, 80, 230);
    const struct layout l = layout_of(context);
    make_plates(z, &l);
    context->state = z;
    return PH_OK;
}

/* The middle of pair i in half steps from the middle of the picture: x to the right, y upwards. */
static void place_of(const struct demo_context *context, uint32_t i, int32_t *x2, int32_t *y2)
{
    const int32_t columns = context->width > context->height * 3 / 2 ? PAIRS / 2 : COLUMNS;
    const int32_t rows = PAIRS / columns;
    *x2 = 2 * ((int32_t)i % columns) - columns + 1;
    *y2 = rows - 2 - 2 * ((int32_t)i / columns);
}

static int zfight_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct zfight *const z = context->state;
    const struct layout l = layout_of(context);
    const struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, NEAR_Z, FAR_Z);
    const uint32_t sway = (uint32_t)fx_sin((fx_t)(frame << 8)) << 12; /* 22 degrees either way */
    const uint32_t nod = (uint32_t)fx_cos((fx_t)(frame << 8)) << 11;
    const struct ph_xform yaw = ph_xform_rotate_y(sway);
    const struct ph_xform pitch = ph_xform_rotate_x(nod);
    int status = demo_begin(context, r, &ph_xform_identity, &projection, NULL, ph_rgb565(18, 20, 30));
    for (uint32_t i = 0; i < PAIRS && status == PH_OK; i++) {
        struct ph_xform place = ph_xform_mul(&yaw, &pitch);
        int32_t x2, y2;
        place_of(context, i, &x2, &y2);
        place.t =
            (struct fx_vec3){l.step_x * distances[i] / 2 * x2, l.step_y * distances[i] / 2 * y2, FX_INT(-distances[i])};
        status = ph_draw_mesh(r, &z->plates[i][1], &place); /* the blue one first: it stays where the two are equal */
        status = status ? status : ph_draw_mesh(r, &z->plates[i][0], &place);
    }
    return status;
}

static uint32_t zfight_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    static const char *const formats[PH_DEPTH_FORMATS] = {[PH_DEPTH_FIXED16] = "FIXED16 1/64 APART",
                                                          [PH_DEPTH_FLOAT16] = "FLOAT16 1/64 APART",
                                                          [PH_DEPTH_FIXED24] = "FIXED24 1/64 APART",
                                                          [PH_DEPTH_FLOAT24] = "FLOAT24 1/64 APART",
                                                          [PH_DEPTH_LINEAR_W] = "LINEAR 1/64 APART"};
    const char *const format = formats[r->stats.depth_format];
    const int32_t columns = context->width > context->height * 3 / 2 ? PAIRS / 2 : COLUMNS;
    const int32_t rows = PAIRS / columns + 1;
    demo_text(r, band, lines, pixels, (context->width - ph_overlay_width(format, 1)) / 2, context->height / 16, format);
    for (uint32_t i = 0; i < PAIRS; i++) {
        int32_t x2, y2;
        place_of(context, i, &x2, &y2);
        const int32_t x = context->width / 2 + x2 * context->width / (2 * columns);
        const int32_t y = context->height / 2 - y2 * context->height / (2 * rows);
        demo_text(r, band, lines, pixels, x - ph_overlay_width(labels[i], 1) / 2, y - PH_FONT_HEIGHT / 2, labels[i]);
    }
    return lines;
}

const struct demo demo_zfight = {
    .name = "zfight",
    .summary = "pairs of plates at growing distances: where the depth buffer gives up; try --depth fixed16",
    .loop_frames = LOOP_FRAMES,
    DEMO_ARENA(sizeof(struct zfight), 1240),
    .vertex_max = 8 * PAIRS,
    .triangle_max = 4 * PAIRS,
    .init = zfight_init,
    .frame = zfight_frame,
    .band = zfight_band,
};
