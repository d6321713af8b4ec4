/*
 * A program that names the features that its macros say, to weigh them: see features.csv. Without macros it draws an
 * unlit mesh, clipped, under a perspective, in fixed16. With SHOWN it runs on a computer, and prints the CRC of three
 * frames.
 */
#include "picture.h"

#include "overlay.h"
#include "shadow.h"

#ifndef SHADING
#define SHADING PH_SHADE_UNLIT
#endif
#ifndef FORMAT
#define FORMAT PH_DEPTH_FIXED16
#endif
#ifndef DEPTH_BYTES
#define DEPTH_BYTES 2
#endif
#ifndef FILTER
#define FILTER PH_FILTER_NEAREST
#endif
#ifndef LIGHT
#define LIGHT PH_LIGHT_DIRECTIONAL
#endif
#ifdef SHOWN
#include "crc32.h"
#include <stdio.h>
#endif

PICTURE(DEPTH_BYTES * 4);

static uint16_t ramp[PH_RAMP_SIZE];
#ifdef DITHER
static struct ph_dithered_ramp dithered_ramps[1];
static struct ph_dither dither = {.ramps = dithered_ramps, .ramp_max = 1};
#endif

#ifdef ANTIALIAS
static uint32_t samples[2 * WIDTH * BAND];
#endif
#ifdef SHOW
static uint16_t shown[WIDTH * HEIGHT];
#endif
#ifdef CORES
static bool other_core(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void other_core_join(void)
{
}
#endif

static int begin(uint32_t turn)
{
    static const struct ph_scene_light lights = {FX_HALF,
                                                 1,
                                                 {{.kind = LIGHT,
                                                   .intensity = FX_ONE,
#ifdef COLOURED_LIGHT
                                                   .red = FX_ONE,
#endif
                                                   .to_light_q30 = {0, 0, 1 << 30},
                                                   .position = {0, 0, FX_INT(2)},
                                                   .cos_inner = FX_HALF}}};
    const struct ph_xform view = ph_xform_translate(0, 0, -FX_INT(3) + (fx_t)(turn >> 16));
    struct ph_projection lens;
#if defined(FISHEYE)
    int status = ph_projection_fisheye(&lens, FX_INT(180), FX_HALF, FX_INT(20));
#elif defined(ORTHO)
    int status = ph_projection_ortho(&lens, -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, FX_HALF, FX_INT(20));
#else
    int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(20));
#endif
    status = status != PH_OK ? status : ph_frame_begin(&renderer, &view, &lens, &lights, 0);
#ifdef FOG
    static const struct ph_fog fog = {0x1234, FX_ONE, FX_INT(8)};
    status = status != PH_OK ? status : ph_frame_fog(&renderer, &fog);
#endif
    return status;
}

/* What is drawn beside a mesh. */
static int draw_more(const struct ph_mesh *mesh, const struct ph_xform *to_world, const struct ph_material *material)
{
    int status = PH_OK;
    (void)mesh, (void)to_world, (void)material;
#ifdef SHADOW
    static const struct ph_plane_equation ground = {{0, 1 << 30, 0}, FX_ONE};
    status = status != PH_OK ? status : ph_draw_shadow(&renderer, mesh, to_world, positions[1], &ground, material);
#endif
#ifdef BILLBOARD
    status = status != PH_OK ? status : ph_draw_billboard(&renderer, positions[0], FX_ONE, FX_ONE, material);
#endif
#ifdef POINTS
    const struct ph_points points = {.positions = positions, .count = 6, .size = FX_INT(2)};
    status = status != PH_OK ? status : ph_draw_points(&renderer, &points, to_world, material);
#endif
#ifdef LINE
    ph_draw_line(&renderer, positions[0], positions[1], material);
#endif
    return status;
}

static int draw(uint32_t turn)
{
    static const uint16_t texels[5] = {0xffff, 0x1234, 0x1234, 0xffff, 0x5555};
    static const struct ph_texture texture = {
        .texels = texels, .log2_width = 1, .log2_height = 1, .filter = FILTER, .levels = 1};
#ifdef BLEND
    static const struct ph_blend blend = {
#ifdef ALPHAS
        .draw = ph_draw_blended_alphas,
        .alphas = &texture,
#else
        .draw = ph_draw_blended,
#endif
        .kind = BLEND,
        .alpha = 16,
        .key = 0x1234};
#endif
    static const struct ph_material material = {
        .shading = SHADING,
        .ambient = FX_HALF,
        .diffuse = FX_HALF,
        .colour = 0xffff,
        .ramp = ramp,
        .texture = &texture,
#ifdef BLEND
        .blend = &blend,
#endif
    };
    static const uint16_t edges[3][2] = {{0, 1}, {1, 2}, {2, 3}};
    struct ph_mesh mesh = {
        .positions = positions,
        .normals = normals,
        .uvs = uvs,
        .triangles = triangles,
        .edges = edges,
        .parts = &part,
        .materials = &material,
        .vertex_count = 6,
        .triangle_count = 8,
        .edge_count = 3,
        .part_count = 1,
#ifdef COLOURS
        .colours = ramp,
#endif
    };
    const struct ph_xform to_world = ph_xform_rotate_y(turn);
#ifdef BOUNDS
    static struct ph_sphere bounds[1];
    ph_mesh_bounds(&mesh, bounds);
#endif
    int status = ph_draw_mesh(&renderer, &mesh, &to_world);
    return status != PH_OK ? status : draw_more(&mesh, &to_world, &material);
}

#ifdef SHOWN
static uint32_t crc;
#endif

static void put(const uint16_t *rows, uint32_t n)
{
#ifdef SHOWN
    crc = crc32_update(crc, (const uint8_t *)rows, 2 * n);
#else
    for (uint32_t i = 0; i < n; i++) {
        display = rows[i];
    }
#endif
}

#ifdef SHOW
static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *rows)
{
    (void)context, (void)x, (void)y;
    put(rows, width * height);
    return 0;
}
#endif

static int bands(void)
{
#ifdef SHOW
    return ph_show(&renderer, flush, NULL);
#else
    for (uint32_t band = 0, count = ph_frame_bands(&renderer); band < count; band++) {
        const uint32_t lines = ph_draw_band(&renderer, band, pixels);
#ifdef TEXT
        static const struct ph_overlay_style style = {0xffff, 0, 1};
        const struct ph_overlay_band at = {pixels, WIDTH, (int32_t)band * BAND, BAND};
        ph_text(&at, 2, 2, "text", &style);
#endif
        put(pixels, lines * WIDTH);
    }
    return PH_OK;
#endif
}

int main(void)
{
    const struct ph_config config = {
        PICTURE_CONFIG,
#ifdef ANTIALIAS
        .samples = (uint16_t *)samples,
        .antialiasing = PH_ANTIALIAS_2X2,
#endif
#ifdef CORES
        .other_core = other_core,
        .other_core_join = other_core_join,
        .cores = PH_TWO_CORES,
#endif
#ifdef COARSE
        .occlusion = PH_COARSE_DEPTH,
#endif
#if defined(COLOURS) || defined(COLOURED_LIGHT)
        .colouring = PH_COLOURS,
#endif
#ifdef SHOW
        .pixels = pixels,
        .shown = shown,
#endif
        .depth_format = FORMAT
    };
    int status = ph_renderer_init(&renderer, &config);
#ifdef DITHER
    status = status != PH_OK ? status : ph_dither(&renderer, &dither);
#endif
    ph_material_ramp(ramp, 255, 160, 0, FX_ONE);
    for (uint32_t turn = 0; status == PH_OK; turn += 1 << 28) {
        status = begin(turn);
        status = status != PH_OK ? status : draw(turn);
        status = status != PH_OK ? status : bands();
#ifdef SHOWN
        if (turn == 2 << 28) {
            printf("%08x %u\n", (unsigned)crc, (unsigned)renderer.stats.fragments);
            break;
        }
#endif
    }
    return status;
}
