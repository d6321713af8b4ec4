/* triangle: what the examples draw, and the memory that it takes: 320x240 in bands of 16 lines, 20 KB with the pixels.
 */
#ifndef TRIANGLE_H
#define TRIANGLE_H

#include <pinhole/render.h>

enum { WIDTH = 320, HEIGHT = 240, BAND = 16 };

static uint64_t triangle_vertices[16], triangle_lists[32];
static uint16_t triangle_depth[WIDTH * BAND], triangle_pixels[WIDTH * BAND];
static uint32_t triangle_bins[HEIGHT / BAND];

static int triangle_init(struct ph_renderer *r, enum ph_pixel_order order)
{
    struct ph_config config = {0};
    config.width = WIDTH;
    config.height = HEIGHT;
    config.band_height = BAND;
    config.depth_format = PH_DEPTH_FIXED16;
    config.depth = triangle_depth;
    config.bins = triangle_bins;
    config.bin_max = HEIGHT / BAND;
    config.vertices = triangle_vertices;
    config.vertex_max = sizeof triangle_vertices / ph_vertex_bytes;
    config.triangles = triangle_lists;
    config.triangle_max = sizeof triangle_lists / ph_triangle_bytes;
    config.pixels = triangle_pixels;
    config.pixel_order = (uint8_t)order;
    return ph_renderer_init(r, &config);
}

/* The triangle, a little further round with each frame. It has two sides. */
static int triangle_draw(struct ph_renderer *r, uint32_t frame)
{
    static const struct fx_vec3 corners[] = {{-FX_ONE, -FX_ONE, 0}, {FX_ONE, -FX_ONE, 0}, {0, FX_ONE, 0}};
    static const uint16_t faces[][3] = {{0, 1, 2}};
    struct ph_part part = {0};
    struct ph_material material = {0};
    struct ph_mesh mesh = {0};
    part.count = 1;
    material.shading = PH_SHADE_UNLIT;
    material.colour = ph_rgb565(255, 160, 0);
    material.two_sided = 1;
    mesh.positions = corners;
    mesh.vertex_count = 3;
    mesh.triangles = faces;
    mesh.triangle_count = 1;
    mesh.parts = &part;
    mesh.part_count = 1;
    mesh.materials = &material;

    const struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-3));
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25); /* 128 frames a turn */
    struct ph_projection lens;
    int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE * WIDTH / HEIGHT, FX_HALF, FX_INT(10));
    status = status != 0 ? status : ph_frame_begin(r, &view, &lens, NULL, 0);
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

#endif
