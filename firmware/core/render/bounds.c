/*
 * Bounds of meshes: whether a sphere lies off the picture, and the sphere around vertices. See bounds.h, render.h.
 *
 * The test has products of 32 bits, and rounds so that a sphere only grows. It takes coordinates within 4096.0, so that
 * nothing saturates that ph_draw_mesh computes of points in the sphere, and matrices that make no vector twice as long;
 * all else may be in the picture. Elements of matrices are cut to Q2.14. So a coordinate of the centre in the world is
 * at most 2^-14 |c| + 3 LSB off, where |c| is the sum of the magnitudes of its coordinates, and one in the view
 * 2^-14 |world| + 3 LSB more; sqrt 3 times these is the error of the place. To it 16 LSB come of what ph_draw_mesh
 * rounds. The picture has a border of one pixel here, which is more than what ph_draw_mesh rounds on the screen.
 */
#include "bounds.h"

#include "check.h"
#include "fisheye.h"
#include "list.h"
#include "sphere.h"

#define REACH ((uint32_t)1 << 28) /* 4096.0 */

/* Whether all coordinates are within 4096.0. */
static bool is_near(struct fx_vec3 v)
{
    return (((uint32_t)v.x + REACH) | ((uint32_t)v.y + REACH) | ((uint32_t)v.z + REACH)) < 2 * REACH;
}

static uint32_t sum_of(struct fx_vec3 v)
{
    return fx_magnitude(v.x) + fx_magnitude(v.y) + fx_magnitude(v.z);
}

/* x times v in Q14, rounded down; |x| is below 2^28, |v| at most 2^16. */
static inline int32_t times(int32_t x, int32_t v)
{
    return FX_MULTIPLIES ? (int32_t)(fx_mul_wide(x, v) >> 14) : (x >> 14) * v + ((x & 16383) * v >> 14);
}

static int32_t row_times(const int32_t row[3], struct fx_vec3 p, int32_t t)
{
    return times(p.x, row[0] >> 16) + times(p.y, row[1] >> 16) + times(p.z, row[2] >> 16) + t;
}

/* Product of two rows, Q26: below 2^30. */
static int32_t dot_q26(const int32_t a[3], const int32_t b[3])
{
    return (a[0] >> 17) * (b[0] >> 17) + (a[1] >> 17) * (b[1] >> 17) + (a[2] >> 17) * (b[2] >> 17);
}

/* By how much a matrix can make a vector longer, Q14: not too little, and less than 7 % too much for a rotation with a
 * scale. Its square is at most the largest sum of a row's magnitudes in r r^T (Gershgorin), and its root at most
 * (x + square / x) / 2 for any x. Elements are cut to Q13, and 9 of them may add 3 units to the norm. */
static uint32_t norm_of(const struct ph_xform *m)
{
    const int32_t(*const r)[3] = m->r;
    const uint32_t xy = fx_magnitude(dot_q26(r[0], r[1])), yz = fx_magnitude(dot_q26(r[1], r[2])),
                   xz = fx_magnitude(dot_q26(r[0], r[2]));
    const uint32_t x = (uint32_t)dot_q26(r[0], r[0]) + xy + xz, y = (uint32_t)dot_q26(r[1], r[1]) + xy + yz,
                   z = (uint32_t)dot_q26(r[2], r[2]) + xz + yz;
    const uint32_t more = x > y ? x : y, square = more > z ? more : z;
    const int half = (32 - fx_clz32(square)) >> 1;
    return ((uint32_t)1 << half) + (square >> half) + 7;
}

/* Whether a sphere lies beyond the left or the right side, or the upper or the lower one. The screen position is
 * centre + 2^focal_log2 focal x / w. A side is a plane with the normal (focal, -reach); cut to Q14, both are less than
 * one unit off. */
static bool misses_sides(const struct ph_lens *lens, int32_t focal, int32_t centre, int32_t size, int32_t x, int32_t w,
                         int32_t radius)
{
    const int32_t f = focal >> 16, off = (int32_t)((fx_magnitude(x) + fx_magnitude(w)) >> 14) + 4;
    for (int32_t to_side = size * 256 - centre, i = 0; i < 2; i++) {
        const int32_t reach = (to_side + 256) * 64 >> lens->focal_log2;
        const uint32_t normal =
            lens->kind == PH_ORTHOGRAPHIC ? (uint32_t)f : ph_hypot_above((uint32_t)f, fx_magnitude(reach));
        if (times(x, f) - times(w, reach) > times(radius, (int32_t)normal + 2) + off) {
            return true;
        }
        x = -x;
        to_side = centre;
    }
    return false;
}

/* Whether a sphere lies off the picture; false also where the test cannot tell. */
static bool misses(struct ph_renderer *r, const struct ph_sphere *sphere, const struct ph_xform *to_world)
{
    const struct ph_xform *const view = &r->view;
    const struct ph_lens *const lens = &r->lens;
    const struct fx_vec3 c = sphere->centre;
    if (sphere->radius <= 0 || (uint32_t)sphere->radius >= REACH || !is_near(c) || !is_near(to_world->t) ||
        !is_near(view->t)) {
        return false;
    }
    const struct fx_vec3 world = {row_times(to_world->r[0], c, to_world->t.x),
                                  row_times(to_world->r[1], c, to_world->t.y),
                                  row_times(to_world->r[2], c, to_world->t.z)};
    r->view_norm = r->view_norm != 0 ? r->view_norm : norm_of(view);
    const uint32_t norm = norm_of(to_world), two = (uint32_t)1 << 15;
    const uint32_t both = (norm | r->view_norm) < two ? (norm * r->view_norm >> 14) + 1 : two;
    if (both >= two || !is_near(world)) {
        return false;
    }
    const int32_t w = -row_times(view->r[2], world, view->t.z);
    const int32_t radius = times(sphere->radius, (int32_t)both) + (int32_t)((2 * sum_of(c) + sum_of(world)) >> 13) + 33;
    if (fx_magnitude(w) >= REACH || (uint32_t)radius >= REACH) {
        return false;
    }
    if (lens->kind != PH_FISHEYE && (w + radius < lens->near_z || w - radius > lens->far_z)) {
        return true;
    }
    const int32_t x = row_times(view->r[0], world, view->t.x), y = -row_times(view->r[1], world, view->t.y);
    if (fx_magnitude(x) >= REACH || fx_magnitude(y) >= REACH) {
        return false;
    }
    if (lens->kind == PH_FISHEYE) {
        return ph_fisheye_misses_sphere(r, x, y, w, radius);
    }
    const int32_t divisor = lens->kind == PH_ORTHOGRAPHIC ? FX_ONE : w;
    return misses_sides(lens, lens->focal_x, lens->centre_x, r->config.width, x, divisor, radius) ||
           misses_sides(lens, lens->focal_y, lens->centre_y, r->config.height, y, divisor, radius);
}

static void count_part(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_part *part)
{
    if (!ph_is_wire(&mesh->materials[part->material])) {
        r->stats.triangles_in += part->count;
        r->stats.triangles_culled += part->count;
    }
}

static bool cull_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (r->list.stage == PH_LIST_CLOSED || !misses(r, mesh->bounds, to_world)) {
        return false;
    }
    r->stats.meshes_culled++;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        count_part(r, mesh, &mesh->parts[i]);
    }
    return true;
}

static bool cull_part(struct ph_renderer *r, const struct ph_mesh *mesh, uint32_t i, const struct ph_xform *to_world)
{
    if (mesh->part_count == 1 || !misses(r, &mesh->bounds[1 + i], to_world)) {
        return false;
    }
    r->stats.parts_culled++;
    count_part(r, mesh, &mesh->parts[i]);
    return true;
}

const struct ph_culling ph_cull_spheres = {.cull_mesh = cull_mesh, .cull_part = cull_part};

/* ---- spheres around vertices ------------------------------------------------------------------------------------- */

static void widen(fx_t *low, fx_t *high, fx_t v)
{
    *low = v < *low ? v : *low;
    *high = v > *high ? v : *high;
}

static fx_t middle(fx_t low, fx_t high)
{
    return (fx_t)((uint32_t)low + (((uint32_t)high - (uint32_t)low) >> 1));
}

/* The sphere around n > 0 points, or (index) around those of so many numbers. */
static struct ph_sphere sphere_around(const struct fx_vec3 *points, const uint16_t *index, uint32_t n)
{
    struct fx_vec3 low = {FX_MAX, FX_MAX, FX_MAX}, high = {FX_MIN, FX_MIN, FX_MIN};
    uint64_t most = 0;
    for (uint32_t i = 0; i < n; i++) {
        const struct fx_vec3 *const p = &points[index != NULL ? index[i] : i];
        widen(&low.x, &high.x, p->x);
        widen(&low.y, &high.y, p->y);
        widen(&low.z, &high.z, p->z);
    }
    const struct fx_vec3 centre = {middle(low.x, high.x), middle(low.y, high.y), middle(low.z, high.z)};
    for (uint32_t i = 0; i < n; i++) {
        const uint64_t distance2 = ph_distance2(&centre, &points[index != NULL ? index[i] : i]);
        most = distance2 > most ? distance2 : most;
    }
    const uint32_t root = fx_sqrt_u64(most);
    const uint64_t radius = (uint64_t)root + (fx_mul_wide_u(root, root) < most || root == 0);
    return (struct ph_sphere){centre, radius <= FX_MAX ? (fx_t)radius : 0, PH_CULL_SPHERES};
}

int ph_mesh_bounds(struct ph_mesh *mesh, struct ph_sphere *bounds)
{
    if (bounds == NULL || mesh == NULL) {
        return PH_ERR_INVAL;
    }
    struct ph_mesh unbounded = *mesh;
    unbounded.bounds = NULL;
    if (!ph_mesh_is_whole(&unbounded)) {
        return PH_ERR_INVAL;
    }
    const struct ph_sphere none = {.culling = PH_CULL_SPHERES};
    bounds[0] = mesh->vertex_count > 0 ? sphere_around(mesh->positions, NULL, mesh->vertex_count) : none;
    for (uint32_t i = 0; i < mesh->part_count && mesh->part_count > 1; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        bounds[1 + i] = ph_is_wire(&mesh->materials[part->material]) ? bounds[0]
                        : part->count == 0 /* there may be no array */
                            ? none
                            : sphere_around(mesh->positions, mesh->triangles[part->first], 3 * part->count);
    }
    mesh->bounds = bounds;
    return PH_OK;
}
