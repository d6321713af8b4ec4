/* Everything that render.h and shadow.h draw: each shading, filter, light, lens and depth format, blends, fog, lines,
 * billboards, shadows, antialiasing, a second core, ph_show and its differences; but no points, which points.c draws.
 * `display` says what is drawn. */
#include "picture.h"

#include "shadow.h"

PICTURE(16);

static uint16_t ramp[PH_RAMP_SIZE], samples[4 * WIDTH * BAND], shown[WIDTH * HEIGHT];

static bool other_core(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void other_core_join(void)
{
}

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *rows)
{
    (void)context, (void)x, (void)y;
    for (uint32_t i = 0; i < width * height; i++) {
        display = ((const uint16_t *)rows)[i];
    }
    return 0;
}

static int begin(unsigned choice)
{
    struct ph_config config = {PICTURE_CONFIG, .depth_format = ph_depth_formats[choice % PH_DEPTH_FORMATS]};
    config.samples = choice & 8 ? samples : NULL;
    config.antialiasing = PH_ANTIALIAS_2X2;
    config.cores = PH_TWO_CORES;
    config.occlusion = PH_COARSE_DEPTH;
    config.colouring = PH_COLOURS;
    config.other_core = other_core;
    config.other_core_join = other_core_join;
    config.pixels = pixels;
    config.shown = shown;
    return ph_renderer_init(&renderer, &config);
}

static int look(unsigned choice)
{
    static const struct ph_scene_light lights = {
        FX_HALF,
        3,
        {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}},
         {.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .red = FX_ONE},
         {.kind = PH_LIGHT_SPOT, .intensity = FX_ONE, .reach = FX_ONE, .cos_inner = FX_ONE}}};
    static const struct ph_fog fog = {0, FX_ONE, FX_INT(8)};
    const struct ph_xform view = ph_view_look_at(positions[choice % 6], positions[0], positions[1]);
    struct ph_projection lens;
    int status = choice % 3 == 0   ? ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(20))
                 : choice % 3 == 1 ? ph_projection_ortho(&lens, -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, FX_HALF, FX_INT(20))
                                   : ph_projection_fisheye(&lens, FX_INT(180), FX_HALF, FX_INT(20));
    status = status != PH_OK ? status : ph_frame_begin(&renderer, &view, &lens, &lights, 0);
    return status != PH_OK ? status : ph_frame_fog(&renderer, &fog);
}

static int draw_meshes(void)
{
    static const uint16_t texels[5] = {0xffff, 0x1234, 0x1234, 0xffff, 0x5555}, edges[1][2] = {{0, 1}};
    static const struct ph_texture textures[3] = {
        {.texels = texels, .log2_width = 1, .log2_height = 1, .filter = PH_FILTER_NEAREST},
        {.texels = texels, .log2_width = 1, .log2_height = 1, .filter = PH_FILTER_BILINEAR, .wrap = PH_WRAP_CLAMP},
        {.texels = texels, .log2_width = 1, .log2_height = 1, .filter = PH_FILTER_MIPMAP, .levels = 1}};
    static const struct ph_blend blends[4] = {{.draw = ph_draw_blended, .kind = PH_BLEND_KEY},
                                              {.draw = ph_draw_blended, .kind = PH_BLEND_MASK, .alphas = &textures[0]},
                                              {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16},
                                              {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 16}};
    static const struct ph_material materials[7] = {
        {.shading = PH_SHADE_UNLIT, .blend = &blends[2]},
        {.shading = PH_SHADE_FLAT, .diffuse = FX_ONE, .ramp = ramp, .blend = &blends[3]},
        {.shading = PH_SHADE_GOURAUD, .diffuse = FX_ONE, .specular = FX_ONE, .ramp = ramp},
        {.shading = PH_SHADE_TEXTURE, .texture = &textures[0], .blend = &blends[0]},
        {.shading = PH_SHADE_TEXTURE_LIT, .diffuse = FX_ONE, .texture = &textures[1], .blend = &blends[1]},
        {.shading = PH_SHADE_WIRE},
        {.shading = PH_SHADE_TEXTURE_GOURAUD, .diffuse = FX_ONE, .texture = &textures[2]}};
    static const struct ph_plane_equation ground = {{0, 1 << 30, 0}, FX_ONE};
    static const struct ph_part parts[7] = {{0, 8, 0}, {0, 8, 1}, {0, 8, 2}, {0, 8, 3},
                                            {0, 8, 4}, {0, 8, 5}, {0, 8, 6}};
    const struct ph_mesh mesh = {.positions = positions,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .triangles = triangles,
                                 .edges = edges,
                                 .parts = parts,
                                 .materials = materials,
                                 .vertex_count = 6,
                                 .triangle_count = 8,
                                 .edge_count = 1,
                                 .part_count = 7,
                                 .colours = texels};
    const struct ph_xform turn = ph_xform_rotate_y((uint32_t)display << 16);
    int status = ph_draw_mesh(&renderer, &mesh, &turn);
    status = status != PH_OK ? status : ph_draw_shadow(&renderer, &mesh, &turn, positions[1], &ground, &materials[0]);
    status = status != PH_OK ? status : ph_draw_billboard(&renderer, positions[0], FX_ONE, FX_ONE, &materials[3]);
    ph_draw_line(&renderer, positions[0], positions[1], &materials[0]);
    return status;
}

int main(void)
{
    int status = PH_OK;
    ph_material_ramp(ramp, 255, 160, 0, FX_ONE);
    while (status == PH_OK) {
        status = begin(display);
        status = status != PH_OK ? status : look(display);
        status = status != PH_OK ? status : draw_meshes();
        status = status != PH_OK ? status : ph_show(&renderer, flush, NULL);
    }
    return status;
}
