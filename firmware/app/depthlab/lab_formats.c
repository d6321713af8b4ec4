/* See lab_formats.h. The formats that the tables of the depth lab have a row for. */
#include "lab_formats.h"

/* A format of the renderer, and the floats with each number of bits of exponent, as other formats are no floats. */
#define DRAWN(id, name, coding, bits, octaves, small)     {name, LAB_DRAWN, bits, &ph_depth_##id, 0},
#define EXPONENTS(id, name, coding, bits, octaves, small) EXPONENTS_##coding(id, name, bits)
#define EXPONENTS_FIXED(id, name, bits)
#define EXPONENTS_LINEAR(id, name, bits)
#define EXPONENTS_FLOAT(id, name, bits)                                                                                \
    {name "-e3", LAB_DRAWN, bits, &ph_depth_##id, 3}, {name "-e4", LAB_DRAWN, bits, &ph_depth_##id, 4},                \
        {name "-e5", LAB_DRAWN, bits, &ph_depth_##id, 5}, {name "-e6", LAB_DRAWN, bits, &ph_depth_##id, 6},

const struct lab_format lab_formats[] = {
    PH_DEPTH_EACH(DRAWN) /* clang-format off */
    {"linear-w", LAB_LINEAR, 24, NULL, 0},
    {"over-w", LAB_OVER_W, 16, NULL, 4},
    {"over-w", LAB_OVER_W, 24, NULL, 4},
    {"ndc-q16", LAB_NDC_Q16, 16, NULL, 0},
    {"ndc-q16", LAB_NDC_Q16, 24, NULL, 0},
    {"recip-q16", LAB_RECIP_Q16, 16, NULL, 0},
    {"recip-q16", LAB_RECIP_Q16, 24, NULL, 0},
    {"clip-q16", LAB_CLIP_Q16, 16, NULL, 0},
    {"clip-q16", LAB_CLIP_Q16, 24, NULL, 0},
    {"log", LAB_LOG, 16, NULL, 0},
    {"log", LAB_LOG, 24, NULL, 0},
    PH_DEPTH_EACH(EXPONENTS) /* clang-format on */
};

const uint32_t lab_format_count = sizeof lab_formats / sizeof lab_formats[0];

int lab_exponent(const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    const struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = near_z, .far_z = far_z};
    if (format->kind != LAB_DRAWN) {
        return format->exponent;
    }
    const bool is_float = format->format->coding == PH_DEPTH_IS_FLOAT;
    return !is_float || format->exponent != 0 ? format->exponent : (int)ph_depth_choose_exponent(&p);
}
