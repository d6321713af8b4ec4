/* See models.h. What all shapes share: memory, triangles and quads, number formats, the material. */
#include "models_build.h"

int model_begin(struct demo_arena *arena, struct ph_mesh *mesh, struct model_build *build, uint32_t vertices,
                uint32_t triangles)
{
    *mesh = (struct ph_mesh){.vertex_count = vertices, .triangle_count = triangles};
    build->positions = demo_alloc(arena, vertices * sizeof(*build->positions));
    build->normals = demo_alloc(arena, vertices * sizeof(*build->normals));
    build->triangles = demo_alloc(arena, triangles * sizeof(*build->triangles));
    build->triangle_count = 0;
    if (!build->positions || !build->normals || !build->triangles) {
        return PH_ERR_NOMEM;
    }
    mesh->positions = build->positions;
    mesh->normals = (const int16_t(*)[3])build->normals;
    mesh->triangles = (const uint16_t(*)[3])build->triangles;
    return PH_OK;
}

void model_triangle(struct model_build *build, uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *const t = build->triangles[build->triangle_count++];
    t[0] = (uint16_t)a;
    t[1] = (uint16_t)b;
    t[2] = (uint16_t)c;
}

void model_quad(struct model_build *build, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    model_triangle(build, a, b, c);
    model_triangle(build, a, c, d);
}

fx_t model_q16(int32_t q30)
{
    return (q30 + (1 << 13)) >> 14;
}

int16_t model_q14(int32_t q30)
{
    return (int16_t)((q30 + (1 << 15)) >> 16);
}

void *model_scratch(struct demo_arena *arena, size_t n)
{
    const size_t bytes = MODEL_ROUND8(n), end = arena->size & ~(size_t)7;
    if (end < bytes || end - bytes < arena->used) {
        return NULL;
    }
    arena->size = end - bytes;
    return arena->base + arena->size;
}

int model_material(struct demo_arena *arena, struct ph_mesh *mesh, const struct ph_material *material)
{
    struct ph_part *const part = demo_alloc(arena, sizeof(*part));
    if (!part) {
        return PH_ERR_NOMEM;
    }
    *part = (struct ph_part){.first = 0, .count = mesh->triangle_count, .material = 0};
    mesh->parts = part;
    mesh->part_count = 1;
    mesh->materials = material;
    return PH_OK;
}

/* a times a number of Q2.30, rounded to nearest. */
static int32_t mul_q30(int32_t a, int32_t b)
{
    return (int32_t)((fx_mul_wide(a, b) + (1 << 29)) >> 30);
}

/* Cosine and sine of angle number i of n around the circle. */
static void circle(uint32_t i, uint32_t n, int32_t *sin_q30, int32_t *cos_q30)
{
    fx_sincos_q30((uint32_t)((((uint64_t)i << 32) + n / 2) / n), sin_q30, cos_q30);
}

int model_torus(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t major, uint32_t minor, int32_t radius_q28,
                int32_t tube_q28)
{
    struct model_build build;
    if (major < 3 || major > 256 || minor < 3 || minor > 256 || radius_q28 < 0 || tube_q28 < 0 ||
        (int64_t)radius_q28 + tube_q28 > INT32_MAX) {
        return PH_ERR_INVAL;
    }
    if (major * minor > 65536 || model_begin(arena, mesh, &build, major * minor, 2 * major * minor) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < major; i++) {
        const uint32_t row = i * minor, next = (i + 1) % major * minor;
        int32_t su, cu;
        circle(i, major, &su, &cu);
        for (uint32_t j = 0; j < minor; j++) {
            int32_t sv, cv;
            circle(j, minor, &sv, &cv);
            const int32_t ring = radius_q28 + mul_q30(tube_q28, cv);
            build.positions[row + j].x = (fx_t)((fx_mul_wide(ring, cu) + ((int64_t)1 << 41)) >> 42);
            build.positions[row + j].y = (fx_t)((fx_mul_wide(ring, su) + ((int64_t)1 << 41)) >> 42);
            build.positions[row + j].z = (fx_t)((fx_mul_wide(tube_q28, sv) + ((int64_t)1 << 41)) >> 42);
            build.normals[row + j][0] = model_q14(mul_q30(cv, cu));
            build.normals[row + j][1] = model_q14(mul_q30(cv, su));
            build.normals[row + j][2] = model_q14(sv);
            model_quad(&build, row + j, next + j, next + (j + 1) % minor, row + (j + 1) % minor);
        }
    }
    return PH_OK;
}

int model_cube(struct demo_arena *arena, struct ph_mesh *mesh)
{
    /* For each face: normal, right, up. */
    static const int8_t faces[6][3][3] = {
        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    };
    static const uint8_t corners[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    struct model_build build;
    fx_t(*const uvs)[2] = demo_alloc(arena, 24 * sizeof(*uvs));
    if (!uvs || model_begin(arena, mesh, &build, 24, 12) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    mesh->uvs = (const fx_t(*)[2])uvs;
    for (uint32_t i = 0; i < 24; i++) {
        const int8_t(*const face)[3] = faces[i / 4];
        const int u = corners[i % 4][0], v = corners[i % 4][1];
        fx_t p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = FX_INT(face[0][k] + (2 * u - 1) * face[1][k] + (1 - 2 * v) * face[2][k]);
            build.normals[i][k] = (int16_t)(16384 * face[0][k]);
        }
        build.positions[i] = (struct fx_vec3){p[0], p[1], p[2]};
        uvs[i][0] = FX_INT(u);
        uvs[i][1] = FX_INT(v);
    }
    for (uint32_t q = 0; q < 24; q += 4) {
        model_quad(&build, q, q + 1, q + 2, q + 3);
    }
    return PH_OK;
}

/* The wavy normal at (x, z) = (i2, k2) / 2 is the direction of (.5 sin 1.3 x, 1, .5 cos 1.7 z). */
static void ground_normal(int32_t i2, int32_t k2, int16_t normal[3])
{
    const int64_t turn_13_q16 = 29118787035115; /* .65 rad in 2^-48 turns */
    const int64_t turn_17_q16 = 38078413815150; /* .85 rad */
    int32_t sin_x, cos_z, unused;
    struct fx_vec3 unit;
    fx_sincos_q30((uint32_t)((i2 * turn_13_q16 + (1 << 15)) >> 16), &sin_x, &unused);
    fx_sincos_q30((uint32_t)((k2 * turn_17_q16 + (1 << 15)) >> 16), &unused, &cos_z);
    fx_vec3_direction_q30((struct fx_vec3){sin_x >> 1, FX_Q30_ONE, cos_z >> 1}, &unit);
    normal[0] = model_q14(unit.x);
    normal[1] = model_q14(unit.y);
    normal[2] = model_q14(unit.z);
}

int model_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells)
{
    struct model_build build;
    if (cells < 1 || cells > 255) {
        return PH_ERR_INVAL;
    }
    const uint32_t side = cells + 1;
    if (model_begin(arena, mesh, &build, side * side, 2 * cells * cells) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < side; i++) {
        for (uint32_t j = 0; j < side; j++) {
            const int32_t x2 = (int32_t)(2 * j) - (int32_t)cells, z2 = (int32_t)(2 * i) - (int32_t)cells;
            const uint32_t a = i * side + j;
            build.positions[a] = (struct fx_vec3){x2 * FX_HALF, 0, z2 * FX_HALF};
            ground_normal(x2, z2, build.normals[a]);
            if (i < cells && j < cells) {
                model_triangle(&build, a, a + side, a + side + 1);
                model_triangle(&build, a, a + side + 1, a + 1);
            }
        }
    }
    return PH_OK;
}
