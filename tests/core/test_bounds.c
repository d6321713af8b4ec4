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

/* ---- any sphere, any matrices ------------------------------------------------------------------------------------ */

/* A coordinate; now and then one at the end of the range that the test takes. */
static int32_t any_place(void)
{
    const int32_t end = (1 << 28) - (int32_t)ref_uniform(-2, 3);
    return ref_uniform(0, 4) < 1 ? (ref_uniform(0, 2) < 1 ? end : -end)
                                 : within(exp2(ref_uniform(10, ref_uniform(0, 4) < 1 ? 31 : 27)));
}

static struct ph_xform any_matrix(void)
{
    const double scale = ref_uniform(0, 2), shear = ref_uniform(0, 2) < 1 ? 0 : ref_uniform(0, 1);
    struct ph_xform x = {.t = {any_place(), any_place(), any_place()}};
    double r[3][3];
    ref_rotation(3, r);
    for (int i = 0; i < 9; i++) {
        const double other = r[i % 3][0] * ref_uniform(-1, 1);
        x.r[i / 3][i % 3] = (int32_t)(fmax(fmin(scale * (r[i / 3][i % 3] + shear * other), 1.9999), -2) * 0x1p30);
    }
    return x;
}

/* How far a plane (normal, less `limit`) is from the nearest point of a sphere that both matrices move and deform. */
static long double beyond(const struct ph_renderer *r, const struct ph_xform *to_world, const struct ph_sphere *s,
                          const long double normal[3], long double limit)
{
    const struct ph_xform *const v = &r->view, *const w = to_world;
    const long double c[3] = {s->centre.x, s->centre.y, s->centre.z}, tw[3] = {w->t.x, w->t.y, w->t.z},
                      tv[3] = {v->t.x, v->t.y, v->t.z};
    long double at = 0, size2 = 0;
    for (int i = 0; i < 3; i++) {
        long double to = tw[i], along = 0;
        for (int k = 0; k < 3; k++) {
            to += ldexpl(w->r[i][k], -30) * c[k];
            along += normal[k] * ldexpl(v->r[k][i], -30);
        }
        at += along * to + normal[i] * tv[i];
    }
    for (int j = 0; j < 3; j++) {
        long double along = 0;
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                along += normal[k] * ldexpl(v->r[k][i], -30) * ldexpl(w->r[i][j], -30);
            }
        }
        size2 += along * along;
    }
    return at - s->radius * sqrtl(size2) - limit;
}

/* Whether one of the planes of the picture has all of the sphere beyond it. */
static bool is_off(const struct ph_renderer *r, const struct ph_xform *to_world, const struct ph_sphere *s)
{
    const struct ph_lens *const lens = &r->lens;
    const bool parallel = lens->kind == PH_ORTHOGRAPHIC;
    const long double behind[3] = {0, 0, 1}, before[3] = {0, 0, -1};
    bool off = beyond(r, to_world, s, behind, -(long double)lens->near_z) > 0 ||
               beyond(r, to_world, s, before, lens->far_z) > 0;
    for (int side = 0; side < 4; side++) {
        const bool across = side < 2, first = side % 2 == 0;
        const long double focal = ldexpl(across ? lens->focal_x : lens->focal_y, -30) * (first == across ? -1 : 1);
        const long double centre = across ? lens->centre_x : lens->centre_y,
                          size = across ? r->config.width : r->config.height;
        const long double reach = ldexpl(first ? centre : size * 256 - centre, -8 - lens->focal_log2);
        const long double normal[3] = {across ? focal : 0, across ? 0 : focal, parallel ? 0 : reach};
        off = off || beyond(r, to_world, s, normal, parallel ? reach * 65536 : 0) > 0;
    }
    return off;
}

/* Only what lies beyond a plane of the picture is culled, whatever the sphere and the matrices are. */
static void only_what_is_beyond_a_plane_is_culled(void **state)
{
    struct rig rig;
    int culled = 0, near = 0;
    (void)state;
    rig_open(&rig, 32, 24, 24, PH_DEPTH_FIXED16, 4, 4);
    ref_seed(2);
    for (int turn = 0; turn < 200000; turn++) {
        const struct fx_vec3 corner = {0, 0, 0};
        const struct ph_sphere s = {
            {any_place(), any_place(), any_place()}, (fx_t)exp2(ref_uniform(0, 30.9)), PH_CULL_SPHERES};
        const struct ph_mesh mesh = {.positions = &corner, .vertex_count = 1, .bounds = &s};
        const struct ph_xform view = any_matrix(), to_world = any_matrix();
        const fx_t size = (fx_t)exp2(ref_uniform(12, 26));
        struct ph_projection lens;
        if ((turn % 2 == 0 ? ph_projection_ortho(&lens, -size, size, -size / 2, size, -size, 16 * size)
                           : ph_projection_perspective(&lens, ref_q16(ref_uniform(3, 170)), FX_ONE, 1 + size / 64,
                                                       16 * size)) != PH_OK ||
            ph_frame_begin(&rig.r, &view, &lens, NULL, 0) != PH_OK) {
            continue;
        }
        assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &to_world), PH_OK);
        const bool off = is_off(&rig.r, &to_world, &s);
        assert_true(off || rig.r.stats.meshes_culled == 0);
        culled += rig.r.stats.meshes_culled != 0;
        near += !off;
    }
    assert_true(culled > 10000 && near > 10000);
    rig_close(&rig);
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
        cmocka_unit_test(only_what_is_beyond_a_plane_is_culled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
