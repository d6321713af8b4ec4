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

/* The code of an unsigned float of d, as a real number: 2^mantissa codes an octave, the lowest two alike. */
static double float_code(double d, int mantissa)
{
    int exponent;
    const double fraction = frexp(d, &exponent); /* d = fraction 2^exponent, fraction in 1/2 .. 1 */
    if (d <= 0 || exponent <= -15) {
        return ldexp(d, 15 + mantissa);
    }
    return ldexp(2 * fraction - 1, mantissa) + ldexp(exponent + 15, mantissa);
}

double depth_code_at(enum ph_depth_format format, const struct depth_lab *lab, double z)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z);
    const double d = n * (f - z) / (z * f);           /* complementary: n/z - n/f */
    const double fixed = n * (f - z) / (z * (f - n)); /* the same, 1 at the near plane */
    switch (format) {
    case PH_DEPTH_FIXED24:
        return fixed * 16777215;
    case PH_DEPTH_FLOAT16:
        return float_code(d, 12);
    case PH_DEPTH_FLOAT24:
        return float_code(d, 20);
    case PH_DEPTH_LINEAR_W:
        return (f - z) / (f - n) * 65535;
    default:
        return fixed * 65535;
    }
}

/* For a float this is the step of the octave of z. */
static double float_step(const struct depth_lab *lab, double z, int mantissa)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z);
    int exponent;
    frexp(n * (f - z) / (z * f), &exponent);
    const int octave = z >= f || exponent < -14 ? -14 : exponent;
    return ldexp(z * z / n, octave - 1 - mantissa);
}

double depth_step_m(enum ph_depth_format format, const struct depth_lab *lab, double z)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z);
    switch (format) {
    case PH_DEPTH_FIXED24:
        return z * z * (f - n) / (f * n * 16777215);
    case PH_DEPTH_FLOAT16:
        return float_step(lab, z, 12);
    case PH_DEPTH_FLOAT24:
        return float_step(lab, z, 20);
    case PH_DEPTH_LINEAR_W:
        return (f - n) / 65535;
    default:
        return z * z * (f - n) / (f * n * 65535);
    }
}

double depth_subpixel_m(const struct depth_lab *lab, int bits, double z)
{
    return sqrt(2) * ldexp(depth_pixel_slope(lab), -bits) * z;
}

/*
 * Two gradients, each wrong by half a unit of the last guard bit, stepped from one corner of the picture to the other.
 */
static double interpolation_m(enum ph_depth_format format, const struct depth_lab *lab, double z)
{
    const int guard_bits = format == PH_DEPTH_FIXED24 || format == PH_DEPTH_FLOAT24 ? 8 : 16;
    return ldexp(lab->width + lab->height, -guard_bits) * depth_step_m(format, lab, z);
}

double depth_share_m(enum depth_share share, enum ph_depth_format format, const struct depth_lab *lab, double z)
{
    switch (share) {
    case DEPTH_SHARE_INPUT:
        return GRID_M;
    case DEPTH_SHARE_MATRIX: /* one rounding, and a third of an element each from x, y and z */
        return GRID_M + ldexp(z, -28);
    case DEPTH_SHARE_DIVIDE: /* N, 1/w and their product, each cut to 30 bits or more */
        return 3 * ldexp(z, -30);
    case DEPTH_SHARE_STORE:
        return depth_step_m(format, lab, z);
    case DEPTH_SHARE_INTERPOLATION:
        return interpolation_m(format, lab, z);
    default:
        return depth_subpixel_m(lab, DEPTH_SUBPIXEL_BITS, z);
    }
}

double depth_s_min_m(double s_xy, double s_z, double tan_phi)
{
    return hypot(s_xy + s_z * tan_phi, s_z);
}
