/*
 * The teapot that Martin Newell modelled with Bezier patches (published in F. Crow, "The Origins of the Teapot",
 * IEEE CG&A 7(1), 1987). Most of the 306 control points of its 32 patches are mirror images: pot, lid and bottom are
 * turned from profiles, handle and spout are tubes with a plane of symmetry. The tables below hold the other points, in
 * 1/4000 of the publication's unit and with its z upwards.
 */
#include "models_build.h"

#define CENTRE_Z 6300  /* half the height, in 1/4000 units */
#define DIVISOR  10000 /* 1/4000 unit times this is one of ours; a published unit becomes 0.4 */

/* A control ring of a turned part. Its points in the first quarter are (r, 0), (r, k), (k, r), (0, r) at height z. */
struct ring {
    int16_t r, k, z;
};

/* Two patches from the lid's knob to its edge; neighbouring patches share a ring. */
static const struct ring lid_rings[7] = {
    {0, 0, 12600},      {3200, 1800, 12600}, {0, 0, 11400},      {800, 448, 10800},
    {1600, 896, 10200}, {5200, 2912, 10200}, {5200, 2912, 9600},
};

/* Four patches from the inner rim down to the middle of the bottom. */
static const struct ring pot_rings[13] = {
    {5600, 3136, 9600}, {5350, 2996, 10125}, {5750, 3220, 10125}, {6000, 3360, 9600}, {7000, 3920, 7500},
    {8000, 4480, 5400}, {8000, 4480, 3600},  {8000, 4480, 1800},  {6000, 3360, 900},  {6000, 3360, 600},
    {6000, 3360, 300},  {5700, 3192, 0},     {0, 0, 0},
};

/* Half rings of a tube as x, y >= 0, z; both ends lie in the plane of symmetry. A tube is two patches long. */
static const int16_t handle_rings[7][4][3] = {
    {{-6400, 0, 8100}, {-6400, 1200, 8100}, {-6000, 1200, 9000}, {-6000, 0, 9000}},
    {{-9200, 0, 8100}, {-9200, 1200, 8100}, {-10000, 1200, 9000}, {-10000, 0, 9000}},
    {{-10800, 0, 8100}, {-10800, 1200, 8100}, {-12000, 1200, 9000}, {-12000, 0, 9000}},
    {{-10800, 0, 7200}, {-10800, 1200, 7200}, {-12000, 1200, 7200}, {-12000, 0, 7200}},
    {{-10800, 0, 6300}, {-10800, 1200, 6300}, {-12000, 1200, 5400}, {-12000, 0, 5400}},
    {{-10000, 0, 4500}, {-10000, 1200, 4500}, {-10600, 1200, 3750}, {-10600, 0, 3750}},
    {{-8000, 0, 3600}, {-8000, 1200, 3600}, {-7600, 1200, 2400}, {-7600, 0, 2400}},
};
static const int16_t spout_rings[7][4][3] = {
    {{6800, 0, 5700}, {6800, 2640, 5700}, {6800, 2640, 2400}, {6800, 0, 2400}},
    {{10400, 0, 5700}, {10400, 2640, 5700}, {12400, 2640, 3300}, {12400, 0, 3300}},
    {{9200, 0, 8400}, {9200, 1000, 8400}, {9600, 1000, 8100}, {9600, 0, 8100}},
    {{10800, 0, 9600}, {10800, 1000, 9600}, {13200, 1000, 9600}, {13200, 0, 9600}},
    {{11200, 0, 9900}, {11200, 1000, 9900}, {14100, 1000, 9975}, {14100, 0, 9975}},
    {{11600, 0, 9900}, {11600, 600, 9900}, {13800, 600, 10050}, {13800, 0, 10050}},
    {{11200, 0, 9600}, {11200, 600, 9600}, {12800, 600, 9600}, {12800, 0, 9600}},
};

/* The 16 control points of a patch: rows along the profile or tube, columns around it. */
struct patch {
    int16_t point[4][4][3];
};

/* Bernstein weights of i / n, times n^3, and those of the derivatives, times n^2. */
static void bernstein(int32_t i, int32_t n, int32_t weight[4], int32_t slope[4])
{
    const int32_t j = n - i;
    weight[0] = j * j * j;
    weight[1] = 3 * i * j * j;
    weight[2] = 3 * i * i * j;
    weight[3] = i * i * i;
    slope[0] = -3 * j * j;
    slope[1] = 3 * j * j - 6 * i * j;
    slope[2] = 6 * i * j - 3 * i * i;
    slope[3] = 3 * i * i;
}

/* The sum over the patch of row weight * column weight * coordinate k. It is exact: below 2^33 for n <= 8. */
static int64_t weigh(const struct patch *patch, const int32_t row[4], const int32_t column[4], int k)
{
    int64_t sum = 0;
    for (int i = 0; i < 4; i++) {
        int32_t inner = 0;
        for (int j = 0; j < 4; j++) {
            inner += column[j] * patch->point[i][j][k];
        }
        sum += fx_mul_wide(row[i], inner);
    }
    return sum;
}

/* a / b rounded to nearest, b > 0. */
static fx_t round_divide(int64_t a, int64_t b)
{
    const int64_t doubled = 2 * a + b, quotient = doubled / (2 * b);
    return (fx_t)(doubled % (2 * b) < 0 ? quotient - 1 : quotient);
}

/* a x b of unit vectors in Q2.30. */
static struct fx_vec3 cross_q30(struct fx_vec3 a, struct fx_vec3 b)
{
    return (struct fx_vec3){
        (fx_t)((fx_mul_wide(a.y, b.z) - fx_mul_wide(a.z, b.y)) >> 30),
        (fx_t)((fx_mul_wide(a.z, b.x) - fx_mul_wide(a.x, b.z)) >> 30),
        (fx_t)((fx_mul_wide(a.x, b.y) - fx_mul_wide(a.y, b.x)) >> 30),
    };
}

/* Writes vertex v: the patch at row i and column j of n. The published z is our y. */
static void put_vertex(struct model_build *build, uint32_t v, const struct patch *patch, int32_t i, int32_t j,
                       int32_t n)
{
    int32_t row[4], row_slope[4], column[4], column_slope[4];
    int32_t point[3], down[3], around[3];
    const int64_t cube = (int64_t)n * n * n;
    bernstein(i, n, row, row_slope);
    bernstein(j, n, column, column_slope);
    for (int k = 0; k < 3; k++) {
        const int64_t centre = k == 2 ? CENTRE_Z * cube * cube : 0;
        point[k] = round_divide((weigh(patch, row, column, k) - centre) * FX_ONE, DIVISOR * cube * cube);
        down[k] = (int32_t)weigh(patch, row_slope, column, k);
        around[k] = (int32_t)weigh(patch, row, column_slope, k);
    }
    build->positions[v] = (struct fx_vec3){point[0], point[2], -point[1]};

    struct fx_vec3 along, across, unit;
    fx_vec3_direction_q30((struct fx_vec3){down[0], down[2], -down[1]}, &along);
    fx_vec3_direction_q30((struct fx_vec3){around[0], around[2], -around[1]}, &across);
    fx_vec3_direction_q30(cross_q30(along, across), &unit);
    build->normals[v][0] = model_q14(unit.x);
    build->normals[v][1] = model_q14(unit.y);
    build->normals[v][2] = model_q14(unit.z);
}

/* Patch number `row` of a turned part in quarter 0 .. 3. */
static void turned_patch(struct patch *patch, const struct ring *rings, uint32_t row, uint32_t quarter)
{
    for (uint32_t i = 0; i < 4; i++) {
        const struct ring *const ring = &rings[3 * row + i];
        const int16_t first[4][2] = {{ring->r, 0}, {ring->r, ring->k}, {ring->k, ring->r}, {0, ring->r}};
        for (int j = 0; j < 4; j++) {
            const int16_t x = quarter & 1 ? (int16_t)-first[j][1] : first[j][0];
            const int16_t y = quarter & 1 ? first[j][0] : first[j][1];
            patch->point[i][j][0] = quarter & 2 ? (int16_t)-x : x;
            patch->point[i][j][1] = quarter & 2 ? (int16_t)-y : y;
            patch->point[i][j][2] = ring->z;
        }
    }
}

/* Patch number `row` of a tube: half 0 as it is listed, half 1 as its mirror image, which continues around the tube. */
static void tube_patch(struct patch *patch, const int16_t (*rings)[4][3], uint32_t row, uint32_t half)
{
    for (uint32_t i = 0; i < 4; i++) {
        for (uint32_t j = 0; j < 4; j++) {
            const int16_t *const from = rings[3 * row + i][half ? 3 - j : j];
            patch->point[i][j][0] = from[0];
            patch->point[i][j][1] = half ? (int16_t)-from[1] : from[1];
            patch->point[i][j][2] = from[2];
        }
    }
}

/* Writes rows first .. last of a turned part; each is a ring of 4 n vertices. Returns the next free vertex. */
static uint32_t turn(struct model_build *build, uint32_t v, const struct ring *rings, uint32_t first, uint32_t last,
                     uint32_t n)
{
    struct patch patch;
    for (uint32_t row = first; row <= last; row++) {
        const uint32_t number = row == 0 ? 0 : (row - 1) / n;
        for (uint32_t quarter = 0; quarter < 4; quarter++) {
            turned_patch(&patch, rings, number, quarter);
            for (uint32_t j = 0; j < n; j++) {
                put_vertex(build, v++, &patch, (int32_t)(row - number * n), (int32_t)j, (int32_t)n);
            }
        }
    }
    return v;
}

/* Adds the quads between `rings` rings of `columns` vertices, which begin at vertex v. */
static void join_rings(struct model_build *build, uint32_t v, uint32_t rings, uint32_t columns)
{
    for (uint32_t i = 0; i + 1 < rings; i++) {
        for (uint32_t j = 0; j < columns; j++) {
            const uint32_t a = v + i * columns + j, d = v + i * columns + (j + 1) % columns;
            model_quad(build, a, a + columns, d + columns, d);
        }
    }
}

/* Lid and pot: a pole, rings, a pole. The lid's edge and the inner rim are joined as any two rings are. */
static uint32_t body(struct model_build *build, uint32_t n)
{
    const uint32_t columns = 4 * n, rings = 6 * n;
    uint32_t v = turn(build, 1, lid_rings, 1, 2 * n, n);
    v = turn(build, v, pot_rings, 0, 4 * n - 1, n);
    build->positions[0] = (struct fx_vec3){0, round_divide((int64_t)CENTRE_Z * FX_ONE, DIVISOR), 0};
    build->positions[v] = (struct fx_vec3){0, round_divide(-(int64_t)CENTRE_Z * FX_ONE, DIVISOR), 0};
    /* a patch has no direction around at a pole; its profile is level there */
    build->normals[0][0] = build->normals[0][2] = build->normals[v][0] = build->normals[v][2] = 0;
    build->normals[0][1] = 16384;
    build->normals[v][1] = -16384;
    for (uint32_t j = 0; j < columns; j++) {
        model_triangle(build, 1 + j, 1 + (j + 1) % columns, 0);
    }
    join_rings(build, 1, rings, columns);
    for (uint32_t j = 0; j < columns; j++) {
        model_triangle(build, v - columns + (j + 1) % columns, v - columns + j, v);
    }
    return v + 1;
}

/* Handle or spout: rings of 2 n vertices, and a flat cover at each end. */
static uint32_t tube(struct model_build *build, uint32_t v, const int16_t (*rings)[4][3], uint32_t n)
{
    const uint32_t columns = 2 * n, first = v;
    struct patch patch;
    for (uint32_t row = 0; row <= 2 * n; row++) {
        const uint32_t number = row > n ? 1 : 0;
        for (uint32_t j = 0; j < columns; j++) {
            tube_patch(&patch, rings, number, j / n);
            put_vertex(build, v++, &patch, (int32_t)(row - number * n), (int32_t)(j % n), (int32_t)n);
        }
    }
    join_rings(build, first, 2 * n + 1, columns);
    const uint32_t last = first + 2 * n * columns;
    for (uint32_t j = 1; j + 1 < columns; j++) {
        model_triangle(build, first, first + j, first + j + 1);
        model_triangle(build, last, last + j + 1, last + j);
    }
    return v;
}

int model_teapot(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t segments)
{
    struct model_build build;
    if (segments < 2 || segments > 8) {
        return PH_ERR_INVAL;
    }
    if (model_begin(arena, mesh, &build, MODEL_TEAPOT_VERTICES(segments), MODEL_TEAPOT_TRIANGLES(segments)) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    uint32_t v = body(&build, segments);
    v = tube(&build, v, handle_rings, segments);
    tube(&build, v, spout_rings, segments);
    return PH_OK;
}
