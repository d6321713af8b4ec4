/*
 * The fisheye is compared with rays in double. The ray of a pixel (dx, dy) from the centre is |(dx, dy)| / f radians
 * off the axis, and the pixel must show the nearest triangle that it meets. The reference subdivides nothing: its edges
 * curve because of the rays.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI       3.14159265358979323846
#define QUAD_MAX 600

/* Quads, each in a colour of its own (number + 1 as the pixel's value), as a mesh and in double. */
struct scene {
    struct fx_vec3 positions[4 * QUAD_MAX];
    uint16_t triangles[2 * QUAD_MAX][3];
    struct ph_part parts[QUAD_MAX];
    struct ph_material materials[QUAD_MAX];
    struct ph_mesh mesh;
    int quads;
};

static void add_quad(struct scene *s, const double corners[4][3])
{
    const int q = s->quads++;
    assert_true(q < QUAD_MAX);
    for (int i = 0; i < 4; i++) {
        s->positions[4 * q + i] =
            (struct fx_vec3){ref_q16(corners[i][0]), ref_q16(corners[i][1]), ref_q16(corners[i][2])};
    }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++) {
            s->triangles[2 * q + k][i] = (uint16_t)(4 * q + (i == 0 ? 0 : i + k));
        }
    }
    s->parts[q] = (struct ph_part){(uint32_t)(2 * q), 2, (uint16_t)q};
    s->materials[q] = (struct ph_material){.shading = PH_SHADE_UNLIT, .colour = (uint16_t)(q + 1)};
    s->mesh = (struct ph_mesh){.positions = s->positions,
                               .triangles = (const uint16_t(*)[3])s->triangles,
                               .parts = s->parts,
                               .materials = s->materials,
                               .vertex_count = (uint32_t)(4 * s->quads),
                               .triangle_count = (uint32_t)(2 * s->quads),
                               .part_count = (uint32_t)s->quads};
}

/* A box; inside out: a room. */
static void add_box(struct scene *s, const double low[3], const double high[3], bool room)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int side = 0; side < 2; side++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            double c[4][3];
            for (int i = 0; i < 4; i++) {
                const bool flip = (side == 1) == room;
                const int turn = flip ? 3 - i : i;
                c[i][axis] = side ? high[axis] : low[axis];
                c[i][u] = turn == 1 || turn == 2 ? low[u] : high[u];
                c[i][v] = turn >= 2 ? low[v] : high[v];
            }
            add_quad(s, (const double(*)[3])c);
        }
    }
}

struct camera {
    double r[3][3], t[3]; /* world to view */
    double fov;           /* radians, from top to bottom */
    double near, far;
};

static void dots(const double m[3][3], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    }
}

/* View direction of a picture point; false behind 170 degrees. */
static bool ray(const struct camera *c, int width, int height, double sx, double sy, double q[3])
{
    const double dx = sx - width / 2., dy = sy - height / 2., theta = hypot(dx, dy) * c->fov / height;
    const double across = theta > 0 ? sin(theta) / hypot(dx, dy) : 0;
    q[0] = dx * across;
    q[1] = -dy * across;
    q[2] = -cos(theta);
    return theta < 169 * PI / 180;
}

static void view_of(const struct camera *c, const struct fx_vec3 *p, double out[3])
{
    const double world[3] = {p->x / 65536., p->y / 65536., p->z / 65536.};
    dots(c->r, world, out);
    for (int i = 0; i < 3; i++) {
        out[i] += c->t[i];
    }
}

static double volume(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

struct viewed {
    double p[4 * QUAD_MAX][3];
};

/* The quad that a ray meets first (its front), and where; -1 for none. */
static int look(const struct scene *s, const struct viewed *v, const struct camera *c, const double q[3],
                double *distance)
{
    int found = -1;
    *distance = INFINITY;
    for (int i = 0; i < 2 * s->quads; i++) {
        const double *a = v->p[s->triangles[i][0]], *b = v->p[s->triangles[i][1]], *d = v->p[s->triangles[i][2]];
        const double wa = volume(q, b, d), wb = volume(q, d, a), wd = volume(q, a, b), whole = volume(a, b, d);
        if (whole >= 0 || wa > 0 || wb > 0 || wd > 0) {
            continue;
        }
        const double t = whole / (wa + wb + wd);
        if (t >= c->near && t <= c->far && t < *distance) {
            *distance = t;
            found = i / 2;
        }
    }
    return found;
}

static void open_scene(struct rig *rig, int width, int height, int band, const struct ph_depth_format *format)
{
    rig_open(rig, width, height, band, format, 4 * QUAD_MAX, 20000);
}

static void draw_scene(struct rig *rig, const struct scene *s, const struct camera *c)
{
    struct ph_projection p;
    struct ph_xform view;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            view.r[i][k] = ref_q30(c->r[i][k]);
        }
    }
    view.t = (struct fx_vec3){ref_q16(c->t[0]), ref_q16(c->t[1]), ref_q16(c->t[2])};
    assert_int_equal(ph_projection_fisheye(&p, ref_q16(c->fov * 180 / PI), ref_q16(c->near), ref_q16(c->far)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &view, &p, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig->r, &s->mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(rig));
    assert_int_equal(rig->r.stats.triangles_dropped, 0);
}

struct sample {
    int quad;
    double distance;
};

/* What the rays through the centre of a pixel and two rings around it meet. */
#define SAMPLES 25

static void look_around(const struct scene *s, const struct viewed *v, const struct camera *c, const struct rig *rig,
                        double x, double y, double reach, struct sample out[SAMPLES])
{
    for (int i = 0; i < SAMPLES; i++) {
        const double a = i % 12 * PI / 6, far = i == 0 ? 0 : i <= 12 ? reach : reach / 2;
        double q[3];
        ray(c, rig->width, rig->height, x + far * cos(a), y + far * sin(a), q);
        out[i].quad = look(s, v, c, q, &out[i].distance);
    }
}

/* Whether a face that is seen almost edge-on lies near a pixel: a sliver that the rings miss. */
static bool shows_nearby(const struct scene *s, const struct viewed *v, const struct camera *c, const struct rig *rig,
                         double x, double y, double reach, int quad)
{
    for (int i = 0; i < 41 * 41; i++) {
        const double dx = (i % 41 - 20) * reach / 20, dy = (i / 41 - 20) * reach / 20;
        double q[3], distance;
        ray(c, rig->width, rig->height, x + dx, y + dy, q);
        if (hypot(dx, dy) <= reach && look(s, v, c, q, &distance) == quad) {
            return true;
        }
    }
    return false;
}

/* Every pixel shows what a ray within `reach` pixels of its centre meets, at about that distance. */
static void compare(const struct rig *rig, const struct scene *s, const struct camera *c, double reach)
{
    struct viewed *v = malloc(sizeof(*v));
    int exact = 0, seen = 0;
    assert_non_null(v);
    for (int i = 0; i < 4 * s->quads; i++) {
        view_of(c, &s->positions[i], v->p[i]);
    }
    for (int i = 0; i < rig->width * rig->height; i++) {
        const double x = i % rig->width + .5, y = i / rig->width + .5;
        struct sample around[SAMPLES];
        double q[3], least = INFINITY, most = 0;
        int same = 0;
        if (!ray(c, rig->width, rig->height, x, y, q)) {
            continue;
        }
        const int got = rig->pixels[i] - 1;
        look_around(s, v, c, rig, x, y, reach, around);
        for (int k = 0; k < SAMPLES; k++) {
            if (around[k].quad == got) {
                same++;
                least = fmin(least, around[k].distance);
                most = fmax(most, around[k].distance);
            }
        }
        if (same == 0 && !shows_nearby(s, v, c, rig, x, y, reach, got)) {
            fail_msg("(%.1f, %.1f) shows quad %d instead of %d", x, y, got, around[0].quad);
        }
        const double depth = got < 0 ? 0 : rig_distance(rig, rig->depth[i], c->near, c->far);
        if (got >= 0 && same == SAMPLES && (depth < least * .98 || depth > most * 1.02)) { /* not at edges */
            fail_msg("(%.1f, %.1f): at %f instead of %f to %f", x, y, depth, least, most);
        }
        exact += around[0].quad == got;
        seen++;
    }
    assert_true(exact >= seen * 97 / 100);
    free(v);
}

static void build_room(struct scene *s)
{
    static const double boxes[][2][3] = {{{-1, -1, -5}, {1, 1, -4}}, {{-3, -1, -2}, {-2, 2, -1}},
                                         {{2, -1, 1}, {3, 0, 2}},    {{-1, -1, 3}, {0, 1.5, 4}},
                                         {{4, -1, -4}, {5, 4, -3}},  {{-5, 0, 2}, {-4, 1, 3}},
                                         {{-.5, 2, -1}, {.5, 3, 0}}, {{1, -.8, -1.5}, {1.5, -.3, -1}}};
    s->quads = 0;
    add_box(s, (const double[3]){-7, -1, -6}, (const double[3]){6, 5, 5}, true);
    for (size_t i = 0; i < sizeof(boxes) / sizeof(boxes[0]); i++) {
        add_box(s, boxes[i][0], boxes[i][1], false);
    }
}

static void place_camera(struct camera *c, const double eye[3], double turn, double fov)
{
    double t[3];
    ref_rotation(turn, c->r);
    dots(c->r, eye, t);
    for (int i = 0; i < 3; i++) {
        c->t[i] = -t[i];
    }
    c->fov = fov * PI / 180;
    c->near = .1;
    c->far = 40;
}

static void pixels_show_what_their_rays_meet(void **state)
{
    static const double fovs[] = {60, 120, 180, 220, 240};
    struct scene *s = malloc(sizeof(*s));
    (void)state;
    assert_non_null(s);
    build_room(s);
    ref_seed(9);
    for (int i = 0; i < 10; i++) {
        struct camera c;
        struct rig rig;
        open_scene(&rig, 160, 120, 120, i & 1 ? PH_DEPTH_FLOAT16 : PH_DEPTH_FIXED16);
        place_camera(&c, (const double[3]){ref_uniform(-1.5, 1.5), ref_uniform(0, 1.5), ref_uniform(0, 2)},
                     i < 2 ? 0 : PI, fovs[i / 2]);
        draw_scene(&rig, s, &c);
        compare(&rig, s, &c, 1);
        rig_close(&rig);
    }
    free(s);
}

/* The near and far "planes" are spheres around the eye: the reference cuts its rays there, pieces are cut straight. */
static void near_and_far_are_distances_from_the_eye(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    (void)state;
    assert_non_null(s);
    build_room(s);
    ref_seed(19);
    for (int i = 0; i < 4; i++) {
        struct camera c;
        struct rig rig;
        open_scene(&rig, 120, 120, 120, PH_DEPTH_FIXED16);
        place_camera(&c, (const double[3]){.2, .4, .3}, PI, 200);
        c.near = 1.6 + i * .2;
        c.far = 6.5 - i * .3;
        draw_scene(&rig, s, &c);
        assert_true(rig.r.stats.triangles_clipped > 10);
        compare(&rig, s, &c, 2);
        rig_close(&rig);
    }
    free(s);
}

/* Walls of cells x cells quads whose inner corners were moved within the wall: no pixel shows the background. */
static void build_wall(struct scene *s, const double origin[3], const double u[3], const double v[3], int cells)
{
    double grid[9][9][3];
    for (int i = 0; i <= cells; i++) {
        for (int k = 0; k <= cells; k++) {
            const bool inner = i > 0 && i < cells && k > 0 && k < cells;
            const double a = (i + (inner ? ref_uniform(-.3, .3) : 0)) / cells;
            const double b = (k + (inner ? ref_uniform(-.3, .3) : 0)) / cells;
            for (int x = 0; x < 3; x++) {
                grid[i][k][x] = origin[x] + a * u[x] + b * v[x];
            }
        }
    }
    for (int i = 0; i < cells; i++) {
        for (int k = 0; k < cells; k++) {
            double c[4][3];
            memcpy(c[0], grid[i][k], sizeof(c[0]));
            memcpy(c[1], grid[i + 1][k], sizeof(c[1]));
            memcpy(c[2], grid[i + 1][k + 1], sizeof(c[2]));
            memcpy(c[3], grid[i][k + 1], sizeof(c[3]));
            add_quad(s, (const double(*)[3])c);
        }
    }
}

/* Rooms of 2 units, and of .03, in which a divided edge's last bit is a visible part of a pixel. */
static void tessellated_walls_have_no_holes(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    (void)state;
    assert_non_null(s);
    ref_seed(29);
    for (int i = 0; i < 16; i++) {
        const double half = i < 8 ? 1 : .015, side = 2 * half;
        const double axes[4][3] = {{side, 0, 0}, {0, side, 0}, {0, 0, side}, {side, 0, 0}};
        struct camera c;
        struct rig rig;
        s->quads = 0;
        for (int axis = 0; axis < 3; axis++) { /* edges of walls meet: the same corners, not moved along the rim */
            double high[3] = {-half, -half, -half};
            high[axis] = half;
            build_wall(s, (const double[3]){-half, -half, -half}, axes[(axis + 1) % 3], axes[(axis + 2) % 3],
                       1 + i % 8);
            build_wall(s, high, axes[(axis + 2) % 3], axes[(axis + 1) % 3], 1 + i % 8);
        }
        open_scene(&rig, 200, 160, 160, PH_DEPTH_FIXED16);
        place_camera(
            &c,
            (const double[3]){half * ref_uniform(-.6, .6), half * ref_uniform(-.6, .6), half * ref_uniform(-.6, .6)},
            PI, 230);
        c.near = half / 100;
        draw_scene(&rig, s, &c);
        for (int k = 0; k < 200 * 160; k++) {
            double q[3];
            if (ray(&c, 200, 160, k % 200 + .5, k / 200 + .5, q) && rig.pixels[k] == 0) {
                fail_msg("room %d: hole at (%d, %d)", i, k % 200, k / 200);
            }
        }
        rig_close(&rig);
    }
    free(s);
}

/* Picture of a view point. */
static void project(const struct camera *c, int width, int height, const double p[3], double out[2])
{
    const double rho = hypot(p[0], p[1]), r = atan2(rho, -p[2]) * height / c->fov;
    out[0] = width / 2. + r * p[0] / rho;
    out[1] = height / 2. - r * p[1] / rho;
}

static bool lit_near(const struct rig *rig, const double at[2])
{
    for (int i = 0; i < 9; i++) {
        const int x = (int)floor(at[0]) + i % 3 - 1, y = (int)floor(at[1]) + i / 3 - 1;
        if (x >= 0 && x < rig->width && y >= 0 && y < rig->height && rig->pixels[y * rig->width + x] != 0) {
            return true;
        }
    }
    return false;
}

/* 2000 points of the exact curve each have a pixel next to them; every pixel has one of the points within 1.2 px. */
static void lines_follow_the_exact_curve(void **state)
{
    enum { SIZE = 160, POINTS = 4000 };
    static double at[POINTS][2];
    const struct ph_material white = {.shading = PH_SHADE_WIRE, .colour = 0xffff};
    (void)state;
    ref_seed(39);
    for (int i = 0; i < 60; i++) {
        struct rig rig;
        struct camera c = {.fov = (40 + 3 * i) * PI / 180, .near = .01, .far = 100};
        double ends[2][3];
        struct ph_projection p;
        open_scene(&rig, SIZE, SIZE, SIZE, PH_DEPTH_FIXED16);
        assert_int_equal(ph_projection_fisheye(&p, ref_q16(40 + 3 * i), ref_q16(.01), FX_INT(100)), PH_OK);
        assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
        for (int k = 0; k < 6; k++) {
            ends[k / 3][k % 3] = ref_uniform(-4, 4);
        }
        ph_draw_line(&rig.r, (struct fx_vec3){ref_q16(ends[0][0]), ref_q16(ends[0][1]), ref_q16(ends[0][2])},
                     (struct fx_vec3){ref_q16(ends[1][0]), ref_q16(ends[1][1]), ref_q16(ends[1][2])}, &white);
        assert_true(rig_finish(&rig));
        for (int k = 0; k < POINTS; k++) {
            double p3[3];
            for (int x = 0; x < 3; x++) {
                p3[x] = ends[0][x] + (ends[1][x] - ends[0][x]) * k / (POINTS - 1);
            }
            project(&c, SIZE, SIZE, p3, at[k]);
            if (at[k][0] > 1 && at[k][0] < SIZE - 1 && at[k][1] > 1 && at[k][1] < SIZE - 1) {
                assert_true(lit_near(&rig, at[k]));
            }
        }
        for (int k = 0; k < SIZE * SIZE; k++) {
            double nearest = INFINITY;
            for (int n = 0; rig.pixels[k] != 0 && n < POINTS; n++) {
                nearest = fmin(nearest, hypot(at[n][0] - k % SIZE - .5, at[n][1] - k / SIZE - .5));
            }
            assert_true(rig.pixels[k] == 0 || nearest <= 1.2);
        }
        rig_close(&rig);
    }
}

static void picture_does_not_depend_on_the_band_height(void **state)
{
    static const int bands[] = {1, 7, 16, 59};
    struct scene *s = malloc(sizeof(*s));
    struct camera c;
    struct rig whole;
    (void)state;
    assert_non_null(s);
    build_room(s);
    ref_seed(49);
    place_camera(&c, (const double[3]){0, .5, 0}, PI, 220);
    open_scene(&whole, 80, 60, 60, PH_DEPTH_FLOAT16);
    draw_scene(&whole, s, &c);
    for (int i = 0; i < 4; i++) {
        struct rig rig;
        open_scene(&rig, 80, 60, bands[i], PH_DEPTH_FLOAT16);
        draw_scene(&rig, s, &c);
        assert_memory_equal(rig.pixels, whole.pixels, 80 * 60 * 2);
        assert_memory_equal(rig.depth, whole.depth, 80 * 60 * sizeof(*rig.depth));
        rig_close(&rig);
    }
    rig_close(&whole);
    free(s);
}

/* Under 10 degrees a fisheye is a perspective within 0.1 px of 120: light, textures, depth and statistics agree. */
static void narrow_fisheye_is_a_perspective(void **state)
{
    static const enum ref_scene_id scenes[] = {REF_TORUS, REF_CUBE};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct ref_scene scene;
        struct rig_mesh mesh;
        struct rig rigs[2];
        int alike = 0;
        ref_scene_build(&scene, scenes[i]);
        rig_mesh_build(&mesh, &scene);
        for (int k = 0; k < 2; k++) {
            const struct ph_scene_light light = {
                .ambient = ref_q16(.2),
                .count = 1,
                .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, 0, FX_Q30_ONE}}}};
            struct ph_xform pose = rig_pose(&scene, 5);
            struct ph_projection p;
            pose.t.z = FX_INT(-22);
            rig_open(&rigs[k], 120, 120, 120, PH_DEPTH_FIXED16, 4000, 8000);
            assert_int_equal(k ? ph_projection_fisheye(&p, FX_INT(10), FX_INT(10), FX_INT(40))
                               : ph_projection_perspective(&p, FX_INT(10), FX_ONE, FX_INT(10), FX_INT(40)),
                             PH_OK);
            assert_int_equal(ph_frame_begin(&rigs[k].r, &ph_xform_identity, &p, &light, 0), PH_OK);
            assert_int_equal(ph_draw_mesh(&rigs[k].r, &mesh.mesh, &pose), PH_OK);
            assert_true(rig_finish(&rigs[k]));
        }
        for (int k = 0; k < 120 * 120; k++) {
            double a[3], b[3];
            rig_rgb(&rigs[0], k % 120, k / 120, a);
            rig_rgb(&rigs[1], k % 120, k / 120, b);
            alike += fabs(a[0] - b[0]) < 20 && fabs(a[1] - b[1]) < 20 && fabs(a[2] - b[2]) < 20 &&
                     abs((int)(rigs[0].depth[k] - rigs[1].depth[k])) < 400;
        }
        assert_true(alike > 120 * 120 * 98 / 100);
        assert_int_equal(rigs[0].r.stats.triangles_in, rigs[1].r.stats.triangles_in);
        assert_int_equal(rigs[0].r.stats.vertices, rigs[1].r.stats.vertices);
        rig_close(&rigs[0]);
        rig_close(&rigs[1]);
        rig_mesh_free(&mesh);
        ref_scene_free(&scene);
    }
}

static void pieces_over_the_budget_are_left_out_and_counted(void **state)
{
    struct scene *s = malloc(sizeof(*s));
    struct rig rig;
    struct ph_projection p;
    (void)state;
    assert_non_null(s);
    build_room(s);
    rig_open(&rig, 80, 60, 60, PH_DEPTH_FIXED16, 4 * QUAD_MAX, 100);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(220), FX_ONE / 8, FX_INT(40)), PH_OK);
    assert_int_equal(ph_frame_begin(&rig.r, &ph_xform_identity, &p, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig.r, &s->mesh, &ph_xform_identity), PH_OK);
    assert_int_equal(rig.r.stats.triangles_drawn, 100);
    assert_true(rig.r.stats.triangles_dropped > 100);
    assert_true(rig_finish(&rig));
    rig_close(&rig);
    free(s);
}

static void impossible_fisheyes_are_refused(void **state)
{
    struct ph_projection p = {.near_z = 77};
    struct ph_mat4 m;
    (void)state;
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(10) - 1, FX_ONE, FX_INT(9)), PH_ERR_INVAL);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(240) + 1, FX_ONE, FX_INT(9)), PH_ERR_INVAL);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(180), 0, FX_INT(9)), PH_ERR_INVAL);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(180), FX_ONE, FX_ONE), PH_ERR_INVAL);
    assert_int_equal(p.near_z, 77);
    assert_int_equal(
        ph_matrix_projection(&m, &(struct ph_projection){.kind = PH_FISHEYE, .near_z = 1, .far_z = 2}, PH_GL),
        PH_ERR_INVAL);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(10), FX_ONE, FX_INT(9)), PH_OK);
    assert_int_equal(ph_projection_fisheye(&p, FX_INT(240), FX_ONE, FX_INT(9)), PH_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_show_what_their_rays_meet),
        cmocka_unit_test(near_and_far_are_distances_from_the_eye),
        cmocka_unit_test(tessellated_walls_have_no_holes),
        cmocka_unit_test(lines_follow_the_exact_curve),
        cmocka_unit_test(picture_does_not_depend_on_the_band_height),
        cmocka_unit_test(narrow_fisheye_is_a_perspective),
        cmocka_unit_test(pieces_over_the_budget_are_left_out_and_counted),
        cmocka_unit_test(impossible_fisheyes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
