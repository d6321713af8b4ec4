/*
 * What blends and fog cost a pixel: a quad over a picture of 320x240, in bands of 16 lines. Each line of output is
 *
 *   NAME FORMAT frame PIXELS COUNT
 *
 * NAME is SHADING, SHADING-KIND, or fog-...; COUNT is what the frame takes beyond the same one without the quad, or
 * without fog.
 */
#include "bench.h"

#include "render.h"

#define WIDTH  320
#define HEIGHT 240
#define LINES  16
#define LOG2   6

static uint64_t vertices[1024], triangles[4096];
static uint32_t bins[HEIGHT];
static uint16_t depth[WIDTH * LINES], pixels[WIDTH * LINES], texels[1 << 2 * LOG2], alphas[1 << 2 * LOG2];
static uint16_t ramp[PH_RAMP_SIZE];

static const struct ph_scene_light sun = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {511886330, 614263596, 716640862}}}};
static const struct ph_fog mist = {.start = FX_ONE, .end = FX_INT(9), .colour = 0x1863};

static void draw(const struct ph_material *material, bool fogged)
{
    static const struct fx_vec3 corners[4] = {{-FX_INT(4), -FX_INT(3), -FX_ONE},
                                              {FX_INT(4), -FX_INT(3), 0},
                                              {FX_INT(4), FX_INT(3), FX_ONE},
                                              {-FX_INT(4), FX_INT(3), 0}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {0, 16384, 0}, {16384, 0, 0}, {0, 0, 16384}};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {FX_ONE, FX_ONE}, {0, FX_ONE}};
    static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {.count = 2};
    static const struct ph_projection projection = {.kind = PH_PERSPECTIVE,
                                                    .scale_x_q20 = 1362140, /* 60 degrees from bottom to top */
                                                    .scale_y_q20 = 1816187,
                                                    .near_z = FX_HALF,
                                                    .far_z = FX_INT(100)};
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = LINES,
                                     .depth_format = PH_DEPTH_FIXED16,
                                     .occlusion = PH_COARSE_DEPTH,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth};
    const struct ph_mesh mesh = {.positions = corners,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .vertex_count = 4,
                                 .triangles = faces,
                                 .triangle_count = material != NULL ? 2 : 0,
                                 .parts = &part,
                                 .materials = material,
                                 .part_count = material != NULL};
    const struct ph_xform place = ph_xform_translate(0, 0, -FX_INT(4));
    struct ph_renderer r;
    if (ph_renderer_init(&r, &config) != PH_OK ||
        ph_frame_begin(&r, &ph_xform_identity, &projection, &sun, 0) != PH_OK ||
        (fogged && ph_frame_fog(&r, &mist) != PH_OK) || ph_draw_mesh(&r, &mesh, &place) != PH_OK) {
        machine_print("blends: the renderer refuses a picture\n");
        return;
    }
    const uint32_t bands = ph_frame_bands(&r);
    for (uint32_t band = 0; band < bands; band++) {
        ph_draw_band(&r, band, pixels);
    }
    if (r.stats.triangles_dropped != 0 || (material != NULL && r.stats.fragments != WIDTH * HEIGHT)) {
        machine_print("blends: a quad does not cover the picture\n");
    }
}

static void measure(const char *name, const struct ph_material *material, bool fogged)
{
    const char *what[3] = {name, "fixed16", "frame"};
    machine_start();
    draw(material, fogged);
    machine_stop(what, WIDTH * HEIGHT);
}

static const struct ph_texture nearest = {.texels = texels, .log2_width = LOG2, .log2_height = LOG2},
                               bilinear = {.texels = texels,
                                           .log2_width = LOG2,
                                           .log2_height = LOG2,
                                           .filter = PH_FILTER_BILINEAR},
                               map = {.texels = alphas, .log2_width = LOG2, .log2_height = LOG2};
static const struct ph_blend blends[] = {
    {.draw = ph_draw_blended, .kind = PH_BLEND_KEY, .key = 0xf81f},
    {.draw = ph_draw_blended_alphas, .kind = PH_BLEND_MASK, .alphas = &map},
    {.draw = ph_draw_blended, .kind = PH_BLEND_TIMES, .alpha = 32},
    {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 12},
    {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 20},
    {.draw = ph_draw_blended_alphas, .kind = PH_BLEND_ALPHA, .alpha = 32, .alphas = &map},
    {.draw = ph_draw_blended_alphas, .kind = PH_BLEND_ADD, .alpha = 32, .alphas = &map},
    {.draw = ph_draw_blended, .kind = PH_BLEND_TIMES, .alpha = 20}};
static const struct {
    const char *name;
    const struct ph_shading *shading;
    const struct ph_texture *texture;
    const struct ph_blend *blend;
} cases[] = {{"flat", PH_SHADE_UNLIT, NULL, NULL},
             {"gouraud", PH_SHADE_GOURAUD, NULL, NULL},
             {"texture", PH_SHADE_TEXTURE, &nearest, NULL},
             {"bilinear", PH_SHADE_TEXTURE, &bilinear, NULL},
             {"texture-key", PH_SHADE_TEXTURE, &nearest, &blends[0]},
             {"bilinear-key", PH_SHADE_TEXTURE, &bilinear, &blends[0]},
             {"texture-mask", PH_SHADE_TEXTURE, &nearest, &blends[1]},
             {"flat-alpha", PH_SHADE_UNLIT, NULL, &blends[3]},
             {"gouraud-alpha", PH_SHADE_GOURAUD, NULL, &blends[3]},
             {"texture-alpha", PH_SHADE_TEXTURE, &nearest, &blends[3]},
             {"flat-add", PH_SHADE_UNLIT, NULL, &blends[4]},
             {"gouraud-add", PH_SHADE_GOURAUD, NULL, &blends[4]},
             {"texture-add", PH_SHADE_TEXTURE, &nearest, &blends[4]},
             {"flat-times", PH_SHADE_UNLIT, NULL, &blends[2]},
             {"gouraud-times", PH_SHADE_GOURAUD, NULL, &blends[2]},
             {"texture-times", PH_SHADE_TEXTURE, &nearest, &blends[2]},
             {"gouraud-times-some", PH_SHADE_GOURAUD, NULL, &blends[7]},
             {"texture-alphas", PH_SHADE_TEXTURE, &nearest, &blends[5]},
             {"texture-alphas-add", PH_SHADE_TEXTURE, &nearest, &blends[6]}};

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"};
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    ph_material_ramp(ramp, 255, 160, 64, 0);
    for (uint32_t i = 0; i < sizeof texels / sizeof texels[0]; i++) {
        texels[i] = (uint16_t)(i * 40503);
        alphas[i] = (uint16_t)(i * 30011 + (i << 7)); /* green, of all 64 steps */
    }
    struct ph_material material = {.ambient = FX_ONE / 5, .diffuse = FX_ONE / 5 * 4, .colour = 0x1234, .ramp = ramp};
    measure("empty", NULL, false);
    measure("empty-fog", NULL, true);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        material.shading = cases[i].shading;
        material.texture = cases[i].texture;
        material.blend = cases[i].blend;
        measure(cases[i].name, &material, false);
    }
    material = (struct ph_material){.colour = 0x1234};
    measure("flat-fog", &material, true);
    return 0;
}
