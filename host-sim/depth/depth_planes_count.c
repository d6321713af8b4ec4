/* See depth_planes_count.h. Two planes are drawn at many places; a pixel that shows the far one there is counted as
 * wrong. */
#include "depth_planes_count.h"

#include "depth_planes_climb.h"
#include "depth_separation.h"

#include <math.h>
#include <string.h>

#define PLACES    24     /* tried for each separation */
#define SIDE_PX   12.0   /* half the side of a small plane, */
#define TINY_PX   3.0    /* and of a tiny one */
#define MARGIN    1.25   /* room for a separation, and for moving in front */
#define STEP      0.0625 /* log2 of a step of the sweep */
#define SHIFT_MAX 3      /* parts of a plane by which the one in front is moved within itself */
#define UP_MAX    128    /* steps above S_min that are tried before giving up */
#define DOWN_MAX  192    /* steps below it */

static uint32_t area_of(const struct planes_canvas *canvas)
{
    return (uint32_t)canvas->lab->width * canvas->lab->height;
}

struct planes_count depth_planes_count(struct planes_canvas *canvas, const struct planes_pair *pair, uint8_t *verdicts)
{
    const uint32_t area = area_of(canvas);
    const bool nearer = depth_planes_front_is_nearer(pair);
    struct planes_count count = {0, 0};
    depth_planes_draw(canvas, &pair->behind, NULL);
    for (uint32_t i = 0; i < area; i++) {
        verdicts[i] = canvas->pixels[i] != PLANES_NONE;
    }
    depth_planes_draw(canvas, NULL, &pair->front);
    for (uint32_t i = 0; i < area; i++) {
        verdicts[i] = verdicts[i] != 0 && canvas->pixels[i] != PLANES_NONE ? PLANES_RIGHT : PLANES_UNCOUNTED;
        count.samples += verdicts[i] == PLANES_RIGHT;
    }
    depth_planes_draw(canvas, &pair->behind, &pair->front);
    for (uint32_t i = 0; i < area; i++) {
        if (verdicts[i] == PLANES_RIGHT && nearer != (canvas->pixels[i] == PLANES_FRONT)) {
            verdicts[i] = PLANES_WRONG;
            count.wrong++;
        }
    }
    return count;
}

/* Fractions spread evenly over 0 .. 1 by multiples of the golden ratio and its kin. */
static double spread(int i, double by)
{
    return i * by - floor(i * by);
}

/* The slope of rays at the edge of the picture at which planes that lean so are nearest to us, less a part. */
static double steepest_slope(const struct depth_lab *lab, struct planes_lean lean, double less)
{
    double along, across;
    depth_planes_extent(lab, lean.azimuth_deg, &along, &across);
    return (lean.tilt_deg > 0 ? -1 : 1) * fmax(along - less, 0);
}

/* Where the picture reaches farthest to the side at which the planes are nearest to us: beside the middle, with a
 * margin, so that a plane which is put there has pixels. */
static double across_at_edge(const struct depth_lab *lab, struct planes_lean lean)
{
    const double half_h = depth_pixel_slope(lab) * lab->height / 2, half_w = half_h * lab->width / lab->height;
    const double c = cos(depth_radians(lean.azimuth_deg)), s = sin(depth_radians(lean.azimuth_deg));
    const double of_width = s == 0 ? 0 : copysign(half_w, s), of_height = c == 0 ? 0 : copysign(half_h, c);
    return 0.9 * (lean.tilt_deg > 0 ? 1 : -1) * (of_height * s - of_width * c);
}

/* Place number i of the sweep. Its upper edge is at at_m, or its lower one where the planes lean towards us: at the
 * middle of the picture, or near the edge at which rays meet the planes most steeply. In three of four places the plane
 * in front is moved within itself, towards us. */
static struct planes_place place_of(const struct planes_canvas *canvas, const struct ph_depth_format *format,
                                    struct planes_lean lean, int i)
{
    const struct depth_lab *lab = canvas->lab;
    const double pixel = depth_pixel_slope(lab), step = fmin(depth_step_m(format, lab, lean.at_m), lean.at_m / 16);
    const double room = 4 * step + lean.at_m * SHIFT_MAX / PLANES_PARTS * MARGIN;
    const double most = (i % 8 == 6 ? TINY_PX : SIDE_PX) * pixel;
    lean.at_m -= 2 * step * spread(i, 0.6180339887);
    lean.azimuth_deg = isnan(lean.azimuth_deg) ? 360 * spread(i, 0.5698402909) : lean.azimuth_deg;
    const bool is_at_edge = i % 4 == 0 && lean.tilt_deg != 0;
    const double from = is_at_edge ? steepest_slope(lab, lean, most) : 0;
    lean.at_m *= 1 - from * tan(depth_radians(lean.tilt_deg));
    struct planes_place place = depth_planes_whole(lab, lean, room);
    const double side = i % 2 == 0 ? fmin(most, place.slope_side) : place.slope_side;
    const double down = (place.slope_low - from) / MARGIN, up = (place.slope_high - from) / MARGIN;
    const double low = from + (i % 2 == 0 ? fmax(-most, down) : down);
    const double high = from + (i % 2 == 0 ? fmin(most, up) : up);
    place.slope_low = lean.tilt_deg >= 0 ? low + pixel * spread(i, 0.7548776662) : from;
    place.slope_high = lean.tilt_deg > 0 ? from : high - pixel * spread(i, 0.7548776662);
    place.slope_middle = is_at_edge ? across_at_edge(lab, lean) : 0;
    place.slope_side = side - pixel * spread(i, 0.8191725134);
    place.shift = (lean.tilt_deg >= 0 ? -1 : 1) * (i / 2 % (SHIFT_MAX + 1));
    return place;
}

enum verdict { ALL_RIGHT, SOME_WRONG, IMPOSSIBLE };

/* Draws both planes; only where the one behind shows somewhere is there something to count. */
static bool is_wrong(struct planes_canvas *canvas, const struct planes_pair *pair)
{
    const uint32_t area = area_of(canvas);
    depth_planes_draw(canvas, &pair->behind, &pair->front);
    for (uint32_t i = 0; i < area; i++) {
        if (canvas->pixels[i] == PLANES_BEHIND) {
            return depth_planes_count(canvas, pair, canvas->verdicts).wrong > 0;
        }
    }
    return false;
}

/* Is any pixel of any place wrong at this separation? IMPOSSIBLE: the separation rounds to 0, or has no room. *real_m:
 * the largest separation of a place after rounding. */
static enum verdict try_places(struct planes_canvas *canvas, const struct ph_depth_format *format,
                               struct planes_lean lean, double separation_m, double *real_m)
{
    *real_m = 0;
    for (int i = 0; i < PLACES; i++) {
        struct planes_pair pair;
        struct planes_place place = place_of(canvas, format, lean, i);
        place.separation_m = separation_m;
        depth_planes_turn(canvas, place.lean.azimuth_deg);
        if (!depth_planes_make(canvas->lab, &place, &pair) || !depth_planes_front_is_nearer(&pair)) {
            return IMPOSSIBLE;
        }
        *real_m = fmax(*real_m, depth_planes_separation_m(&pair));
        if (is_wrong(canvas, &pair)) {
            return SOME_WRONG;
        }
    }
    return ALL_RIGHT;
}

/* Returns the largest tangent between the axis and a ray that meets the planes of the sweep, at a corner of the
 * picture. */
static double tan_phi_max(const struct depth_lab *lab)
{
    const double half = depth_pixel_slope(lab) / 2;
    return hypot(half * lab->width, half * lab->height);
}

double depth_planes_predicted_m(const struct depth_lab *lab, const struct ph_depth_format *format, double z,
                                double slope, double tilt_deg)
{
    const double angle = depth_radians(tilt_deg);
    return depth_step_m(format, lab, z) * fabs(cos(angle) - slope * sin(angle)) +
           depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z) / sqrt(2) * fabs(sin(angle));
}

/* Predicts for the row that needs most: the steps of a float get coarser at the near end of each octave. */
static void predict(const struct depth_lab *lab, const struct ph_depth_format *format, struct planes_lean lean,
                    struct planes_sweep *sweep)
{
    lean.tilt_deg = fabs(lean.tilt_deg);
    const double rise = tan(depth_radians(lean.tilt_deg)), tan_phi = tan_phi_max(lab);
    const struct planes_place whole = depth_planes_whole(lab, lean, 0);
    const double pixel = depth_pixel_slope(lab);
    sweep->bound_m = depth_separation_m(format, lab, lean.at_m, lean.tilt_deg, depth_way_px(lab));
    for (int row = 0; row * pixel <= -whole.slope_low / MARGIN; row++) {
        const double slope = -row * pixel;
        const double z = lean.at_m / (1 - slope * rise), s_xy = depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z);
        sweep->s_min_m = fmax(sweep->s_min_m, depth_s_min_m(s_xy, depth_step_m(format, lab, z), tan_phi));
        sweep->at_tilt_m = fmax(sweep->at_tilt_m, depth_planes_predicted_m(lab, format, z, slope, lean.tilt_deg));
    }
    const double at_edge =
        depth_planes_predicted_m(lab, format, lean.at_m, steepest_slope(lab, lean, 0), lean.tilt_deg);
    sweep->at_tilt_m = fmax(sweep->at_tilt_m, at_edge);
}

struct planes_sweep depth_planes_sweep(struct planes_canvas *canvas, const struct ph_depth_format *format,
                                       struct planes_lean lean)
{
    struct planes_sweep sweep = {0, 0, 0, HUGE_VAL, HUGE_VAL};
    predict(canvas->lab, format, lean, &sweep);
    double real_m;
    int step = 16, by = 4; /* from twice S_min, in large steps first */
    enum verdict verdict = try_places(canvas, format, lean, sweep.s_min_m * exp2(step * STEP), &real_m);
    while (verdict == IMPOSSIBLE && step > -DOWN_MAX) { /* steep planes so far apart do not fit before the eye */
        step -= 16;
        verdict = try_places(canvas, format, lean, sweep.s_min_m * exp2(step * STEP), &real_m);
    }
    while (verdict == SOME_WRONG && step <= UP_MAX) {
        step += 16;
        verdict = try_places(canvas, format, lean, sweep.s_min_m * exp2(step * STEP), &real_m);
    }
    while (verdict == ALL_RIGHT) {
        sweep.measured_m = real_m;
        step -= by;
        verdict = step > -DOWN_MAX ? try_places(canvas, format, lean, sweep.s_min_m * exp2(step * STEP), &real_m)
                                   : IMPOSSIBLE;
        if (verdict != ALL_RIGHT && by > 1) { /* back to the last that was right, and on in small ones */
            step += by;
            by = 1;
            verdict = ALL_RIGHT;
            real_m = sweep.measured_m;
        }
    }
    sweep.found_m = sweep.measured_m;
    if (isfinite(sweep.measured_m) && lean.tilt_deg != 0 && canvas->draw == NULL) {
        sweep.found_m = fmax(sweep.measured_m, depth_planes_climb_m(canvas, lean, sweep.bound_m));
    }
    return sweep;
}
