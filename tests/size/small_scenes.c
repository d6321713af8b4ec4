/*
 * Random scenes that the small profile draws: a CRC of the bytes of each, a line a scene. test_small.sh builds it with
 * the whole library and with the small profile, and compares.
 *
 * Usage: small_scenes FIRST COUNT
 */
#include "render.h"

#include <stdio.h>
#include <stdlib.h>

enum { VERTICES = 220, TRIANGLES = 440, SIDE = 300, MESHES = 3 };

static uint32_t seed;

static uint32_t any(uint32_t n) /* 0 .. n - 1 */
{
    seed = seed * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)seed * n >> 32);
}

static int32_t between(int32_t a, int32_t b)
{
    return a + (int32_t)any((uint32_t)(b - a) + 1);
}

static uint64_t room[4 * VERTICES * MESHES * PH_VERTEX_BYTES_32 / 8], list[40000];
static uint16_t pixels[SIDE * SIDE], depth[SIDE * SIDE];
static uint32_t bins[SIDE];
static struct fx_vec3 all_positions[MESHES][VERTICES], *positions;
static int16_t all_normals[MESHES][VERTICES][3], (*normals)[3];
static uint16_t all_triangles[MESHES][TRIANGLES][3], (*triangles)[3];
static uint16_t ramps[2][PH_RAMP_SIZE];

/* A surface that is bent round a ring, so that its small triangles face all ways. */
static uint32_t ring(fx_t large, fx_t small)
{
    const uint32_t around = 3 + any(12), across = 3 + any(10);
    uint32_t n = 0;
    for (uint32_t i = 0; i < around * across; i++) {
        int32_t s, c, ss, sc;
        fx_sincos_q30((uint32_t)(((uint64_t)(i / across) << 32) / around), &s, &c);
        fx_sincos_q30((uint32_t)(((uint64_t)(i % across) << 32) / across), &ss, &sc);
        const fx_t far = large + (fx_t)((int64_t)small * sc >> 30);
        positions[i] = (struct fx_vec3){(fx_t)((int64_t)far * c >> 30), (fx_t)((int64_t)far * s >> 30),
                                        (fx_t)((int64_t)small * ss >> 30)};
        normals[i][0] = (int16_t)((int64_t)sc * c >> 46);
        normals[i][1] = (int16_t)((int64_t)sc * s >> 46);
        normals[i][2] = (int16_t)(ss >> 16);
        const uint32_t row = i / across, next = (row + 1) % around * across, at = i % across, right = (at + 1) % across;
        const uint16_t a = (uint16_t)(row * across + at), b = (uint16_t)(next + at), d = (uint16_t)(next + right),
                       e = (uint16_t)(row * across + right);
        triangles[n][0] = a, triangles[n][1] = b, triangles[n++][2] = d;
        triangles[n][0] = a, triangles[n][1] = d, triangles[n++][2] = e;
    }
    return around * across;
}

/* Triangles of any size and shape, many of them thin, or edge-on. */
static uint32_t soup(fx_t size)
{
    const uint32_t n = 6 + any(50);
    for (uint32_t i = 0; i < n; i++) {
        const fx_t flat = any(3) == 0 ? 64 + (fx_t)any(4096) : size;
        positions[i] = (struct fx_vec3){between(-size, size), between(-size, size), between(-flat, flat)};
        for (int k = 0; k < 3; k++) {
            normals[i][k] = (int16_t)between(-9400, 9400);
        }
    }
    for (uint32_t i = 0; i < 2 * n; i++) {
        for (int k = 0; k < 3; k++) {
            triangles[i][k] = (uint16_t)any(n);
        }
    }
    return n;
}

static const struct ph_shading *any_shading(void)
{
    const uint32_t kind = any(4);
    return kind == 0 ? PH_SHADE_UNLIT : kind == 1 ? PH_SHADE_FLAT : PH_SHADE_GOURAUD;
}

static int draw_mesh(struct ph_renderer *r, uint32_t number)
{
    static struct ph_material materials[MESHES][2];
    static struct ph_part parts[2];
    struct ph_material *const m = materials[number];
    positions = all_positions[number];
    normals = all_normals[number];
    triangles = all_triangles[number];
    const bool is_ring = any(3) != 0;
    const uint32_t n = is_ring ? ring(between(FX_ONE / 2, 3 * FX_ONE), between(FX_ONE / 8, FX_ONE))
                               : soup(between(FX_ONE / 8, 12 * FX_ONE));
    for (int i = 0; i < 2; i++) {
        m[i] = (struct ph_material){.shading = any_shading(),
                                    .two_sided = any(3) == 0,
                                    .shininess_log2 = (uint8_t)any(8),
                                    .depth_bias = any(4) == 0 ? (uint8_t)any(60) : 0,
                                    .ambient = (fx_t)any(FX_ONE),
                                    .diffuse = (fx_t)any(FX_ONE),
                                    .specular = any(2) == 0 ? (fx_t)any(FX_ONE) : 0,
                                    .colour = (uint16_t)any(65536),
                                    .ramp = any(9) == 0 ? NULL : ramps[any(2)]};
    }
    const uint32_t first = any(n);
    parts[0] = (struct ph_part){0, first, 0};
    parts[1] = (struct ph_part){first, 2 * n - first, 1};
    const struct ph_mesh mesh = {.positions = positions,
                                 .normals = any(8) == 0 ? NULL : normals,
                                 .triangles = triangles,
                                 .parts = parts,
                                 .materials = m,
                                 .vertex_count = n,
                                 .triangle_count = 2 * n,
                                 .part_count = 2};
    const struct ph_xform turn_x = ph_xform_rotate_x(seed), turn_y = ph_xform_rotate_y(any(UINT32_MAX));
    struct ph_xform place = ph_xform_mul(&turn_x, &turn_y);
    place.t = (struct fx_vec3){between(-3 * FX_ONE, 3 * FX_ONE), between(-3 * FX_ONE, 3 * FX_ONE),
                               between(-9 * FX_ONE, 3 * FX_ONE)};
    return ph_draw_mesh(r, &mesh, &place);
}

static int begin(struct ph_renderer *r)
{
    const uint16_t width = (uint16_t)between(1, SIDE), height = (uint16_t)between(1, SIDE);
    const struct ph_config config = {.width = width,
                                     .height = height,
                                     .band_height = (uint16_t)between(1, height),
                                     .depth_format = PH_DEPTH_FIXED16,
                                     .vertices = room,
                                     .vertex_max = 4 * VERTICES * MESHES,
                                     .triangles = list,
                                     .triangle_max = sizeof list / PH_TRIANGLE_BYTES_32,
                                     .bins = bins,
                                     .bin_max = SIDE,
                                     .depth = depth};
    const int status = ph_renderer_init(r, &config);
    const struct ph_scene_light light = {
        (fx_t)any(FX_ONE),
        any(6) != 0,
        {{.kind = PH_LIGHT_DIRECTIONAL,
          .intensity = (fx_t)any(4 * FX_ONE),
          .to_light_q30 = {between(-600000000, 600000000), between(-600000000, 600000000), 600000000}}}};
    const fx_t near_z = 64 << any(11), far_z = near_z + 1 + (fx_t)any(1 << (12 + any(12)));
    const fx_t half = FX_ONE * 4;
    struct ph_projection lens;
    const struct ph_xform view = ph_xform_translate(0, 0, between(-4 * FX_ONE, FX_ONE));
    const int made = any(5) == 0 ? ph_projection_ortho(&lens, -half, half, -half, half, near_z, far_z)
                                 : ph_projection_perspective(&lens, FX_INT(20 + (int)any(100)), FX_ONE, near_z, far_z);
    return status != PH_OK ? status
           : made != PH_OK ? made
                           : ph_frame_begin(r, &view, &lens, any(9) == 0 ? NULL : &light, (uint16_t)any(65536));
}

/* FNV-1a of the pixels and of the depth of each band. */
static uint32_t sum_of(uint32_t sum, const uint16_t *of, uint32_t n)
{
    for (uint32_t i = 0; i < 2 * n; i++) {
        sum = (sum ^ ((const uint8_t *)of)[i]) * 16777619u;
    }
    return sum;
}

static void draw_scene(uint32_t number)
{
    static struct ph_renderer r;
    uint32_t sum = 2166136261u;
    seed = number * 2654435761u;
    int status = begin(&r);
    for (uint32_t i = any(MESHES) + 1; i > 0 && status == PH_OK; i--) {
        status = draw_mesh(&r, i - 1);
    }
    const uint32_t bands = ph_frame_bands(&r);
    for (uint32_t i = 0; i < bands; i++) {
        const uint32_t lines = ph_draw_band(&r, i, pixels);
        sum = sum_of(sum_of(sum, pixels, lines * r.config.width), depth, lines * r.config.width);
    }
    printf("%u %d %08x %u %u\n", (unsigned)number, status, (unsigned)sum, (unsigned)r.stats.triangles_dropped,
           (unsigned)r.stats.fragments);
}

int main(int argc, char **argv)
{
    const uint32_t first = argc > 2 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    const uint32_t count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1;
    ph_material_ramp(ramps[0], 255, 160, 0, 0);
    ph_material_ramp(ramps[1], 10, 200, 255, FX_ONE);
    for (uint32_t i = first; i < first + count; i++) {
        draw_scene(i);
    }
    return 0;
}
