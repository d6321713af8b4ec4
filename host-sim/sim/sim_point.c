/* See sim_point.h. */
#include "sim_point.h"

#include "fx_math.h"
#include "lab_probe.h"
#include "sim_fisheye.h"
#include "sim_fraction.h"

#include <math.h>

struct place {
    struct sim_fraction c[4];
};

static struct place moved(const struct ph_xform *m, const struct place *p)
{
    const fx_t t[3] = {m->t.x, m->t.y, m->t.z};
    struct place out = *p;
    for (int i = 0; i < 3; i++) {
        out.c[i] = sim_fraction_of(t[i], 16);
        for (int j = 0; j < 3; j++) {
            out.c[i] = sim_fraction_add(out.c[i], sim_fraction_times(sim_fraction_of(m->r[i][j], 30), p->c[j]));
        }
    }
    return out;
}

/* The depth of clip space, from the distance along the view: w times (a + b / w), or parallel a + b z. */
static struct sim_fraction clip_depth(const struct ph_projection *p, enum ph_convention convention,
                                      struct sim_fraction z)
{
    const struct sim_fraction n = sim_fraction_of(p->near_z, 16), f = sim_fraction_of(p->far_z, 16),
                              range = sim_fraction_add(f, sim_fraction_minus(n)), two = sim_fraction_of(2, 0);
    const bool parallel = p->kind == PH_ORTHOGRAPHIC;
    /* from 0 at the near plane to w at the far one */
    const struct sim_fraction way = sim_fraction_divide(sim_fraction_add(z, sim_fraction_minus(n)), range),
                              zero = parallel ? way : sim_fraction_times(way, f);
    const struct sim_fraction w = parallel ? sim_fraction_of(1, 0) : z;
    const struct sim_fraction both = sim_fraction_add(sim_fraction_times(two, zero), sim_fraction_minus(w));
    return convention == PH_D3D        ? zero
           : convention == PH_REVERSED ? sim_fraction_add(w, sim_fraction_minus(zero))
           : convention == PH_GL       ? both
           : parallel                  ? sim_fraction_minus(both)
                                       : both;
}

/* From camera coordinates of ours to clip space of the convention. */
static struct place clipped(const struct ph_projection *p, enum ph_convention convention, const struct place *camera)
{
    const bool parallel = p->kind == PH_ORTHOGRAPHIC, turned = convention == PH_LMU && !parallel;
    const struct sim_fraction distance = sim_fraction_minus(camera->c[2]), one = sim_fraction_of(1, 0),
                              w = parallel ? one : distance;
    struct place out;
    out.c[0] = sim_fraction_add(sim_fraction_times(sim_fraction_of(p->scale_x_q20, 20), camera->c[0]),
                                sim_fraction_minus(sim_fraction_times(sim_fraction_of(p->shift_x, 16), w)));
    out.c[1] = sim_fraction_add(sim_fraction_times(sim_fraction_of(p->scale_y_q20, 20), camera->c[1]),
                                sim_fraction_minus(sim_fraction_times(sim_fraction_of(p->shift_y, 16), w)));
    out.c[2] = clip_depth(p, convention, distance);
    out.c[3] = w;
    for (int i = 0; i < 4 && turned; i++) { /* all four have the other sign, and the depth once more */
        out.c[i] = i == 2 ? out.c[i] : sim_fraction_minus(out.c[i]);
    }
    return out;
}

static void put_stage(FILE *file, const char *stage, const struct place *exact, const struct ph_vec4 *code, int count)
{
    const fx_t codes[4] = {code->x, code->y, code->z, code->w};
    for (int i = 0; i < count; i++) {
        char name[16];
        snprintf(name, sizeof name, "%s.%c", stage, "xyzw"[i]);
        sim_fraction_print(file, name, exact->c[i], codes[i]);
    }
}

static void put_depths(FILE *file, const struct ph_projection *p, fx_t distance)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        struct lab_probe probe;
        const bool seen = distance >= p->near_z && distance <= p->far_z;
        if (lab_formats[i].kind != LAB_DRAWN || lab_formats[i].exponent != 0 || p->kind != PH_PERSPECTIVE || !seen ||
            lab_probe_open(&probe, &lab_formats[i], p->near_z, p->far_z) != 0) {
            continue;
        }
        const uint32_t code = lab_code(&probe, distance);
        fprintf(file, "depth.%s %u %.9g\n", lab_formats[i].name, (unsigned)code, code / (double)probe.largest);
    }
}

/* Our camera's coordinates, or our world's, in the convention: its camera, or its world, may be left-handed. */
static struct place written(struct place place, bool left_handed)
{
    place.c[2] = left_handed ? sim_fraction_minus(place.c[2]) : place.c[2];
    return place;
}

/* A vertex before the lens, which all lenses share: Pinhole's codes in the convention, and the exact values in our
 * coordinates. */
struct seen {
    struct ph_vec4 object_code, world_code, view_code;
    struct place object, world, camera;
};

static struct seen seen_of(struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                           struct sim_matrix_writing writing)
{
    const struct ph_mat4 place_matrix = ph_mat4_xform(object), view_matrix = sim_matrix_of_view(view, writing);
    struct seen s = {.object_code = {point.x, point.y, point.z, FX_ONE},
                     .object = {{sim_fraction_of(point.x, 16), sim_fraction_of(point.y, 16),
                                 sim_fraction_of(point.z, 16), sim_fraction_of(1, 0)}}};
    s.world_code = ph_mat4_apply(&place_matrix, s.object_code);
    s.world_code.z = writing.left_world ? fx_neg_sat(s.world_code.z) : s.world_code.z;
    s.view_code = ph_mat4_apply(&view_matrix, s.world_code);
    s.world = moved(object, &s.object);
    s.camera = moved(view, &s.world);
    return s;
}

static void put_seen(FILE *file, const struct seen *s, struct sim_matrix_writing writing)
{
    const struct place world = written(s->world, writing.left_world),
                       camera = written(s->camera, writing.convention == PH_D3D);
    put_stage(file, "object", &s->object, &s->object_code, 3);
    put_stage(file, "world", &world, &s->world_code, 3);
    put_stage(file, "view", &camera, &s->view_code, 3);
}

#define DEGREES_PER_RADIAN 3754936 /* Q16.16 */

/* A fisheye's stages behind the camera. Angles have no fractions. The core takes no angle: codes of it are what the
 * place in the picture says. */
static int print_fisheye(FILE *file, const struct seen *s, const struct ph_projection *p, uint16_t width,
                         uint16_t height, struct sim_matrix_writing writing)
{
    const struct ph_vec4 *const v = &s->view_code;
    const struct fx_vec3 at = {v->x, v->y, writing.convention == PH_D3D ? fx_neg_sat(v->z) : v->z};
    struct sim_fisheye code;
    if (!sim_fisheye_place(p, width, height, at, &code)) {
        return PH_ERR_RANGE;
    }
    const long double x = sim_fraction_real(s->camera.c[0]), y = sim_fraction_real(s->camera.c[1]),
                      z = sim_fraction_real(s->camera.c[2]), aside = hypotl(x, y), angle = atan2l(aside, -z);
    const struct sim_fraction scale =
        sim_fraction_times(sim_fraction_of(p->scale_y_q20, 20), sim_fraction_of(height, 1));
    const long double radius = angle * sim_fraction_real(scale), per_length = aside > 0 ? radius / aside : 0;
    const fx_t across = code.x - code.centre_x, down = code.y - code.centre_y, radius_code = fx_hypot_sat(across, down),
               radians = fx_div_sat(radius_code, code.scale);
    const bool upwards = writing.convention == PH_LMU;
    put_seen(file, s, writing);
    sim_decimal_print(file, "distance", hypotl(aside, z), fx_hypot_sat(fx_hypot_sat(at.x, at.y), at.z));
    sim_decimal_print(file, "angle.degrees", angle * 180 / acosl(-1), fx_mul_sat(radians, DEGREES_PER_RADIAN));
    sim_decimal_print(file, "angle.radians", angle, radians);
    sim_fraction_print(file, "angle.scale", scale, code.scale);
    sim_decimal_print(file, "radius", radius, radius_code);
    sim_decimal_print(file, "pixel.x", width / 2.0L + x * per_length, code.x);
    sim_decimal_print(file, "pixel.y", height / 2.0L + (upwards ? y : -y) * per_length,
                      upwards ? FX_INT(height) - code.y : code.y);
    return 0;
}

/* The stages behind the camera of a lens that is a matrix. */
static int print_matrix_lens(FILE *file, const struct seen *s, const struct ph_projection *projection, uint16_t width,
                             uint16_t height, struct sim_matrix_writing writing)
{
    const enum ph_convention convention = writing.convention;
    const struct sim_fraction half = sim_fraction_of(1, 1), one = sim_fraction_of(1, 0);
    struct ph_mat4 lens;
    const int status = ph_matrix_projection(&lens, projection, convention);
    if (status != 0) {
        return status;
    }
    const struct ph_mat4 viewport = ph_matrix_viewport(width, height, convention);
    const struct ph_vec4 clip = ph_mat4_apply(&lens, s->view_code);
    const struct place exact_clip = clipped(projection, convention, &s->camera);
    if (clip.w == 0 || sim_fraction_is_0(exact_clip.c[3])) {
        return PH_ERR_RANGE;
    }
    const struct ph_vec4 ndc = {fx_div_sat(clip.x, clip.w), fx_div_sat(clip.y, clip.w), fx_div_sat(clip.z, clip.w),
                                FX_ONE};
    const struct ph_vec4 pixel = ph_mat4_apply(&viewport, ndc);
    struct place exact_ndc = exact_clip, exact_pixel;
    for (int i = 0; i < 3; i++) {
        exact_ndc.c[i] = sim_fraction_divide(exact_clip.c[i], exact_clip.c[3]);
    }
    const struct sim_fraction up = convention == PH_LMU ? exact_ndc.c[1] : sim_fraction_minus(exact_ndc.c[1]);
    exact_pixel.c[0] =
        sim_fraction_times(sim_fraction_times(sim_fraction_add(exact_ndc.c[0], one), half), sim_fraction_of(width, 0));
    exact_pixel.c[1] =
        sim_fraction_times(sim_fraction_times(sim_fraction_add(up, one), half), sim_fraction_of(height, 0));
    put_seen(file, s, writing);
    put_stage(file, "clip", &exact_clip, &clip, 4);
    put_stage(file, "ndc", &exact_ndc, &ndc, 3);
    put_stage(file, "pixel", &exact_pixel, &pixel, 2);
    return 0;
}

int sim_point_print(FILE *file, struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                    const struct ph_projection *projection, uint16_t width, uint16_t height,
                    struct sim_matrix_writing writing)
{
    const struct seen s = seen_of(point, object, view, writing);
    if (projection->kind == PH_FISHEYE) {
        return print_fisheye(file, &s, projection, width, height, writing);
    }
    const int status = print_matrix_lens(file, &s, projection, width, height, writing);
    if (status == 0) {
        put_depths(file, projection, fx_neg_sat(ph_xform_point(view, ph_xform_point(object, point)).z));
    }
    return status;
}

struct sim_fraction sim_point_away(struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view)
{
    const struct seen s = seen_of(point, object, view, (struct sim_matrix_writing){PH_GL, false});
    return sim_fraction_minus(s.camera.c[2]);
}

void sim_point_flatten(FILE *file, struct fx_vec3 point, const struct ph_xform *object, const struct ph_xform *view,
                       const struct ph_mat4 *flat, struct sim_matrix_writing writing)
{
    const struct place exact = {{sim_fraction_of(point.x, 16), sim_fraction_of(point.y, 16),
                                 sim_fraction_of(point.z, 16), sim_fraction_of(1, 0)}};
    const struct place world = moved(object, &exact), camera = moved(view, &world);
    const struct place seen = written(camera, writing.convention == PH_D3D);
    const struct fx_vec3 at = ph_xform_point(view, ph_xform_point(object, point));
    const struct ph_vec4 in_view = {at.x, at.y, writing.convention == PH_D3D ? fx_neg_sat(at.z) : at.z, FX_ONE};
    const struct ph_vec4 code = ph_mat4_apply(flat, in_view);
    struct place out;
    for (int i = 0; i < 4; i++) {
        out.c[i] = sim_fraction_of(0, 0);
        for (int j = 0; j < 4; j++) {
            out.c[i] = sim_fraction_add(out.c[i], sim_fraction_times(sim_fraction_of(flat->m[i][j], 16), seen.c[j]));
        }
    }
    put_stage(file, "flatten", &out, &code, 4);
    if (sim_fraction_is_0(out.c[3]) || code.w == 0) { /* the point is projected to infinity */
        return;
    }
    const struct ph_vec4 divided = {fx_div_sat(code.x, code.w), fx_div_sat(code.y, code.w), fx_div_sat(code.z, code.w),
                                    FX_ONE};
    for (int i = 0; i < 3; i++) {
        out.c[i] = sim_fraction_divide(out.c[i], out.c[3]);
    }
    put_stage(file, "divided", &out, &divided, 3);
}
