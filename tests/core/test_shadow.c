/*
 * Planar shadows are compared with a reference that draws nothing. For every pixel, a ray in double finds the point of
 * the ground that it shows; the point is in shadow if the segment from there to the light meets the object. The
 * projection onto a plane from a light at the origin (K. Juenemann, HAW Hamburg, chapter 9) is checked as a matrix, for
 * planes in any position.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "ref_rig.h"
#include "shadow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE   120
#define GROUND 0x1111
#define SHADOW 0x2222

static const struct ph_material dark = {.shading = PH_SHADE_UNLIT, .depth_bias = 16, .colour = SHADOW};

/* A tetrahedron, closed, of any place and size. */
struct object {
    struct fx_vec3 corners[4];
    struct ph_mesh mesh;
};

static const uint16_t faces[4][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
static const struct ph_part all_faces = {0, 4, 0};
static const struct ph_material plain = {.shading = PH_SHADE_UNLIT, .colour = 0x7777};

static void build(struct object *o, const double middle[3], double size)
{
    static const double unit[4][3] = {{0, 1, 0}, {.9, -.5, .3}, {-.7, -.5, .7}, {-.2, -.5, -.9}};
    double turn[3][3];
    ref_rotation(3, turn);
    for (int i = 0; i < 4; i++) {
        double p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = middle[k];
            for (int x = 0; x < 3; x++) {
                p[k] += size * turn[k][x] * unit[i][x];
            }
        }
        o->corners[i] = (struct fx_vec3){ref_q16(p[0]), ref_q16(p[1]), ref_q16(p[2])};
    }
    o->mesh = (struct ph_mesh){.positions = o->corners,
                               .triangles = faces,
                               .parts = &all_faces,
                               .materials = &plain,
                               .vertex_count = 4,
                               .triangle_count = 4,
                               .part_count = 1};
}

static void to_double(const struct fx_vec3 *p, double out[3])
{
    out[0] = p->x / 65536.;
    out[1] = p->y / 65536.;
    out[2] = p->z / 65536.;
}

static double volume(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Whether the segment from ground point g to the light meets a face of the object. */
static bool in_shadow(const struct object *o, const double g[3], const double light[3])
{
    double way[3];
    for (int k = 0; k < 3; k++) {
        way[k] = light[k] - g[k];
    }
    for (int f = 0; f < 4; f++) {
        double p[3][3];
        for (int i = 0; i < 3; i++) {
            to_double(&o->corners[faces[f][i]], p[i]);
            for (int k = 0; k < 3; k++) {
                p[i][k] -= g[k];
            }
        }
        const double a = volume(way, p[1], p[2]), b = volume(way, p[2], p[0]), c = volume(way, p[0], p[1]);
        const double t = volume(p[0], p[1], p[2]) / (a + b + c);
        if (((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) && t > 0 && t < 1) {
            return true;
        }
    }
    return false;
}

/* The ground y = 0 as a square of half side 40, seen from `eye` down to `target`. */
struct view {
    struct rig rig;
    struct ph_xform view;
    struct ph_projection projection;
    double eye[3];
};

static void open_view(struct view *v, enum ph_projection_kind kind, const struct ph_depth_format *format, int band)
{
    const struct fx_vec3 eye = {FX_INT(3), FX_INT(7), FX_INT(9)};
    memset(v, 0, sizeof(*v));
    rig_open(&v->rig, SIZE, SIZE, band, format, 64, 6000);
    v->view = ph_view_look_at(eye, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
    const int status =
        kind == PH_PERSPECTIVE ? ph_projection_perspective(&v->projection, FX_INT(70), FX_ONE, FX_ONE, FX_INT(100))
        : kind == PH_ORTHOGRAPHIC
            ? ph_projection_ortho(&v->projection, FX_INT(-8), FX_INT(8), FX_INT(-8), FX_INT(8), FX_ONE, FX_INT(60))
            : ph_projection_fisheye(&v->projection, FX_INT(90), FX_ONE, FX_INT(100));
    assert_int_equal(status, PH_OK);
    assert_int_equal(ph_frame_begin(&v->rig.r, &v->view, &v->projection, NULL, 0), PH_OK);
    to_double(&eye, v->eye);
}

static void draw_ground(struct view *v)
{
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = GROUND};
    static const struct fx_vec3 corners[4] = {{FX_INT(-40), 0, FX_INT(-40)},
                                              {FX_INT(-40), 0, FX_INT(40)},
                                              {FX_INT(40), 0, FX_INT(40)},
                                              {FX_INT(40), 0, FX_INT(-40)}};
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {0, 2, 0};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    assert_int_equal(ph_draw_mesh(&v->rig.r, &mesh, &ph_xform_identity), PH_OK);
}

/* The ground point of a picture point; false in the sky. */
static bool ground_at(const struct view *v, double sx, double sy, double g[3])
{
    const double dx = (sx - SIZE / 2.) / (SIZE / 2.), dy = -(sy - SIZE / 2.) / (SIZE / 2.);
    double at[3] = {0, 0, 0}, way[3] = {0, 0, -1}, world[2][3];
    if (v->projection.kind == PH_PERSPECTIVE) {
        way[0] = dx * tan(35 * 3.14159265358979 / 180);
        way[1] = dy * tan(35 * 3.14159265358979 / 180);
    } else if (v->projection.kind == PH_ORTHOGRAPHIC) {
        at[0] = 8 * dx;
        at[1] = 8 * dy;
    } else {
        const double theta = hypot(dx, dy) * 45 * 3.14159265358979 / 180;
        way[0] = theta > 0 ? sin(theta) * dx / hypot(dx, dy) : 0;
        way[1] = theta > 0 ? sin(theta) * dy / hypot(dx, dy) : 0;
        way[2] = -cos(theta);
    }
    for (int k = 0; k < 3; k++) { /* the transposed rotation */
        world[0][k] = v->eye[k];
        world[1][k] = 0;
        for (int i = 0; i < 3; i++) {
            world[0][k] += v->view.r[i][k] / 1073741824. * at[i];
            world[1][k] += v->view.r[i][k] / 1073741824. * way[i];
        }
    }
    const double t = -world[0][1] / world[1][1];
    for (int k = 0; k < 3; k++) {
        g[k] = world[0][k] + t * world[1][k];
    }
    return t > 1.05 && fabs(g[0]) < 39 && fabs(g[2]) < 39;
}

/* Every pixel of the ground is dark if its point is in the shadow; unless a point less than 1 px away is not. */
static int compare(const struct view *v, const struct object *o, const double light[3])
{
    int shadows = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        int dark_around = 0, points = 0;
        for (int k = 0; k < 9; k++) {
            const double a = k * .7853981634, far = k < 8 ? .9 : 0;
            double g[3];
            if (ground_at(v, i % SIZE + .5 + far * cos(a), i / SIZE + .5 + far * sin(a), g)) {
                points++;
                dark_around += in_shadow(o, g, light);
            }
        }
        if (points == 9 && (dark_around == 0 || dark_around == 9)) {
            const uint16_t want = dark_around == 9 ? SHADOW : GROUND;
            if (v->rig.pixels[i] != want) {
                fail_msg("kind %d: (%d, %d) is %04x instead of %04x", v->projection.kind, i % SIZE, i / SIZE,
                         v->rig.pixels[i], want);
            }
            shadows += dark_around == 9;
        }
    }
    return shadows;
}

static const struct ph_plane_equation ground = {{0, FX_Q30_ONE, 0}, 0};

static int draw_and_compare(struct object *o, const double light[3], enum ph_projection_kind kind,
                            const struct ph_depth_format *format)
{
    struct view v;
    const struct fx_vec3 at = {ref_q16(light[0]), ref_q16(light[1]), ref_q16(light[2])};
    double exact[3];
    to_double(&at, exact);
    open_view(&v, kind, format, SIZE);
    draw_ground(&v);
    assert_int_equal(ph_draw_shadow(&v.rig.r, &o->mesh, &ph_xform_identity, at, &ground, &dark), PH_OK);
    assert_true(rig_finish(&v.rig));
    const int shadows = compare(&v, o, exact);
    rig_close(&v.rig);
    return shadows;
}

static void shadow_is_what_the_light_does_not_reach(void **state)
{
    int shadows = 0;
    (void)state;
    ref_seed(8);
    for (int i = 0; i < 48; i++) {
        struct object o;
        build(&o, (const double[3]){ref_uniform(-2, 2), ref_uniform(1.6, 3), ref_uniform(-2, 2)}, 1.5);
        const double light[3] = {ref_uniform(-4, 4), ref_uniform(6, 9), ref_uniform(-4, 4)};
        shadows +=
            draw_and_compare(&o, light, (enum ph_projection_kind)(i % 3), ph_depth_formats[i / 3 % PH_DEPTH_FORMATS]);
    }
    assert_true(shadows > 48 * 200);
}

/* The ground clips the object: its part below casts no shadow (the reference's rays end at the ground). */
static void what_is_below_the_plane_casts_no_shadow(void **state)
{
    int shadows = 0;
    (void)state;
    ref_seed(18);
    for (int i = 0; i < 30; i++) {
        struct object o;
        build(&o, (const double[3]){ref_uniform(-2, 2), ref_uniform(-.8, .8), ref_uniform(-2, 2)}, 1.7);
        const double light[3] = {ref_uniform(-4, 4), ref_uniform(4, 6), ref_uniform(-4, 4)};
        shadows += draw_and_compare(&o, light, (enum ph_projection_kind)(i % 3), PH_DEPTH_FIXED16);
    }
    assert_true(shadows > 30 * 50);
}

/* Reaching above the light: rays end at the light; the shadow goes on to the edge of the ground. */
static void what_is_above_the_light_casts_no_shadow(void **state)
{
    int shadows = 0;
    (void)state;
    ref_seed(28);
    for (int i = 0; i < 30; i++) {
        struct object o;
        build(&o, (const double[3]){ref_uniform(-2, 2), ref_uniform(1.5, 3), ref_uniform(-2, 2)}, 2);
        const double light[3] = {ref_uniform(4, 6), ref_uniform(2, 3), ref_uniform(-4, 4)};
        shadows += draw_and_compare(&o, light, (enum ph_projection_kind)(i % 3), PH_DEPTH_FIXED16);
    }
    assert_true(shadows > 30 * 200);
}

static uint32_t drawn_for(double object_y, double light_y, const struct ph_plane_equation *plane)
{
    struct object o;
    struct view v;
    ref_seed(38);
    build(&o, (const double[3]){0, object_y, 0}, 1);
    open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, SIZE);
    assert_int_equal(
        ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity, (struct fx_vec3){0, ref_q16(light_y), 0}, plane, &dark),
        PH_OK);
    const uint32_t drawn = v.rig.r.stats.triangles_drawn;
    rig_close(&v.rig);
    return drawn;
}

static void nothing_is_drawn_where_there_is_no_shadow(void **state)
{
    const struct ph_plane_equation ceiling = {{0, -FX_Q30_ONE, 0}, FX_INT(4)}; /* lit from below, at y = 4 */
    (void)state;
    assert_true(drawn_for(2, 6, &ground) > 0);
    assert_int_equal(drawn_for(2, 0, &ground), 0);  /* light in the plane */
    assert_int_equal(drawn_for(2, -3, &ground), 0); /* and below it */
    assert_int_equal(drawn_for(-2, 6, &ground), 0); /* object below */
    assert_int_equal(drawn_for(-2, -6, &ground), 0);
    assert_int_equal(drawn_for(8, 6, &ground), 0); /* object above the light */
    assert_int_equal(drawn_for(2, 6, &ceiling), 0);
    assert_int_equal(drawn_for(6, 0, &ceiling), 0);
}

/* Seen from below the plane a one-sided shadow is not there, a two-sided one is. */
static void shadow_lies_on_the_side_of_the_light(void **state)
{
    (void)state;
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        struct object o;
        struct view v;
        struct ph_material material = dark;
        const struct ph_xform below = ph_view_look_at((struct fx_vec3){0, FX_INT(-6), FX_ONE},
                                                      (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
        ref_seed(48);
        build(&o, (const double[3]){0, 2, 0}, 1);
        material.two_sided = (uint8_t)two_sided;
        open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, SIZE);
        assert_int_equal(ph_frame_begin(&v.rig.r, &below, &v.projection, NULL, 0), PH_OK);
        assert_int_equal(ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity, (struct fx_vec3){0, FX_INT(6), 0},
                                        &ground, &material),
                         PH_OK);
        assert_int_equal(v.rig.r.stats.triangles_drawn > 0, two_sided);
        rig_close(&v.rig);
    }
}

/* Inside the shadow no pixel is left out, wherever the camera stands: no depth fighting with the ground. */
static void shadow_does_not_fight_with_the_ground(void **state)
{
    (void)state;
    ref_seed(58);
    for (int i = 0; i < 24; i++) {
        struct view v;
        struct object o;
        const double height = .3 + i * .2, distance = 4 + i % 8 * 4;
        const struct fx_vec3 light = {0, FX_INT(30), 0}, eye = {0, ref_q16(height), ref_q16(distance)};
        build(&o, (const double[3]){0, 3, 0}, 3);
        open_view(&v, PH_PERSPECTIVE, ph_depth_formats[i % PH_DEPTH_FORMATS], SIZE);
        v.view = ph_view_look_at(eye, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
        to_double(&eye, v.eye);
        assert_int_equal(ph_frame_begin(&v.rig.r, &v.view, &v.projection, NULL, 0), PH_OK);
        draw_ground(&v);
        assert_int_equal(ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity, light, &ground, &dark), PH_OK);
        assert_true(rig_finish(&v.rig));
        compare(&v, &o, (const double[3]){0, 30, 0});
        rig_close(&v.rig);
    }
}

static void picture_does_not_depend_on_the_band_height(void **state)
{
    struct object o;
    struct view v[2];
    (void)state;
    ref_seed(68);
    build(&o, (const double[3]){0, 1, 0}, 2);
    for (int i = 0; i < 2; i++) {
        open_view(&v[i], PH_PERSPECTIVE, PH_DEPTH_FLOAT16, i ? 7 : SIZE);
        draw_ground(&v[i]);
        assert_int_equal(ph_draw_shadow(&v[i].rig.r, &o.mesh, &ph_xform_identity,
                                        (struct fx_vec3){FX_ONE, FX_INT(4), 0}, &ground, &dark),
                         PH_OK);
        assert_true(rig_finish(&v[i].rig));
    }
    assert_memory_equal(v[0].rig.pixels, v[1].rig.pixels, SIZE * SIZE * 2);
    rig_close(&v[0].rig);
    rig_close(&v[1].rig);
}

/* HAW's Q = [d E 0; -n^T 0] for a plane n.p = d and the light at the origin. */
static void shadow_of(const double n[3], double d, const double light[3], const struct fx_vec3 *point, double out[3])
{
    double p[3], w = 0;
    to_double(point, p);
    for (int k = 0; k < 3; k++) {
        p[k] -= light[k];
        w -= n[k] * p[k];
        d += n[k] * light[k];
    }
    for (int k = 0; k < 3; k++) {
        out[k] = light[k] + d * p[k] / w;
    }
}

static void picture_of(const struct view *v, const double p[3], double out[2])
{
    double at[3];
    for (int i = 0; i < 3; i++) {
        const fx_t t = i == 0 ? v->view.t.x : i == 1 ? v->view.t.y : v->view.t.z;
        at[i] = t / 65536.;
        for (int k = 0; k < 3; k++) {
            at[i] += v->view.r[i][k] / 1073741824. * p[k];
        }
    }
    const double focal = SIZE / 2. / tan(35 * 3.14159265358979 / 180);
    out[0] = SIZE / 2. + focal * at[0] / -at[2];
    out[1] = SIZE / 2. - focal * at[1] / -at[2];
}

/* The smallest upright rectangle around some points of the picture: x, y. */
struct extent {
    double least[2], most[2];
};

static const struct extent no_extent = {{SIZE, SIZE}, {0, 0}};

static void extend(struct extent *e, double x, double y)
{
    const double at[2] = {x, y};
    for (int i = 0; i < 2; i++) {
        e->least[i] = fmin(e->least[i], at[i]);
        e->most[i] = fmax(e->most[i], at[i]);
    }
}

/* On any plane: the pixels of the shadow reach as far as the four corners that the matrix gives. */
static void shadows_reach_as_far_as_the_matrix_of_haw_says(void **state)
{
    (void)state;
    ref_seed(78);
    for (int i = 0; i < 200; i++) {
        const struct ph_material both = {.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = SHADOW};
        double n[3], middle[3], light[3], to[3];
        struct extent got = no_extent, want = no_extent;
        struct object o;
        struct view v;
        ref_direction(n);
        const struct ph_plane_equation plane = {{ref_q30(n[0]), ref_q30(n[1]), ref_q30(n[2])},
                                                ref_q16(ref_uniform(-1, 1))};
        for (int k = 0; k < 3; k++) {
            light[k] = ref_q16(n[k] * 6 + ref_uniform(-1, 1)) / 65536.;
            middle[k] = n[k] * 3 + ref_uniform(-1, 1);
        }
        build(&o, middle, .5);
        shadow_of(n, plane.d / 65536., light, &o.corners[0], to);
        open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, SIZE);
        v.view = ph_view_look_at(
            (struct fx_vec3){ref_q16(to[0] + 5 * n[0]), ref_q16(to[1] + 5 * n[1]), ref_q16(to[2] + 5 * n[2])},
            (struct fx_vec3){ref_q16(to[0]), ref_q16(to[1]), ref_q16(to[2])}, (struct fx_vec3){0, FX_ONE, 0});
        assert_int_equal(ph_frame_begin(&v.rig.r, &v.view, &v.projection, NULL, 0), PH_OK);
        assert_int_equal(ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity,
                                        (struct fx_vec3){ref_q16(light[0]), ref_q16(light[1]), ref_q16(light[2])},
                                        &plane, &both),
                         PH_OK);
        assert_true(rig_finish(&v.rig));
        for (int k = 0; k < 4; k++) {
            double at[2];
            shadow_of(n, plane.d / 65536., light, &o.corners[k], to);
            picture_of(&v, to, at);
            extend(&want, at[0], at[1]);
        }
        for (int k = 0; k < SIZE * SIZE; k++) {
            if (v.rig.pixels[k] == SHADOW) {
                extend(&got, k % SIZE + .5, k / SIZE + .5);
            }
        }
        for (int x = 0; x < 2; x++) {
            const double least = fmax(want.least[x], 0), most = fmin(want.most[x], SIZE);
            assert_true(got.least[x] >= least - .01 && got.most[x] <= most + .01);
            assert_true(got.least[x] <= least + 8 && got.most[x] >= most - 8); /* sharp corners */
        }
        rig_close(&v.rig);
    }
}

/* Half of what the ground is, where an opaque shadow would be, and each pixel once. */
static void ground_is_seen_through_a_blended_shadow(void **state)
{
    static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    static const struct ph_material grey = {.shading = PH_SHADE_UNLIT, .depth_bias = 16, .blend = &half};
    const struct fx_vec3 light = {FX_ONE, FX_INT(9), FX_ONE};
    struct object o;
    struct view opaque, blended;
    int shaded = 0;
    (void)state;
    build(&o, (const double[3]){0, 2, 0}, 1.5);
    open_view(&opaque, PH_PERSPECTIVE, PH_DEPTH_FIXED16, 16);
    open_view(&blended, PH_PERSPECTIVE, PH_DEPTH_FIXED16, 16);
    draw_ground(&opaque);
    draw_ground(&blended);
    assert_int_equal(ph_draw_shadow(&opaque.rig.r, &o.mesh, &ph_xform_identity, light, &ground, &dark), PH_OK);
    assert_int_equal(ph_draw_shadow(&blended.rig.r, &o.mesh, &ph_xform_identity, light, &ground, &grey), PH_OK);
    assert_true(rig_finish(&opaque.rig) && rig_finish(&blended.rig));
    const uint16_t wire = GROUND, colour = (uint16_t)(*(const uint8_t *)&wire << 8 | ((const uint8_t *)&wire)[1]);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const uint8_t *const bytes = (const uint8_t *)&blended.rig.pixels[i];
        const int is = bytes[0] << 8 | bytes[1];
        if (opaque.rig.pixels[i] != SHADOW) {
            assert_int_equal(blended.rig.pixels[i], opaque.rig.pixels[i]);
            continue;
        }
        shaded++;
        assert_true(abs(2 * (is >> 11) - (colour >> 11)) <= 1);
        assert_true(abs(2 * (is >> 5 & 63) - (colour >> 5 & 63)) <= 2);
        assert_true(abs(2 * (is & 31) - (colour & 31)) <= 1);
    }
    assert_true(shaded > 100);
    rig_close(&opaque.rig);
    rig_close(&blended.rig);
}

/* Neither the mesh nor its shadow has room for the rows that blended triangles are drawn into. */
static void blended_shadow_without_room_is_left_out_and_counted(void **state)
{
    static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 16};
    static const struct ph_material glass = {.shading = PH_SHADE_UNLIT, .colour = SHADOW, .blend = &half};
    struct object o;
    struct view v;
    (void)state;
    build(&o, (const double[3]){0, 2, 0}, 1.5);
    o.mesh.materials = &glass;
    open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, SIZE);
    rig_close(&v.rig);
    rig_open(&v.rig, 1024, 64, 64, PH_DEPTH_FIXED16, 4, 100);
    assert_int_equal(ph_frame_begin(&v.rig.r, &v.view, &v.projection, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&v.rig.r, &o.mesh, &ph_xform_identity), PH_OK);
    assert_int_equal(v.rig.r.stats.triangles_dropped, 4);
    assert_int_equal(
        ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity, (struct fx_vec3){0, FX_INT(9), 0}, &ground, &glass),
        PH_OK);
    assert_int_equal(v.rig.r.stats.triangles_drawn, 0);
    assert_int_equal(v.rig.r.stats.vertices_dropped, 4);
    assert_int_equal(v.rig.r.stats.triangles_in, 8);
    assert_int_equal(v.rig.r.stats.triangles_dropped, 8);
    assert_true(rig_finish(&v.rig));
    rig_close(&v.rig);
}

#define PIECES 60

/* Loose triangles, some of which are cut: they reach below the plane, above the light, and behind the camera. */
static void build_pieces(struct ph_mesh *mesh)
{
    static struct fx_vec3 points[3 * PIECES];
    static uint16_t triangles[PIECES][3];
    static const struct ph_part all = {.count = PIECES};
    for (int i = 0; i < 3 * PIECES; i++) {
        const double size = i % 3 == 0 ? 8 : 3;
        const struct fx_vec3 from = i % 3 == 0 ? (struct fx_vec3){0, FX_INT(3), 0} : points[i - i % 3];
        points[i] = (struct fx_vec3){from.x + ref_q16(ref_uniform(-size, size)), from.y + ref_q16(ref_uniform(-4, 4)),
                                     from.z + ref_q16(ref_uniform(-size, size))};
        triangles[i / 3][i % 3] = (uint16_t)i;
    }
    *mesh = (struct ph_mesh){.positions = points,
                             .triangles = triangles,
                             .parts = &all,
                             .materials = &plain,
                             .vertex_count = 3 * PIECES,
                             .triangle_count = PIECES,
                             .part_count = 1};
}

/* What does not fit is left out, and what is drawn is shadow there with room for all, too. */
static void with_little_room_only_shadow_is_drawn(void **state)
{
    static const struct ph_material both = {.shading = PH_SHADE_UNLIT, .two_sided = 1, .colour = SHADOW};
    static uint16_t whole[SIZE * SIZE];
    struct ph_mesh mesh;
    int parts = 0;
    (void)state;
    ref_seed(31);
    build_pieces(&mesh);
    for (int budget = 1000; budget > 0; budget = budget == 1000 ? 150 : budget - 1) {
        struct view v;
        open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, 16);
        rig_close(&v.rig);
        rig_open(&v.rig, SIZE, SIZE, 16, PH_DEPTH_FIXED16, 3 * PIECES + 5, budget);
        assert_int_equal(ph_frame_begin(&v.rig.r, &v.view, &v.projection, NULL, 0), PH_OK);
        assert_int_equal(
            ph_draw_shadow(&v.rig.r, &mesh, &ph_xform_identity, (struct fx_vec3){FX_ONE, FX_INT(6), 0}, &ground, &both),
            PH_OK);
        assert_true(rig_finish(&v.rig));
        parts += v.rig.r.stats.triangles_drawn > 0 && v.rig.r.stats.triangles_dropped > 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            whole[i] = budget == 1000 ? v.rig.pixels[i] : whole[i];
            assert_true(v.rig.pixels[i] == 0 || v.rig.pixels[i] == whole[i]);
        }
        rig_close(&v.rig);
    }
    assert_true(parts > 20);
}

static void mesh_over_the_vertex_budget_is_left_out_and_counted(void **state)
{
    struct object o;
    struct view v;
    (void)state;
    build(&o, (const double[3]){0, 2, 0}, 1);
    open_view(&v, PH_PERSPECTIVE, PH_DEPTH_FIXED16, SIZE);
    v.rig.r.config.vertex_max = 3;
    assert_int_equal(
        ph_draw_shadow(&v.rig.r, &o.mesh, &ph_xform_identity, (struct fx_vec3){0, FX_INT(6), 0}, &ground, &dark),
        PH_ERR_NOMEM);
    assert_int_equal(v.rig.r.stats.vertices_dropped, 4);
    assert_int_equal(v.rig.r.stats.triangles_in, 0);
    rig_close(&v.rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadow_is_what_the_light_does_not_reach),
        cmocka_unit_test(what_is_below_the_plane_casts_no_shadow),
        cmocka_unit_test(what_is_above_the_light_casts_no_shadow),
        cmocka_unit_test(nothing_is_drawn_where_there_is_no_shadow),
        cmocka_unit_test(shadow_lies_on_the_side_of_the_light),
        cmocka_unit_test(shadow_does_not_fight_with_the_ground),
        cmocka_unit_test(picture_does_not_depend_on_the_band_height),
        cmocka_unit_test(shadows_reach_as_far_as_the_matrix_of_haw_says),
        cmocka_unit_test(with_little_room_only_shadow_is_drawn),
        cmocka_unit_test(mesh_over_the_vertex_budget_is_left_out_and_counted),
        cmocka_unit_test(ground_is_seen_through_a_blended_shadow),
        cmocka_unit_test(blended_shadow_without_room_is_left_out_and_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
