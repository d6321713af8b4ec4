/*
 * Cliffs: what is rare against what is usual, each by itself at 320x240. Each line of output is
 *
 *   NAME VARIANT UNIT UNITS COUNT
 *
 * VARIANT is usual or cliff; `empty` follows with the same frame of nothing. The cost of a UNIT (pixel, triangle, row,
 * vertex, edge, frame) is the difference over UNITS.
 *
 * The lines inner-... are pixels in the loops of the kernels alone: rows of 64 pixels, `empty` the same of 32. Light
 * and filters stand against the nearest texel, a blend against a flat span. Filtered rows lie within one repeat of the
 * texture; those that leave it cost more where kernels tell them apart.
 */
#include "bench.h"

#include "kernels/kernels.h"
#include "kernels/texel_row.h"
#include "kernels/texture_tile.h"
#include "models.h"

#define WIDTH     320
#define HEIGHT    240
#define ARENA     (512 * 1024)
#define VERTICES  2048
#define TRIANGLES 2600
#define PX        631 /* a pixel at z = -2, Q16.16 */
#define LOG2      6
#define LOG2_MOST 10

static uint64_t arena_bytes[ARENA / 8], vertices[VERTICES * 8], triangles[TRIANGLES * 20];
static uint32_t depth[WIDTH * HEIGHT], bins[HEIGHT];
static uint16_t pixels[WIDTH * HEIGHT], samples[4 * WIDTH * 16], texels[1 << 2 * LOG2_MOST], ramp[PH_RAMP_SIZE];

static struct fx_vec3 positions[VERTICES];
static int16_t normals[VERTICES][3];
static fx_t uvs[VERTICES][2];
static uint16_t corners[TRIANGLES][3], edges[1][2];
static struct ph_texture texture;
static struct ph_material material;
static struct ph_part part;
static struct ph_mesh mesh;

static const struct ph_scene_light sun = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {511886330, 614263596, 716640862}}}};
static const struct ph_scene_light lamp = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {
        {.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .position = {FX_INT(2), FX_INT(2), 0}, .reach = FX_INT(4)}}};

enum unit { PIXEL, TRIANGLE, VERTEX, EDGE, FRAME, DRAW };

static const char *const unit_names[] = {"pixel", "triangle", "vertex", "edge", "frame", "draw"};

#define DRAWS 64

/* How a frame is drawn. */
struct view {
    struct ph_xform place;
    struct ph_projection projection;
    const struct ph_scene_light *light;
    const struct ph_depth_format *depth_format;
    uint16_t lines; /* of a band */
    bool antialias;
    enum { ONE_MESH, MESHES, BILLBOARDS } draws; /* the mesh, or in place of it DRAWS of them, or DRAWS billboards */
};

static struct view usual(void)
{
    return (struct view){.place = ph_xform_translate(0, 0, FX_INT(-3)),
                         .projection = {.kind = PH_PERSPECTIVE,
                                        .scale_x_q20 = 1362140, /* 60 degrees from bottom to top */
                                        .scale_y_q20 = 1816187,
                                        .near_z = FX_HALF,
                                        .far_z = FX_INT(100)},
                         .light = &sun,
                         .depth_format = PH_DEPTH_AUTO,
                         .lines = 16};
}

static struct ph_renderer renderer_of(const struct view *view)
{
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = view->lines,
                                     .depth_format = view->depth_format,
                                     .occlusion = PH_COARSE_DEPTH,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = (void *)depth,
                                     .samples = view->antialias ? samples : NULL,
                                     .antialiasing = view->antialias ? PH_ANTIALIAS_2X2 : NULL};
    struct ph_renderer r;
    if (ph_renderer_init(&r, &config) != PH_OK) {
        machine_print("cliffs: the renderer refuses a picture\n");
    }
    return r;
}

/* The places of meshes and billboards of 6 pixels, side by side. */
static struct fx_vec3 place_of(uint32_t i)
{
    return (struct fx_vec3){(fx_t)(i % 16 * 20 - 150) * PX, (fx_t)(i / 16 * 20 - 40) * PX, FX_INT(-2)};
}

static void list(struct ph_renderer *r, const struct view *view, const struct ph_mesh *what)
{
    if (view->draws == ONE_MESH) {
        ph_draw_mesh(r, what, &view->place);
        return;
    }
    for (uint32_t i = 0; i < DRAWS && what->part_count > 0; i++) {
        const struct fx_vec3 at = place_of(i);
        const struct ph_xform place = ph_xform_translate(at.x, at.y, at.z);
        if (view->draws == MESHES) {
            ph_draw_mesh(r, what, &place);
        } else {
            ph_draw_billboard(r, at, 6 * PX, 6 * PX, &material);
        }
    }
}

static void draw(struct ph_renderer *r, const struct view *view, const struct ph_mesh *what)
{
    if (ph_frame_begin(r, &ph_xform_identity, &view->projection, view->light, 0) != PH_OK) {
        machine_print("cliffs: the renderer refuses a camera\n");
    }
    list(r, view, what);
    const uint32_t bands = ph_frame_bands(r);
    for (uint32_t band = 0; band < bands; band++) {
        ph_draw_band(r, band, pixels);
    }
}

static void measure(const char *name, const char *variant, enum unit unit, const struct view *view)
{
    static const struct ph_mesh nothing;
    struct ph_renderer r = renderer_of(view);
    const char *what[3] = {name, variant, unit_names[unit]};
    draw(&r, view, &mesh);
    const uint32_t units[] = {r.stats.fragments, r.stats.triangles_drawn, mesh.vertex_count, mesh.edge_count, 1, DRAWS};
    if (r.stats.triangles_dropped + r.stats.vertices_dropped > 0) {
        machine_print("cliffs: a scene does not fit\n");
    }
    machine_start();
    draw(&r, view, &mesh);
    machine_stop(what, units[unit]);
    what[1] = "empty";
    machine_start();
    draw(&r, view, &nothing);
    machine_stop(what, units[unit]);
}

static void set_material(const struct ph_shading *shading)
{
    material = (struct ph_material){.shading = shading,
                                    .two_sided = 1,
                                    .ambient = FX_ONE / 5,
                                    .diffuse = 4 * FX_ONE / 5,
                                    .colour = ph_rgb565(255, 160, 64),
                                    .ramp = ramp,
                                    .texture = &texture};
    texture = (struct ph_texture){.texels = texels, .log2_width = LOG2, .log2_height = LOG2, .wrap = PH_WRAP_REPEAT};
    mesh = (struct ph_mesh){.positions = positions,
                            .normals = (const int16_t(*)[3])normals,
                            .uvs = (const fx_t(*)[2])uvs,
                            .triangles = (const uint16_t(*)[3])corners,
                            .edges = (const uint16_t(*)[2])edges,
                            .parts = &part,
                            .materials = &material,
                            .part_count = 1};
    part = (struct ph_part){0};
}

static void add_triangle(const fx_t x[3], const fx_t y[3])
{
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t n = mesh.vertex_count++;
        positions[n] = (struct fx_vec3){x[i], y[i], FX_ONE};
        normals[n][2] = 1 << 14;
        uvs[n][0] = FX_HALF + x[i] / 8;
        uvs[n][1] = FX_HALF - y[i] / 8;
        corners[mesh.triangle_count][i] = (uint16_t)n;
    }
    part.count = ++mesh.triangle_count;
}

/* Right triangles of so many eighths of a pixel, side by side over the picture, `most` at most. */
static void field(const struct ph_shading *shading, int32_t wide, int32_t high, uint32_t most)
{
    const fx_t w = wide * PX / 8, h = high * PX / 8;
    set_material(shading);
    for (fx_t y = -100 * PX; y + h < 100 * PX; y += h + 2 * PX) {
        for (fx_t x = -150 * PX; x + w < 150 * PX && mesh.triangle_count < most; x += w + 2 * PX) {
            add_triangle((const fx_t[3]){x, x + w, x}, (const fx_t[3]){y, y, y + h});
        }
    }
}

/* A square of side 2, with the texture from `from` to `to`. */
static void square(const struct ph_shading *shading, fx_t from, fx_t to)
{
    static const fx_t x[3] = {-FX_ONE, FX_ONE, FX_ONE}, y[3] = {-FX_ONE, -FX_ONE, FX_ONE};
    set_material(shading);
    add_triangle(x, y);
    add_triangle(y, x);
    for (uint32_t i = 0; i < 6; i++) {
        uvs[i][0] = positions[i].x > 0 ? to : from;
        uvs[i][1] = positions[i].y > 0 ? from : to;
        positions[i].z = 0;
    }
}

/* The torus so many times as large; its positions are in the arena. */
static void scale(int32_t by)
{
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const struct fx_vec3 p = mesh.positions[i];
        positions[i] = (struct fx_vec3){p.x * by, p.y * by, p.z * by};
    }
    mesh.positions = positions;
}

static void torus(const struct ph_shading *shading)
{
    struct demo_arena arena = {(uint8_t *)arena_bytes, sizeof arena_bytes, 0};
    set_material(shading);
    material.two_sided = 0;
    if (model_torus(&arena, &mesh, 32, 16, 1 << 28, 107374182) != PH_OK ||
        (shading == PH_SHADE_WIRE && model_edges(&arena, &mesh) != PH_OK)) {
        machine_print("cliffs: the arena is full\n");
    }
    part.count = mesh.triangle_count;
    mesh.parts = &part;
    mesh.materials = &material;
    mesh.part_count = 1;
}

static void textures(void)
{
    struct view view = usual();
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    measure("little-light", "usual", PIXEL, &view);
    square(PH_SHADE_TEXTURE_LIT, 0, FX_ONE);
    measure("little-light", "cliff", PIXEL, &view);
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    measure("clamp-outside", "usual", PIXEL, &view);
    square(PH_SHADE_TEXTURE, -FX_ONE, 2 * FX_ONE);
    texture.wrap = PH_WRAP_CLAMP;
    measure("clamp-outside", "cliff", PIXEL, &view);
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    texture.filter = PH_FILTER_BILINEAR;
    measure("clamp-bilinear", "usual", PIXEL, &view);
    square(PH_SHADE_TEXTURE, -FX_ONE, 2 * FX_ONE);
    texture.filter = PH_FILTER_BILINEAR;
    texture.wrap = PH_WRAP_CLAMP;
    measure("clamp-bilinear", "cliff", PIXEL, &view);
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    measure("texture-edge-on", "usual", PIXEL, &view);
    view.place = ph_xform_rotate_y(1061812292); /* 89 degrees */
    view.place.t.z = FX_INT(-3);
    measure("texture-edge-on", "cliff", PIXEL, &view);
    view = usual();
    field(PH_SHADE_GOURAUD, 23, 23, 600);
    measure("texture-4-pixels", "usual", TRIANGLE, &view);
    field(PH_SHADE_TEXTURE, 23, 23, 600);
    measure("texture-4-pixels", "cliff", TRIANGLE, &view);
}

/* A square, or a field of small triangles, with a texture of 2^log2 texels in width and height. */
static void measure_size(const char *name, const char *variant, const struct ph_filter *filter, bool small,
                         uint8_t log2)
{
    const struct view view = usual();
    if (small) {
        field(PH_SHADE_TEXTURE, 8 * 20, 8 * 20, 100);
    } else {
        square(PH_SHADE_TEXTURE, 0, FX_ONE);
    }
    texture.filter = filter;
    texture.log2_width = texture.log2_height = log2;
    measure(name, variant, PIXEL, &view);
}

/* Large textures against one of 256 texels in width and height. */
static void texture_sizes(void)
{
    static const struct {
        const char *name;
        const struct ph_filter *filter;
        uint8_t log2;
        bool small;
    } pair[] = {
        {"texture-512", PH_FILTER_NEAREST, 9, false},        {"texture-1024", PH_FILTER_NEAREST, 10, false},
        {"bilinear-512", PH_FILTER_BILINEAR, 9, false},      {"bilinear-1024", PH_FILTER_BILINEAR, 10, false},
        {"small-512", PH_FILTER_NEAREST, 9, true},           {"small-1024", PH_FILTER_NEAREST, 10, true},
        {"small-bilinear-512", PH_FILTER_BILINEAR, 9, true}, {"small-bilinear-1024", PH_FILTER_BILINEAR, 10, true}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        measure_size(pair[i].name, "usual", pair[i].filter, pair[i].small, 8);
        measure_size(pair[i].name, "cliff", pair[i].filter, pair[i].small, pair[i].log2);
    }
}

/* One colour over another: the same triangles, opaque and blended. */
static void blends(void)
{
    static const struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    const struct view view = usual();
    square(PH_SHADE_UNLIT, 0, FX_ONE);
    measure("blend", "usual", PIXEL, &view);
    material.blend = &glass;
    measure("blend", "cliff", PIXEL, &view);
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    measure("blend-texture", "usual", PIXEL, &view);
    material.blend = &glass;
    measure("blend-texture", "cliff", PIXEL, &view);
}

/* Units of u and v for kernels that draw as many rows as the picture has, all pixels of which are drawn, from texel to
 * texel. */
enum { TEXEL_U = 1 << 22, TEXEL_V = 1 << 20, FAR = 1 };

static void nearest_rows(uint32_t n)
{
    struct ph_tile_rows r = {.row = {.right = n << 16,
                                     .d = 1u << 31,
                                     .depth = (uint16_t *)(void *)depth,
                                     .pixels = pixels,
                                     .stride_bytes = 2 * WIDTH,
                                     .u_mask = (1u << LOG2) - 1,
                                     .v_mask = ((1u << LOG2) - 1) << LOG2,
                                     .texels = texels,
                                     .rows = HEIGHT},
                             .columns = n,
                             .u = {.step = TEXEL_U},
                             .v = {.step = TEXEL_V}};
    ph_texture_tile(&r);
}

static void rows_of(void (*draw)(const struct ph_texel_row *), uint32_t n)
{
    struct ph_texel_row row = {.n = n,
                               .d = 1u << 31,
                               .u = {.step = TEXEL_U / 2},
                               .v = {.step = TEXEL_V},
                               .u_mask = (1u << LOG2) - 1,
                               .v_mask = ((1u << LOG2) - 1) << LOG2,
                               .texels = texels,
                               .level = 16,
                               .light = 16u << 24};
    for (uint32_t y = 0; y < HEIGHT; y++) {
        row.depth = (uint16_t *)(void *)depth + (size_t)y * WIDTH;
        row.pixels = pixels + (size_t)y * WIDTH;
        draw(&row);
    }
}

static void lit_rows(uint32_t n)
{
    rows_of(ph_texel_row_lit, n);
}

static void smooth_rows(uint32_t n)
{
    rows_of(ph_texel_row_smooth, n);
}

static void smooth_lit_rows(uint32_t n)
{
    rows_of(ph_texel_row_smooth_lit, n);
}

static void flat_rows(uint32_t n)
{
    for (uint32_t y = 0; y < HEIGHT; y++) {
        ph_span_flat(pixels + (size_t)y * WIDTH, (uint16_t *)(void *)depth + (size_t)y * WIDTH, n, 1u << 31, 0, 1);
    }
}

static void blended_rows(uint32_t n)
{
    for (uint32_t y = 0; y < HEIGHT; y++) {
        ph_span_blend(pixels + (size_t)y * WIDTH, (uint16_t *)(void *)depth + (size_t)y * WIDTH, n, 1u << 31, 0,
                      0x02008010, 16);
    }
}

static void measure_loop(const char *name, const char *variant, void (*draw)(uint32_t))
{
    enum { WIDE = 64, NARROW = 32 };
    const char *what[3] = {name, variant, unit_names[PIXEL]};
    for (uint32_t n = WIDE; n >= NARROW; n -= WIDE - NARROW) {
        for (uint32_t i = 0; i < WIDTH * HEIGHT / 2; i++) {
            depth[i] = FAR << 16 | FAR;
        }
        machine_start();
        draw(n);
        machine_stop(what, (WIDE - NARROW) * HEIGHT);
        what[1] = "empty";
    }
}

static void inner_loops(void)
{
    static const struct {
        const char *name;
        void (*usual)(uint32_t), (*cliff)(uint32_t);
    } pair[] = {{"inner-lit", nearest_rows, lit_rows},
                {"inner-bilinear", nearest_rows, smooth_rows},
                {"inner-bilinear-lit", nearest_rows, smooth_lit_rows},
                {"inner-blend", flat_rows, blended_rows}};
    for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
        measure_loop(pair[i].name, "usual", pair[i].usual);
        measure_loop(pair[i].name, "cliff", pair[i].cliff);
    }
}

static void shapes(void)
{
    const struct view view = usual();
    field(PH_SHADE_GOURAUD, 8 * 31, 8 * 31, 100);
    measure("40-pixels-wide", "usual", PIXEL, &view);
    field(PH_SHADE_GOURAUD, 8 * 40, 8 * 40, 100);
    measure("40-pixels-wide", "cliff", PIXEL, &view);
    field(PH_SHADE_GOURAUD, 8, 8 * 30, 100);
    measure("sliver", "usual", PIXEL, &view);
    field(PH_SHADE_GOURAUD, 8, 8 * 195, 100);
    measure("sliver", "cliff", PIXEL, &view);
}

static void shadings(void)
{
    static const struct {
        const char *name;
        const struct ph_shading *shading;
    } other[] = {{"flat-torus", PH_SHADE_FLAT}, {"unlit-torus", PH_SHADE_UNLIT}};
    const struct view view = usual();
    for (int i = 0; i < 2; i++) {
        torus(PH_SHADE_GOURAUD);
        measure(other[i].name, "usual", FRAME, &view);
        torus(other[i].shading);
        measure(other[i].name, "cliff", FRAME, &view);
    }
    torus(PH_SHADE_GOURAUD);
    measure("wire-edge", "usual", TRIANGLE, &view);
    torus(PH_SHADE_WIRE);
    measure("wire-edge", "cliff", EDGE, &view);
}

/* Measures unlit vertices without triangles, and lit ones, which cost the light besides. */
static void vertices_alone(void)
{
    struct view view = usual();
    torus(PH_SHADE_GOURAUD);
    measure("point-light", "usual", VERTEX, &view);
    view.light = &lamp;
    measure("point-light", "cliff", VERTEX, &view);
    view = usual();
    part.count = 0;
    measure("beyond-16", "usual", VERTEX, &view);
    view.place.t.z = FX_INT(-60);
    scale(20);
    measure("beyond-16", "cliff", VERTEX, &view);
    view = usual();
    torus(PH_SHADE_GOURAUD);
    part.count = 0;
    measure("orthographic", "usual", VERTEX, &view);
    view.projection = (struct ph_projection){.kind = PH_ORTHOGRAPHIC,
                                             .scale_x_q20 = 1 << 19,
                                             .scale_y_q20 = 1 << 19,
                                             .near_z = FX_HALF,
                                             .far_z = FX_INT(100)};
    measure("orthographic", "cliff", VERTEX, &view);
}

/* A quad of 6 pixels around each of n places, or around the origin. */
static void quads(const struct ph_shading *shading, uint32_t n)
{
    const fx_t s = 3 * PX;
    set_material(shading);
    for (uint32_t i = 0; i < n; i++) {
        const struct fx_vec3 at = n > 1 ? place_of(i) : (struct fx_vec3){0};
        const fx_t x[4] = {at.x - s, at.x + s, at.x + s, at.x - s}, y[4] = {at.y - s, at.y - s, at.y + s, at.y + s};
        for (uint32_t k = 0; k < 4; k++) {
            positions[4 * i + k] = (struct fx_vec3){x[k], y[k], at.z};
            uvs[4 * i + k][0] = k == 1 || k == 2 ? FX_ONE : 0;
            uvs[4 * i + k][1] = k < 2 ? FX_ONE : 0;
        }
        for (uint32_t k = 0; k < 2; k++) {
            corners[2 * i + k][0] = (uint16_t)(4 * i);
            corners[2 * i + k][1] = (uint16_t)(4 * i + 1 + k);
            corners[2 * i + k][2] = (uint16_t)(4 * i + 2 + k);
        }
    }
    mesh.vertex_count = 4 * n;
    mesh.triangle_count = part.count = 2 * n;
}

static void draws(void)
{
    static const struct ph_blend key = {.draw = ph_draw_blended, .kind = PH_BLEND_KEY, .key = 0xf81f};
    static const struct {
        const char *name;
        const struct ph_shading *shading;
        const struct ph_blend *blend;
        int draws;
    } each[] = {{"draw", PH_SHADE_UNLIT, NULL, MESHES},
                {"billboard", PH_SHADE_UNLIT, NULL, BILLBOARDS},
                {"billboard-texture", PH_SHADE_TEXTURE, NULL, BILLBOARDS},
                {"billboard-key", PH_SHADE_TEXTURE, &key, BILLBOARDS}};
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        struct view view = usual();
        view.place = ph_xform_identity;
        quads(each[i].shading, DRAWS);
        material.blend = each[i].blend;
        measure(each[i].name, "usual", DRAW, &view);
        quads(each[i].shading, 1);
        material.blend = each[i].blend;
        view.draws = each[i].draws;
        measure(each[i].name, "cliff", DRAW, &view);
    }
}

/* Long lines along the diagonals of the picture. */
static void lines(void)
{
    static uint16_t diagonals[64][2];
    struct view view = usual();
    view.place = ph_xform_translate(0, 0, FX_INT(-2));
    set_material(PH_SHADE_WIRE);
    for (uint16_t i = 0; i < 64; i++) {
        const fx_t x = (i < 32 ? i - 16 : 64 - 48 - i + 32) * 9 * PX, y = 118 * PX;
        positions[2 * i] = (struct fx_vec3){x, y, 0};
        positions[2 * i + 1] = (struct fx_vec3){-x, -y, 0};
        diagonals[i][0] = (uint16_t)(2 * i);
        diagonals[i][1] = (uint16_t)(2 * i + 1);
    }
    mesh.edges = (const uint16_t(*)[2])diagonals;
    mesh.vertex_count = 128;
    mesh.edge_count = 64;
    view.lines = HEIGHT;
    measure("long-lines", "usual", EDGE, &view);
    view.lines = 16;
    measure("long-lines", "cliff", EDGE, &view);
}

/* Colours of vertices, and coloured light, on the torus and on a square. */
static void colours(void)
{
    static const struct ph_scene_light coloured = {.ambient = FX_ONE,
                                                   .count = 1,
                                                   .lights = {{.kind = PH_LIGHT_DIRECTIONAL,
                                                               .intensity = FX_ONE,
                                                               .to_light_q30 = {511886330, 614263596, 716640862},
                                                               .red = FX_ONE,
                                                               .green = FX_HALF,
                                                               .blue = FX_ONE / 4}}};
    static uint16_t own[VERTICES];
    struct view view = usual();
    for (uint32_t i = 0; i < VERTICES; i++) {
        own[i] = (uint16_t)(i * 40503);
    }
    for (int k = 0; k < 4; k++) {
        static const char *const names[] = {"vertex-colours", "coloured-light", "vertex-colours-fill",
                                            "coloured-light-fill"};
        if (k < 2) {
            torus(PH_SHADE_GOURAUD);
        } else {
            square(PH_SHADE_GOURAUD, 0, FX_ONE);
        }
        const enum unit unit = k < 2 ? FRAME : PIXEL;
        measure(names[k], "usual", unit, &view);
        view.light = k % 2 != 0 ? &coloured : &sun;
        mesh.colours = k % 2 == 0 ? own : NULL;
        measure(names[k], "cliff", unit, &view);
        view.light = &sun;
    }
}

/* Depth with a bias by slope, and of 24 bits. */
static void depths(void)
{
    struct view view = usual();
    torus(PH_SHADE_GOURAUD);
    measure("bias-slope", "usual", FRAME, &view);
    material.depth_bias_slope = 2;
    measure("bias-slope", "cliff", FRAME, &view);
    torus(PH_SHADE_GOURAUD);
    view.depth_format = PH_DEPTH_FIXED16;
    measure("fixed24", "usual", FRAME, &view);
    view.depth_format = PH_DEPTH_FIXED24;
    measure("fixed24", "cliff", FRAME, &view);
    view.depth_format = PH_DEPTH_FLOAT16;
    measure("float24", "usual", FRAME, &view);
    view.depth_format = PH_DEPTH_FLOAT24;
    measure("float24", "cliff", FRAME, &view);
}

static void frames(void)
{
    struct view view = usual();
    torus(PH_SHADE_GOURAUD);
    measure("linear-w", "usual", FRAME, &view);
    view.depth_format = PH_DEPTH_LINEAR_W;
    measure("linear-w", "cliff", FRAME, &view);
    view = usual();
    measure("1-line-bands", "usual", FRAME, &view);
    view.lines = 1;
    measure("1-line-bands", "cliff", FRAME, &view);
    view = usual();
    measure("antialias", "usual", FRAME, &view);
    view.antialias = true;
    measure("antialias", "cliff", FRAME, &view);
    view = usual();
    square(PH_SHADE_TEXTURE, 0, FX_ONE);
    measure("1-line-textured", "usual", FRAME, &view);
    view.lines = 1;
    measure("1-line-textured", "cliff", FRAME, &view);
}

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"};
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    for (uint32_t i = 0; i < sizeof texels / sizeof texels[0]; i++) {
        texels[i] = (uint16_t)(i * 40503);
    }
    ph_material_ramp(ramp, 255, 160, 64, 0);
    textures();
    texture_sizes();
    blends();
    inner_loops();
    shapes();
    shadings();
    vertices_alone();
    draws();
    lines();
    colours();
    depths();
    frames();
    return 0;
}
