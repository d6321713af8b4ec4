/* Coarse depth (coarse.h): pictures are what they are without it, and what is hidden is not looked at. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "coarse.h"
#include "raster.h"
#include "render.h"

enum { WIDTH = 320, HEIGHT = 64, QUADS = 12, SMALL = 40, CORNERS = 4 * QUADS + 3 * SMALL, SCENES = 150 };
enum { FACES = 2 * QUADS + SMALL };

static uint64_t vertices[4096], triangles[4096];
static uint32_t bins[HEIGHT], depth[WIDTH * HEIGHT];
static uint16_t pictures[2][WIDTH * HEIGHT];
static struct fx_vec3 corners[CORNERS];
static uint16_t faces[FACES][3];
static struct ph_part parts[FACES];
static struct ph_material materials[FACES];
static uint16_t ramp[PH_RAMP_SIZE];
static uint32_t seed;

static int32_t random_in(int32_t from, int32_t to)
{
    seed = seed * 1664525u + 1013904223u;
    return from + (int32_t)((uint64_t)(uint32_t)(to - from) * (seed >> 8) >> 24);
}

/* A quad around the axis, larger than the picture or not; it faces the camera, or leans. */
static void add_quad(uint32_t i)
{
    const fx_t z = -random_in(FX_INT(2), FX_INT(12)), lean = i % 3 == 0 ? random_in(-FX_ONE, FX_ONE) : 0;
    const fx_t x = random_in(FX_ONE, FX_INT(16)), y = random_in(FX_HALF, FX_INT(6));
    const struct fx_vec3 four[4] = {{-x, -y, z - lean}, {x, -y, z + lean}, {x, y, z + lean}, {-x, y, z - lean}};
    memcpy(&corners[4 * i], four, sizeof four);
    for (uint16_t k = 0; k < 2; k++) {
        faces[2 * i + k][0] = (uint16_t)(4 * i);
        faces[2 * i + k][1] = (uint16_t)(4 * i + 1 + k);
        faces[2 * i + k][2] = (uint16_t)(4 * i + 2 + k);
    }
}

static void add_small(uint32_t i)
{
    const uint16_t first = (uint16_t)(4 * QUADS + 3 * i);
    const fx_t z = -random_in(FX_INT(2), FX_INT(12)), x = random_in(-FX_INT(6), FX_INT(6)),
               y = random_in(-FX_ONE, FX_ONE);
    corners[first] = (struct fx_vec3){x, y, z};
    corners[first + 1] = (struct fx_vec3){x + FX_ONE / 4, y, z};
    corners[first + 2] = (struct fx_vec3){x, y + FX_ONE / 4, z + FX_ONE / 8};
    for (uint16_t k = 0; k < 3; k++) {
        faces[2 * QUADS + i][k] = (uint16_t)(first + k);
    }
}

static void make_scene(void)
{
    for (uint32_t i = 0; i < QUADS; i++) {
        add_quad(i);
    }
    for (uint32_t i = 0; i < SMALL; i++) {
        add_small(i);
    }
    for (uint32_t i = 0; i < FACES; i++) {
        parts[i] = (struct ph_part){.first = i, .count = 1, .material = (uint16_t)i};
        materials[i] = (struct ph_material){.shading = random_in(0, 2) == 0 ? PH_SHADE_UNLIT : PH_SHADE_GOURAUD,
                                            .colour = (uint16_t)(i + 1),
                                            .ambient = FX_ONE / 4,
                                            .diffuse = FX_ONE / 2,
                                            .two_sided = true,
                                            .ramp = ramp};
    }
}

static void draw(const struct ph_depth_format *format, uint16_t lines, const struct ph_occlusion *occlusion,
                 uint16_t *pixels)
{
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = lines,
                                     .depth_format = format,
                                     .occlusion = occlusion,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth};
    const struct ph_projection projection = {
        .near_z = FX_ONE, .far_z = FX_INT(40), .scale_x_q20 = 1 << 19, .scale_y_q20 = 5 << 19};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = (const uint16_t(*)[3])faces,
                                 .parts = parts,
                                 .materials = materials,
                                 .vertex_count = CORNERS,
                                 .triangle_count = FACES,
                                 .part_count = FACES};
    struct ph_renderer r;
    assert_int_equal(ph_renderer_init(&r, &config), PH_OK);
    assert_int_equal(ph_frame_begin(&r, &ph_xform_identity, &projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&r, &mesh, &ph_xform_identity), PH_OK);
    for (uint32_t band = 0, bands = ph_frame_bands(&r); band < bands; band++) {
        ph_draw_band(&r, band, pixels + band * lines * WIDTH);
    }
    assert_int_equal(r.stats.triangles_dropped + r.stats.vertices_dropped, 0);
}

static void pictures_are_the_same_without_it(void **state)
{
    (void)state;
    static const struct ph_depth_format *const formats[] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16, PH_DEPTH_FIXED24,
                                                            PH_DEPTH_LINEAR_W};
    static const uint16_t heights[] = {8, 16, 24, HEIGHT};
    ph_material_ramp(ramp, 255, 200, 100, 0);
    for (uint32_t scene = 0; scene < SCENES; scene++) {
        seed = scene;
        make_scene();
        draw(formats[scene % 4], heights[scene / 4 % 4], NULL, pictures[0]);
        draw(formats[scene % 4], heights[scene / 4 % 4], PH_COARSE_DEPTH, pictures[1]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    }
}

/* A triangle of rows 0 .. 15 from column `from` to column `to`, the edge between them aslant or not. */
static struct ph_triangle wall(int32_t from, int32_t to, int32_t dx_from, int32_t dx_to, uint32_t d)
{
    struct ph_triangle t = {.y_bottom = 16, .kind = PH_KIND_FLAT, .block = PH_BLOCK_NONE};
    t.as.large.long_left = 1;
    t.as.large.of.colour = 7;
    t.as.large.lower = (struct ph_edge){to * 65536, dx_to};
    t.as.large.long_edge = (struct ph_edge){from * 65536, dx_from};
    t.as.large.depth.as.plane.base = d;
    return t;
}

/* How many pixels of t are drawn where two triangles that share an edge were drawn before; the depths of these are
 * forgotten, so that the coarse depth alone can hide it. */
static uint32_t drawn_behind(struct ph_triangle t)
{
    static const struct ph_material none;
    static uint16_t pixels[16 * WIDTH], codes[16 * WIDTH];
    struct ph_coarse coarse = {.count = 0, .occlusion = PH_COARSE_DEPTH};
    const struct ph_band band = {pixels, codes, false, WIDTH, 0, 16, WIDTH, &coarse, PH_DEPTH_FIXED16->ways, NULL};
    struct ph_triangle left = wall(-5, 100, 0, 1 << 16, 2000u << 16), right = wall(100, 330, 1 << 16, 0, 1990u << 16);
    left.material = right.material = t.material = &none;
    memset(codes, 0, sizeof codes);
    assert_int_not_equal(ph_draw_triangle(&left, &band), 0);
    assert_int_not_equal(ph_draw_triangle(&right, &band), 0);
    memset(codes, 0, sizeof codes);
    memset(pixels, 0, sizeof pixels);
    ph_draw_triangle(&t, &band);
    uint32_t count = 0;
    for (uint32_t i = 0; i < 16 * WIDTH; i++) {
        count += pixels[i] != 0;
    }
    return count;
}

static void what_is_hidden_is_not_looked_at(void **state)
{
    (void)state;
    assert_int_equal(drawn_behind(wall(-9, 400, 0, 0, 1990u << 16)),
                     0); /* as far: it does not pass the test of depth */
    assert_int_equal(drawn_behind(wall(60, 260, 3 << 16, -(1 << 15), 1000u << 16)), 0);
    assert_int_equal(drawn_behind(wall(-9, 400, 0, 0, (1990u << 16) + 65535)), 0);
}

static void what_may_be_seen_is_drawn(void **state)
{
    (void)state;
    assert_int_equal(drawn_behind(wall(-9, 400, 0, 0, 1991u << 16)), 16 * WIDTH);
    struct ph_triangle leaning = wall(0, WIDTH, 0, 0, 1000u << 16);
    leaning.as.large.depth.as.plane.gx = 4u << 16;
    assert_int_equal(drawn_behind(leaning), 16 * WIDTH);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_the_same_without_it),
        cmocka_unit_test(what_is_hidden_is_not_looked_at),
        cmocka_unit_test(what_may_be_seen_is_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
