/* Spheres around vertices, what refuses those that lie, and how culling is counted. fuzz_bounds.c has the pictures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_drawing.h"
#include "ref_random.h"

#include <math.h>

#define POINTS 40

/* The square of the distance of a point from a centre; long double has its 64 bits. */
static long double distance2(const struct ph_sphere *s, const struct fx_vec3 *p)
{
    const long double x = (long double)p->x - s->centre.x, y = (long double)p->y - s->centre.y,
                      z = (long double)p->z - s->centre.z;
    return x * x + y * y + z * z;
}

static int32_t within(double limit)
{
    return (int32_t)fmax(fmin(ref_uniform(-limit, limit), INT32_MAX), INT32_MIN);
}

/* The radius is the distance of the farthest point from the middle of the box, rounded up. */
static void sphere_is_the_least_with_its_centre(void **state)
{
    struct fx_vec3 points[POINTS];
    (void)state;
    ref_seed(1);
    for (int turn = 0; turn < 2000; turn++) {
        const double limit = exp2(ref_uniform(0, 29.7)), off = ref_uniform(-1, 1) * exp2(30);
        struct ph_mesh mesh = {.positions = points, .vertex_count = 1 + (uint32_t)turn % POINTS};
        struct ph_sphere s[1];
        double low = INFINITY, high = -INFINITY;
        long double most = 0;
        for (uint32_t i = 0; i < mesh.vertex_count; i++) {
            points[i] = (struct fx_vec3){within(limit) + (int32_t)off, within(limit), within(limit)};
            low = fmin(low, points[i].x);
            high = fmax(high, points[i].x);
        }
        assert_int_equal(ph_mesh_bounds(&mesh, s), PH_OK);
        assert_ptr_equal(mesh.bounds, s);
        assert_int_equal(s->centre.x, (int32_t)floor((low + high) / 2));
        for (uint32_t i = 0; i < mesh.vertex_count; i++) {
            most = fmaxl(most, distance2(s, &points[i]));
        }
        const long double radius = s->radius;
        assert_true(radius * radius >= most);
        assert_true(radius == 1 || (radius - 1) * (radius - 1) < most);
    }
}

/* Two corners of all that Q16.16 holds are further from each other than a radius can say. */
static void sphere_that_does_not_fit_is_none(void **state)
{
    static const struct fx_vec3 corners[] = {{FX_MIN, FX_MIN, FX_MIN}, {FX_MAX, FX_MAX, FX_MAX}, {FX_MAX, 0, 0}};
    struct ph_mesh mesh = {.positions = corners, .vertex_count = 2};
    struct ph_sphere s;
    (void)state;
    assert_int_equal(ph_mesh_bounds(&mesh, &s), PH_OK);
    assert_int_equal(s.radius, 0);
    mesh.vertex_count = 0;
    assert_int_equal(ph_mesh_bounds(&mesh, &s), PH_OK);
    assert_int_equal(s.radius, 0);
    mesh.positions = &corners[2];
    mesh.vertex_count = 1;
    assert_int_equal(ph_mesh_bounds(&mesh, &s), PH_OK);
    assert_int_equal(s.radius, 1);
}

static void bounds_need_a_mesh_and_room(void **state)
{
    const struct ph_mesh wrong = {.vertex_count = 3};
    struct ph_mesh mesh = wrong;
    struct ph_sphere s;
    (void)state;
    assert_int_equal(ph_mesh_bounds(NULL, &s), PH_ERR_INVAL);
    assert_int_equal(ph_mesh_bounds(&mesh, &s), PH_ERR_INVAL);
    assert_null(mesh.bounds);
    mesh.vertex_count = 0;
    assert_int_equal(ph_mesh_bounds(&mesh, NULL), PH_ERR_INVAL);
}

/* A mesh of two triangles side by side, 10 px apart; each is a part. */
struct pair {
    struct fx_vec3 positions[6];
    struct ph_part parts[2];
    struct ph_material materials[2];
    struct ph_sphere bounds[PH_BOUNDS(2)];
    struct ph_mesh mesh;
};

static const uint16_t two[2][3] = {{0, 1, 2}, {3, 4, 5}}, sides[3][2] = {{0, 1}, {1, 2}, {2, 0}};

static void make_pair(struct drawing *d, struct pair *p)
{
    const struct shape shapes[2] = {{'a', {{1, 1}, {1, 5}, {5, 5}}}, {'b', {{11, 1}, {11, 5}, {15, 5}}}};
    for (int i = 0; i < 2; i++) {
        const struct rig_one *one = shape_mesh(d, &shapes[i]);
        for (int k = 0; k < 3; k++) {
            p->positions[3 * i + k] = one->positions[k];
        }
        p->materials[i] = one->material;
        p->parts[i] = (struct ph_part){(uint32_t)i, 1, (uint16_t)i};
        p->mesh = one->mesh;
    }
    p->mesh.positions = p->positions;
    p->mesh.triangles = two;
    p->mesh.edges = sides;
    p->mesh.parts = p->parts;
    p->mesh.materials = p->materials;
    p->mesh.vertex_count = 6;
    p->mesh.triangle_count = 2;
    p->mesh.edge_count = 3;
    p->mesh.part_count = 2;
    p->mesh.bounds = NULL;
    assert_int_equal(ph_mesh_bounds(&p->mesh, p->bounds), PH_OK);
}

/* Draws the pair so many pixels further right. */
static int draw_pair(struct drawing *d, const struct pair *p, int right)
{
    struct ph_xform place = ph_xform_identity;
    place.t.x = p->positions[2].x - p->positions[0].x;
    place.t.x = place.t.x / 4 * right;
    return ph_draw_mesh(&d->rig.r, &p->mesh, &place);
}

static void what_is_off_the_picture_is_counted(void **state)
{
    struct drawing d;
    struct pair p;
    const struct ph_stats *const stats = &d.rig.r.stats;
    (void)state;
    drawing_open(&d);
    make_pair(&d, &p);
    assert_int_equal(draw_pair(&d, &p, 0), PH_OK);
    assert_int_equal(stats->meshes_culled + stats->parts_culled + stats->triangles_culled, 0);
    assert_int_equal(draw_pair(&d, &p, 9), PH_OK);
    assert_int_equal(stats->meshes_culled, 0);
    assert_int_equal(stats->parts_culled, 1);
    assert_int_equal(stats->vertices, 12);
    assert_int_equal(stats->triangles_in, 4);
    assert_int_equal(stats->triangles_culled, 1);
    assert_int_equal(draw_pair(&d, &p, 25), PH_OK);
    assert_int_equal(stats->meshes_culled, 1);
    assert_int_equal(stats->vertices, 12);
    assert_int_equal(stats->triangles_in, 6);
    assert_int_equal(stats->triangles_culled, 3);
    p.materials[0].shading = PH_SHADE_WIRE; /* whose lines no count has */
    assert_int_equal(draw_pair(&d, &p, 25), PH_OK);
    assert_int_equal(stats->meshes_culled, 2);
    assert_int_equal(stats->triangles_in, 7);
    assert_true(rig_finish(&d.rig));
    assert_int_equal(draw_pair(&d, &p, 25), PH_ERR_STATE);
    assert_int_equal(stats->meshes_culled, 2);
    drawing_close(&d);
}

/* Without room for its vertices a mesh is drawn all the same where nothing of it is to be seen. */
static void what_is_off_the_picture_needs_no_room(void **state)
{
    struct drawing d;
    struct pair p;
    (void)state;
    drawing_open(&d);
    make_pair(&d, &p);
    d.rig.r.config.vertex_max = 5;
    assert_int_equal(draw_pair(&d, &p, 0), PH_ERR_NOMEM);
    assert_int_equal(draw_pair(&d, &p, 25), PH_OK);
    drawing_close(&d);
}

/* A sphere without a name of what tests it, or without a radius, is none. */
static void sphere_without_test_or_radius_is_none(void **state)
{
    struct drawing d;
    struct pair p;
    (void)state;
    drawing_open(&d);
    make_pair(&d, &p);
    p.bounds[0].culling = NULL;
    assert_int_equal(draw_pair(&d, &p, 25), PH_OK);
    p.bounds[0].culling = PH_CULL_SPHERES;
    for (int i = 0; i < 3; i++) {
        p.bounds[i].radius = 0;
    }
    assert_int_equal(draw_pair(&d, &p, 25), PH_OK);
    assert_int_equal(d.rig.r.stats.meshes_culled + d.rig.r.stats.parts_culled, 0);
    assert_int_equal(d.rig.r.stats.vertices, 12);
    drawing_close(&d);
}

/* The tests' library is a checked build. */
static void bounds_that_lie_are_refused(void **state)
{
    struct drawing d;
    struct pair p;
    (void)state;
    drawing_open(&d);
    make_pair(&d, &p);
    for (int i = 0; i < 3; i++) {
        p.bounds[i].radius--;
        assert_int_equal(draw_pair(&d, &p, 0), PH_ERR_INVAL);
        p.bounds[i].radius++;
        p.bounds[i].centre.y = FX_MAX;
        assert_int_equal(draw_pair(&d, &p, 0), PH_ERR_INVAL);
        assert_int_equal(ph_mesh_bounds(&p.mesh, p.bounds), PH_OK);
        assert_int_equal(draw_pair(&d, &p, 0), PH_OK);
    }
    p.materials[1].shading = PH_SHADE_WIRE; /* its edges are elsewhere than its triangle was */
    assert_int_equal(draw_pair(&d, &p, 0), PH_ERR_INVAL);
    assert_int_equal(ph_mesh_bounds(&p.mesh, p.bounds), PH_OK);
    assert_int_equal(draw_pair(&d, &p, 0), PH_OK);
    drawing_close(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_is_the_least_with_its_centre),
        cmocka_unit_test(sphere_that_does_not_fit_is_none),
        cmocka_unit_test(bounds_need_a_mesh_and_room),
        cmocka_unit_test(what_is_off_the_picture_is_counted),
        cmocka_unit_test(what_is_off_the_picture_needs_no_room),
        cmocka_unit_test(sphere_without_test_or_radius_is_none),
        cmocka_unit_test(bounds_that_lie_are_refused),
    };
    return cmocka_run_group_tests_name("bounds", tests, NULL, NULL);
}
