/*
 * The LMU tutorial's own camera, from its matrices to its pixels, in double: near and far are the coordinates n > f,
 * both negative, and w is the coordinate z, negative for all that is visible. A triangle is clipped in that clip space
 * against six planes, divided by its negative w and taken to a picture whose y points up. None of it is the product's
 * code. The renderer draws the same triangle with the camera that ph_camera_from() makes of n and f, and must cover the
 * same pixels at the same distance. Only pixels whose centre lies within MARGIN of the outline are left out, as
 * positions are rounded.
 *
 * A point is inside there where w <= x <= -w, and the same for y and z; n gives z / w = 1, f gives -1. The test of
 * HAW and EECE, -w <= x <= w, holds for w > 0 only: it throws the whole picture away.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "camera.h"
#include "assert_near.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI        3.14159265358979323846
#define WIDTH     60
#define HEIGHT    40
#define CORNERS   9 /* three, and at most one more for each plane */
#define MARGIN    (1. / 32)
#define TRIANGLES 3000

struct camera {
    double fov, n, f; /* radians; coordinates, both negative */
    bool parallel;    /* its window is that of the perspective at n */
    double eye[3], to[3];
};

/* ---- the tutorial's pipeline ------------------------------------------------------------------------------------ */

/* T_ortho, or T_ortho T_persp->ortho, with b = n tan(fov / 2) = -t and l = a b = -r. */
static void projection_of(const struct camera *c, double m[4][4])
{
    const double n = c->n, f = c->f, b = n * tan(c->fov / 2), t = -b, l = b * WIDTH / HEIGHT, r = -l;
    const double ortho[4][4] = {{2 / (r - l), 0, 0, (l + r) / (l - r)},
                                {0, 2 / (t - b), 0, (b + t) / (b - t)},
                                {0, 0, 2 / (n - f), (f + n) / (f - n)},
                                {0, 0, 0, 1}};
    const double persp[4][4] = {{n, 0, 0, 0}, {0, n, 0, 0}, {0, 0, n + f, -n * f}, {0, 0, 1, 0}};
    for (int e = 0; e < 16; e++) {
        m[e / 4][e % 4] = c->parallel ? ortho[e / 4][e % 4] : 0;
        for (int k = 0; k < 4 && !c->parallel; k++) {
            m[e / 4][e % 4] += ortho[e / 4][k] * persp[k][e % 4];
        }
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static void unit(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

/* R_view T_view: the rows of R_view are l x u, u and -l. */
static void to_camera(const struct camera *c, const double world[3], double out[4])
{
    double rows[3][3], l[3];
    for (int i = 0; i < 3; i++) {
        l[i] = c->to[i] - c->eye[i];
    }
    unit(l);
    cross(l, (const double[3]){0, 1, 0}, rows[0]);
    unit(rows[0]);
    cross(rows[0], l, rows[1]);
    for (int i = 0; i < 3; i++) {
        rows[2][i] = -l[i];
    }
    out[3] = 1;
    for (int i = 0; i < 3; i++) {
        out[i] = 0;
        for (int k = 0; k < 3; k++) {
            out[i] += rows[i][k] * (world[k] - c->eye[k]);
        }
    }
}

/* How far a point is inside plane 0 .. 5 (x, y, z at the one end and at the other), where w has that sign. */
static double inside(const double p[4], int plane, double sign)
{
    return sign * p[3] + (plane % 2 ? -p[plane / 2] : p[plane / 2]);
}

/* Clips a polygon in place. Returns the number of corners left. */
static int clip(double polygon[CORNERS][4], int count, double sign)
{
    for (int plane = 0; plane < 6; plane++) {
        double out[CORNERS][4];
        int n = 0;
        for (int i = 0; i < count; i++) {
            const double *const a = polygon[i], *const b = polygon[(i + 1) % count];
            const double da = inside(a, plane, sign), db = inside(b, plane, sign);
            for (int k = 0; k < 4 && da >= 0; k++) {
                out[n][k] = a[k];
            }
            n += da >= 0;
            for (int k = 0; k < 4 && (da >= 0) != (db >= 0); k++) {
                out[n][k] = a[k] + (b[k] - a[k]) * da / (da - db);
            }
            n += (da >= 0) != (db >= 0);
        }
        count = n;
        memcpy(polygon, out, sizeof(double[4]) * (size_t)n);
    }
    return count;
}

/* Divides by w, and takes it to pixels: [0, w] x [0, h], y up. */
static void to_pixels(const double p[4], double at[2])
{
    at[0] = (p[0] / p[3] + 1) * WIDTH / 2;
    at[1] = (p[1] / p[3] + 1) * HEIGHT / 2;
}

/* How many pixels a point lies inside a convex polygon; outside it is negative. */
static double depth_in(double polygon[CORNERS][4], int count, double x, double y)
{
    double area = 0, least = count < 3 ? -HUGE_VAL : HUGE_VAL, at[CORNERS][2];
    for (int i = 0; i < count; i++) {
        to_pixels(polygon[i], at[i]);
    }
    for (int i = 2; i < count; i++) {
        area += (at[i - 1][0] - at[0][0]) * (at[i][1] - at[0][1]) - (at[i - 1][1] - at[0][1]) * (at[i][0] - at[0][0]);
    }
    for (int i = 0; i < count; i++) {
        const double *const a = at[i], *const b = at[(i + 1) % count];
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
        const double side = (dx * (y - a[1]) - dy * (x - a[0])) * (area < 0 ? -1 : 1);
        least = length > 1e-9 ? fmin(least, side / length) : least;
    }
    return least;
}

/* The distance of a triangle at a pixel: for its plane in clip space, a x + b y + c w = 1, it is -w = -1 / (a X + b Y
 * + c) with X, Y = x / w, y / w. */
static double distance_at(double corners[3][4], double x, double y)
{
    const double ndc[3] = {2 * x / WIDTH - 1, 2 * y / HEIGHT - 1, 1};
    double rows[3][3], sum = 0;
    for (int i = 0; i < 3; i++) {
        const double *const a = corners[(i + 1) % 3], *const b = corners[(i + 2) % 3];
        cross((const double[3]){a[0], a[1], a[3]}, (const double[3]){b[0], b[1], b[3]}, rows[i]);
        for (int k = 0; k < 3; k++) {
            sum += rows[i][k] * ndc[k];
        }
    }
    const double determinant = corners[0][0] * rows[0][0] + corners[0][1] * rows[0][1] + corners[0][3] * rows[0][2];
    return -determinant / sum;
}

/* ---- the renderer's picture ------------------------------------------------------------------------------------- */

static struct rig rig;

static int open_rig(void **state)
{
    (void)state;
    rig_open(&rig, WIDTH, HEIGHT, HEIGHT, PH_DEPTH_FLOAT24, 8, 64);
    return 0;
}

static int close_rig(void **state)
{
    (void)state;
    rig_close(&rig);
    return 0;
}

static void draw(const struct camera *c, const struct fx_vec3 points[3])
{
    static const uint16_t index[1][3] = {{0, 1, 2}};
    static const struct ph_part part = {0, 1, 0};
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xFFFF, .two_sided = 1};
    const struct ph_mesh mesh = {.positions = points,
                                 .triangles = index,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
    const double t = -c->n * tan(c->fov / 2), r = t * WIDTH / HEIGHT;
    struct ph_xform view = ph_view_look_at(vec(c->eye[0], c->eye[1], c->eye[2]), vec(c->to[0], c->to[1], c->to[2]),
                                           (struct fx_vec3){0, FX_ONE, 0});
    fx_t n = ref_q16(c->n), f = ref_q16(c->f);
    struct ph_projection p;
    assert_int_equal(ph_camera_from(PH_LMU, &view, &n, &f), PH_OK);
    assert_int_equal(
        c->parallel ? ph_projection_ortho(&p, -ref_q16(r), ref_q16(r), -ref_q16(t), ref_q16(t), n, f)
                    : ph_projection_perspective(&p, ref_q16(c->fov * 180 / PI), ref_q16((double)WIDTH / HEIGHT), n, f),
        PH_OK);
    assert_int_equal(ph_frame_begin(&rig.r, &view, &p, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(&rig));
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

/* What was compared. */
struct tally {
    int drawn, empty, near_outline, cut, behind, wrong_test_kept;
    double worst; /* distance: by which share of what is allowed it is off */
};

/* Every place is a whole number of Q16.16, so that both cameras get the same. */
static double rounded(double v)
{
    return real(ref_q16(v));
}

static void make(bool parallel, struct camera *c, double world[3][3], struct fx_vec3 points[3])
{
    *c = (struct camera){.parallel = parallel,
                         .fov = rounded(ref_uniform(40, 100)) * PI / 180,
                         .n = rounded(parallel ? ref_uniform(-6, -2) : ref_uniform(-2, -.5)),
                         .f = rounded(ref_uniform(-14, -8))};
    for (int i = 0; i < 3; i++) {
        c->eye[i] = rounded(ref_uniform(-3, 3));
        c->to[i] = rounded(c->eye[i] + ref_uniform(-1, 1) + (i == 2 ? 2 : 0));
    }
    for (int e = 0; e < 9; e++) {
        world[e / 3][e % 3] = rounded(ref_uniform(-9, 9));
    }
    for (int i = 0; i < 3; i++) {
        points[i] = vec(world[i][0], world[i][1], world[i][2]);
    }
}

/* The renderer's distance must be one that the triangle has within 1/16 pixel of the centre. */
static void check_distance(double corners[3][4], const struct camera *c, int x, int row, struct tally *tally)
{
    const double got = rig_distance(&rig, rig.depth[row * WIDTH + x], -c->n, -c->f), up = HEIGHT - row - .5;
    double least = HUGE_VAL, most = 0;
    for (int k = 0; k < 4; k++) {
        const double at = distance_at(corners, x + .5 + (k % 2 ? .0625 : -.0625), up + (k / 2 ? .0625 : -.0625));
        least = fmin(least, at);
        most = fmax(most, at);
    }
    const double middle = (least + most) / 2, most_off = (most - least) / 2 + middle / 5000;
    tally->worst = fmax(tally->worst, fabs(got - middle) / most_off);
}

static void compare(const struct camera *c, double corners[3][4], struct tally *tally)
{
    double polygon[CORNERS][4], thrown_away[CORNERS][4];
    memcpy(polygon, corners, sizeof(double[3][4]));
    memcpy(thrown_away, corners, sizeof(double[3][4]));
    const int n = clip(polygon, 3, c->parallel ? 1 : -1);
    tally->cut += n > 3;
    tally->behind += !c->parallel && n >= 3 && (corners[0][3] > 0 || corners[1][3] > 0 || corners[2][3] > 0);
    tally->wrong_test_kept += clip(thrown_away, 3, 1) >= 3;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double in = depth_in(polygon, n, i % WIDTH + .5, HEIGHT - i / WIDTH - .5); /* rows go down */
        if (fabs(in) <= MARGIN) {
            tally->near_outline++;
            continue;
        }
        if ((rig.pixels[i] != 0) != (in > 0)) {
            fail_msg("pixel %d, %d is %s", i % WIDTH, i / WIDTH, in > 0 ? "missing" : "drawn");
        }
        tally->drawn += in > 0;
        tally->empty += in < 0;
        if (in > 1. / 8 && !c->parallel) {
            check_distance(corners, c, i % WIDTH, i / WIDTH, tally);
        }
    }
}

static struct tally compare_many(bool parallel)
{
    struct tally tally = {.drawn = 0};
    ref_seed(parallel ? 71 : 70);
    for (int i = 0; i < TRIANGLES; i++) {
        struct camera c;
        struct fx_vec3 points[3];
        double world[3][3], at[4], projection[4][4], corners[3][4] = {{0}};
        make(parallel, &c, world, points);
        projection_of(&c, projection);
        for (int k = 0; k < 3; k++) {
            to_camera(&c, world[k], at);
            for (int e = 0; e < 16; e++) {
                corners[k][e / 4] += projection[e / 4][e % 4] * at[e % 4];
            }
        }
        draw(&c, points);
        compare(&c, corners, &tally);
    }
    printf(
        "%s: %d pixels drawn, %d empty, %d within 1/32 px of an outline; %d triangles cut, %d reach behind the eye\n",
        parallel ? "parallel" : "negative w", tally.drawn, tally.empty, tally.near_outline, tally.cut, tally.behind);
    return tally;
}

static void triangles_clipped_at_negative_w_cover_the_renderer_s_pixels(void **state)
{
    (void)state;
    const struct tally tally = compare_many(false);
    printf("distances: off by %.2f of what 1/16 px and 1/5000 of the distance allow\n", tally.worst);
    assert_true(tally.worst <= 1);
    assert_true(tally.drawn > 100 * TRIANGLES && tally.empty > 100 * TRIANGLES);
    assert_true(tally.cut > TRIANGLES / 4 && tally.behind > TRIANGLES / 4);
    assert_int_equal(tally.wrong_test_kept, 0); /* -w <= x <= w */
}

/* w is 1 here, so that -w <= x <= w is right, but near and far are negative as before. */
static void triangles_of_a_parallel_camera_cover_the_renderer_s_pixels(void **state)
{
    (void)state;
    const struct tally tally = compare_many(true);
    assert_true(tally.drawn > 50 * TRIANGLES && tally.empty > 50 * TRIANGLES);
    assert_true(tally.cut > TRIANGLES / 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_clipped_at_negative_w_cover_the_renderer_s_pixels),
        cmocka_unit_test(triangles_of_a_parallel_camera_cover_the_renderer_s_pixels),
    };
    return cmocka_run_group_tests(tests, open_rig, close_rig);
}
