/* shapes: meshes made by code for the programs here: a cube, a ball, a torus, a floor. */
#ifndef SHAPES_H
#define SHAPES_H

#include <pinhole/render.h>

/* The light of most programs here: from the upper left, in front. */
static const struct ph_scene_light shapes_daylight = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.intensity = FX_ONE, .to_light_q30 = {-FX_Q30_ONE / 5 * 2, FX_Q30_ONE / 5 * 3, FX_Q30_ONE / 10 * 7}}}};

/* A mesh of at most 33 x 17 vertices. */
struct shape {
    struct fx_vec3 positions[33 * 17];
    int16_t normals[33 * 17][3];
    fx_t uvs[33 * 17][2];
    uint16_t triangles[32 * 16 * 2][3];
    struct ph_part part;
};

static inline struct ph_mesh shape_mesh(struct shape *s, uint32_t vertices, uint32_t triangles,
                                        const struct ph_material *material)
{
    s->part = (struct ph_part){.count = triangles};
    return (struct ph_mesh){.positions = s->positions,
                            .normals = (const int16_t(*)[3])s->normals,
                            .uvs = (const fx_t(*)[2])s->uvs,
                            .triangles = (const uint16_t(*)[3])s->triangles,
                            .parts = &s->part,
                            .materials = material,
                            .vertex_count = vertices,
                            .triangle_count = triangles,
                            .part_count = 1,
                            .material_count = 1};
}

/* Fills the triangles of a grid of columns x rows cells; its vertices go row by row. Returns how many. */
static inline uint32_t shape_grid(struct shape *s, uint32_t columns, uint32_t rows)
{
    for (uint32_t i = 0; i < columns * rows; i++) {
        const uint16_t a = (uint16_t)(i / columns * (columns + 1) + i % columns), below = (uint16_t)(a + columns + 1);
        const uint16_t quad[2][3] = {{a, below, (uint16_t)(below + 1)}, {a, (uint16_t)(below + 1), (uint16_t)(a + 1)}};
        for (int k = 0; k < 6; k++) {
            s->triangles[2 * i + (uint32_t)k / 3][k % 3] = quad[k / 3][k % 3];
        }
    }
    return columns * rows * 2;
}

/* A torus about z: radius 1, tube `tube`. */
static inline struct ph_mesh shape_torus(struct shape *s, fx_t tube, const struct ph_material *material)
{
    for (uint32_t i = 0; i < 33 * 17; i++) {
        const fx_t u = FX_ONE * (fx_t)(i % 33) / 32, v = -FX_ONE * (fx_t)(i / 33) / 16;
        const fx_t out = fx_cos(v), n[3] = {fx_mul_sat(out, fx_cos(u)), fx_mul_sat(out, fx_sin(u)), fx_sin(v)};
        const fx_t ring[3] = {fx_cos(u), fx_sin(u), 0};
        fx_t *const to[3] = {&s->positions[i].x, &s->positions[i].y, &s->positions[i].z};
        for (int k = 0; k < 3; k++) {
            *to[k] = ring[k] + fx_mul_sat(tube, n[k]);
            s->normals[i][k] = (int16_t)(n[k] / 4);
        }
        s->uvs[i][0] = u * 4;
        s->uvs[i][1] = v * 2;
    }
    return shape_mesh(s, 33 * 17, shape_grid(s, 32, 16), material);
}

/* A ball of radius 1 with its poles on y. */
static inline struct ph_mesh shape_ball(struct shape *s, const struct ph_material *material)
{
    for (uint32_t i = 0; i < 33 * 17; i++) {
        const fx_t u = FX_ONE * (fx_t)(i % 33) / 32, v = FX_ONE * (fx_t)(i / 33) / 32, out = fx_sin(v);
        const struct fx_vec3 p = {fx_mul_sat(out, fx_sin(u)), fx_cos(v), fx_mul_sat(out, fx_cos(u))};
        s->positions[i] = p;
        s->normals[i][0] = (int16_t)(p.x / 4);
        s->normals[i][1] = (int16_t)(p.y / 4);
        s->normals[i][2] = (int16_t)(p.z / 4);
        s->uvs[i][0] = u;
        s->uvs[i][1] = 2 * v;
    }
    return shape_mesh(s, 33 * 17, shape_grid(s, 32, 16), material);
}

/* A cube from -1 to 1; each face has the whole texture. */
static inline struct ph_mesh shape_cube(struct shape *s, const struct ph_material *material)
{
    static const int8_t axes[6][3][3] = {/* normal, right, up */
                                         {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
                                         {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    for (uint32_t i = 0; i < 24; i++) {
        const int8_t(*const axis)[3] = axes[i / 4];
        const int32_t u = i % 4 == 1 || i % 4 == 2, v = i % 4 < 2;
        fx_t p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = FX_INT(axis[0][k] + (2 * u - 1) * axis[1][k] + (1 - 2 * v) * axis[2][k]);
            s->normals[i][k] = (int16_t)(axis[0][k] * 16384);
        }
        s->positions[i] = (struct fx_vec3){p[0], p[1], p[2]};
        s->uvs[i][0] = FX_INT(u);
        s->uvs[i][1] = FX_INT(v);
    }
    for (uint32_t i = 0; i < 12; i++) {
        const uint16_t base = (uint16_t)(i / 2 * 4);
        s->triangles[i][0] = base;
        s->triangles[i][1] = (uint16_t)(base + 1 + i % 2);
        s->triangles[i][2] = (uint16_t)(base + 2 + i % 2);
    }
    return shape_mesh(s, 24, 12, material);
}

/* A floor of 16 x 16 units at y = -1; the texture repeats in each unit. */
static inline struct ph_mesh shape_floor(struct shape *s, const struct ph_material *material)
{
    for (uint32_t i = 0; i < 17 * 17; i++) {
        const int32_t x = (int32_t)(i % 17) - 8, z = (int32_t)(i / 17) - 8;
        s->positions[i] = (struct fx_vec3){FX_INT(x), -FX_ONE, FX_INT(z)};
        s->normals[i][1] = 16384;
        s->uvs[i][0] = FX_INT(x);
        s->uvs[i][1] = FX_INT(z);
    }
    return shape_mesh(s, 17 * 17, shape_grid(s, 16, 16), material);
}

/* Fills 16 x 16 texels with two colours in squares of 8. */
static inline struct ph_texture shape_checks(uint16_t texels[256], uint16_t one, uint16_t other)
{
    for (int i = 0; i < 256; i++) {
        texels[i] = ((i ^ i >> 4) & 8) != 0 ? one : other;
    }
    return (struct ph_texture){.texels = texels, .log2_width = 4, .log2_height = 4};
}

/* A material that takes light, with its ramp. */
static inline struct ph_material shape_lit(uint16_t ramp[PH_RAMP_SIZE], uint8_t red, uint8_t green, uint8_t blue)
{
    ph_material_ramp(ramp, red, green, blue, FX_HALF);
    return (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                .colour = ph_rgb565(red, green, blue),
                                .ramp = ramp,
                                .ambient = FX_ONE / 4,
                                .diffuse = FX_ONE * 3 / 4,
                                .specular = FX_HALF,
                                .shininess_log2 = 4};
}

#endif
