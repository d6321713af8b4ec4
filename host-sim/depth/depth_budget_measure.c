/* See depth_budget_measure.h. One section measures one part of the pipeline; random inputs are the same on every
 * run. */
#include "depth_budget_measure.h"

#include "band.h"
#include "depth.h"
#include "exact.h"
#include "transform.h"
#include "setup.h"

#include <math.h>
#include <stdlib.h>

#define TRIES       2000
#define ROLLS       320 /* with 96 both ends of a rounding are met too seldom */
#define GRID_PX     4
#define ROLL_TURN32 0x14f1bbcdu /* 29.5 degrees: no multiple of anything on the screen */

/* The range of a set of values. */
struct spread {
    double least, most;
};

static void widen(struct spread *spread, double value)
{
    spread->least = fmin(spread->least, value);
    spread->most = fmax(spread->most, value);
}

static const struct spread nothing = {HUGE_VAL, -HUGE_VAL};

/* Gives the same numbers on every run and machine. */
static uint32_t next_random(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

/* A random number in -1 .. 1. */
static double next_signed(uint32_t *state)
{
    return (int32_t)next_random(state) / 2147483648.0;
}

static fx_t to_fx(double v)
{
    return (fx_t)floor(v * 65536 + 0.5);
}

static void begin(struct planes_canvas *canvas, const struct ph_xform *view)
{
    ph_frame_begin(&canvas->renderer, view, &canvas->projection, NULL, 0);
}

double depth_budget_input_m(struct planes_canvas *canvas, double z)
{
    begin(canvas, &ph_xform_identity);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&canvas->renderer.lens, &ph_xform_identity);
    const struct fx_vec3 here = {0, 0, -to_fx(z)}, nearer = {0, 0, here.z + 1};
    const struct ph_lens *lens = &canvas->renderer.lens;
    return depth_metres(ph_clip_place(lens, &matrix, &here).w - ph_clip_place(lens, &matrix, &nearer).w);
}

/* The third row of the rotation by b about x, then by a about y, exactly. */
static void third_row(uint32_t a, uint32_t b, double row[3])
{
    const double ya = a / 4294967296.0 * 2 * depth_radians(180), xb = b / 4294967296.0 * 2 * depth_radians(180);
    row[0] = -sin(ya);
    row[1] = cos(ya) * sin(xb);
    row[2] = cos(ya) * cos(xb);
}

double depth_budget_matrix_m(struct planes_canvas *canvas, double z)
{
    struct spread spread = nothing;
    uint32_t random = 1;
    begin(canvas, &ph_xform_identity);
    for (int i = 0; i < TRIES; i++) {
        const uint32_t a = next_random(&random), b = next_random(&random);
        const struct ph_xform ry = ph_xform_rotate_y(a), rx = ph_xform_rotate_x(b);
        struct ph_xform turned = ph_xform_mul(&ry, &rx);
        double row[3];
        third_row(a, b, row);
        const uint32_t corner = next_random(&random); /* of a cube, where the errors of the elements meet */
        const double half = z * (1 - fabs(next_signed(&random)) / 16) / 2;
        const struct fx_vec3 p = {to_fx(corner & 1 ? half : -half), to_fx(corner & 2 ? half : -half),
                                  to_fx(corner & 4 ? half : -half)};
        const double turned_z = row[0] * p.x + row[1] * p.y + row[2] * p.z;
        turned.t.z = to_fx(-z - turned_z / 65536);
        const struct ph_clip_matrix matrix = ph_clip_matrix(&canvas->renderer.lens, &turned);
        widen(&spread, ph_clip_place(&canvas->renderer.lens, &matrix, &p).w + (turned_z + turned.t.z));
    }
    return (spread.most - spread.least) / 65536;
}

double depth_budget_divide_m(struct planes_canvas *canvas, double z)
{
    struct spread spread = nothing;
    begin(canvas, &ph_xform_identity);
    const struct ph_lens *lens = &canvas->renderer.lens;
    for (int i = 0; i < TRIES; i++) {
        const fx_t w = to_fx(z) - 7 * i; /* towards the camera: z may be the far plane */
        if (w < lens->near_z) {
            break;
        }
        const struct ph_quotient quotient = ph_depth_quotient(lens, w);
        widen(&spread, ldexp((double)quotient.q * w, -30 - quotient.s) / lens->near_z);
    }
    return (spread.most - spread.least) * z;
}

double depth_budget_subpixel_m(struct planes_canvas *canvas, double z)
{
    const struct depth_lab *lab = canvas->lab;
    struct spread x = nothing, y = nothing;
    uint32_t random = 1;
    begin(canvas, &ph_xform_identity);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&canvas->renderer.lens, &ph_xform_identity);
    const double half = depth_pixel_slope(lab) / 2, reach = z * half * 0.9;
    for (int i = 0; i < TRIES; i++) {
        const struct fx_vec3 p = {to_fx(next_signed(&random) * reach * lab->width),
                                  to_fx(next_signed(&random) * reach * lab->height), -to_fx(z)};
        struct ph_vertex v;
        ph_transform(&canvas->renderer, &matrix, &p, &v);
        const double at_x = (double)p.x / -p.z * canvas->projection.scale_x_q20 / 1048576;
        const double at_y = (double)p.y / p.z * canvas->projection.scale_y_q20 / 1048576;
        widen(&x, v.x - 128.0 * lab->width * (1 + at_x));
        widen(&y, v.y - 128.0 * lab->height * (1 + at_y));
    }
    return hypot(x.most - x.least, y.most - y.least) / 256 * depth_pixel_slope(lab) * z;
}

/* ---- interpolation -------------------------------------------------------------------------------------- */

/* A corner as the rasterizer sees it, and 1 / w. */
struct corner {
    double x, y, inverse;
};

/* 1 / w of the plane through three corners at a point of the screen. */
static double plane_at(const struct corner *a, const struct corner *b, const struct corner *c, double x, double y)
{
    const double area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
    const double s = ((x - a->x) * (c->y - a->y) - (c->x - a->x) * (y - a->y)) / area;
    const double t = ((b->x - a->x) * (y - a->y) - (x - a->x) * (b->y - a->y)) / area;
    return a->inverse + s * (b->inverse - a->inverse) + t * (c->inverse - a->inverse);
}

static void snapped_corners(const struct planes_canvas *canvas, const struct planes_quad *quad,
                            struct corner corners[4])
{
    const struct ph_renderer *r = &canvas->renderer;
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &r->view);
    for (int i = 0; i < 4; i++) {
        const bool right = i == 1 || i == 2, top = i >= 2;
        const struct fx_vec3 p = {quad->a.x + (right ? quad->ux : 0), quad->a.y + (top ? quad->vy : 0),
                                  quad->a.z + (top ? quad->vz : 0)};
        struct ph_vertex v;
        ph_transform(r, &matrix, &p, &v);
        corners[i] = (struct corner){v.x, v.y, -65536.0 / p.z}; /* the camera rolls: w is exactly -z */
    }
}

/* The run of a row that a pixel lies in, of a triangle whose plane has 64 bits. */
static void find_run(const struct ph_triangle *triangle, const struct ph_depth_format *format, int32_t width, int32_t x,
                     int32_t y, struct ph_triangle *run)
{
    const struct ph_band row = {.y0 = y, .y1 = y + 1, .width = width};
    const int half = y >= triangle->as.large.y_mid;
    struct ph_half_rows in;
    int32_t from = x, to = x + 1; /* a pixel on the diagonal may be the other triangle's */
    if (ph_rows_of_half(triangle, &row, half, &in) && in.left.x >> 16 <= x && in.right.x >> 16 > x) {
        from = in.left.x < 0 ? 0 : in.left.x >> 16;
        to = in.right.x >> 16 < width ? in.right.x >> 16 : width;
    }
    *run = *triangle;
    while (from <= x) {
        from += ph_exact_run(triangle, format->ways->exact, from, to, y, run);
    }
}

/* The code that a triangle's plane has at a pixel, before it is cut off. */
static double code_of(const struct depth_lab *lab, const struct ph_triangle *triangle,
                      const struct ph_depth_format *format, uint32_t x, uint32_t y)
{
    struct ph_triangle run;
    const struct ph_triangle *const t = triangle->block == PH_BLOCK_EXACT ? &run : triangle;
    if (t == &run) {
        find_run(triangle, format, lab->width, (int32_t)x, (int32_t)y, &run);
    }
    const struct ph_small_triangle *const small = &t->as.small.rows;
    const struct ph_plane of_small = {small->d - (uint32_t)t->y_top * small->d_dy, small->gd, small->d_dy};
    const bool is_small = t->kind <= PH_KIND_SMALL_SPLIT;
    const uint32_t at = ph_plane_at(is_small ? &of_small : &t->as.large.depth.as.plane, x, y);
    const uint32_t value = t->kind == PH_KIND_SMALL_KNEE ? ph_knee_code(at, small->knee) : at;
    const double signed_value = value < UINT32_MAX - 65535 ? value : value - 4294967296.0; /* a little beyond far */
    if (t->block == PH_BLOCK_LINEAR) {
        return ph_depth_linear(&t->as.large.depth.over_w.linear, value) / 65536.0;
    }
    return t->block != PH_BLOCK_NONE
               ? depth_code_of_float(format, lab, ldexp(signed_value, -32 - ph_block_exponent(t->block)))
               : value / (ph_depth_bytes(format) == 4 ? 256.0 : 65536.0);
}

/* Whether the snapped corners leave the centre of a pixel inside, and not just on a side. */
static bool covers(const struct planes_canvas *canvas, const struct fx_vec3 p[3], int32_t x, int32_t y)
{
    const struct ph_renderer *r = &canvas->renderer;
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &r->view);
    struct ph_vertex v[3];
    int sides = 0;
    for (int i = 0; i < 3; i++) {
        ph_transform(r, &matrix, &p[i], &v[i]);
    }
    for (int i = 0; i < 3; i++) {
        const struct ph_vertex *const a = &v[i], *const b = &v[(i + 1) % 3];
        const int64_t dx = (int64_t)b->x - a->x, dy = (int64_t)b->y - a->y;
        const int64_t side = dx * (y * 256 + 128 - a->y) - dy * (x * 256 + 128 - a->x);
        const int64_t least = (llabs(dx) + llabs(dy)) / 64;
        sides += (side > least) - (side < -least);
    }
    return abs(sides) == 3;
}

double depth_budget_code(const struct planes_canvas *canvas, uint32_t number, const struct fx_vec3 p[3], int32_t x,
                         int32_t y)
{
    struct ph_triangle triangle;
    if (!covers(canvas, p, x, y)) {
        return NAN;
    }
    ph_setup_number(&canvas->renderer, number, &triangle);
    return code_of(canvas->lab, &triangle, canvas->renderer.config.depth_format, (uint32_t)x, (uint32_t)y);
}

/* Widens by the errors of the planes on a grid of pixels, in metres. Corners 0 and 2 are the diagonal. */
static void take_errors(const struct planes_canvas *canvas, const struct corner c[4], struct spread *error)
{
    const struct depth_lab *lab = canvas->lab;
    const struct ph_depth_format *const format = canvas->renderer.config.depth_format;
    struct ph_triangle triangles[2];
    ph_setup_number(&canvas->renderer, 0, &triangles[0]);
    ph_setup_number(&canvas->renderer, 1, &triangles[1]);
    for (uint32_t row = GRID_PX / 2; row < lab->height; row += GRID_PX) {
        for (uint32_t column = GRID_PX / 2; column < lab->width; column += GRID_PX) {
            if (canvas->pixels[row * lab->width + column] == PLANES_NONE) {
                continue;
            }
            const double x = column * 256.0 + 128, y = row * 256.0 + 128;
            const double side = (c[2].x - c[0].x) * (y - c[0].y) - (x - c[0].x) * (c[2].y - c[0].y);
            const double other = (c[2].x - c[0].x) * (c[1].y - c[0].y) - (c[1].x - c[0].x) * (c[2].y - c[0].y);
            const int second = side * other <= 0;
            const double distance = 1 / plane_at(&c[0], &c[2], &c[second ? 3 : 1], x, y);
            /* Outside the corners, by the rounding of an edge, codes end: at theirs or at the far plane's. */
            if (distance >= 1 / c[0].inverse && distance <= 1 / c[2].inverse) {
                widen(error,
                      (code_of(lab, &triangles[second], format, column, row) - depth_code_at(format, lab, distance)) *
                          depth_step_m(format, lab, distance));
            }
        }
    }
}

double depth_budget_interpolation_m(struct planes_canvas *canvas, double z)
{
    struct planes_place place =
        depth_planes_whole(canvas->lab, (struct planes_lean){z, DEPTH_BUDGET_TILT_DEG, 0}, 1.0 / 65536);
    struct planes_pair pair;
    struct spread error = nothing;
    place.slope_high = 0;
    if (!depth_planes_make(canvas->lab, &place, &pair)) {
        return NAN;
    }
    for (uint32_t i = 1; i <= ROLLS; i++) { /* the camera rolls: the same plane from other corners and gradients */
        struct corner corners[4];
        canvas->view = ph_xform_rotate_z(i * ROLL_TURN32);
        depth_planes_draw(canvas, &pair.behind, NULL);
        if (canvas->renderer.stats.triangles_drawn == 2 && canvas->renderer.stats.triangles_clipped == 0) {
            snapped_corners(canvas, &pair.behind, corners);
            take_errors(canvas, corners, &error);
        }
    }
    canvas->view = ph_xform_identity;
    return error.most >= error.least ? error.most - error.least : NAN;
}
