/* The code of a vertex, and the formats' definition in double: see depth_chain.h. */
#include "depth_chain.h"

#include <math.h>

static bool is_float(const struct ph_depth_format *format)
{
    return format->coding == PH_DEPTH_IS_FLOAT;
}

uint32_t depth_chain(const struct ph_lens *lens, const struct ph_depth_format *format, fx_t w)
{
    const struct ph_quotient quotient = ph_depth_quotient(lens, w);
    const int down = ph_depth_bytes(format) == 4 ? 8 : 16;
    if (format->coding == PH_DEPTH_IS_LINEAR) {
        struct ph_linear linear = lens->linear;
        linear.down = (int8_t)(linear.down - quotient.s);
        return ph_depth_linear(&linear, quotient.q >> 2) >> 16;
    }
    if (!is_float(format)) {
        return (ph_depth_at(lens, quotient, 0) + PH_DEPTH_BIAS_FIXED16) >> down;
    }
    const int block = quotient.s > 2 ? quotient.s - 2 : 0, float_down = lens->float_down;
    const uint32_t d = ph_depth_at(lens, quotient, block);
    const int octave = ph_depth_octave(d, ph_depth_lowest(block, float_down));
    return (ph_depth_float16_value(d, octave - float_down) + ph_depth_float16_offset(octave, block, float_down)) >>
           down;
}

double depth_exact(const struct ph_lens *lens, const struct ph_depth_format *format, double w)
{
    const int bits = is_float(format) ? lens->float_down + 1 : 4; /* of exponent */
    const double head_room = 1 - ldexp(1, bits > 4 ? bits - 13 : -9), near_z = lens->near_z, far_z = lens->far_z;
    if (format->coding == PH_DEPTH_IS_LINEAR) {
        return 65536 * head_room * (far_z - w) / (far_z - near_z) + 16;
    }
    const double d = fmax(near_z * head_room * (1 / w - 1 / far_z), 0), unit = ph_depth_bytes(format) == 4 ? 256 : 1;
    if (!is_float(format)) {
        return unit * (65536 * d * fmin(far_z / (far_z - near_z), 8) + 16.25);
    }
    const int top = (1 << bits) - 1, octave = d < ldexp(1, 1 - top) ? top - 1 : -1 - ilogb(d);
    return unit * (ldexp(d, 17 - bits + octave) + ldexp(top - octave - 1, 16 - bits) + 8);
}

double depth_tolerance(const struct ph_depth_format *format)
{
    return ph_depth_bytes(format) == 4 ? 1. / 16 : 1. / 64;
}

bool depth_is_right(const struct ph_lens *lens, const struct ph_depth_format *format, fx_t w, uint32_t code)
{
    const bool deep = is_float(format) && lens->float_down > 3; /* down to the last bits of N/w and N/f: make proof */
    const double tolerance = depth_tolerance(format), off = deep ? 5 * ldexp(1, -30) : ldexp(1, -29);
    return code <= depth_exact(lens, format, w * (1 - off)) + tolerance &&
           code > depth_exact(lens, format, w * (1 + off)) - 1 - tolerance;
}
