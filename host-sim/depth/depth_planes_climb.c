/* See depth_planes_climb.h. */
#include "depth_planes_climb.h"

#include "depth_budget_measure.h"
#include "depth_separation.h"

#include <math.h>

#define WORK      1600 /* triangles that are tried at first, for each of the two, and then while one climbs */
#define PLACES    3
#define TRIES     50   /* for a triangle that has room */
#define BEYOND_PX 1.5  /* how far a corner may lie behind the pixel */
#define SMALL_PX  32.0 /* a small triangle (render.h) */
#define INSIDE_PX 34   /* from the border of the picture such triangles have room on all sides */
#define EDGE_PX   3
#define LISTED    100  /* triangles of a frame */
#define PHASE     0.04 /* of 1/256 px: so far from where snapping turns over */

/* A triangle on the screen: its corners, in pixels from the one that is looked at, and how far its plane lies before
 * the farthest one, in LSBs along the view. */
struct shape {
    double x[3], y[3], before;
};

struct sample {
    struct shape shape;
    int64_t offset; /* of its plane: vz y - vy z for the points of it. It grows with the distance */
    double code;    /* at the pixel, before it is cut off; NAN: the triangle has no room or does not cover the pixel */
    double off;     /* by how much its offset is larger than that which the code stands for */
};

struct climb {
    struct planes_canvas *canvas;
    uint32_t random;
    double farthest;      /* LSBs: the distance of the farthest corner */
    int32_t x, y;         /* the pixel, */
    double across, along; /* the slopes of its ray in the planes' frame, */
    double at;            /* and where the farthest plane meets it: LSBs along the view */
    int32_t vy, vz;       /* the lattice, */
    double per_z;         /* and by how much the offset grows with a step along the view */
    double far_x, far_y;  /* the direction on the screen in which the planes lean away */
    double room;          /* LSBs along the view for the separation that is enough */
    bool small;
    int work;
};

static double uniform(struct climb *s, double from, double to)
{
    s->random = s->random * 1664525u + 1013904223u;
    return from + (to - from) * (s->random >> 8) / 16777216.0;
}

static bool chance(struct climb *s, double share)
{
    return uniform(s, 0, 1) < share;
}

/* ---- a triangle in its plane -------------------------------------------------------------------------------- */

/* The slopes of the ray through a point of the picture, turned back to the planes' frame. */
static void ray_of(const struct climb *s, double x, double y, double *across, double *along)
{
    const struct planes_canvas *const canvas = s->canvas;
    const struct planes_ray ray = depth_planes_ray(canvas, x, y);
    *across = (ray.right * canvas->view.r[0][0] + ray.up * canvas->view.r[1][0]) / FX_Q30_ONE;
    *along = (ray.right * canvas->view.r[0][1] + ray.up * canvas->view.r[1][1]) / FX_Q30_ONE;
}

static fx_t nearest_fx(double v)
{
    return (fx_t)floor(v + 0.5);
}

/* Finds the corners of a shape on the lattice, and the offset of its plane. False: they have no room. */
static bool corners_of(const struct climb *s, const struct shape *shape, struct fx_vec3 p[3], int64_t *offset)
{
    const double rise = (double)s->vz / s->vy, near_lsb = s->canvas->lab->near_z;
    const fx_t ay = nearest_fx(s->along * s->at), az = nearest_fx(shape->before - s->at);
    *offset = (int64_t)s->vz * ay - (int64_t)s->vy * az;
    for (int i = 0; i < 3; i++) {
        double across, along;
        ray_of(s, s->x + shape->x[i], s->y + shape->y[i], &across, &along);
        const double z = (double)*offset / s->vy / (1 + along * rise);
        if (!(z > near_lsb + 2 && z <= s->farthest && fabs(z * across) < 1e9 && fabs(z * along) < 1e9)) {
            return false;
        }
        const fx_t j = nearest_fx((along * z - ay) / s->vy);
        p[i] = (struct fx_vec3){nearest_fx(across * z), ay + j * s->vy, az + j * s->vz};
        if (-p[i].z > s->farthest || -p[i].z < near_lsb) {
            return false;
        }
    }
    return true;
}

static void begin(struct planes_canvas *canvas)
{
    ph_frame_begin(&canvas->renderer, &canvas->view, &canvas->projection, NULL, PLANES_NONE);
}

static void list_triangle(struct planes_canvas *canvas, const struct fx_vec3 p[3], uint16_t colour)
{
    static const uint16_t face[1][3] = {{0, 1, 2}};
    static const int16_t normals[3][3] = {{0, 0, 16384}, {11585, 0, 11585}, {0, 11585, 11585}};
    static const fx_t uvs[3][2] = {{0, 0}, {FX_ONE, 0}, {FX_ONE, FX_ONE}};
    const struct ph_part part = {.count = 1};
    const struct ph_mesh mesh = {.positions = p,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .vertex_count = 3,
                                 .triangles = face,
                                 .triangle_count = 1,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = depth_planes_paint(canvas, colour)};
    ph_draw_mesh(&canvas->renderer, &mesh, &ph_xform_identity);
}

/* Finds a shape's offset and code. */
static void measure(struct climb *s, struct sample *sample)
{
    struct planes_canvas *const canvas = s->canvas;
    const struct ph_stats *const stats = &canvas->renderer.stats;
    struct fx_vec3 p[3];
    sample->code = NAN;
    if (!corners_of(s, &sample->shape, p, &sample->offset)) {
        return;
    }
    if (stats->triangles_in == LISTED || stats->triangles_clipped > 0) {
        begin(canvas);
    }
    const uint32_t number = stats->triangles_drawn;
    list_triangle(canvas, p, PLANES_FRONT);
    if (stats->triangles_drawn == number + 1 && stats->triangles_clipped == 0) {
        const double code = depth_budget_code(canvas, number, p, s->x, s->y); /* NAN: the pixel is not covered */
        const double z =
            isfinite(code) ? depth_distance_of(canvas->renderer.config.depth_format, canvas->lab, code) : NAN;
        sample->off = (double)sample->offset - z * 65536 * s->per_z;
        sample->code = z > 0 && isfinite(z) ? code : NAN;
    }
}

/* Draws both: whether they cover the pixel and it shows the one behind. */
static bool is_wrong(const struct climb *s, const struct sample *behind, const struct sample *front)
{
    struct planes_canvas *const canvas = s->canvas;
    const uint32_t pixel = (uint32_t)(s->y * canvas->lab->width + s->x);
    const uint16_t colours[] = {PLANES_FRONT, PLANES_BEHIND};
    const struct sample *const samples[] = {front, behind};
    struct fx_vec3 p[2][3];
    int64_t offset;
    for (int i = 0; i < 2; i++) {
        corners_of(s, &samples[i]->shape, p[i], &offset);
    }
    for (int both = 0; both < 2; both++) { /* the one in front alone, then the one behind before it */
        begin(canvas);
        for (int i = both; i >= 0; i--) {
            list_triangle(canvas, p[i], colours[i]);
        }
        ph_frame_bands(&canvas->renderer);
        ph_draw_band(&canvas->renderer, 0, canvas->pixels);
        if (canvas->pixels[pixel] != colours[both]) {
            return false;
        }
    }
    return true;
}

/* ---- shapes ------------------------------------------------------------------------------------------------- */

/* Puts each corner where snapping moves it by almost 1/512 px, to where the planes lean (way 1) or to the other side:
 * the whole plane then seems nearer, or farther. */
static void set_phase(const struct climb *s, struct shape *t, int way)
{
    for (int i = 0; i < 3; i++) {
        t->x[i] = (floor(t->x[i] * 256) + 0.5 + copysign(PHASE, s->far_x * way)) / 256;
        t->y[i] = (floor(t->y[i] * 256) + 0.5 + copysign(PHASE, s->far_y * way)) / 256;
    }
}

/* Whether the corners lie no farther outside of the picture than this is wide and high, none of them much behind the
 * pixel. */
static bool has_room(const struct climb *s, const double x[3], const double y[3])
{
    const struct depth_lab *const lab = s->canvas->lab;
    for (int i = 0; i < 3; i++) {
        const double column = s->x + x[i], row = s->y + y[i];
        if (x[i] * s->far_x + y[i] * s->far_y > BEYOND_PX || (s->small && hypot(x[i], y[i]) >= SMALL_PX) ||
            column < -lab->width || column > 2 * lab->width || row < -lab->height || row > 2 * lab->height) {
            return false;
        }
    }
    return true;
}

/* The farthest place that a corner of a large triangle may have: gradients are stepped the longest way from there. */
static void farthest_corner(struct climb *s, double *x, double *y)
{
    const double width = s->canvas->lab->width, height = s->canvas->lab->height;
    double most = 0;
    for (int i = 0; i < 4; i++) {
        const double to_x = (i % 2 == 0 ? 1 - width : 2 * width - 1) - s->x,
                     to_y = (i < 2 ? 1 - height : 2 * height - 1) - s->y;
        if (to_x * s->far_x + to_y * s->far_y <= 0 && fabs(to_x) + fabs(to_y) > most) {
            most = fabs(to_x) + fabs(to_y);
            *x = to_x + uniform(s, -1, 1);
            *y = to_y + uniform(s, -1, 1);
        }
    }
}

/* A corner on our side of the pixel, at any distance. */
static void random_corner(struct climb *s, double *x, double *y)
{
    const double most = s->small ? SMALL_PX : 3.0 * s->canvas->lab->height;
    const double size = exp2(uniform(s, -1, log2(most))), turn = uniform(s, -1.6, 1.6);
    *x = size * (-cos(turn) * s->far_x - sin(turn) * s->far_y);
    *y = size * (-cos(turn) * s->far_y + sin(turn) * s->far_x);
    if (!s->small && chance(s, 0.4)) {
        farthest_corner(s, x, y);
    }
}

/* The corner from which gradients are stepped the longest way to the pixel, or in one of five triangles any. */
static int first_corner(struct climb *s, const double x[3], const double y[3])
{
    int first = (int)uniform(s, 0, 3);
    for (int i = 0; i < 3 && !chance(s, 0.2); i++) {
        first = fabs(x[i]) + fabs(y[i]) > fabs(x[first]) + fabs(y[first]) ? i : first;
    }
    return first;
}

/* Two corners, and the third one so that the pixel lies inside: anywhere, and often beside a corner. */
static struct shape random_shape(struct climb *s, int way)
{
    const double least = s->small ? -6 : -12;
    double x[3] = {0, 0, 0}, y[3] = {0, 0, 0};
    for (int tries = 0; tries == 0 || (tries < TRIES && !has_room(s, x, y)); tries++) {
        const double a = exp2(uniform(s, least, -least)), b = exp2(uniform(s, least, -least));
        random_corner(s, &x[0], &y[0]);
        random_corner(s, &x[1], &y[1]);
        if (s->small && chance(s, 0.7)) { /* a sliver */
            const double along = uniform(s, -0.3, 1), beside = exp2(uniform(s, -7, 0));
            x[1] = x[0] * along + uniform(s, -1, 1) * beside;
            y[1] = y[0] * along + uniform(s, -1, 1) * beside;
        }
        x[2] = -(a * x[0] + b * x[1]);
        y[2] = -(a * y[0] + b * y[1]);
    }
    const int first = s->small ? (int)uniform(s, 0, 3) : first_corner(s, x, y);
    struct shape t = {.before = uniform(s, 0, s->room / 4)};
    for (int i = 0; i < 3; i++) {
        t.x[i] = x[(i + first) % 3];
        t.y[i] = y[(i + first) % 3];
    }
    if (chance(s, 0.7)) {
        set_phase(s, &t, way);
    }
    return t;
}

/* Moves each corner a little, mostly by whole steps of the sub-pixel grid: that keeps its phase. */
static struct shape shape_near(struct climb *s, const struct shape *from)
{
    const double most = uniform(s, -8, 2);
    const bool whole = chance(s, 0.7);
    struct shape t = *from;
    for (int i = 0; i < 3; i++) {
        const double by = exp2(uniform(s, -9, most)), x = uniform(s, -by, by), y = uniform(s, -by, by);
        t.x[i] += whole ? floor(x * 256 + 0.5) / 256 : x;
        t.y[i] += whole ? floor(y * 256 + 0.5) / 256 : y;
    }
    return t;
}

/* ---- the search --------------------------------------------------------------------------------------------- */

/* Finds the triangle that seems nearest (way 1) or farthest (-1) for where it is. */
static struct sample find_shape(struct climb *s, int way)
{
    struct sample best = {.code = NAN};
    for (int i = 0; i < s->work; i++) {
        struct sample next;
        next.shape = i % 2 == 0 || isnan(best.code) ? random_shape(s, way) : shape_near(s, &best.shape);
        measure(s, &next);
        if (!isnan(next.code) && (isnan(best.code) || way * next.off > way * best.off)) {
            best = next;
        }
    }
    return best;
}

/* Moves a triangle away (way 1) while its code stays at `code` or above, or towards us (-1) at `code` or below. Either
 * a little on from the best so far, or at once to where the first one would be as far off from the border of the code.
 */
static void climb(struct climb *s, struct sample *best, int64_t start, double code, int way)
{
    const struct sample first = *best;
    const double border = code + (way < 0);
    const double border_m = depth_distance_of(s->canvas->renderer.config.depth_format, s->canvas->lab, border);
    best->offset = start;
    for (int i = 0; i < s->work; i++) {
        struct sample next = {.shape = i % 3 == 0 ? first.shape : best->shape};
        const double before = next.shape.before;
        next.shape = chance(s, 0.2) ? next.shape : shape_near(s, &next.shape);
        next.shape.before = i % 3 == 2 ? before - way * s->room * exp2(uniform(s, -12, -1))
                                       : s->at - border_m * 65536 - first.off / s->per_z * uniform(s, 0.5, 1.2);
        measure(s, &next);
        if (way * floor(next.code) >= way * code && way * (next.offset - best->offset) > 0) { /* not if it is NAN */
            *best = next;
        }
    }
}

/* The lattice of planes that tilt by that or a little less. */
static void set_lattice(struct climb *s, double tilt_deg)
{
    const double pixel = depth_pixel_slope(s->canvas->lab) * s->farthest, rise = -tan(depth_radians(tilt_deg));
    const double most = fmin(fmax(pixel / 4096, 8), 64); /* fine against 1/256 px, where steps of Q16.16 are */
    double least_off = HUGE_VAL;
    for (int vy = 1; vy <= most; vy++) {
        const double vz = trunc(rise * vy), off = fabs(atan(rise) - atan(vz / vy));
        if (off < least_off - 1e-4) {
            least_off = off;
            s->vy = vy;
            s->vz = (int32_t)vz;
        }
    }
}

/* The pixel: near a corner of the picture, where the planes are nearest (where 1) or farthest (-1), or in the middle.
 */
static void set_pixel(struct climb *s, double tilt_deg, int where, int border_px)
{
    const struct planes_canvas *const canvas = s->canvas;
    const int32_t width = canvas->lab->width, height = canvas->lab->height;
    const int32_t from_x = where == 0 || border_px > width / 2 ? width / 2 : border_px;
    const int32_t from_y = where == 0 || border_px > height / 2 ? height / 2 : border_px;
    const double sign = copysign(1, tilt_deg), one = FX_Q30_ONE;
    s->far_x = sign * canvas->view.r[0][1] / one;
    s->far_y = -sign * canvas->view.r[1][1] / one; /* rows go down */
    s->x = s->far_x * where < 0 ? width - 1 - from_x : from_x;
    s->y = s->far_y * where < 0 ? height - 1 - from_y : from_y;
    ray_of(s, s->x, s->y, &s->across, &s->along);
    const double rise = (double)s->vz / s->vy, beyond = sign * BEYOND_PX * depth_pixel_slope(canvas->lab);
    s->at = s->farthest * (1 + (s->along + beyond) * rise) / (1 + s->along * rise);
}

static double search_m(struct climb *s, double bound_m)
{
    const double unit = hypot(s->vy, s->vz) * 65536;
    s->per_z = s->vy + s->along * s->vz;
    s->room = bound_m * unit / s->per_z;
    s->random = 1;
    begin(s->canvas);
    struct sample behind = find_shape(s, 1), front = find_shape(s, -1);
    if (isnan(behind.code) || isnan(front.code) || !(s->per_z > 0)) {
        return 0;
    }
    const double code = floor(behind.code);
    climb(s, &behind, behind.offset, code, 1);
    climb(s, &front, behind.offset, code, -1);
    return front.offset < behind.offset && is_wrong(s, &behind, &front) ? (double)(behind.offset - front.offset) / unit
                                                                        : 0;
}

/*
 * Searches with the farthest corner so far away. Small triangles, in the formats that have them, are off most where
 * rays meet the planes most steeply. Of large ones the first corner can lie farther off a pixel in the middle of the
 * picture or at its far side, where planes that lean little have room.
 */
static double search_places_m(struct climb *s, double at_m, double tilt_deg, double bound_m)
{
    static const struct place {
        bool small;
        int where, border_px;
        double tilt_deg;
    } places[2][PLACES] = {{{false, 1, EDGE_PX, 90}, {false, 1, EDGE_PX, 40}, {false, 0, EDGE_PX, 22}},
                           {{true, 1, INSIDE_PX, 90}, {true, 1, INSIDE_PX, 45}, {false, 1, EDGE_PX, 90}}};
    double most_m = 0;
    s->farthest = floor(at_m * 65536);
    for (int i = 0; i < PLACES; i++) {
        const struct place *const place = &places[s->canvas->renderer.config.depth_format->is_small][i];
        const double tilt = copysign(fmin(fabs(tilt_deg), place->tilt_deg), tilt_deg);
        s->small = place->small;
        set_lattice(s, tilt);
        set_pixel(s, tilt, place->where, place->border_px);
        most_m = fmax(most_m, search_m(s, bound_m));
    }
    return most_m;
}

double depth_planes_climb_m(struct planes_canvas *canvas, struct planes_lean lean, double bound_m)
{
    const struct depth_lab *const lab = canvas->lab;
    const double widest_deg = atan2(lab->width, lab->height) / depth_radians(1);
    const double coarsest_m = depth_coarsest_m(canvas->renderer.config.depth_format, lab, lean.at_m, depth_way_px(lab));
    const bool is_twice = coarsest_m < lean.at_m;
    struct climb s = {.canvas = canvas, .work = is_twice ? WORK / 2 : WORK};
    depth_planes_turn(canvas, isnan(lean.azimuth_deg) ? widest_deg : lean.azimuth_deg);
    double most_m = search_places_m(&s, lean.at_m, lean.tilt_deg, bound_m);
    if (is_twice) {
        most_m = fmax(most_m, search_places_m(&s, coarsest_m, lean.tilt_deg, bound_m));
    }
    return most_m;
}
