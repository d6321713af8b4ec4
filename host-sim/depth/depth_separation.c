/* See depth_separation.h. */
#include "depth_separation.h"

#include <math.h>
#include <string.h>

#define GUARD_PX 2048 /* from the centre of the picture: vertex.h */
/* Codes of 16 bits by which planes of 32 bits are off at a corner, and so at most anywhere between the corners, in
 * triangles with sides up to 64 px. What is cut off there, in codes, at most:
 *   setup_small.c, sides up to 32 px, FINE_DEPTH: 1/4 by slopes of 15 bits, each off by one and all for the worse; 1/32
 *     by differences of 15 bits and 1/32 by a reciprocal of 16, for so many bits are dropped only if depth rises by
 *     less than 2^26; 1/4 by the gradients' last bits in 2 2^13 steps of 1/256 px. With fewer bits dropped the corners
 *     themselves are looked at: RIGHT_DEPTH.
 *   planes.c, sides up to 64 px: what stands beside FINE_STEP and FINE_DROP, 5/16.
 * With antialiasing, whose sides have up to 64 samples, 1 1/8: slopes and gradients weigh twice as much.
 * tests/core/test_depth_slivers.c holds it. */
#define SMALL_CODES (9.0 / 16)
#define HANG        508 /* units of 2^-32 that hang_plane of planes.c leaves out */

double depth_way_px(const struct depth_lab *lab)
{
    return fmin(2.0 * (lab->width + lab->height), depth_guard_way_px(lab));
}

double depth_guard_way_px(const struct depth_lab *lab)
{
    return 2 * GUARD_PX + (lab->width + lab->height) / 2.0;
}

/* Planes across octaves: the distance of the farthest corner over that of the nearest, at most. */
static double depth_ratio(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const int octaves = format->coding == PH_DEPTH_IS_LINEAR ? 5 : format->octaves + 1; /* linear-w: 4 bits of N/w */
    return fmin(ldexp(1, octaves), z / depth_metres(lab->near_z));
}

/* How far the value of such a plane is off, as a part of N / w of the nearest corner: its gradients are off by so many
 * units of 2^-30 of that for each pixel. */
static double across_octaves(const struct ph_depth_format *format, const struct depth_lab *lab, double way_px)
{
    if (format->coding == PH_DEPTH_IS_LINEAR) { /* N/w takes 29 bits (planes.c) */
        return ldexp(way_px / 2 + 2, -28);
    }
    const int down = depth_exponent_bits(lab) - 1 - (format->bits == 24); /* round_depth of planes.c */
    return format->coding == PH_DEPTH_IS_FLOAT ? ldexp(way_px * (1 + ldexp(1, down)) / 2 + 2, -30) : 0;
}

/* depth_off but for what a plane across octaves is off. */
static struct depth_off off_alike(const struct ph_depth_format *format, const struct depth_lab *lab, double z,
                                  double way_px)
{
    const bool is_24 = format->bits == 24;
    const double corner = depth_share_m(DEPTH_SHARE_DIVIDE, format, lab, z);
    if (format->coding == PH_DEPTH_IS_LINEAR) {
        return (struct depth_off){0, corner + ldexp(depth_metres(lab->far_z), -29)};
    }
    return (struct depth_off){ldexp(way_px / 2 + (is_24 ? 2 : HANG), is_24 ? -8 : -16), corner};
}

struct depth_off depth_off(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    struct depth_off off = off_alike(format, lab, z, way_px);
    off.metres += z * depth_ratio(format, lab, z) * across_octaves(format, lab, way_px);
    return off;
}

struct depth_off depth_off_small(const struct ph_depth_format *format, const struct depth_lab *lab, double z)
{
    const double across = format->coding == PH_DEPTH_IS_FLOAT ? ldexp(z, -17) : 0;
    return (struct depth_off){SMALL_CODES, depth_share_m(DEPTH_SHARE_DIVIDE, format, lab, z) + across};
}

/* The distance before z in which a code changes, if both triangles are off so much. */
static double before_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z,
                       struct depth_off off)
{
    const double nearer = depth_distance_of(format, lab, depth_code_at(format, lab, z) + 1 + 2 * off.codes);
    return nearer > 0 ? z - nearer + 2 * off.metres : HUGE_VAL;
}

/* Lengths along the view at a distance, for triangles that reach way_px. */
static double small_step_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    (void)way_px;
    return before_m(format, lab, z, depth_off_small(format, lab, z));
}

static double step_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    return before_m(format, lab, z, depth_off(format, lab, z, way_px));
}

static double step_alike_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    return before_m(format, lab, z, off_alike(format, lab, z, way_px));
}

static double plateau_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    (void)way_px;
    return depth_share_m(DEPTH_SHARE_STORE, format, lab, z);
}

typedef double length_at(const struct ph_depth_format *, const struct depth_lab *, double, double);

/* Where a length is the largest, of the distances up to z. Steps grow with the distance, but for those of a float,
 * which grow to the far end of each octave. */
static double where_largest(length_at *of, const struct ph_depth_format *format, const struct depth_lab *lab, double z,
                            double way_px)
{
    double worst = z;
    for (int octave = 1; format->coding == PH_DEPTH_IS_FLOAT && octave < 1 << depth_exponent_bits(lab); octave++) {
        const double end = depth_octave_end_m(format, lab, octave);
        if (end > depth_metres(lab->near_z) && end < z &&
            of(format, lab, end, way_px) > of(format, lab, worst, way_px)) {
            worst = end;
        }
    }
    return worst;
}

static double largest(length_at *of, const struct ph_depth_format *format, const struct depth_lab *lab, double z,
                      double way_px)
{
    return of(format, lab, where_largest(of, format, lab, z, way_px), way_px);
}

double depth_coarsest_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double way_px)
{
    return where_largest(format->is_small ? small_step_m : step_alike_m, format, lab, z, way_px);
}

/* up sin(tilt) + along cos(tilt) of the tilt that needs most. */
static double leaning_m(double up, double along, double tilt_deg)
{
    const double tilt = fmin(depth_radians(tilt_deg), atan2(up, along));
    return up * sin(tilt) + along * cos(tilt);
}

double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *lab, double z, double tilt_deg,
                          double way_px)
{
    const double facing = largest(plateau_m, format, lab, z, way_px), pixel = depth_pixel_slope(lab);
    if (tilt_deg <= 0) {
        return facing;
    }
    const double tan_phi = hypot(lab->width, lab->height) * pixel / 2;
    const double tan_corner = tan_phi * (2 * way_px / (lab->width + lab->height) - 1);
    const double rounded = 3 * depth_share_m(DEPTH_SHARE_INPUT, format, lab, z) +
                           depth_share_m(DEPTH_SHARE_MATRIX, format, lab, z); /* of both, along an axis */
    const double up = depth_share_m(DEPTH_SHARE_SUBPIXEL, format, lab, z) + rounded * sqrt(2) * depth_across_unit(lab);
    const double step = largest(step_m, format, lab, z, way_px), alike = largest(step_alike_m, format, lab, z, way_px);
    const double across = 2 * z * across_octaves(format, lab, way_px);
    const double large =
        fmin(leaning_m(up + step * tan_phi, step + rounded, tilt_deg),
             leaning_m(up + alike * tan_phi + across * tan_corner, alike + across + rounded, tilt_deg));
    const double tiny = format->is_small ? largest(small_step_m, format, lab, z, way_px) : 0;
    return fmax(fmax(facing, large), leaning_m(up + tiny * tan_phi, tiny + rounded, tilt_deg));
}

uint32_t depth_separation_lsbs(double metres)
{
    return metres < 16384 ? (uint32_t)ceil(ldexp(metres, 16) * (1 - 1e-12)) : UINT32_MAX;
}

void depth_separation_text(double metres, char text[LAB_TEXT_SIZE])
{
    const uint32_t lsbs = depth_separation_lsbs(metres);
    if (lsbs == UINT32_MAX) {
        strcpy(text, "none");
    } else {
        lab_length_text(lsbs, text);
    }
}
