/*
 * The five scenes on which renderers are compared by instruction counts and picture quality: torus, cube, fill,
 * icosphere, ground. At 320x240 frame f of 0 .. 63 is exactly the scene's frame f:
 *
 *   a = 2 pi (f + .5) / 64, b = .2 + .3 f / 64 rad, R = Rx(b) Ry(a), camera at the origin, 60 degrees, .5 .. 100.
 *
 * After that a continues and b runs back: frames 64 .. 127 use b of 63 .. 0, and frame 128 is frame 0 again.
 */
#include "demo_scene.h"
#include "models.h"

#define LOOP_FRAMES    128
#define FILL_PARTS     8
#define TEXTURE_LOG2   6
#define TEXTURE_TEXELS (1u << (2 * TEXTURE_LOG2))

struct bench {
    struct ph_mesh mesh; /* first: tests/bench/icosphere_image.inc has one in flash */
    struct ph_material material;
    struct ph_texture texture;
    uint16_t ramp[PH_RAMP_SIZE];
};

struct fill {
    struct ph_mesh mesh;
    struct ph_material materials[FILL_PARTS];
    struct ph_part parts[FILL_PARTS];
    struct fx_vec3 positions[4 * FILL_PARTS];
    uint16_t triangles[2 * FILL_PARTS][3];
};

#define BENCH_BYTES (MODEL_ROUND8(sizeof(struct bench)) + MODEL_ROUND8(sizeof(struct ph_part)))

/* normalize(.5, .6, .7) towards the light; .2 ambient, .8 diffuse */
static const struct ph_scene_light bench_light = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {511886330, 614263596, 716640862}}},
};

static struct ph_xform benchmark_rotation(uint32_t frame)
{
    const uint64_t b_first_q16 = 8959626780035; /* .2 rad in 2^-48 turns */
    const uint64_t b_step_q16 = 209991252657;   /* .3 / 64 rad */
    const uint32_t phase = frame % LOOP_FRAMES;
    const uint32_t step = phase < LOOP_FRAMES / 2 ? phase : LOOP_FRAMES - 1 - phase, a = (2 * frame + 1) << 25;
    const uint32_t b = (uint32_t)((b_first_q16 + step * b_step_q16 + (1 << 15)) >> 16);
    const struct ph_xform about_x = ph_xform_rotate_x(b);
    const struct ph_xform about_y = ph_xform_rotate_y(a);
    return ph_xform_mul(&about_x, &about_y);
}

static int bench_begin(const struct demo_context *context, struct ph_renderer *r)
{
    const struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_HALF, FX_INT(100));
    return demo_begin(context, r, &ph_xform_identity, &projection, &bench_light, 0);
}

/* Makes the state with its lit material, in context->state. NULL: the arena is full. */
static struct bench *bench_new(struct demo_context *context)
{
    struct bench *const b = demo_alloc(&context->arena, sizeof(*b));
    if (b) {
        b->material = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                           .ambient = (FX_ONE + 2) / 5,
                                           .diffuse = (4 * FX_ONE + 2) / 5,
                                           .colour = ph_rgb565(255, 160, 64),
                                           .ramp = b->ramp};
        ph_material_ramp(b->ramp, 255, 160, 64, 0);
        context->state = b;
    }
    return b;
}

/* Gives the material to a mesh that a model's maker has made, or not. */
static int bench_finish(struct demo_context *context, struct bench *b, int made)
{
    return made == PH_OK ? model_material(&context->arena, &b->mesh, &b->material) : PH_ERR_NOMEM;
}

#define TORUS_BYTES(major, minor)                                                                                      \
    (BENCH_BYTES + MODEL_BYTES(MODEL_TORUS_VERTICES(major, minor), MODEL_TORUS_TRIANGLES(major, minor)))
#define ICOSPHERE_BYTES(n) (BENCH_BYTES + MODEL_BYTES(MODEL_ICOSPHERE_VERTICES(n), MODEL_ICOSPHERE_TRIANGLES(n)))

#define GROUND_BYTES(cells) (BENCH_BYTES + MODEL_BYTES(MODEL_GROUND_VERTICES(cells), MODEL_GROUND_TRIANGLES(cells)))

/* Torus, icosphere and ground are the finest for which the arena is made. */
static int torus_init(struct demo_context *context)
{
    struct bench *const b = bench_new(context);
    const bool fine = context->arena.size >= TORUS_BYTES(32, 16);
    return !b ? PH_ERR_NOMEM
              : bench_finish(
                    context, b,
                    model_torus(&context->arena, &b->mesh, fine ? 32 : 20, fine ? 16 : 10, 1 << 28, 107374182));
}

static int icosphere_init(struct demo_context *context)
{
    struct bench *const b = bench_new(context);
    uint32_t n = 4;
    while (n > 2 && context->arena.size < ICOSPHERE_BYTES(n)) {
        n--;
    }
    return !b ? PH_ERR_NOMEM : bench_finish(context, b, model_icosphere(&context->arena, &b->mesh, n));
}

static int ground_init(struct demo_context *context)
{
    struct bench *const b = bench_new(context);
    return !b ? PH_ERR_NOMEM
              : bench_finish(
                    context, b,
                    model_ground(&context->arena, &b->mesh, context->arena.size >= GROUND_BYTES(20) ? 20 : 16));
}

static int cube_init(struct demo_context *context)
{
    struct bench *const b = bench_new(context);
    uint16_t *const texels = demo_alloc(&context->arena, TEXTURE_TEXELS * sizeof(*texels));
    if (!b || !texels || model_cube(&context->arena, &b->mesh) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < TEXTURE_TEXELS; i++) {
        const uint32_t x = i % (1u << TEXTURE_LOG2), y = i >> TEXTURE_LOG2;
        texels[i] = ph_rgb565((uint8_t)(4 * x), (uint8_t)(4 * y), ((x >> 3) ^ (y >> 3)) & 1 ? 255 : 64);
    }
    b->texture = (struct ph_texture){
        .texels = texels, .log2_width = TEXTURE_LOG2, .log2_height = TEXTURE_LOG2, .wrap = PH_WRAP_CLAMP};
    b->material = (struct ph_material){.shading = PH_SHADE_TEXTURE, .texture = &b->texture};
    return model_material(&context->arena, &b->mesh, &b->material);
}

/* Draws the model, turning 3 units in front of the camera. */
static int object_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct bench *const b = context->state;
    struct ph_xform to_world = benchmark_rotation(frame);
    to_world.t.z = FX_INT(-3);
    const int status = bench_begin(context, r);
    return status ? status : ph_draw_mesh(r, &b->mesh, &to_world);
}

/* Draws the ground, which turns around the camera half a unit above it. */
static int ground_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct bench *const b = context->state;
    const struct ph_xform rotation = benchmark_rotation(frame);
    const struct ph_xform below = ph_xform_translate(0, -FX_HALF, 0);
    const struct ph_xform to_world = ph_xform_mul(&rotation, &below);
    /* Nothing has to fit into the width here: a taller view would only show where the near plane cuts the ground. */
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_60_Q20, FX_HALF, FX_INT(100));
    projection.scale_x_q20 = (int32_t)(fx_mul_wide(projection.scale_x_q20, DEMO_SCALE_60_Q20) / projection.scale_y_q20);
    projection.scale_y_q20 = DEMO_SCALE_60_Q20;
    const int status = demo_begin(context, r, &ph_xform_identity, &projection, &bench_light, 0);
    return status ? status : ph_draw_mesh(r, &b->mesh, &to_world);
}

/* Quad number i at z = -distance. It is a little larger than the picture: half its height is 1.02 tan 30 distance. */
static void fill_quad(struct fill *f, uint32_t i, int32_t distance, const struct demo_context *context)
{
    const int64_t half_q30 = (int64_t)632323634 * distance; /* 1.02 / sqrt 3 */
    const int64_t w = context->width, h = context->height, tall_q30 = h > w ? half_q30 * h / w : half_q30;
    const int64_t wide_q30 = 3 * w > 4 * h ? tall_q30 * w / h : (4 * tall_q30 + 1) / 3;
    const fx_t y = (fx_t)((tall_q30 + (1 << 13)) >> 14), x = (fx_t)((wide_q30 + (1 << 13)) >> 14);
    const fx_t z = FX_INT(-distance);
    const struct fx_vec3 corners[4] = {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
    const uint16_t v = (uint16_t)(4 * i);
    const uint16_t halves[2][3] = {
        {v, (uint16_t)(v + 1), (uint16_t)(v + 2)},
        {v, (uint16_t)(v + 2), (uint16_t)(v + 3)},
    };
    for (uint32_t k = 0; k < 4; k++) {
        f->positions[v + k] = corners[k];
    }
    for (uint32_t k = 0; k < 6; k++) {
        f->triangles[2 * i + k / 3][k % 3] = halves[k / 3][k % 3];
    }
    f->parts[i] = (struct ph_part){.first = 2 * i, .count = 2, .material = (uint16_t)i};
}

/* Four quads, each in front of the last, then four hidden ones. */
static int fill_init(struct demo_context *context)
{
    static const int8_t distances[FILL_PARTS] = {10, 8, 6, 4, 5, 7, 9, 11};
    static const uint8_t colours[FILL_PARTS][3] = {{40, 40, 160},  {40, 140, 160}, {60, 180, 60},  {230, 180, 40},
                                                   {230, 100, 40}, {200, 40, 40},  {180, 40, 140}, {120, 120, 120}};
    struct fill *const f = demo_alloc(&context->arena, sizeof(*f));
    if (!f) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < FILL_PARTS; i++) {
        fill_quad(f, i, distances[i], context);
        f->materials[i] = (struct ph_material){.shading = PH_SHADE_UNLIT,
                                               .colour = ph_rgb565(colours[i][0], colours[i][1], colours[i][2])};
    }
    f->mesh = (struct ph_mesh){.positions = f->positions,
                               .triangles = (const uint16_t(*)[3])f->triangles,
                               .parts = f->parts,
                               .materials = f->materials,
                               .vertex_count = 4 * FILL_PARTS,
                               .triangle_count = 2 * FILL_PARTS,
                               .part_count = FILL_PARTS};
    context->state = f;
    return PH_OK;
}

static int fill_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct fill *const f = context->state;
    (void)frame; /* a still picture */
    const int status = bench_begin(context, r);
    return status ? status : ph_draw_mesh(r, &f->mesh, &ph_xform_identity);
}

static const struct demo_level torus_coarser = {
    .arena_bytes = TORUS_BYTES(20, 10), .vertex_max = 200, .triangle_max = 220};

const struct demo demo_torus = {
    .name = "torus",
    .summary = "benchmark 1: a Gouraud torus, 1024 triangles",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = TORUS_BYTES(32, 16),
    .vertex_max = 512,
    .triangle_max = 512,
    .coarser = &torus_coarser,
    .coarser_count = 1,
    .by_name_only = true, /* `shadow` has a ring that looks like something */
    .init = torus_init,
    .frame = object_frame,
};

const struct demo demo_cube = {
    .name = "cube",
    .summary = "benchmark 2: a textured cube",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = BENCH_BYTES + MODEL_CUBE_BYTES + TEXTURE_TEXELS * sizeof(uint16_t),
    .vertex_max = 24,
    .triangle_max = 6,
    .init = cube_init,
    .frame = object_frame,
};

const struct demo demo_fill = {
    .name = "fill",
    .summary = "benchmark 3: eight quads that fill the picture, four of them hidden; one plain colour is right",
    .loop_frames = 1,
    .arena_bytes = sizeof(struct fill),
    .vertex_max = 4 * FILL_PARTS,
    .triangle_max = 2 * FILL_PARTS,
    .by_name_only = true, /* on a kit it is one plain colour */
    .init = fill_init,
    .frame = fill_frame,
};

static const struct demo_level icosphere_coarser[] = {
    {.arena_bytes = ICOSPHERE_BYTES(3),
     .vertex_max = MODEL_ICOSPHERE_VERTICES(3),
     .triangle_max = 560,
     .enough_px = 170},
    {.arena_bytes = ICOSPHERE_BYTES(2),
     .vertex_max = MODEL_ICOSPHERE_VERTICES(2),
     .triangle_max = 160,
     .enough_px = 64},
};

const struct demo demo_icosphere = {
    .name = "icosphere",
    .summary = "benchmark 4: a sphere of 5120 triangles",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = ICOSPHERE_BYTES(4),
    .vertex_max = MODEL_ICOSPHERE_VERTICES(4),
    .triangle_max = 1900,
    .coarser = icosphere_coarser,
    .coarser_count = sizeof icosphere_coarser / sizeof icosphere_coarser[0],
    .by_name_only = true, /* `yard` has it dressed up */
    .init = icosphere_init,
    .frame = object_frame,
};

static const struct demo_level ground_coarser = {.arena_bytes = GROUND_BYTES(16),
                                                 .vertex_max = MODEL_GROUND_VERTICES(16),
                                                 .triangle_max = 320,
                                                 .corner_max = 160,
                                                 .enough_px = 135};

const struct demo demo_ground = {
    .name = "ground",
    .summary = "benchmark 5: a plain that passes under the camera and meets the near plane",
    .loop_frames = LOOP_FRAMES,
    .arena_bytes = GROUND_BYTES(20),
    .vertex_max = 441,
    .triangle_max = 480,
    .corner_max = 224,
    .coarser = &ground_coarser,
    .coarser_count = 1,
    .by_name_only = true, /* `yard` has it dressed up */
    .init = ground_init,
    .frame = ground_frame,
};
