/* See ref_drawing.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_drawing.h"

#include <math.h>
#include <string.h>

const char *const nothing[HEIGHT] = {
    "................", "................", "................", "................",
    "................", "................", "................", "................",
    "................", "................", "................", "................",
};

static fx_t q16(double v)
{
    return (fx_t)lrint(v * 65536);
}

uint16_t colour_of(char letter)
{
    int i = letter - '0';
    return ph_rgb565((uint8_t)(8 * (i % 32)), (uint8_t)(4 * (i % 64)), i < 64 ? 255 : 128);
}

static struct fx_vec3 position(const double corner[3])
{
    return (struct fx_vec3){q16(corner[0]), q16(HEIGHT - corner[1]), q16(-2 - corner[2])};
}

void drawing_open_formats(struct drawing *d, int band_height, int triangle_max, const struct ph_depth_format *format)
{
    memset(d, 0, sizeof(*d));
    rig_open(&d->rig, WIDTH, HEIGHT, band_height, format, 64, triangle_max);
}

void drawing_close(struct drawing *d)
{
    rig_close(&d->rig);
}

void drawing_begin(struct drawing *d, const struct ph_scene_light *light)
{
    struct ph_projection projection;
    assert_int_equal(ph_projection_ortho(&projection, 0, FX_INT(WIDTH), 0, FX_INT(HEIGHT), FX_ONE, FX_INT(3)), PH_OK);
    assert_int_equal(ph_frame_begin(&d->rig.r, &ph_xform_identity, &projection, light, BLACK), PH_OK);
    d->count = 0;
}

void drawing_open(struct drawing *d)
{
    drawing_open_formats(d, HEIGHT, 64, PH_DEPTH_FIXED16);
    drawing_begin(d, NULL);
}

struct rig_one *shape_mesh(struct drawing *d, const struct shape *shape)
{
    struct rig_one *one = &d->ones[d->count++];
    assert_true(d->count <= SHAPE_MAX);
    memset(one, 0, sizeof(*one));
    for (uint16_t k = 0; k < 3; k++) {
        one->positions[k] = position(shape->corners[k]);
        one->triangle[0][k] = k;
    }
    one->material = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = colour_of(shape->letter)};
    one->part = (struct ph_part){0, 1, 0};
    one->mesh = (struct ph_mesh){.positions = one->positions,
                                 .triangles = (const uint16_t(*)[3])one->triangle,
                                 .parts = &one->part,
                                 .materials = &one->material,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
    return one;
}

void draw_mesh(struct drawing *d, const struct rig_one *one)
{
    assert_int_equal(ph_draw_mesh(&d->rig.r, &one->mesh, &ph_xform_identity), PH_OK);
}

void draw_shapes(struct drawing *d, const struct shape *shapes, int count)
{
    for (int i = 0; i < count; i++) {
        draw_mesh(d, shape_mesh(d, &shapes[i]));
    }
}

char letter_at(const struct drawing *d, int x, int y)
{
    uint16_t colour = d->rig.pixels[y * WIDTH + x];
    for (int letter = '0'; letter <= 'z'; letter++) {
        if (colour == colour_of((char)letter)) {
            return (char)letter;
        }
    }
    return colour == BLACK ? '.' : '?';
}

void expect(struct drawing *d, const char *const rows[HEIGHT])
{
    char shown[HEIGHT][WIDTH + 1] = {0};
    int wrong = 0;
    assert_true(rig_finish(&d->rig));
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            shown[y][x] = letter_at(d, x, y);
            wrong += shown[y][x] != rows[y][x];
        }
    }
    for (int y = 0; wrong && y < HEIGHT; y++) {
        print_message("    %s   %s\n", rows[y], shown[y]);
    }
    assert_int_equal(wrong, 0);
}

void expect_shapes(const struct shape *shapes, int count, const char *const rows[HEIGHT])
{
    struct drawing d;
    drawing_open(&d);
    draw_shapes(&d, shapes, count);
    expect(&d, rows);
    drawing_close(&d);
}
