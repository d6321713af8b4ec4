/* See lab_formats.h. The formats that the tables of the depth lab have a row for. */
#include "lab_formats.h"

const struct lab_format lab_formats[] = {
    {"fixed16", LAB_DRAWN, 16, PH_DEPTH_FIXED16, 0},
    {"float16", LAB_DRAWN, 16, PH_DEPTH_FLOAT16, 0},
    {"fixed24", LAB_DRAWN, 24, PH_DEPTH_FIXED24, 0},
    {"float24", LAB_DRAWN, 24, PH_DEPTH_FLOAT24, 0},
    {"linear-w", LAB_DRAWN, 16, PH_DEPTH_LINEAR_W, 0},
    {"linear-w", LAB_LINEAR, 24, 0, 0},
    {"over-w", LAB_OVER_W, 16, 0, 4},
    {"over-w", LAB_OVER_W, 24, 0, 4},
    {"ndc-q16", LAB_NDC_Q16, 16, 0, 0},
    {"ndc-q16", LAB_NDC_Q16, 24, 0, 0},
    {"recip-q16", LAB_RECIP_Q16, 16, 0, 0},
    {"recip-q16", LAB_RECIP_Q16, 24, 0, 0},
    {"clip-q16", LAB_CLIP_Q16, 16, 0, 0},
    {"clip-q16", LAB_CLIP_Q16, 24, 0, 0},
    {"log", LAB_LOG, 16, 0, 0},
    {"log", LAB_LOG, 24, 0, 0},
    {"float16-e3", LAB_DRAWN, 16, PH_DEPTH_FLOAT16, 3},
    {"float16-e4", LAB_DRAWN, 16, PH_DEPTH_FLOAT16, 4},
    {"float16-e5", LAB_DRAWN, 16, PH_DEPTH_FLOAT16, 5},
    {"float16-e6", LAB_DRAWN, 16, PH_DEPTH_FLOAT16, 6},
    {"float24-e3", LAB_DRAWN, 24, PH_DEPTH_FLOAT24, 3},
    {"float24-e4", LAB_DRAWN, 24, PH_DEPTH_FLOAT24, 4},
    {"float24-e5", LAB_DRAWN, 24, PH_DEPTH_FLOAT24, 5},
    {"float24-e6", LAB_DRAWN, 24, PH_DEPTH_FLOAT24, 6},
};

const uint32_t lab_format_count = sizeof lab_formats / sizeof lab_formats[0];

int lab_exponent(const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    const struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = near_z, .far_z = far_z};
    if (format->kind != LAB_DRAWN) {
        return format->exponent;
    }
    const bool is_float = format->format == PH_DEPTH_FLOAT16 || format->format == PH_DEPTH_FLOAT24;
    return !is_float || format->exponent != 0 ? format->exponent : (int)ph_depth_choose_exponent(&p);
}
