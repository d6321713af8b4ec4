#include "depth_planes_count.h"

#include "depth_budget_terms.h"

#include <math.h>
#include <string.h>

#define PLACES   32     /* tried for each separation */
#define SIDE_PX  12.0   /* half the side of a small plane */
#define STEP     0.0625 /* log2 of a step of the sweep */
#define UP_MAX   128    /* steps above S_min that are tried before giving up */
#define DOWN_MAX 192    /* steps below it */

static uint32_t area_of(const struct planes_canvas *canvas)
{
    return (uint32_t)canvas->lab->width * canvas->lab->height;
}

struct planes_count planes_count(struct planes_canvas *canvas, const struct planes_pair *pair, uint8_t *verdicts)
{
    const uint32_t area = area_of(canvas);
    const bool nearer = planes_front_is_nearer(pair);
    struct planes_count count = {0, 0};
    planes_draw(canvas, &pair->behind, NULL);
    for (uint32_t i = 0; i < area; i++) {
        verdicts[i] = canvas->pixels[i] != PLANES_NONE;
    }
    planes_draw(canvas, NULL, &pair->front);
    for (uint32_t i = 0; i < area; i++) {
        verdicts[i] = verdicts[i] != 0 && canvas->pixels[i] != PLANES_NONE ? PLANES_RIGHT : PLANES_UNCOUNTED;
        count.samples += verdicts[i] == PLANES_RIGHT;
    }
    planes_draw(canvas, &pair->behind, &pair->front);
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

/* Place number i of the sweep; its upper edge, or its lower one where the planes lean towards us, is at at_m. */
static struct planes_place place_of(const struct planes_canvas *canvas, enum ph_depth_format format, double at_m,
                                    double tilt_deg, int i)
{
    const struct depth_lab *lab = canvas->lab;
    const double pixel = depth_pixel_slope(lab), step = fmin(depth_step_m(format, lab, at_m), at_m / 16);
    const bool small = i % 2 == 0;
    struct planes_place place = planes_whole(lab, at_m - 2 * step * spread(i, 0.6180339887), tilt_deg, 4 * step);
    const double low = small ? -SIDE_PX * pixel : place.slope_low, high = small ? SIDE_PX * pixel : place.slope_high;
    if (tilt_deg >= 0) {
        place.slope_low = fmax(low, place.slope_low) + pixel * spread(i, 0.7548776662);
        place.slope_high = tilt_deg > 0 ? 0 : high - pixel * spread(i, 0.5698402910);
    } else {
        place.slope_low = 0;
        place.slope_high = fmin(high, place.slope_high) - pixel * spread(i, 0.7548776662);
    }
    place.slope_side = (small ? SIDE_PX * pixel : place.slope_side) - pixel * spread(i, 0.8191725134);
    return place;
}

/* Whether any pixel of any place is wrong at this separation. */
static bool is_wrong_somewhere(struct planes_canvas *canvas, enum ph_depth_format format, double at_m, double tilt_deg,
                               double separation_m)
{
    const uint32_t area = area_of(canvas);
    for (int i = 0; i < PLACES; i++) {
        struct planes_pair pair;
        struct planes_place place = place_of(canvas, format, at_m, tilt_deg, i);
        place.separation_m = separation_m;
        if (!planes_make(canvas->lab, &place, &pair) || !planes_front_is_nearer(&pair)) {
            continue;
        }
        planes_draw(canvas, &pair.behind, &pair.front);
        bool any = false;
        for (uint32_t k = 0; k < area && !any; k++) {
            any = canvas->pixels[k] == PLANES_BEHIND;
        }
        if (!any) {
            continue;
        }
        uint8_t *const verdicts = canvas->verdicts;
        if (planes_count(canvas, &pair, verdicts).wrong > 0) {
            return true;
        }
    }
    return false;
}

/* The largest tangent of a ray to the axis that meets the planes of the sweep: at a corner of the picture. */
static double tan_phi_max(const struct depth_lab *lab)
{
    const double half = depth_pixel_slope(lab) / 2;
    return hypot(half * lab->width, half * lab->height);
}

double planes_predicted_m(const struct depth_lab *lab, enum ph_depth_format format, double z, double slope,
                          double tilt_deg)
{
    const double angle = depth_radians(tilt_deg);
    return depth_step_m(format, lab, z) * fabs(cos(angle) - slope * sin(angle)) +
           depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z) / sqrt(2) * fabs(sin(angle));
}

/* The most that any row of the sweep needs: the steps of a float get coarser at the near end of each octave. */
static void predict(const struct depth_lab *lab, enum ph_depth_format format, double at_m, double tilt_deg,
                    struct planes_sweep *sweep)
{
    const double lean = tan(depth_radians(fabs(tilt_deg))), tan_phi = tan_phi_max(lab);
    const struct planes_place whole = planes_whole(lab, at_m, fabs(tilt_deg), 0);
    const double pixel = depth_pixel_slope(lab);
    for (int row = 0; - row * pixel >= whole.slope_low; row++) {
        const double slope = -row * pixel;
        const double z = at_m / (1 - slope * lean), s_xy = depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z);
        sweep->s_min_m = fmax(sweep->s_min_m, depth_s_min_m(s_xy, depth_step_m(format, lab, z), tan_phi));
        sweep->at_tilt_m = fmax(sweep->at_tilt_m, planes_predicted_m(lab, format, z, slope, fabs(tilt_deg)));
    }
}

struct planes_sweep planes_sweep(struct planes_canvas *canvas, enum ph_depth_format format, double at_m,
                                 double tilt_deg)
{
    struct planes_sweep sweep = {0, 0, HUGE_VAL};
    predict(canvas->lab, format, at_m, tilt_deg, &sweep);
    int step = 16; /* twice S_min */
    while (is_wrong_somewhere(canvas, format, at_m, tilt_deg, sweep.s_min_m * exp2(step * STEP))) {
        step += 16;
        if (step > UP_MAX) {
            return sweep;
        }
    }
    while (step > -DOWN_MAX &&
           !is_wrong_somewhere(canvas, format, at_m, tilt_deg, sweep.s_min_m * exp2((step - 1) * STEP))) {
        step--;
    }
    sweep.measured_m = sweep.s_min_m * exp2(step * STEP);
    return sweep;
}
