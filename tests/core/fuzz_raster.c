/*
 * Random triangles with extremes of every kind are drawn through the renderer's public interface, under
 * AddressSanitizer and UndefinedBehaviorSanitizer. Besides, no byte outside the caller's buffers may change, the bands
 * and the statistics must add up, and another band height, a second core, or other rubbish in the memory must give the
 * same bytes. A third of the frames have triangles as usual meshes have them, of up to 40 px before the camera.
 *
 * Usage: fuzz_raster [quick | long | TRIANGLES [SEED]]
 * quick (the default) is 400,000 triangles, long twenty. Each frame has its own seed, printed when it fails;
 * `fuzz_raster 1 SEED` repeats that frame alone.
 *
 * Usage: fuzz_raster threads [FRAMES [SEED]]
 * draws so many frames (50) again with a thread as second core. long_sanitizers.sh has ThreadSanitizer look at it.
 */
#include "render.h"
#include "shadow.h"

#include <inttypes.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define QUICK       400000
#define LONG        20000000
#define CANARY      0xa5
#define FENCE       256 /* bytes on either side of a buffer */
#define VERTICES    48
#define TRIANGLES   64
#define EDGES       16
#define ONE_MEMORY  2048 /* vertices, where triangles lie in their memory, too */
#define DRAWS       3    /* of the mesh in a frame, most: with a second camera, and as a shadow */
#define POINTS      8
#define PARTS       4
#define LOG2_MAX    6 /* of texture sizes; LOG2_MOST now and then */
#define LOG2_MOST   10
#define TEXELS_MOST ((4u << (2 * LOG2_MOST)) / 3 + 8) /* with all levels */

/* ---- random numbers ---------------------------------------------------------------------------------------- */

static uint64_t state;
static uint64_t frame_seed;

static uint32_t bits(void)
{
    state += 0x9e3779b97f4a7c15u;
    uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)(z >> 32);
}

/* 0 .. n - 1 */
static uint32_t below(uint32_t n)
{
    return (uint32_t)((uint64_t)bits() * n >> 32);
}

static int32_t within(int32_t limit)
{
    return (int32_t)((int64_t)below(2 * (uint32_t)limit + 1) - limit);
}

/* A Q16.16 of any kind; `plane` is a value at which something happens. */
static fx_t any_fx(fx_t plane)
{
    static const fx_t special[] = {0, 1, -1, FX_ONE, -FX_ONE, FX_MAX, FX_MIN, FX_INT(32767), FX_INT(-32767)};
    switch (below(8)) {
    case 0:
        return (fx_t)bits();
    case 1:
        return special[below(sizeof(special) / sizeof(special[0]))];
    case 2:
        return plane;
    case 3:
        return fx_add_wrap(plane, within(2));
    case 4:
        return within(FX_INT(100));
    default:
        return within(FX_INT(3));
    }
}

static int32_t any_q30(void)
{
    static const int32_t special[] = {0, 1, -1, FX_Q30_ONE, -FX_Q30_ONE, INT32_MAX, INT32_MIN};
    switch (below(4)) {
    case 0:
        return (int32_t)bits();
    case 1:
        return special[below(sizeof(special) / sizeof(special[0]))];
    default:
        return within(FX_Q30_ONE);
    }
}

/* The second core as a thread. It waits for work all the time, so that it comes in time to meet the first one. */
static struct core {
    bool here; /* it is used */
    void (*run)(void *argument);
    void *argument;
    uint32_t delay;
    uint32_t given, done; /* pieces of work */
} core;

/* ---- memory with fences ------------------------------------------------------------------------------------- */

struct fenced {
    uint8_t *base;
    size_t size;
};

static void fail(const char *what)
{
    fprintf(stderr, "fuzz_raster: %s; repeat with: fuzz_raster 1 %" PRIu64 "\n", what, frame_seed);
    exit(1);
}

/* Called by UndefinedBehaviorSanitizer and AddressSanitizer when they report. */
void __ubsan_on_report(void);
void __asan_on_error(void);

void __ubsan_on_report(void)
{
    fprintf(stderr, "fuzz_raster: repeat with: fuzz_raster 1 %" PRIu64 "\n", frame_seed);
}

void __asan_on_error(void)
{
    __ubsan_on_report();
}

static void *fence(struct fenced *f, size_t size)
{
    f->size = size;
    f->base = malloc(size + 2 * FENCE);
    if (!f->base) {
        fail("out of memory");
    }
    memset(f->base, CANARY, size + 2 * FENCE);
    return f->base + FENCE;
}

static void unfence(struct fenced *f)
{
    for (size_t i = 0; i < FENCE; i++) {
        if (f->base[i] != CANARY || f->base[FENCE + f->size + i] != CANARY) {
            fail("a byte outside a buffer was written");
        }
    }
    free(f->base);
}

struct memory {
    struct fenced vertices, triangles, bins, depth, pixels, samples;
    uint16_t *band; /* pixels of one band */
};

/* The depth buffer, the samples and the pixels of a band, which are returned. */
static uint16_t *fence_pixels(struct ph_config *config, bool has_samples, struct memory *memory)
{
    const size_t area = (size_t)config->width * config->band_height, samples = has_samples ? 4 * area : area;
    config->depth = fence(&memory->depth, samples * ph_depth_bytes(config->depth_format));
    uint16_t *const all = fence(&memory->samples, has_samples ? 2 * samples : 0);
    config->samples = has_samples ? all : NULL;
    config->antialiasing = PH_ANTIALIAS_2X2;
    return fence(&memory->pixels, area * 2);
}

static void free_pixels(struct memory *memory)
{
    unfence(&memory->depth);
    unfence(&memory->pixels);
    unfence(&memory->samples);
}

static struct ph_config any_config(struct memory *memory)
{
    static const uint16_t sizes[][2] = {{1, 1},   {1024, 3}, {3, 1024}, {1, 64},   {64, 1},
                                        {16, 12}, {320, 24}, {128, 64}, {160, 120}};
    struct ph_config config = {.occlusion = PH_COARSE_DEPTH,
                               .colouring = PH_COLOURS,
                               .depth_format = ph_depth_formats[below(PH_DEPTH_FORMATS)],
                               .depth_exponent = (uint8_t)(below(2) ? 3 + below(4) : 0)};
    const uint32_t kind = below(16), of = kind < 8 ? kind : 8; /* the last one has room inside for small triangles */
    config.width = (uint16_t)(kind < 12 ? sizes[of][0] : 1 + below(96));
    config.height = (uint16_t)(kind < 12 ? sizes[of][1] : 1 + below(96));
    config.band_height = (uint16_t)(below(3) ? 1 + below(config.height) : config.height);
    const bool has_samples = config.width <= 512 && config.height <= 512 && below(8) == 0;
    config.vertex_max = below(8) ? VERTICES : 1 + below(VERTICES);
    config.triangle_max = below(4) ? 8 * TRIANGLES : 1 + below(TRIANGLES);
    const bool one_memory = below(4) == 0; /* with room for two cores to list triangles one by one */
    config.vertex_max = one_memory ? ONE_MEMORY : config.vertex_max;
    config.bin_max = (uint32_t)((config.height + config.band_height - 1) / config.band_height);
    config.vertices = fence(&memory->vertices, config.vertex_max * ph_vertex_bytes);
    config.triangles = fence(&memory->triangles, one_memory ? 0 : config.triangle_max * ph_triangle_bytes);
    config.triangles = one_memory ? config.vertices : config.triangles;
    config.bins = fence(&memory->bins, config.bin_max * sizeof(*config.bins));
    memory->band = fence_pixels(&config, has_samples, memory);
    return config;
}

static void free_memory(struct memory *memory)
{
    unfence(&memory->vertices);
    unfence(&memory->triangles);
    unfence(&memory->bins);
    free_pixels(memory);
}

/* ---- what is drawn ------------------------------------------------------------------------------------------ */

struct content {
    struct ph_xform view, to_world;
    struct ph_projection projection, second;
    struct ph_scene_light light;
    struct ph_fog fog;
    struct ph_plane_equation ground;
    bool lit, lines, foggy, second_camera, shadow, billboard;
    struct fx_vec3 positions[VERTICES];
    int16_t normals[VERTICES][3];
    fx_t uvs[VERTICES][2];
    uint16_t triangles[TRIANGLES][3];
    uint16_t edges[EDGES][2];
    struct ph_part parts[PARTS + 2]; /* the last two are empty */
    struct ph_material materials[PARTS];
    struct ph_texture textures[PARTS], alphas[PARTS];
    struct ph_blend blends[PARTS];
    uint16_t ramp[PH_RAMP_SIZE], colours[VERTICES];
    struct ph_sphere bounds[PH_BOUNDS(PARTS)];
    struct ph_mesh mesh;
};

static struct fx_vec3 any_point(fx_t plane)
{
    return (struct fx_vec3){any_fx(plane), any_fx(plane), any_fx(below(2) ? fx_sub_wrap(0, plane) : plane)};
}

static struct ph_xform any_xform(void)
{
    struct ph_xform x = ph_xform_identity;
    uint32_t kind = below(8);
    if (kind < 4) {
        struct fx_vec3 axis = {within(FX_ONE), within(FX_ONE), within(FX_ONE)};
        x = ph_xform_quat(fx_quat_axis(axis, bits()),
                          (struct fx_vec3){within(FX_ONE), within(FX_ONE), within(FX_INT(6))});
    } else if (kind < 6) {
        for (int i = 0; i < 9; i++) {
            x.r[i / 3][i % 3] = kind == 4 ? any_q30() : 0;
        }
        x.t = any_point(FX_ONE);
    }
    return x;
}

static struct ph_projection any_projection(void)
{
    struct ph_projection p = {.kind = PH_PERSPECTIVE};
    fx_t near_z = below(4) ? 1 + (fx_t)below(FX_ONE) : below(2) ? 1 : FX_INT(100);
    fx_t far_z = below(4) ? fx_add_sat(near_z, (fx_t)below(FX_INT(200))) : below(2) ? FX_MAX : near_z + 1;
    fx_t fov = below(4) ? FX_INT(20) + (fx_t)below(FX_INT(100)) : below(2) ? 1 + (fx_t)below(FX_ONE) : FX_INT(180) - 1;
    int result = 0;
    switch (below(32) == 0 ? 8 : below(8)) { /* a fisheye divides a triangle into many */
    case 8:
        result = ph_projection_fisheye(&p, FX_INT(10) + (fx_t)below(FX_INT(230)), near_z, far_z);
        break;
    case 0:
        p.kind = below(2) ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE;
        p.scale_x_q20 = (int32_t)bits();
        p.scale_y_q20 = (int32_t)bits();
        p.shift_x = any_fx(FX_ONE);
        p.shift_y = any_fx(FX_ONE);
        p.near_z = any_fx(FX_ONE);
        p.far_z = any_fx(FX_INT(100));
        break;
    case 1:
        result =
            ph_projection_frustum(&p, any_fx(-FX_ONE), any_fx(FX_ONE), any_fx(-FX_ONE), any_fx(FX_ONE), near_z, far_z);
        break;
    case 2:
    case 3:
        result = ph_projection_ortho(&p, any_fx(-FX_ONE), any_fx(FX_ONE), any_fx(-FX_ONE), any_fx(FX_ONE),
                                     any_fx(FX_ONE), any_fx(FX_INT(100)));
        break;
    default:
        result = ph_projection_perspective(&p, fov, 1 + (fx_t)below(FX_INT(3)), near_z, far_z);
    }
    if (result < 0 && ph_projection_perspective(&p, FX_INT(60), FX_ONE, FX_HALF, FX_INT(100)) != 0) {
        fail("a plain camera was refused");
    }
    return p;
}

static struct ph_light any_light(const struct content *c)
{
    static const struct ph_light_kind *const kinds[3] = {PH_LIGHT_DIRECTIONAL, PH_LIGHT_POINT, PH_LIGHT_SPOT};
    struct ph_light light = {.kind = kinds[below(3)], .intensity = (fx_t)below(4 * FX_ONE + 1)};
    struct fx_vec3 towards = {within(FX_ONE), within(FX_ONE), within(FX_ONE)};
    fx_vec3_direction_q30(towards, &light.to_light_q30);
    light.position = below(2) ? ph_xform_point(&c->to_world, c->positions[below(VERTICES)]) : any_point(FX_ONE);
    light.reach = below(2) ? any_fx(FX_ONE) & FX_MAX : (fx_t)below(8);
    if (below(4) == 0) {
        light.red = (fx_t)below(FX_ONE + 1);
        light.green = (fx_t)below(FX_ONE + 1);
        light.blue = (fx_t)below(FX_ONE + 1);
    }
    light.cos_outer = within(FX_ONE);
    light.cos_inner = below(4) ? within(FX_ONE) : light.cos_outer + (fx_t)below(3) - 1;
    return light;
}

/* Read-only texels for any size, as large as the largest. */
static uint16_t *texels;

/* The count of texels in all levels. */
static uint32_t texels_of(const struct ph_texture *t)
{
    uint32_t sum = 0, width = 1u << t->log2_width, height = 1u << t->log2_height;
    for (unsigned level = 0; level <= (t->filter == PH_FILTER_MIPMAP ? t->levels : 0u); level++) {
        sum += width * height;
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
    }
    return sum;
}

/* A random texture. It ends where the memory ends, so that a read behind it is reported. */
static struct ph_texture any_texture(void)
{
    static const struct ph_filter *const filters[3] = {PH_FILTER_NEAREST, PH_FILTER_BILINEAR, PH_FILTER_MIPMAP};
    uint32_t log2_max = below(16) ? LOG2_MAX : LOG2_MOST;
    struct ph_texture t = {.log2_width = (uint8_t)below(log2_max + 1),
                           .log2_height = (uint8_t)below(log2_max + 1),
                           .wrap = (uint8_t)below(4),
                           .filter = filters[below(3)],
                           .levels = below(LOG2_MOST + 1) & 15};
    t.texels = texels + TEXELS_MOST - texels_of(&t);
    return t;
}

static struct ph_material any_material(struct content *c, int i)
{
    c->textures[i] = any_texture();
    c->alphas[i] = any_texture();
    c->blends[i] = (struct ph_blend){.draw = ph_draw_blended_alphas,
                                     .kind = (uint8_t)below(PH_BLEND_ADD + 1),
                                     .alpha = (uint8_t)below(33),
                                     .key = (uint16_t)(below(4) * 40503u),
                                     .alphas = &c->alphas[i]};
    if (c->blends[i].kind != PH_BLEND_MASK && below(2)) {
        c->blends[i].alphas = NULL;
    }
    static const struct ph_shading *const shadings[7] = {
        PH_SHADE_UNLIT,       PH_SHADE_FLAT, PH_SHADE_GOURAUD,        PH_SHADE_TEXTURE,
        PH_SHADE_TEXTURE_LIT, PH_SHADE_WIRE, PH_SHADE_TEXTURE_GOURAUD};
    return (struct ph_material){.shading = shadings[below(7)],
                                .two_sided = (uint8_t)below(2),
                                .shininess_log2 = (uint8_t)below(8),
                                .depth_bias = (uint8_t)(below(2) ? below(57) : 0),
                                .depth_bias_slope = (uint8_t)(below(8) ? 0 : below(256)),
                                .blend = below(4) ? NULL : &c->blends[i],
                                .ambient = (fx_t)below(FX_ONE + 1),
                                .diffuse = (fx_t)below(FX_ONE + 1),
                                .specular = (fx_t)below(FX_ONE + 1),
                                .colour = (uint16_t)bits(),
                                .ramp = c->ramp,
                                .texture = &c->textures[i]};
}

static void any_vertices(struct content *c)
{
    bool tame = below(2);
    for (int i = 0; i < VERTICES; i++) {
        c->positions[i] = tame ? (struct fx_vec3){within(FX_INT(3)), within(FX_INT(3)), within(FX_INT(3))}
                               : any_point(c->projection.near_z);
        for (int k = 0; k < 3; k++) {
            c->normals[i][k] = below(4) ? (int16_t)within(16384) : below(2) ? (int16_t)0 : (int16_t)bits();
        }
        c->colours[i] = (uint16_t)bits();
        c->uvs[i][0] = any_fx(FX_ONE);
        c->uvs[i][1] = any_fx(FX_ONE);
    }
}

/* Loose triangles of 1 to 50 px at 60 degrees and 120 px, which share no vertex. Distances may change within one. */
static void usual_triangles(struct content *c)
{
    c->view = c->to_world = ph_xform_identity;
    ph_projection_perspective(&c->projection, FX_INT(60), FX_ONE, FX_HALF, FX_INT(100));
    for (int i = 0; i < VERTICES; i += 3) {
        const fx_t w = FX_ONE + (fx_t)below(FX_INT(1 << below(7))), lean = (fx_t)below(FX_ONE / 2);
        const fx_t size = fx_mul_sat(w, FX_ONE * (1 + (int32_t)below(50)) / 104);
        const fx_t x = fx_mul_sat(w, within(FX_HALF)), y = fx_mul_sat(w, within(FX_HALF));
        for (int k = i; k < i + 3; k++) {
            c->positions[k] = (struct fx_vec3){x + within(size) / 2, y + within(size) / 2,
                                               -w - fx_mul_sat(w, fx_mul_sat(lean, within(FX_ONE)))};
            c->uvs[k][0] = within(FX_ONE * 6 / 5);
            c->uvs[k][1] = within(FX_ONE * 6 / 5);
        }
    }
    for (int i = 0; i < TRIANGLES; i++) {
        const uint16_t first = (uint16_t)(3 * below(VERTICES / 3)), turned = (uint16_t)below(3);
        for (int k = 0; k < 3; k++) {
            c->triangles[i][k] = (uint16_t)(first + (turned + k) % 3);
        }
    }
}

static void any_content(struct content *c)
{
    memset(c, 0, sizeof(*c));
    c->view = below(2) ? ph_xform_identity : any_xform();
    c->to_world = any_xform();
    c->projection = any_projection();
    any_vertices(c);
    c->lit = below(4);
    c->lines = below(4) == 0;
    c->foggy = below(8) == 0;
    c->fog = (struct ph_fog){(uint16_t)bits(), any_fx(c->projection.near_z), any_fx(c->projection.far_z)};
    c->light.ambient = (fx_t)below(FX_ONE + 1);
    c->light.count = below(PH_LIGHTS_MAX + 1);
    for (uint32_t i = 0; i < c->light.count; i++) {
        c->light.lights[i] = any_light(c);
    }
    for (int i = 0; i < TRIANGLES * 3; i++) {
        c->triangles[i / 3][i % 3] = (uint16_t)below(VERTICES);
    }
    for (int i = 0; i < EDGES * 2; i++) {
        c->edges[i / 2][i % 2] = (uint16_t)below(VERTICES);
    }
    if (below(3) == 0) {
        usual_triangles(c);
    }
    c->second_camera = below(4) == 0;
    c->second = any_projection();
    c->shadow = below(8) == 0;
    c->ground = (struct ph_plane_equation){{0, FX_Q30_ONE, 0}, within(FX_INT(2))};
    c->billboard = below(8) == 0;
    ph_material_ramp(c->ramp, (uint8_t)bits(), (uint8_t)bits(), (uint8_t)bits(), (fx_t)below(FX_ONE + 1));
    const bool one_part = below(4) == 0; /* large enough for two cores to cull it */
    for (int i = 0; i < PARTS; i++) {
        c->parts[i] = (struct ph_part){(uint32_t)i * TRIANGLES / PARTS,
                                       !one_part ? TRIANGLES / PARTS
                                       : i == 0  ? TRIANGLES
                                                 : 0,
                                       (uint16_t)below(PARTS)};
        c->materials[i] = any_material(c, i);
    }
    c->parts[PARTS + 1].material = 1;
    c->mesh = (struct ph_mesh){.positions = c->positions,
                               .normals = (const int16_t(*)[3])c->normals,
                               .uvs = (const fx_t(*)[2])c->uvs,
                               .colours = below(8) ? NULL : c->colours,
                               .triangles = (const uint16_t(*)[3])c->triangles,
                               .edges = (const uint16_t(*)[2])c->edges,
                               .parts = c->parts,
                               .materials = c->materials,
                               .vertex_count = VERTICES,
                               .triangle_count = TRIANGLES,
                               .edge_count = EDGES,
                               .part_count = PARTS};
    if (below(2) && ph_mesh_bounds(&c->mesh, c->bounds) != PH_OK) {
        fail("a mesh has no bounds");
    }
}

/* ---- a frame ------------------------------------------------------------------------------------------------- */

static uint32_t hash_bytes(uint32_t hash, const void *data, size_t size)
{
    const uint8_t *byte = data;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ byte[i]) * 16777619u;
    }
    return hash;
}

static bool begin(struct ph_renderer *r, const struct ph_config *config, const struct content *c)
{
    memset(config->vertices, (int)below(256), config->vertex_max * ph_vertex_bytes);
    memset(config->triangles, (int)below(256), config->triangle_max * ph_triangle_bytes);
    int result = ph_renderer_init(r, config);
    if (result != PH_OK) {
        fail("a good configuration was refused");
    }
    result = ph_frame_begin(r, &c->view, &c->projection, c->lit ? &c->light : NULL, 0x1234);
    if (result == PH_OK && c->foggy && ph_frame_fog(r, &c->fog) != (c->fog.start < c->fog.end ? PH_OK : PH_ERR_INVAL)) {
        fail("ph_frame_fog returned a wrong code");
    }
    return result == PH_OK;
}

static void check_code(int result, const char *what)
{
    if (result != PH_OK && result != PH_ERR_NOMEM) {
        fail(what);
    }
}

static void draw(struct ph_renderer *r, const struct content *c)
{
    const struct fx_vec3 light = {FX_ONE, FX_INT(4), FX_ONE};
    if (c->shadow) {
        check_code(ph_draw_shadow(r, &c->mesh, &c->to_world, light, &c->ground, &c->materials[1]),
                   "ph_draw_shadow returned an unknown code");
    }
    check_code(ph_draw_mesh(r, &c->mesh, &c->to_world), "ph_draw_mesh returned an unknown code");
    if (c->second_camera) {
        ph_frame_camera(r, &c->view, &c->second);
        check_code(ph_draw_mesh(r, &c->mesh, &c->to_world), "ph_draw_mesh returned an unknown code");
    }
    if (c->billboard) {
        check_code(ph_draw_billboard(r, c->positions[0], FX_ONE, FX_HALF, &c->materials[2]),
                   "ph_draw_billboard returned an unknown code");
    }
    const struct ph_mesh empty = {
        .parts = c->parts + PARTS, .materials = c->materials, .part_count = below(3)}; /* and no arrays */
    check_code(ph_draw_mesh(r, &empty, &c->to_world), "a mesh without vertices returned an unknown code");
    check_code(ph_draw_shadow(r, &empty, &c->to_world, light, &c->ground, &c->materials[1]),
               "the shadow of a mesh without vertices returned an unknown code");
    const struct ph_points points = {.positions = c->positions,
                                     .count = c->lines ? POINTS : 0,
                                     .size = c->positions[0].x,
                                     .in_world = c->second_camera,
                                     .round = c->billboard};
    check_code(ph_draw_points(r, &points, &c->to_world, &c->materials[3]), "ph_draw_points returned an unknown code");
    for (int i = 0; c->lines && i < 4; i++) {
        ph_draw_line(r, c->positions[i], c->positions[i + 4], &c->materials[i]);
    }
}

static void check_stats(const struct ph_renderer *r)
{
    const struct ph_stats *s = &r->stats;
    if (s->triangles_drawn > r->config.triangle_max || s->vertices > DRAWS * VERTICES + 4 + POINTS ||
        s->triangles_in > DRAWS * TRIANGLES + 2 || s->triangles_culled > s->triangles_in ||
        s->triangles_clipped > s->triangles_in) {
        fail("the statistics do not add up");
    }
}

/* Hash of all pixels and depth codes. */
static uint32_t draw_bands(struct ph_renderer *r, const struct ph_config *config, uint16_t *pixels)
{
    uint32_t rows = 0, bands = ph_frame_bands(r), hash[2] = {2166136261u, 2166136261u};
    for (uint32_t band = 0; band < bands; band++) {
        const size_t samples_a_pixel = config->samples != NULL ? 4 : 1;
        if (samples_a_pixel > 1) { /* an empty band leaves the depth of its samples as it was */
            memset(config->depth, 0,
                   samples_a_pixel * config->width * config->band_height * ph_depth_bytes(config->depth_format));
        }
        uint32_t lines = ph_draw_band(r, band, pixels);
        size_t bytes = (size_t)lines * config->width * 2;
        if (lines == 0 || lines > config->band_height) {
            fail("a band has a wrong number of lines");
        }
        hash[0] = hash_bytes(hash[0], pixels, bytes);
        hash[1] =
            hash_bytes(hash[1], config->depth, samples_a_pixel * bytes / 2 * ph_depth_bytes(config->depth_format));
        rows += lines;
    }
    if (rows != config->height) {
        fail("the bands do not add up to the picture");
    }
    return hash[0] ^ (hash[1] << 16 | hash[1] >> 16);
}

static void delay(uint32_t steps)
{
    for (volatile uint32_t i = 0; i < steps; i++) {
    }
}

/* A random delay of a core, now and then much longer than a share of the work takes. */
static uint32_t any_delay(void)
{
    return below(1u << (2 * below(9)));
}

static void *core_main(void *unused)
{
    (void)unused;
    for (uint32_t next = 1;; next++) {
        while (__atomic_load_n(&core.given, __ATOMIC_ACQUIRE) != next) {
            sched_yield();
        }
        delay(core.delay);
        core.run(core.argument);
        __atomic_store_n(&core.done, next, __ATOMIC_RELEASE);
    }
    return NULL;
}

static bool run_there(void (*run)(void *argument), void *argument)
{
    core.run = run;
    core.argument = argument;
    core.delay = any_delay();
    __atomic_store_n(&core.given, core.given + 1, __ATOMIC_RELEASE);
    delay(any_delay());
    return true;
}

static void join_there(void)
{
    while (__atomic_load_n(&core.done, __ATOMIC_ACQUIRE) != core.given) {
        sched_yield();
    }
}

static bool run_here(void (*run)(void *argument), void *argument)
{
    const bool is_free = below(8) != 0;
    if (is_free) {
        run(argument);
    }
    return is_free;
}

static void join_here(void)
{
}

/* The frame again with another band height and perhaps with two cores, in memory of its own. */
static uint32_t draw_again(const struct ph_config *config, const struct content *c)
{
    struct fenced bins;
    struct memory memory;
    struct ph_config other = *config;
    struct ph_renderer r;
    other.band_height = (uint16_t)(1 + below(config->height));
    other.bin_max = (uint32_t)((other.height + other.band_height - 1) / other.band_height);
    other.bins = fence(&bins, other.bin_max * sizeof(*other.bins));
    if (core.here || below(2)) {
        other.cores = PH_TWO_CORES;
        other.other_core = core.here ? run_there : run_here;
        other.other_core_join = core.here ? join_there : join_here;
    }
    uint16_t *pixels = fence_pixels(&other, config->samples != NULL, &memory);
    begin(&r, &other, c);
    draw(&r, c);
    uint32_t hash = draw_bands(&r, &other, pixels);
    unfence(&bins);
    free_pixels(&memory);
    return hash;
}

static struct ph_stats draw_frame(void)
{
    static struct content c;
    struct memory memory;
    struct ph_renderer r;
    struct ph_config config = any_config(&memory);
    any_content(&c);
    if (begin(&r, &config, &c)) {
        draw(&r, &c);
        uint32_t hash = draw_bands(&r, &config, memory.band);
        check_stats(&r);
        if (draw_again(&config, &c) != hash) {
            fail("another band height or a second core changed the picture");
        }
    }
    free_memory(&memory);
    return r.stats;
}

static int fuzz(uint32_t triangles, uint32_t frames_most, uint64_t seed)
{
    uint64_t in = 0, drawn = 0, clipped = 0, dropped = 0, fragments = 0, frames = 0;
    printf("%" PRIu32 " triangles or %" PRIu32 " frames, seed %" PRIu64 "\n", triangles, frames_most, seed);
    fflush(stdout);
    for (; in < triangles && frames < frames_most; frames++) {
        frame_seed = seed + frames;
        state = frame_seed * 0xd1342543de82ef95u;
        struct ph_stats stats = draw_frame();
        in += stats.triangles_in;
        drawn += stats.triangles_drawn;
        clipped += stats.triangles_clipped;
        dropped += stats.triangles_dropped;
        fragments += stats.fragments;
    }
    printf("%" PRIu64 " frames, triangles: %" PRIu64 " in, %" PRIu64 " clipped, %" PRIu64 " drawn, %" PRIu64
           " dropped; %" PRIu64 " fragments\n",
           frames, in, clipped, drawn, dropped, fragments);
    /* A run that drew next to nothing has tested nothing. */
    return triangles < QUICK || core.given > 4 * frames ||
                   (drawn > triangles / 20 && clipped > triangles / 50 && dropped > triangles / 200)
               ? 0
               : 1;
}

int main(int argc, char **argv)
{
    static const char usage[] = "usage: fuzz_raster [quick | long | TRIANGLES [SEED]] | threads [FRAMES [SEED]]\n";
    uint32_t triangles = QUICK, frames = UINT32_MAX;
    uint64_t seed = 20261121;
    core.here = argc > 1 && strcmp(argv[1], "threads") == 0;
    const int left = argc - core.here;
    if (left > 3 || (argc > 1 && argv[1][0] == '-')) {
        fputs(usage, argc == 2 ? stdout : stderr);
        return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    if (core.here) {
        pthread_t thread;
        triangles = UINT32_MAX;
        frames = left > 1 ? (uint32_t)strtoul(argv[2], NULL, 10) : 50;
        if (pthread_create(&thread, NULL, core_main, NULL) != 0) {
            fail("no thread");
        }
    } else if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        triangles = strcmp(argv[1], "long") == 0 ? LONG : (uint32_t)strtoul(argv[1], NULL, 10);
        frames = triangles;
    }
    if (left > 2) {
        seed = strtoull(argv[argc - 1], NULL, 10);
    }
    texels = malloc(TEXELS_MOST * sizeof(*texels));
    if (!texels) {
        fail("out of memory");
    }
    for (uint32_t i = 0; i < TEXELS_MOST; i++) {
        texels[i] = (uint16_t)(i * 40503u);
    }
    int result = fuzz(triangles, frames, seed);
    free(texels);
    return result;
}
