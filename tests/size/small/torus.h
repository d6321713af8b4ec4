/* torus: what the image for 32 KB of flash and 4 KB of RAM draws: a ring of 96 vertices and 192 triangles, Gouraud, in
 * bands of 4 lines. HEIGHT: 64 for the OLED, 128 for an ST7735S. torus_mesh.h is what torus_mesh.c writes. */
#ifndef TORUS_H
#define TORUS_H

#include "render.h"

#include "torus_mesh.h"

enum { WIDTH = 128, BAND = 4, FRAMES = 3, VERTICES = 96, TRIANGLES = 192 };

static const struct ph_part torus_part = {0, TRIANGLES, 0};
static const struct ph_material torus_material = {
    .shading = PH_SHADE_GOURAUD, .ambient = FX_HALF, .diffuse = FX_HALF, .ramp = torus_ramp};
static const struct ph_mesh torus = {.positions = torus_positions,
                                     .normals = torus_normals,
                                     .triangles = torus_triangles,
                                     .parts = &torus_part,
                                     .materials = &torus_material,
                                     .vertex_count = VERTICES,
                                     .triangle_count = TRIANGLES,
                                     .part_count = 1};

/* Turns the torus. */
static __attribute__((noinline)) void torus_turn(uint32_t frame, struct ph_xform *to_world)
{
    const struct ph_xform x = ph_xform_rotate_x(0x15000000 + (frame << 26)), y = ph_xform_rotate_y(frame << 27);
    *to_world = ph_xform_mul(&x, &y);
}

/* Begins a frame and draws the torus into it. Returns a status. */
static __attribute__((noinline)) int torus_draw(struct ph_renderer *r, uint32_t frame)
{
    static const struct ph_scene_light light = {
        FX_HALF, 1, {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 644245094, 858993459}}}};
    static const struct ph_projection lens = {.kind = PH_PERSPECTIVE,
                                              .near_z = FX_ONE / 2,
                                              .far_z = FX_INT(16),
                                              .scale_x_q20 = 3 << 19,
                                              .scale_y_q20 = (3 << 19) / HEIGHT * WIDTH};
    static const struct ph_xform view = {{{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}, {0, 0, FX_INT(-4)}};
    struct ph_xform to_world;
    int status = ph_frame_begin(r, &view, &lens, &light, 0);
    torus_turn(frame, &to_world);
    return status != PH_OK ? status : ph_draw_mesh(r, &torus, &to_world);
}

/* 16 greys of an RGB565 pixel in wire order: the upper bits of its green. */
static inline uint32_t torus_grey(uint16_t pixel)
{
    const uint8_t *const bytes = (const uint8_t *)&pixel;
    return (bytes[0] & 7) << 1 | bytes[1] >> 7;
}

#endif
