/*
 * testcard: a picture without text that shows by eye what is wrong with a panel.
 *
 *   a white line on the outermost pixels   missing on one side: window or offset off by one
 *   1, 2, 3, 4 dots towards the corners    clockwise from the top left; counter-clockwise: mirrored
 *   an arrow that points up                not up: wrong rotation
 *   a ring                                 not round: wrong size or pixel aspect
 *   bars: red, green, blue, white, grey    blue first: BGR swapped; on white ground: inverted
 *
 * On a round glass everything but the line and the corners is visible. The card is one orthographic mesh in pixels, x
 * to the right and y upwards, so that every edge lies between pixels.
 */
#include "demo_scene.h"

#define RING_STEPS    64
#define BARS          5
#define DOTS          10
#define QUADS         (4 + DOTS + 1 + BARS) /* frame, dots, shaft of the arrow, bars */
#define VERTICES      (2 * RING_STEPS + 3 + 4 * QUADS)
#define TRIANGLES     (2 * RING_STEPS + 1 + 2 * QUADS)
#define CARD_DISTANCE FX_ONE

struct card {
    struct ph_mesh mesh;
    struct ph_material materials[BARS];
    struct ph_part parts[BARS];
    struct fx_vec3 positions[VERTICES];
    uint16_t triangles[TRIANGLES][3];
};

static uint16_t card_vertex(struct card *card, fx_t x, fx_t y)
{
    card->positions[card->mesh.vertex_count] = (struct fx_vec3){x, y, -CARD_DISTANCE};
    return (uint16_t)card->mesh.vertex_count++;
}

static void card_triangle(struct card *card, uint16_t a, uint16_t b, uint16_t c)
{
    uint16_t *const t = card->triangles[card->mesh.triangle_count++];
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

/* Adds a quad over pixels x0 .. x1 - 1, y0 .. y1 - 1, counted from the lower left pixel. */
static void card_quad(struct card *card, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    const uint16_t a = card_vertex(card, FX_INT(x0), FX_INT(y0)), b = card_vertex(card, FX_INT(x1), FX_INT(y0));
    const uint16_t c = card_vertex(card, FX_INT(x1), FX_INT(y1)), d = card_vertex(card, FX_INT(x0), FX_INT(y1));
    card_triangle(card, a, b, c);
    card_triangle(card, a, c, d);
}

/* Gives this colour to everything that was added since the last call. */
static void card_colour(struct card *card, uint8_t red, uint8_t green, uint8_t blue)
{
    const uint32_t i = card->mesh.part_count++;
    const uint32_t first = i == 0 ? 0 : card->parts[i - 1].first + card->parts[i - 1].count;
    card->materials[i] = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(red, green, blue)};
    card->parts[i] = (struct ph_part){first, card->mesh.triangle_count - first, (uint16_t)i};
}

/* Adds n dots from (x, y) on. Each is `size` pixels wide; the step is twice that, to the right or to the left. */
static void card_dots(struct card *card, int32_t n, int32_t x, int32_t y, int32_t size, bool leftwards)
{
    for (int32_t i = 0; i < n; i++) {
        const int32_t at = leftwards ? x - (2 * i + 1) * size : x + 2 * i * size;
        card_quad(card, at, y, at + size, y + size);
    }
}

static void card_ring(struct card *card, fx_t x, fx_t y, fx_t radius, fx_t line)
{
    const uint16_t first = (uint16_t)card->mesh.vertex_count;
    for (uint32_t i = 0; i < RING_STEPS; i++) {
        const fx_t turns = (fx_t)(i * (65536 / RING_STEPS)), c = fx_cos(turns), s = fx_sin(turns);
        card_vertex(card, x + fx_mul_sat(radius, c), y + fx_mul_sat(radius, s));
        card_vertex(card, x + fx_mul_sat(radius - line, c), y + fx_mul_sat(radius - line, s));
    }
    for (uint32_t i = 0; i < RING_STEPS; i++) {
        const uint16_t a = (uint16_t)(first + 2 * i), b = (uint16_t)(first + 2 * ((i + 1) % RING_STEPS));
        card_triangle(card, a, b, (uint16_t)(b + 1));
        card_triangle(card, a, (uint16_t)(b + 1), (uint16_t)(a + 1));
    }
}

/* Adds an arrow of head and shaft, `size` pixels high, with its middle at (x, y). */
static void card_arrow(struct card *card, int32_t x, int32_t y, int32_t size)
{
    const int32_t half = size / 2, shaft = size / 8 + 1;
    const uint16_t a = card_vertex(card, FX_INT(x - half), FX_INT(y));
    const uint16_t b = card_vertex(card, FX_INT(x + half), FX_INT(y));
    const uint16_t c = card_vertex(card, FX_INT(x), FX_INT(y + half));
    card_triangle(card, a, b, c);
    card_quad(card, x - shaft, y - half, x + shaft, y);
}

static void card_white_lines(struct card *card, int32_t w, int32_t h)
{
    const int32_t smaller = w < h ? w : h, dot = smaller / 24 > 2 ? smaller / 24 : 2;
    const int32_t left = w / 5; /* inside the circle that touches all sides of a square */
    const int32_t low = h / 10;
    card_quad(card, 0, 0, w, 1);
    card_quad(card, 0, h - 1, w, h);
    card_quad(card, 0, 1, 1, h - 1);
    card_quad(card, w - 1, 1, w, h - 1);
    card_dots(card, 1, left, h - low - dot, dot, false);
    card_dots(card, 2, w - left, h - low - dot, dot, true);
    card_dots(card, 3, w - left, low, dot, true);
    card_dots(card, 4, left, low, dot, false);
}

/* The ring and the arrow are above, the bars below. */
static void card_layout(struct card *card, int32_t w, int32_t h)
{
    const int32_t by_height = h * 27 / 100, by_width = w * 38 / 100;
    const int32_t radius = by_height < by_width ? by_height : by_width, y = h - h * 36 / 100;
    const int32_t bar = w * 15 / 100 > 1 ? w * 15 / 100 : 1, left = (w - BARS * bar) / 2;
    const int32_t top = h * 32 / 100, bottom = h * 18 / 100;
    static const uint8_t colours[BARS][3] = {{255, 255, 255}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {128, 128, 128}};
    static const int8_t places[BARS] = {3, 0, 1, 2, 4};

    card_white_lines(card, w, h);
    card_ring(card, FX_INT(w / 2), FX_INT(y), FX_INT(radius), FX_INT(radius > 40 ? 3 : 2));
    card_arrow(card, w / 2, y, radius);
    for (int32_t i = 0; i < BARS; i++) {
        const int32_t x = left + places[i] * bar;
        card_quad(card, x, bottom, x + bar, top);
        card_colour(card, colours[i][0], colours[i][1], colours[i][2]);
    }
}

static int testcard_init(struct demo_context *context)
{
    struct card *const card = demo_alloc(&context->arena, sizeof(*card));
    if (!card) {
        return PH_ERR_NOMEM;
    }
    card->mesh = (struct ph_mesh){.positions = card->positions,
                                  .triangles = (const uint16_t(*)[3])card->triangles,
                                  .parts = card->parts,
                                  .materials = card->materials};
    card_layout(card, context->width, context->height);
    context->state = card;
    return PH_OK;
}

static int testcard_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct card *const card = context->state;
    struct ph_projection projection;
    (void)frame; /* a still picture */
    int status =
        ph_projection_ortho(&projection, 0, FX_INT(context->width), 0, FX_INT(context->height), FX_HALF, FX_INT(2));
    status = status == PH_OK ? demo_begin(context, r, &ph_xform_identity, &projection, NULL, 0) : status;
    return status ? status : ph_draw_mesh(r, &card->mesh, &ph_xform_identity);
}

const struct demo demo_testcard = {
    .name = "testcard",
    .summary = "frame line, corner dots, ring, arrow, colour bars: what is wrong with a panel",
    .loop_frames = 1,
    .arena_bytes = sizeof(struct card),
    .vertex_max = VERTICES,
    .triangle_max = TRIANGLES,
    .init = testcard_init,
    .frame = testcard_frame,
};
