/*
 * picture: what the programs of this folder share: a mesh, and a picture of 128x128 pixels in bands of 16 lines. Each
 * program turns the mesh before a camera and sends the bands to a display. Bytes of such a program are what a feature
 * costs: see test_size.sh.
 */
#ifndef PICTURE_H
#define PICTURE_H

#include "render.h"

enum { WIDTH = 128, HEIGHT = 128, BAND = 16, ROOM = 64 };

#define display (*(volatile uint16_t *)0x40000000) /* the data register of a display that nobody has */

static const struct fx_vec3 positions[6] = {{FX_ONE, 0, 0},  {0, FX_ONE, 0},  {0, 0, FX_ONE},
                                            {-FX_ONE, 0, 0}, {0, -FX_ONE, 0}, {0, 0, -FX_ONE}};
static const int16_t normals[6][3] = {{16384, 0, 0},  {0, 16384, 0},  {0, 0, 16384},
                                      {-16384, 0, 0}, {0, -16384, 0}, {0, 0, -16384}};
static const fx_t uvs[6][2] = {{FX_ONE, 0}, {0, FX_ONE}, {FX_ONE, FX_ONE}, {0, FX_HALF}, {FX_HALF, 0}, {0, 0}};
static const uint16_t triangles[8][3] = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                                         {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
static const struct ph_part part = {0, 8, 0};

static const struct ph_scene_light light = {
    FX_HALF, 1, {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}}}};

/* The memory of a renderer with so many bytes of depth a pixel. */
#define PICTURE(depth_bytes)                                                                                           \
    static uint64_t room[ROOM * PH_VERTEX_BYTES_32 / 8], list[ROOM * PH_TRIANGLE_BYTES_32 / 8];                        \
    static uint64_t depth[WIDTH * BAND * (depth_bytes) / 8];                                                           \
    static uint16_t pixels[WIDTH * BAND];                                                                              \
    static uint32_t bins[HEIGHT / BAND];                                                                               \
    static struct ph_renderer renderer

#define PICTURE_CONFIG                                                                                                 \
    .width = WIDTH, .height = HEIGHT, .band_height = BAND, .vertices = room, .vertex_max = ROOM, .triangles = list,    \
    .triangle_max = ROOM, .bins = bins, .bin_max = HEIGHT / BAND, .depth = depth

/* Shows frames, for ever. */
static inline int show_frames(struct ph_renderer *r, const struct ph_material *material, uint16_t *pixels)
{
    const struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-3));
    const struct ph_mesh mesh = {.positions = positions,
                                 .normals = material->diffuse != 0 ? normals : NULL,
                                 .uvs = material->texture != NULL ? uvs : NULL,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = material,
                                 .vertex_count = 6,
                                 .triangle_count = 8,
                                 .part_count = 1};
    struct ph_projection lens;
    int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(20));
    for (uint32_t turn = 0; status == PH_OK; turn += 1 << 24) {
        const struct ph_xform to_world = ph_xform_rotate_y(turn);
        status = ph_frame_begin(r, &view, &lens, &light, 0);
        status = status != PH_OK ? status : ph_draw_mesh(r, &mesh, &to_world);
        const uint32_t bands = ph_frame_bands(r);
        for (uint32_t band = 0; band < bands; band++) {
            const uint32_t lines = ph_draw_band(r, band, pixels);
            for (uint32_t i = 0; i < lines * WIDTH; i++) {
                display = pixels[i];
            }
        }
    }
    return status;
}

#endif
