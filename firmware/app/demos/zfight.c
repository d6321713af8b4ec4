/*
 * zfight: pairs of parallel plates, a yellow one just before a blue one, at growing distances, each pair as large on
 * the screen as the others (source: K. Juenemann, HAW Hamburg, chapter 9, and course 4600, notes 4.1, on
 * z-fighting). Where blue shows through the yellow, the depth buffer can no longer tell them apart. The plates tilt
 * slowly, so that the pattern moves.
 *
 * The same plates stand on both sides. On the left is the picture's own depth format, on the right fixed16, or float16
 * where fixed16 is on the left: a second renderer draws them, half as wide. When a band's left side is drawn, its depth
 * is no longer needed: there are then the depth and the pixels of the right side.
 */
#include "demo_scene.h"
#include "models.h"
#include "overlay.h"

#include <string.h>

#define LOOP_FRAMES 256
#define PAIRS       6
#define TITLE       10 /* bytes of a label */
#define LEAST_PX    3  /* half a plate with a number above it */
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
    struct ph_renderer right;
    uint32_t bins[1024]; /* of the right side: a picture may have as many bands */
    uint64_t list[1024 / 8];
};

/* How the pairs of a side are arranged, in pixels. */
struct layout {
    int32_t columns, rows;
    int32_t cell_width, cell_height; /* of a pair, with its number above it */
    int32_t number;                  /* rows for the number; 0: there is no room, and one text has the range */
    int32_t half;                    /* of a plate */
    int32_t top, outside;            /* rows above the cells; columns beside them, away from the other side */
};

/* Where the glass may be round, the cells keep away from its corners. */
static struct layout layout_in(const struct demo_context *context, int32_t columns, bool numbered)
{
    const int32_t corner = demo_may_be_round(context) ? demo_text_inset(context) : 0;
    struct layout l = {.columns = columns, .rows = PAIRS / columns};
    l.outside = corner;
    l.top = demo_strip(context, numbered ? 1 : 2);
    l.number = numbered ? DEMO_TEXT_LINE : 0;
    l.cell_width = (context->width / 2 - l.outside) / columns;
    l.cell_height = (context->height - l.top - corner) / l.rows;
    const int32_t high = l.cell_height - l.number, smaller = l.cell_width < high ? l.cell_width : high;
    l.half = smaller > 4 ? smaller * 3 / 8 : 1;
    return l;
}

/* The arrangement with the largest plates, with or without numbers; half 0: no cell is wide enough for a number. */
static struct layout largest(const struct demo_context *context, bool numbered)
{
    const int32_t least = numbered ? ph_overlay_width(labels[PAIRS - 1], 1) + 1 : 0;
    struct layout best = {0};
    for (int32_t columns = 1; columns <= PAIRS; columns++) {
        const struct layout l = layout_in(context, columns, numbered);
        best = PAIRS % columns == 0 && l.half > best.half && l.cell_width >= least ? l : best;
    }
    return best;
}

static struct layout layout_of(const struct demo_context *context)
{
    const struct layout numbered = largest(context, true);
    return numbered.half >= LEAST_PX ? numbered : largest(context, false);
}

/* Half of so many pixels of a picture, at a distance of 1. */
static fx_t at_half_px(const struct demo_context *context, int32_t px)
{
    const fx_t tan_30 = 37837;
    const int32_t w = context->width / 2 + 1, h = context->height;
    return (fx_t)(fx_mul_wide(tan_30, px) / (w < h ? w : h));
}

static void make_plates(const struct demo_context *context, struct zfight *z, const struct layout *l)
{
    static const int8_t corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (uint32_t i = 0; i < PAIRS; i++) {
        for (uint32_t back = 0; back < 2; back++) {
            const fx_t half = at_half_px(context, 2 * l->half) * distances[i] * (back ? 7 : 8) / 8;
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
    make_plates(context, z, &l);
    context->state = z;
    return PH_OK;
}

/* The middle of pair i in half pixels from the left border of its side, and from the top of the picture. */
static void place_of(const struct demo_context *context, const struct layout *l, int32_t i, bool right, int32_t *x2,
                     int32_t *y2)
{
    *x2 = (2 * (i % l->columns) + 1) * l->cell_width + (right ? 0 : 2 * l->outside);
    *y2 = (2 * (i / l->columns) + 1) * l->cell_height + 2 * l->top + l->number;
    *x2 += (context->width / 2 - l->outside) % l->columns; /* what cells leave goes to both sides */
}

/* Makes the scene of one side. The left side is in a picture of full width. */
static int draw_side(const struct demo_context *context, struct ph_renderer *r, uint32_t frame, bool right)
{
    const struct zfight *const z = context->state;
    const struct layout l = layout_of(context);
    struct demo_context side = *context;
    side.width = context->width / 2 + 1;
    struct ph_projection p = demo_perspective(&side, DEMO_SCALE_60_Q20, NEAR_Z, FAR_Z);
    p.scale_x_q20 = context->camera.projection_set ? context->camera.projection.scale_x_q20 : p.scale_x_q20 / 2;
    side.camera.projection.scale_x_q20 = p.scale_x_q20 *= right ? 2 : 1;
    side.camera.projection.shift_x = p.shift_x = right ? 0 : FX_HALF;
    const uint32_t sway = (uint32_t)fx_sin((fx_t)(frame << 8)) << 12; /* 22 degrees either way */
    const uint32_t nod = (uint32_t)fx_cos((fx_t)(frame << 8)) << 11;
    const struct ph_xform yaw = ph_xform_rotate_y(sway);
    const struct ph_xform pitch = ph_xform_rotate_x(nod);
    int status = demo_begin(&side, r, &ph_xform_identity, &p, NULL, ph_rgb565(18, 20, 30));
    for (int32_t i = 0; i < PAIRS && status == PH_OK; i++) {
        struct ph_xform place = ph_xform_mul(&yaw, &pitch);
        int32_t x2, y2;
        place_of(context, &l, i, right, &x2, &y2);
        place.t = (struct fx_vec3){at_half_px(context, x2 - context->width / 2) * distances[i],
                                   at_half_px(context, context->height - y2) * distances[i], FX_INT(-distances[i])};
        status = ph_draw_mesh(r, &z->plates[i][1], &place); /* the blue one first: it stays where the two are equal */
        status = status ? status : ph_draw_mesh(r, &z->plates[i][0], &place);
    }
    return status;
}

static int zfight_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    context->frame = frame;
    return draw_side(context, r, frame, false);
}

/* Makes the scene of the right side, with the depth and the pixels of a band in the depth of the left side's bands. */
static int begin_right(const struct demo_context *context, const struct ph_renderer *left)
{
    struct zfight *const z = context->state;
    struct ph_config config = left->config;
    config.width = context->width / 2;
    config.height = context->height;
    config.band_height >>= left->samples_log2;
    config.depth_format = left->stats.depth_format == PH_DEPTH_FIXED16 ? PH_DEPTH_FLOAT16 : PH_DEPTH_FIXED16;
    config.vertices = config.triangles = z->list;
    config.vertex_max = sizeof(z->list) / PH_VERTEX_BYTES_32;
    config.triangle_max = 4 * PAIRS;
    config.bins = z->bins;
    config.bin_max = sizeof(z->bins) / sizeof(z->bins[0]);
    config.samples = NULL;
    config.other_core = NULL;
    const int status = ph_renderer_init(&z->right, &config);
    return status ? status : draw_side(context, &z->right, context->frame, true);
}

static void draw_right(struct ph_renderer *right, uint32_t band, uint16_t *pixels, uint32_t width)
{
    const uint32_t w = right->config.width;
    uint16_t *const drawn = (uint16_t *)right->config.depth + w * right->config.band_height;
    const uint32_t lines = ph_draw_band(right, band, drawn);
    for (uint32_t y = 0; y < lines; y++) {
        memcpy(pixels + (y + 1) * width - w, drawn + y * w, w * sizeof(*drawn));
    }
}

/* The name of a depth format in capitals, as far as its first word goes; where it is short, three letters of it and the
 * bits. */
static void title_of(const struct ph_depth_format *format, bool is_short, char title[TITLE])
{
    const char *const name = format->name;
    int n = 0;
    for (int i = 0; n < TITLE - 1 && name[i] != '\0' && name[i] != '-'; i++) {
        const bool letter = name[i] >= 'a' && name[i] <= 'z';
        if (!is_short || !letter || n < 3) {
            title[n++] = letter ? (char)(name[i] - 'a' + 'A') : name[i];
        }
    }
    title[n] = '\0';
}

/* Labels a side: the format, and the distance of each pair above it, or the first and the last below the format. */
static void label_side(const struct demo_context *context, const struct ph_renderer *r, uint32_t band, uint32_t lines,
                       uint16_t *pixels, bool right, const struct ph_depth_format *format)
{
    char name[TITLE];
    const struct layout l = layout_of(context);
    const int32_t w = context->width / 2, x = right ? context->width - w : 0, inset = demo_text_inset(context);
    const int32_t middle = x + (w + (right ? -l.outside : l.outside)) / 2;
    title_of(format, w < 60, name);
    demo_text(r, band, lines, pixels, middle, inset, name);
    if (l.number == 0) {
        demo_text(r, band, lines, pixels, middle, inset + DEMO_TEXT_LINE, "2-100");
    }
    for (int32_t i = 0; i < PAIRS && l.number > 0; i++) {
        int32_t x2, y2;
        place_of(context, &l, i, right, &x2, &y2);
        demo_text(r, band, lines, pixels, x + x2 / 2, (y2 - l.cell_height - l.number) / 2 + 1, labels[i]);
    }
}

static uint32_t zfight_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    struct zfight *const z = context->state;
    const uint32_t lines = ph_draw_band(r, band, pixels), width = context->width;
    if (width > 1 && (band > 0 || begin_right(context, r) == PH_OK)) {
        if (band == 0) {
            ph_frame_bands(&z->right);
        }
        draw_right(&z->right, band, pixels, width);
        label_side(context, r, band, lines, pixels, true, z->right.stats.depth_format);
    }
    label_side(context, r, band, lines, pixels, false, r->stats.depth_format);
    return lines;
}

const struct demo demo_zfight = {
    .name = "zfight",
    .summary = "pairs of plates at growing distances: where one depth format gives up, and where another",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = sizeof(struct zfight),
    .vertex_max = 8 * PAIRS,
    .triangle_max = 4 * PAIRS,
    .init = zfight_init,
    .frame = zfight_frame,
    .band = zfight_band,
};
