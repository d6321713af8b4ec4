/* See models.h. A sphere made of an icosahedron whose triangles are divided into four, again and again. */
#include "models_build.h"

#define NONE 0xFFFF

/*
 * The edges that are halved already, in a list for each lower end: first[lower] is the youngest midpoint,
 * next[midpoint] an older one, other[midpoint] the upper end. No vertex has more than 6 edges, so no list is longer.
 */
struct halves {
    struct fx_vec3 *vertices_q30;
    uint32_t count;
    uint16_t *first, *next, *other;
};

/* The midpoint of a and b on the sphere; it is made when it is first asked for. */
static uint16_t midpoint(struct halves *h, uint16_t a, uint16_t b)
{
    const uint16_t lower = a < b ? a : b, upper = a < b ? b : a;
    for (uint16_t m = h->first[lower]; m != NONE; m = h->next[m]) {
        if (h->other[m] == upper) {
            return m;
        }
    }
    const struct fx_vec3 p = h->vertices_q30[lower], q = h->vertices_q30[upper];
    const uint16_t m = (uint16_t)h->count++;
    const struct fx_vec3 sum = {(p.x >> 1) + (q.x >> 1), (p.y >> 1) + (q.y >> 1), (p.z >> 1) + (q.z >> 1)};
    fx_vec3_direction_q30(sum, &h->vertices_q30[m]);
    h->other[m] = upper;
    h->next[m] = h->first[lower];
    h->first[lower] = m;
    return m;
}

/* Divides each triangle into four. It works from the last to the first, so that they fit into the same array. */
static void subdivide(struct halves *h, uint16_t (*triangles)[3], uint32_t triangle_count)
{
    const uint32_t old_count = h->count;
    for (uint32_t i = 0; i < old_count; i++) {
        h->first[i] = NONE;
    }
    for (uint32_t i = triangle_count; i-- > 0;) {
        const uint16_t a = triangles[i][0], b = triangles[i][1], c = triangles[i][2];
        const uint16_t ab = midpoint(h, a, b), bc = midpoint(h, b, c), ca = midpoint(h, c, a);
        const uint16_t four[4][3] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
        for (int k = 0; k < 4; k++) {
            for (int corner = 0; corner < 3; corner++) {
                triangles[4 * i + (uint32_t)k][corner] = four[k][corner];
            }
        }
    }
}

/* Vertex 4 k + 2 s + t has -1 or 1 (s) on axis k and -phi or phi (t) on the next axis. */
static void icosahedron(struct halves *h, struct model_build *build)
{
    static const uint8_t faces[20][3] = {{0, 4, 2},  {0, 2, 5},  {0, 8, 4},  {0, 5, 10}, {0, 10, 8},
                                         {1, 3, 6},  {1, 7, 3},  {1, 6, 8},  {1, 10, 7}, {1, 8, 10},
                                         {2, 4, 9},  {2, 11, 5}, {2, 9, 11}, {3, 9, 6},  {3, 7, 11},
                                         {3, 11, 9}, {4, 8, 6},  {4, 6, 9},  {5, 7, 10}, {5, 11, 7}};
    const int32_t short_q30 = 564499483; /* 1 / sqrt(1 + phi^2) */
    const int32_t long_q30 = 913379351;  /* phi / sqrt(1 + phi^2) */
    for (uint32_t i = 0; i < 12; i++) {
        int32_t p[3] = {0, 0, 0};
        p[i / 4] = i & 2 ? short_q30 : -short_q30;
        p[(i / 4 + 1) % 3] = i & 1 ? long_q30 : -long_q30;
        h->vertices_q30[i] = (struct fx_vec3){p[0], p[1], p[2]};
    }
    h->count = 12;
    for (uint32_t i = 0; i < 20; i++) {
        model_triangle(build, faces[i][0], faces[i][1], faces[i][2]);
    }
}

int model_icosphere(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t levels)
{
    struct model_build build;
    if (levels > MODEL_ICOSPHERE_LEVELS_MAX) {
        return PH_ERR_INVAL;
    }
    const uint32_t vertices = MODEL_ICOSPHERE_VERTICES(levels);
    if (model_begin(arena, mesh, &build, vertices, MODEL_ICOSPHERE_TRIANGLES(levels)) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    /*
     * Until the end the positions are Q2.30: 14 guard bits for the normalisations of all levels. The lists lie where
     * the normals will be, because both are three 16-bit numbers a vertex.
     */
    uint16_t *const lists = (uint16_t *)build.normals;
    struct halves h = {build.positions, 0, lists, lists + vertices, lists + 2 * vertices};
    icosahedron(&h, &build);
    for (uint32_t level = 0; level < levels; level++) {
        subdivide(&h, build.triangles, MODEL_ICOSPHERE_TRIANGLES(level));
    }
    for (uint32_t i = 0; i < vertices; i++) {
        struct fx_vec3 *const p = &build.positions[i];
        build.normals[i][0] = model_q14(p->x);
        build.normals[i][1] = model_q14(p->y);
        build.normals[i][2] = model_q14(p->z);
        *p = (struct fx_vec3){model_q16(p->x), model_q16(p->y), model_q16(p->z)};
    }
    return PH_OK;
}
