/* See depth_budget_terms.h. The depth formats in double precision, and the bounds that follow from their formulas. */
#include "depth_budget_terms.h"

#include <math.h>

#define GRID_M (1.0 / 65536) /* of positions and of w */

const char *const depth_share_names[DEPTH_SHARES] = {"input", "matrix",        "divide",
                                                     "store", "interpolation", "sub-pixel"};

uint32_t depth_drawn_formats(const struct depth_lab *lab)
{
    uint32_t rows = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        rows |= lab_formats[i].kind == LAB_DRAWN ? (uint32_t)1 << i : 0;
    }
    return rows & lab->formats;
}

double depth_pixel_slope(const struct depth_lab *lab)
{
    return 2 * tan(depth_radians(depth_metres(lab->fov_deg) / 2)) / lab->height;
}

void depth_planes_extent(const struct depth_lab *lab, double azimuth_deg, double *along, double *across)
{
    const double half_h = depth_pixel_slope(lab) * lab->height / 2, half_w = half_h * lab->width / lab->height;
    const double c = fabs(cos(depth_radians(azimuth_deg))), s = fabs(sin(depth_radians(azimuth_deg)));
    *along = isnan(azimuth_deg) ? hypot(half_h, half_w) : half_h * c + half_w * s;
    *across = isnan(azimuth_deg) ? hypot(half_h, half_w) : half_w * c + half_h * s;
}

static bool is_float(const struct ph_depth_format *format)
{
    return format->coding == PH_DEPTH_IS_FLOAT;
}

static bool is_linear(const struct ph_depth_format *format)
{
    return format->coding == PH_DEPTH_IS_LINEAR;
}

int depth_exponent_bits(const struct depth_lab *lab)
{
    const struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = lab->near_z, .far_z = lab->far_z};
    return lab->exponent != 0 ? lab->exponent : (int)ph_depth_choose_exponent(&p);
}

/* N of depth.h, in metres. */
static double head_m(const struct ph_depth_format *format, const struct depth_lab *lab)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z);
    const int bits = is_float(format) ? depth_exponent_bits(lab) : 0;
    const bool is_fixed = !is_float(format) && !is_linear(format);
    return n * (is_fixed ? fmin(f / (f - n), 8) : 1) * (1 - ldexp(1, bits > 4 ? bits - 13 : -9));
}

static bool has_24_bits(const struct ph_depth_format *format)
{
    return format->bits == 24;
}

/* A step of 2^-16 of the range in codes. */
static double unit_of(const struct ph_depth_format *format)
{
    return has_24_bits(format) ? 256 : 1;
}

/* d = N/w - N/f at distance z. */
static double depth_at(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double f = depth_metres(lab->far_z);
    return head_m(format, lab) * (f - z) / (z * f);
}

/* F of depth.h: an unsigned float; and its inverse. */
static double float_of(const struct depth_lab *lab, double d)
{
    const int bits = depth_exponent_bits(lab), top = (1 << bits) - 1;
    int exponent;
    const double fraction = frexp(d, &exponent); /* d = fraction 2^exponent, fraction in 1/2 .. 1 */
    return ldexp(d <= 0 || exponent <= -top ? ldexp(d, top) : 2 * fraction - 1 + exponent + top, 16 - bits);
}

static double of_float(const struct depth_lab *lab, double code)
{
    const int bits = depth_exponent_bits(lab), top = (1 << bits) - 1;
    const double octaves = ldexp(code, bits - 16), octave = floor(octaves);
    return octave < 1 ? ldexp(octaves, -top) : ldexp(1 + octaves - octave, (int)octave - top - 1);
}

double depth_code_of_float(const struct ph_depth_format *format, const struct depth_lab *lab, double d)
{
    return (float_of(lab, d) + 8) * unit_of(format);
}

double depth_code_at(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z), d = depth_at(format, lab, z);
    switch (format->coding) {
    case PH_DEPTH_IS_FLOAT:
        return depth_code_of_float(format, lab, d);
    case PH_DEPTH_IS_LINEAR:
        return 65408 * (f - z) / (f - n) + 16;
    default:
        return unit_of(format) * (ldexp(d, 16) + 16.25);
    }
}

double depth_distance_of(const struct ph_depth_format *format, const struct depth_lab *lab, double code)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z), over_far = head_m(format, lab) / f;
    const double short_code = code / unit_of(format);
    switch (format->coding) {
    case PH_DEPTH_IS_FLOAT:
        return head_m(format, lab) / (of_float(lab, short_code - 8) + over_far);
    case PH_DEPTH_IS_LINEAR:
        return f - (code - 16) * (f - n) / 65408;
    default:
        return head_m(format, lab) / (ldexp(short_code - 16.25, -16) + over_far);
    }
}

double depth_octave_end_m(const struct ph_depth_format *format, const struct depth_lab *lab, int octave)
{
    return head_m(format, lab) / (ldexp(1, -octave) + head_m(format, lab) / depth_metres(lab->far_z));
}

/* d of the last bit of the code at d. For a float this is that of the octave of d. */
static double bit_of(const struct ph_depth_format *format, const struct depth_lab *lab, double d)
{
    int exponent;
    if (!is_float(format)) {
        return ldexp(1, has_24_bits(format) ? -24 : -16);
    }
    frexp(d, &exponent);
    const int bits = depth_exponent_bits(lab), lowest = 2 - (1 << bits);
    return ldexp(1, (d <= 0 || exponent < lowest ? lowest : exponent) - (has_24_bits(format) ? 25 : 17) + bits);
}

double depth_step_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    if (is_linear(format)) {
        return (depth_metres(lab->far_z) - depth_metres(lab->near_z)) / 65408;
    }
    return z * z / head_m(format, lab) * bit_of(format, lab, depth_at(format, lab, z));
}

double depth_step_parallel_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double range = depth_metres(lab->far_z) - depth_metres(lab->near_z);
    const int bits = is_float(format) ? depth_exponent_bits(lab) : 0;
    const double whole = 1 - ldexp(1, bits > 4 ? bits - 13 : -9), d = whole * (depth_metres(lab->far_z) - z) / range;
    return bit_of(format, lab, d) * range / whole;
}

double depth_subpixel_m(const struct depth_lab *lab, int bits, double z)
{
    return sqrt(2) * ldexp(depth_pixel_slope(lab), -bits) * z;
}

/* ---- bounds ----------------------------------------------------------------------------------------------- */

/* The share of the divide: N, 1/w and their product are cut to 30 bits or more. */
static double divide_m(double z)
{
    return 3 * ldexp(z, -30);
}

/* How far the border of two codes may lie from where the formula has it. linear-w takes a second reciprocal. */
static double border_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double unit = is_linear(format)  ? ldexp(z, -26) + ldexp(depth_metres(lab->far_z), -29)
                        : is_float(format) ? ldexp(z, -29)
                                           : ldexp(z * z / head_m(format, lab), -31);
    return divide_m(z) + unit;
}

/* What the quotient of N/w does to a plateau that ends at distance z. Before its last bit is set right the quotient is
 * floor(share floor(R)), R = 2^62 / (w 2^shift). */
struct quotient_grain {
    double share; /* 1/2 .. 1: N, normalised */
    double step;  /* by which R changes from one w to the next */
    double unit;  /* of the quotient, in d */
};

static struct quotient_grain grain_at(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    int near_log2, log2;
    struct quotient_grain grain;
    grain.share = frexp(head_m(format, lab), &near_log2);
    const double w = z / GRID_M, part = frexp(w, &log2);
    grain.step = ldexp(1, 30) / part / (w + 1);
    grain.unit = ldexp(1, near_log2 - log2 - 14);
    return grain;
}

/* How many w have one code whose d is `size` wide: those of so many quotients, of the R of these. */
static double distances_of(struct quotient_grain grain, double size)
{
    const double quotients = ceil(size / grain.unit * (1 - 1e-9)), reciprocals = ceil(quotients / grain.share);
    return ceil(reciprocals / grain.step * (1 - 1e-9));
}

/* d of a code. */
static double depth_of_code(const struct ph_depth_format *format, const struct depth_lab *lab, double code)
{
    const double code16 = has_24_bits(format) ? code / 256 : code;
    return is_float(format) ? of_float(lab, code16 - 8) : ldexp(code16 - 16.25, -16);
}

/* The plateau of a code between near and far plane, at most. `slack`: what the borders of codes may be off. */
static double plateau_m(const struct ph_depth_format *format, const struct depth_lab *lab, double code, double slack)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z);
    const double last = depth_distance_of(format, lab, code), first = depth_distance_of(format, lab, code + 1);
    const bool is_cut = last < 0 || last > f || first < n;
    const double from = fmax(first, n), to = last < 0 || last > f ? f : last, length = to - from;
    if (is_linear(format)) {
        return floor((length + 2 * border_m(format, lab, to)) / GRID_M + 1) * GRID_M;
    }
    struct quotient_grain grain = grain_at(format, lab, to + slack);
    const double power = ldexp(1, ilogb(to + slack)); /* just before it the quotients of w are the coarsest */
    if (power > from - slack) {
        grain.step = fmin(grain.step, grain_at(format, lab, power * (1 - 1e-12)).step);
    }
    const double size = depth_of_code(format, lab, code + 1) - depth_of_code(format, lab, code);
    const double counted = distances_of(grain, size) * GRID_M;
    const double measured = length * (1 + 3 * slack / from) + ((1 + 1 / grain.share) / grain.step + 1) * GRID_M;
    return fmin(counted, measured + (is_cut ? slack : 0));
}

/*
 * The plateaus that z may lie on, and their neighbours where near or far plane cuts one: what lab_search.h measures.
 */
static double store_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z), slack = border_m(format, lab, z) + GRID_M;
    double first = floor(depth_code_at(format, lab, fmin(z + slack, f)));
    double last = floor(depth_code_at(format, lab, fmax(z - slack, n))), longest = 0;
    first -= last >= floor(depth_code_at(format, lab, n + slack));
    last += first <= floor(depth_code_at(format, lab, f - slack));
    for (int i = 0; i < 4 && first + i <= last; i++) { /* more of them are shorter than the slack */
        longest = fmax(longest, plateau_m(format, lab, first + i, slack));
    }
    return longest;
}

/* The focal length, 1 / p, lies below a power of two that reaches over the picture (lens_focal of frame.c): its log2.
 */
static int focal_log2(const struct depth_lab *lab)
{
    const int longest = lab->width > lab->height ? lab->width : lab->height;
    const int focal = (int)ceil(-log2(depth_pixel_slope(lab))), reach = (int)ceil(log2(longest)) - 1;
    return focal > reach ? focal : reach;
}

double depth_across_unit(const struct depth_lab *lab)
{
    return ldexp(depth_pixel_slope(lab), focal_log2(lab));
}

/* For x and y together: they are rounded to 2^-16 of 2^focal_log2 px at a distance of 1 m, to 2^-25 of it on the
 * screen, then to 1/256 px.
 */
static double subpixel_m(const struct depth_lab *lab, double z)
{
    const double reach = depth_across_unit(lab);
    return depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z) + sqrt(2) * (ldexp(reach, -16) + ldexp(reach * z, -24));
}

/* A plane through the whole picture: its edges, on the grid of its corners, and how far the pixels that it covers lie
 * from its first corner, which is at an end of the near edge: along its lean and across, in pixels. */
struct whole_plane {
    double nearest, farthest, along, across;
};

static struct whole_plane whole_plane(const struct depth_lab *lab, struct planes_lean lean)
{
    const double pixel = depth_pixel_slope(lab), part = PLANES_PARTS * GRID_M;
    double along, across;
    depth_planes_extent(lab, lean.azimuth_deg, &along, &across);
    struct whole_plane plane;
    plane.nearest =
        fmax(lean.at_m / (1 + along * tan(depth_radians(lean.tilt_deg))), depth_metres(lab->near_z) + 3 * GRID_M);
    plane.nearest = floor(plane.nearest / GRID_M + 0.5) * GRID_M;
    plane.farthest = plane.nearest + floor((lean.at_m - plane.nearest) / part) * part;
    const double edge = across * fmin(lean.at_m / plane.nearest, 4) / pixel;
    plane.along = along / pixel;
    plane.across = edge + fmin(edge, hypot(lab->width, lab->height) / 2);
    return plane;
}

/* The exponent of the octave of d; all below the lowest count as one. */
static int octave_of(const struct depth_lab *lab, double d)
{
    int exponent;
    frexp(fmax(d, ldexp(1, 1 - (1 << depth_exponent_bits(lab)))), &exponent);
    return exponent;
}

/* Sides below 64 px: differences are rounded to 16 bits, their product with a reciprocal to 2^-15 twice. */
static double short_units(const struct depth_lab *lab, double difference)
{
    const bool is_short = lab->width < 96 && lab->height < 96 && difference < ldexp(1, 30);
    return is_short ? ldexp(difference, -14) + ldexp(1, ilogb(difference) - 14) + 1100 : 0;
}

/* A plane from d at `nearest` to d at `farthest`: its unit, and how far off its end is in units (see below). */
struct plane_error {
    double unit, units;
};

/* Whether the plane takes 64 bits: it crosses more octaves than 32 bits serve (planes.c). */
static bool is_exact(const struct ph_depth_format *format, const struct depth_lab *lab, const struct whole_plane *plane)
{
    if (is_linear(format)) {
        const double head = head_m(format, lab);
        return ilogb(head / plane->nearest) - ilogb(head / plane->farthest) > 4;
    }
    return is_float(format) && octave_of(lab, depth_at(format, lab, plane->nearest)) -
                                       octave_of(lab, depth_at(format, lab, plane->farthest)) >
                                   format->octaves;
}

/* The unit in which a run of a plane of 64 bits is stepped at distance z, in metres: of the float's octave, of 1/w. */
static double run_unit_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double head = head_m(format, lab);
    return is_linear(format) ? z * z / head * ldexp(1, ilogb(head / z) - 28)
                             : ldexp(depth_step_m(format, lab, z), has_24_bits(format) ? -8 : -16);
}

/* The largest unit between two distances: it grows towards the far end of an octave. */
static double largest_unit_m(const struct ph_depth_format *format, const struct depth_lab *lab, double from, double to)
{
    const double head = head_m(format, lab), over_far = is_linear(format) ? 0 : head / depth_metres(lab->far_z);
    double most = run_unit_m(format, lab, to);
    for (int octave = 0; octave < 64; octave++) {
        const double end = head / (ldexp(1 + 1e-12, -octave) + over_far);
        most = end > from && end < to ? fmax(most, run_unit_m(format, lab, end)) : most;
    }
    return most;
}

/*
 * A plane of 64 bits (exact.c). Its gradients are cut to 2^-48 per pixel, towards 0. So d is too large along the lean,
 * by a unit for each row and column of the way at most; across the two gradients err against each other, and the width
 * counts for either. A run steps its own unit: a gradient is rounded to half of it and counts from the middle of 512 px
 * and 16 rows, and the beginning of the run is cut off. Corners far away are cut to 2^-40.
 */
static double exact_m(const struct ph_depth_format *format, const struct depth_lab *lab,
                      const struct whole_plane *plane, double way, double z)
{
    const double run = fmin(lab->width, 512) / 2 + 8 + 1;
    return run * largest_unit_m(format, lab, plane->nearest, z) +
           (ldexp(2 * way + plane->across, -48) + ldexp(1, -40)) * z * z / head_m(format, lab);
}

/*
 * In one octave a float steps its codes, across a few octaves d in a block. Its gradients are rounded once more to a
 * multiple of 2^down, with which no bit is lost in the slope of an octave (round_depth of planes.c): for float16 that
 * of the first octave of all, for float24 that of the nearest corner's.
 */
static struct plane_error float_error(const struct depth_lab *lab, const struct ph_depth_format *format,
                                      const struct whole_plane *plane, double way)
{
    const int first = octave_of(lab, depth_at(format, lab, plane->nearest)),
              last = octave_of(lab, depth_at(format, lab, plane->farthest));
    if (first == last) {
        const double unit = ldexp(1, last - 33 + depth_exponent_bits(lab));
        const double difference =
            (depth_at(format, lab, plane->nearest) - depth_at(format, lab, plane->farthest)) / unit;
        return (struct plane_error){unit, has_24_bits(format) ? 2 * way + 4
                                                              : fmax(2 * way + 514, short_units(lab, difference))};
    }
    int over;
    frexp(head_m(format, lab) / plane->nearest, &over);
    const int block = over < 0 ? -1 - over : 0, zeros = has_24_bits(format) ? -first - block : 0;
    const int down = depth_exponent_bits(lab) - 1 - zeros;
    const double rounded = down > 0 ? ldexp(1, down) : 0;
    return (struct plane_error){ldexp(1, -32 - block), (1 + rounded) * 2 * way + 12 + rounded};
}

/*
 * A plane through the whole picture, from `nearest` to its far edge. The corners' quotients are as right as `divide`
 * says; inside the triangle so is what lies between them. A plane of 32 bits has gradients half a unit off at most,
 * 2^-32 or its block's, so at the end of its longest way, from the corner off the screen to the pixel in the
 * opposite one, d is off by `way` units either way. The hang of the plane costs 2 x 255 units in the formats of 16 bits
 * and 3 in the others. linear-w has N/w below 2^29, and then a reciprocal, a product and a difference in units of 2^-30
 * of the far plane.
 */
double depth_interpolation_m(const struct ph_depth_format *format, const struct depth_lab *lab, struct planes_lean lean,
                             double z)
{
    const struct whole_plane plane = whole_plane(lab, lean);
    const double way = hypot(plane.along, plane.across) / sqrt(2);
    const double late = is_linear(format) ? 2 * ldexp(depth_metres(lab->far_z), -30) : 0;
    struct plane_error error = {ldexp(1, -32), 2 * way + 4};
    if (is_exact(format, lab, &plane)) {
        return exact_m(format, lab, &plane, way, z) + divide_m(z) + late;
    }
    if (is_float(format)) {
        error = float_error(lab, format, &plane, way);
    } else if (is_linear(format)) {
        error = (struct plane_error){ldexp(1, ilogb(head_m(format, lab) / plane.nearest) - 28), 2 * way + 8};
    } else if (!has_24_bits(format)) {
        const double difference =
            ldexp(depth_at(format, lab, plane.nearest) - depth_at(format, lab, plane.farthest), 32);
        error.units = fmax(2 * way + 514, short_units(lab, difference));
    }
    return error.units * error.unit * z * z / head_m(format, lab) + divide_m(z) + late;
}

double depth_share_m(enum depth_share share, const struct ph_depth_format *format, const struct depth_lab *lab,
                     double z)
{
    switch (share) {
    case DEPTH_SHARE_INPUT:
        return GRID_M;
    case DEPTH_SHARE_MATRIX: /* one rounding; three elements, half of 2^-28 off, and 3/4 of it by the rotation, times
                                z/2 */
        return GRID_M + ldexp(2.6 * z, -28);
    case DEPTH_SHARE_DIVIDE:
        return divide_m(z);
    case DEPTH_SHARE_STORE:
        return store_m(format, lab, z);
    case DEPTH_SHARE_INTERPOLATION:
        return depth_interpolation_m(format, lab, (struct planes_lean){z, DEPTH_BUDGET_TILT_DEG, 0}, z);
    default:
        return subpixel_m(lab, z);
    }
}

double depth_s_min_m(double s_xy, double s_z, double tan_phi)
{
    return hypot(s_xy + s_z * tan_phi, s_z);
}
