/* Floors, boxes and surfaces of revolution: see models.h. */
#include "models_build.h"

/* Adds the squares of one colour of the chessboard. */
static void floor_squares(struct model_build *build, uint32_t cells, uint32_t colour)
{
    const uint32_t side = cells + 1;
    for (uint32_t i = 0; i < cells; i++) {
        for (uint32_t j = 0; j < cells; j++) {
            const uint32_t a = i * side + j;
            if (((i + j) & 1) == colour) {
                model_quad(build, a, a + side, a + side + 1, a + 1);
            }
        }
    }
}

int model_floor(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells, const struct ph_material materials[2])
{
    struct model_build build;
    if (cells < 1 || cells > 255) {
        return PH_ERR_INVAL;
    }
    const uint32_t side = cells + 1;
    struct ph_part *const parts = demo_alloc(arena, 2 * sizeof(*parts));
    if (!parts || model_begin(arena, mesh, &build, side * side, 2 * cells * cells) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < side * side; i++) {
        const int32_t x2 = (int32_t)(2 * (i % side)) - (int32_t)cells;
        const int32_t z2 = (int32_t)(2 * (i / side)) - (int32_t)cells;
        build.positions[i] = (struct fx_vec3){x2 * FX_HALF, 0, z2 * FX_HALF};
        build.normals[i][0] = build.normals[i][2] = 0;
        build.normals[i][1] = 16384;
    }
    floor_squares(&build, cells, 0);
    parts[0] = (struct ph_part){0, build.triangle_count, 0};
    floor_squares(&build, cells, 1);
    parts[1] = (struct ph_part){parts[0].count, build.triangle_count - parts[0].count, 1};
    mesh->parts = parts;
    mesh->part_count = 2;
    mesh->materials = materials;
    return PH_OK;
}

int model_box(struct demo_arena *arena, struct ph_mesh *mesh, fx_t x, fx_t y, fx_t z)
{
    struct fx_vec3 *const positions = demo_alloc(arena, 24 * sizeof(*positions));
    if (!positions || model_cube(arena, mesh) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < 24; i++) {
        const struct fx_vec3 p = mesh->positions[i];
        positions[i] = (struct fx_vec3){p.x > 0 ? x : -x, p.y > 0 ? y : -y, p.z > 0 ? z : -z};
    }
    mesh->positions = positions;
    return PH_OK;
}

/* The unit normal of a profile's side from a to b, (outwards, upwards) in Q2.30. False: a and b are the same point. */
static bool profile_normal(struct model_point a, struct model_point b, struct fx_vec3 *unit_q30)
{
    return fx_vec3_direction_q30((struct fx_vec3){b.y - a.y, a.radius - b.radius, 0}, unit_q30);
}

/* The normal at point i: the mean of its two sides' normals, or the normal of the side that has a length. */
static struct fx_vec3 ring_normal(const struct model_point *profile, uint32_t points, uint32_t i)
{
    struct fx_vec3 below = {0, 0, 0}, above = {0, 0, 0}, mean = {FX_Q30_ONE, 0, 0};
    if (i > 0) {
        profile_normal(profile[i - 1], profile[i], &below);
    }
    if (i + 1 < points) {
        profile_normal(profile[i], profile[i + 1], &above);
    }
    fx_vec3_direction_q30((struct fx_vec3){below.x / 2 + above.x / 2, below.y / 2 + above.y / 2, 0}, &mean);
    return mean;
}

/* The first n of a ring's vertices. */
static void lathe_ring(struct model_build *build, uint32_t first, uint32_t n, uint32_t sides, struct model_point at,
                       struct fx_vec3 normal)
{
    for (uint32_t k = 0; k < n; k++) {
        const fx_t turns = (fx_t)((k * 65536 + sides / 2) / sides), c = fx_cos(turns), s = fx_sin(turns);
        build->positions[first + k] = (struct fx_vec3){fx_mul_sat(at.radius, c), at.y, -fx_mul_sat(at.radius, s)};
        build->normals[first + k][0] = model_q14(fx_mul_sat(normal.x, c));
        build->normals[first + k][1] = model_q14(normal.y);
        build->normals[first + k][2] = (int16_t)-model_q14(fx_mul_sat(normal.x, s));
    }
}

int model_lathe(struct demo_arena *arena, struct ph_mesh *mesh, const struct model_point *profile, uint32_t points,
                uint32_t sides, uint32_t stripes, const struct ph_material *materials)
{
    struct model_build build;
    if (points < 2 || points > 64 || sides < 3 || sides > 64 || stripes < 1 || sides % stripes != 0) {
        return PH_ERR_INVAL;
    }
    struct ph_part *const parts = demo_alloc(arena, stripes * sizeof(*parts));
    if (!parts || model_begin(arena, mesh, &build, sides * points, 2 * sides * (points - 1)) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < points; i++) {
        lathe_ring(&build, i * sides, sides, sides, profile[i], ring_normal(profile, points, i));
    }
    for (uint32_t stripe = 0; stripe < stripes; stripe++) {
        parts[stripe] = (struct ph_part){build.triangle_count, 0, (uint16_t)stripe};
        for (uint32_t i = 0; i < sides * (points - 1); i++) {
            const uint32_t k = i % sides;
            if (k % stripes == stripe) {
                const uint32_t next = i - k + (k + 1) % sides;
                model_quad(&build, i, next, next + sides, i + sides);
            }
        }
        parts[stripe].count = build.triangle_count - parts[stripe].first;
    }
    mesh->parts = parts;
    mesh->part_count = (uint16_t)stripes;
    mesh->materials = materials;
    return PH_OK;
}

int model_lathe_arc(struct demo_arena *arena, struct ph_mesh *mesh, const struct model_point *profile, uint32_t points,
                    uint32_t sides, uint32_t seen, const struct ph_material *material)
{
    struct model_build build;
    const uint32_t n = seen + 1;
    if (points < 2 || points > 64 || sides < 3 || sides > 64 || seen < 1 || seen >= sides) {
        return PH_ERR_INVAL;
    }
    if (model_begin(arena, mesh, &build, n * points, 2 * seen * (points - 1)) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < points; i++) {
        lathe_ring(&build, i * n, n, sides, profile[i], ring_normal(profile, points, i));
        for (uint32_t k = i * n; i + 1 < points && k < i * n + seen; k++) {
            model_quad(&build, k, k + 1, k + 1 + n, k + n);
        }
    }
    return model_material(arena, mesh, material);
}
