/*
 * depth_separation: what it says of one triangle and of two, against what the renderer draws. Random lenses, pictures,
 * planes and triangles: slivers, small ones, ones that reach far out of the picture, tilted from facing the camera to
 * edge-on, clipped or not. The exact plane through the corners is calculated in doubles.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_separation.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef TRIANGLES /* a lens and format; the long test has more: exhaustive_depth_separation.c */
#define TRIANGLES 150
#define PAIRS     60
#define LENSES    20
#define SEED      38
#endif
#define LSB (1 / 65536.0)

/* Where a plane through the corners of a triangle lies: n p = c, for a p in metres with z along the view. */
struct plane {
    double n[3], c;
};

struct scene {
    struct depth_lab lab;
    struct ph_projection projection;
    struct rig rig;
    double pixel;
};

static void random_lens(struct depth_lab *lab)
{
    const double n = .05 * pow(200, ref_uniform(0, 1)), f = fmin(n * 1.3 * pow(20000, ref_uniform(0, 1)), 16000);
    *lab = (struct depth_lab){.near_z = ref_q16(n),
                              .far_z = ref_q16(f),
                              .fov_deg = ref_q16(ref_uniform(20, 110)),
                              .width = (uint16_t)ref_uniform(40, 330),
                              .height = (uint16_t)ref_uniform(40, 250)};
}

static double near_m(const struct scene *s)
{
    return depth_metres(s->lab.near_z);
}

static double far_m(const struct scene *s)
{
    return depth_metres(s->lab.far_z);
}

static void scene_open(struct scene *s, const struct depth_lab *lab, const struct ph_depth_format *format)
{
    *s = (struct scene){.lab = *lab, .pixel = depth_pixel_slope(lab)};
    assert_int_equal(depth_lab_projection(lab, &s->projection), 0);
    rig_open(&s->rig, lab->width, lab->height, lab->height, format, 3, 16);
}

/* The slope of the ray of a pixel. */
static double ray_x(const struct scene *s, int x)
{
    return (2 * x + 1 - s->lab.width) * 1048576. / ((double)s->projection.scale_x_q20 * s->lab.width);
}

static double ray_y(const struct scene *s, int y)
{
    return (s->lab.height - 1 - 2 * y) * 1048576. / ((double)s->projection.scale_y_q20 * s->lab.height);
}

/* A plane at a random distance in a random pixel, with a random tilt: mostly near 0 or near 90 degrees. */
static struct plane random_plane(const struct scene *s)
{
    const double kind = ref_uniform(0, 1), azimuth = ref_uniform(0, 2 * acos(-1)), right = acos(0);
    const double tilt = kind < .4   ? ref_uniform(0, right)
                        : kind < .7 ? atan(pow(10, ref_uniform(-6, 2)))
                                    : right - pow(10, ref_uniform(-4, 0));
    const double x = ref_uniform(-.5, .5) * s->lab.width * s->pixel,
                 y = ref_uniform(-.5, .5) * s->lab.height * s->pixel;
    const double z = near_m(s) * pow(far_m(s) / near_m(s), ref_uniform(0, 1));
    struct plane plane = {{sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt)}, 0};
    plane.c = z * (plane.n[0] * x + plane.n[1] * y + plane.n[2]);
    return plane;
}

/* A triangle in a plane, about a place of the picture, of any size up to three pictures. False: it does not fit. */
static bool random_triangle(const struct scene *s, const struct plane *plane, double x, double y, struct fx_vec3 p[3])
{
    const double size = pow(2, ref_uniform(0, log2(3 * s->lab.height))), turn = ref_uniform(0, 6.283);
    const double thin = ref_uniform(0, 1) < .5 ? 1 : pow(2, ref_uniform(-9, 0));
    for (int i = 0, tries = 0; i < 3 && tries < 60; tries++) {
        const double u = ref_uniform(-.5, .5) * size, v = ref_uniform(-.5, .5) * size * thin;
        const double at_x = (x + u * cos(turn) - v * sin(turn)) * s->pixel;
        const double at_y = (y + u * sin(turn) + v * cos(turn)) * s->pixel;
        const double w = plane->c / (plane->n[0] * at_x + plane->n[1] * at_y + plane->n[2]);
        if (w > near_m(s) / 4 && w < far_m(s) * 2 && fabs(at_x * w) < 16000 && fabs(at_y * w) < 16000) {
            p[i++] = (struct fx_vec3){ref_q16(at_x * w), ref_q16(at_y * w), ref_q16(-w)};
            if (i == 3) {
                return true;
            }
        }
    }
    return false;
}

static void corner(const struct fx_vec3 *p, double out[3])
{
    out[0] = p->x * LSB, out[1] = p->y * LSB, out[2] = -p->z * LSB;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* The plane through the rounded corners, with a unit normal; false if they lie on a line. */
static bool plane_through(const struct fx_vec3 p[3], struct plane *plane)
{
    double a[3][3], u[3], v[3];
    for (int i = 0; i < 3; i++) {
        corner(&p[i], a[i]);
    }
    for (int i = 0; i < 3; i++) {
        u[i] = a[1][i] - a[0][i];
        v[i] = a[2][i] - a[0][i];
    }
    cross(u, v, plane->n);
    const double length = sqrt(plane->n[0] * plane->n[0] + plane->n[1] * plane->n[1] + plane->n[2] * plane->n[2]);
    plane->c = 0;
    for (int i = 0; i < 3; i++) {
        plane->n[i] /= length > 0 ? length : 1;
        plane->c += plane->n[i] * a[0][i];
    }
    const double sign = plane->c < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        plane->n[i] *= sign;
    }
    plane->c *= sign;
    return length > 0 && plane->c > 0;
}

static void draw(struct scene *s, const struct fx_vec3 p[3])
{
    static const uint16_t face[1][3] = {{0, 1, 2}};
    const struct ph_part part = {0, 1, 0};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = 1};
    const struct ph_mesh mesh = {.positions = p,
                                 .vertex_count = 3,
                                 .triangles = face,
                                 .triangle_count = 1,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = &material};
    assert_int_equal(ph_frame_begin(&s->rig.r, &ph_xform_identity, &s->projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&s->rig.r, &mesh, &ph_xform_identity), PH_OK);
    assert_true(rig_finish(&s->rig));
}

/* 1 / z of the plane at a pixel, and by how much that is moved at most: see depth_separation.h. */
static double inverse_at(const struct scene *s, const struct plane *plane, int x, int y)
{
    return (plane->n[0] * ray_x(s, x) + plane->n[1] * ray_y(s, y) + plane->n[2]) / plane->c;
}

static double moved(const struct scene *s, const struct plane *plane, double inverse)
{
    const double across = fabs(plane->n[0]) + fabs(plane->n[1]), z = 1 / inverse;
    const double px = s->pixel / 512 + ldexp(1, -25), rounded = 2 * LSB + ldexp(1.3 * z, -28);
    return (across * px + inverse * rounded * (across * depth_across_unit(&s->lab) + fabs(plane->n[2]))) / plane->c;
}

/* How much further a code is off than a struct depth_off says, in codes; below 0: not as far. */
static double beyond(const struct scene *s, uint32_t code, double nearest, double farthest, struct depth_off off)
{
    const struct ph_depth_format *const format = s->rig.r.config.depth_format;
    const double high = depth_code_at(format, &s->lab, fmax(nearest - off.metres, near_m(s))) + off.codes;
    const double low = depth_code_at(format, &s->lab, fmin(farthest + off.metres, far_m(s))) - off.codes;
    return fmax(code - high, low - (code + 1.));
}

static double excess_at(const struct scene *s, const struct plane *plane, uint32_t code, int x, int y, double way_px)
{
    const struct ph_depth_format *const format = s->rig.r.config.depth_format;
    const double inverse = inverse_at(s, plane, x, y), by = moved(s, plane, inverse);
    const double nearest = fmax(1 / (inverse + by), near_m(s));
    const double farthest = inverse - by > 1 / far_m(s) ? 1 / (inverse - by) : far_m(s);
    const double large = beyond(s, code, nearest, farthest, depth_off(format, &s->lab, farthest, way_px));
    return format->is_small
               ? fmin(large, beyond(s, code, nearest, farthest, depth_off_small(format, &s->lab, farthest)))
               : large;
}

/* Clipping cuts off what lies before the near plane or behind the far one, to a rounded corner. */
static bool is_between(const struct scene *s, const struct plane *plane, int x, int y)
{
    const double z = 1 / inverse_at(s, plane, x, y);
    return z >= near_m(s) && z <= far_m(s);
}

/* ---- one triangle --------------------------------------------------------------------------------------------------
 */

struct found {
    double worst; /* codes beyond what is promised */
    long pixels, triangles, clipped;
};

static void check_triangle(struct scene *s, double reach, double way_px, struct found *found)
{
    struct plane plane = random_plane(s);
    struct fx_vec3 p[3];
    const double x = ref_uniform(-.5, .5) * s->lab.width * reach, y = ref_uniform(-.5, .5) * s->lab.height * reach;
    if (!random_triangle(s, &plane, x, y, p) || !plane_through(p, &plane)) {
        return;
    }
    draw(s, p);
    found->triangles++;
    found->clipped += s->rig.r.stats.triangles_clipped;
    for (int at = 0; at < s->lab.width * s->lab.height; at++) {
        const int px = at % s->lab.width, py = at / s->lab.width;
        if (s->rig.depth[at] != 0 && is_between(s, &plane, px, py)) {
            const double excess = excess_at(s, &plane, s->rig.depth[at], px, py, way_px);
            found->worst = fmax(found->worst, excess);
            found->pixels++;
        }
    }
}

static void each_triangle_stays_where_it_is_promised(void **state)
{
    struct found all = {0, 0, 0, 0};
    (void)state;
    ref_seed(SEED);
    for (int i = 0; i < LENSES; i++) {
        struct depth_lab lab;
        random_lens(&lab);
        for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
            struct scene s;
            scene_open(&s, &lab, ph_depth_formats[f]);
            for (int k = 0; k < TRIANGLES; k++) {
                check_triangle(&s, 1, depth_way_px(&lab), &all);
            }
            rig_close(&s.rig);
        }
    }
    printf("# %ld triangles, %ld of them clipped, %ld pixels: %g codes beyond what is promised\n", all.triangles,
           all.clipped, all.pixels, fmax(all.worst, 0));
    assert_true(all.triangles > TRIANGLES * LENSES * 4 && all.clipped > all.triangles / 20);
    assert_true(all.worst <= 0);
}

/* ---- two triangles -------------------------------------------------------------------------------------------------
 */

struct pairs {
    long pairs, pixels, wrong, exceeded; /* exceeded: wrong, and further apart than depth_separation_m */
    double most;                         /* of wrong pixels the largest separation, as a part of it */
};

static double farthest_of(const struct fx_vec3 p[3], const struct fx_vec3 q[3])
{
    double z = 0;
    for (int i = 0; i < 3; i++) {
        z = fmax(z, fmax(-p[i].z, -q[i].z) * LSB);
    }
    return z;
}

/* Two triangles of their own in two parallel planes, the separation of which is about what is needed. */
static void check_pair(struct scene *s, uint32_t *codes, struct pairs *pairs)
{
    const struct ph_depth_format *const format = s->rig.r.config.depth_format;
    struct plane behind = random_plane(s), front, exact[2];
    struct fx_vec3 p[2][3];
    const double x = ref_uniform(-.5, .5) * s->lab.width, y = ref_uniform(-.5, .5) * s->lab.height;
    if (!random_triangle(s, &behind, x, y, p[0]) || !plane_through(p[0], &exact[0])) {
        return;
    }
    const double z = fmin(farthest_of(p[0], p[0]), far_m(s)), way = depth_way_px(&s->lab);
    const double bound = depth_separation_m(format, &s->lab, z, 90, way), lean = acos(fmin(exact[0].n[2], 1)) * 57.3;
    const double own = depth_separation_m(format, &s->lab, z, fmin(fmax(lean, .001), 90), way);
    front = exact[0];
    front.c -= fmin(bound, own) * ref_uniform(.1, 1.1);
    if (!(front.c > 0) || !random_triangle(s, &front, x, y, p[1]) || !plane_through(p[1], &exact[1])) {
        return;
    }
    const int area = s->lab.width * s->lab.height;
    draw(s, p[0]);
    memcpy(codes, s->rig.depth, (size_t)area * sizeof *codes);
    draw(s, p[1]);
    pairs->pairs++;
    const double z_max = fmin(farthest_of(p[0], p[1]), far_m(s));
    const double needed = depth_separation_m(format, &s->lab, z_max, fmin(fmax(lean, .001) + .5, 90), way);
    for (int at = 0; at < area; at++) {
        if (codes[at] != 0 && s->rig.depth[at] != 0) {
            const double i0 = inverse_at(s, &exact[0], at % s->lab.width, at / s->lab.width);
            const double i1 = inverse_at(s, &exact[1], at % s->lab.width, at / s->lab.width);
            const double apart = (1 / i0 - 1 / i1) * i0 * exact[0].c; /* along the normal */
            pairs->pixels++;
            if (apart > 0 && s->rig.depth[at] <= codes[at]) {
                pairs->wrong++;
                pairs->most = fmax(pairs->most, apart / needed);
                pairs->exceeded += apart > needed;
            }
        }
    }
}

static void no_pair_further_apart_is_ever_wrong(void **state)
{
    struct pairs all = {0, 0, 0, 0, 0};
    uint32_t *const codes = malloc(330 * 250 * sizeof *codes);
    (void)state;
    assert_non_null(codes);
    ref_seed(SEED + 1);
    for (int i = 0; i < LENSES; i++) {
        struct depth_lab lab;
        random_lens(&lab);
        for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
            struct pairs own = {0, 0, 0, 0, 0};
            struct scene s;
            scene_open(&s, &lab, ph_depth_formats[f]);
            for (int k = 0; k < PAIRS; k++) {
                check_pair(&s, codes, &own);
            }
            all.pairs += own.pairs, all.pixels += own.pixels, all.wrong += own.wrong, all.exceeded += own.exceeded;
            all.most = fmax(all.most, own.most);
            rig_close(&s.rig);
        }
    }
    free(codes);
    printf(
        "# %ld pairs, %ld pixels of both, %ld wrong, %ld of these further apart than what is promised; the worst %.3f "
        "of it\n",
        all.pairs, all.pixels, all.wrong, all.exceeded, all.most);
    assert_true(all.wrong > 100);
    assert_int_equal(all.exceeded, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_triangle_stays_where_it_is_promised),
        cmocka_unit_test(no_pair_further_apart_is_ever_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
