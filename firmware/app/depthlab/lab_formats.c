/* The rows of the depth lab's tables. */
#include "lab_formats.h"

const struct lab_format lab_formats[] = {
    {"fixed16", LAB_DRAWN, 16, PH_DEPTH_FIXED16},
    {"float16", LAB_DRAWN, 16, PH_DEPTH_FLOAT16},
    {"fixed24", LAB_DRAWN, 24, PH_DEPTH_FIXED24},
    {"float24", LAB_DRAWN, 24, PH_DEPTH_FLOAT24},
    {"linear-w", LAB_DRAWN, 16, PH_DEPTH_LINEAR_W},
    {"linear-w", LAB_LINEAR, 24, 0},
    {"over-w", LAB_OVER_W, 16, 0},
    {"over-w", LAB_OVER_W, 24, 0},
    {"ndc-q16", LAB_NDC_Q16, 16, 0},
    {"ndc-q16", LAB_NDC_Q16, 24, 0},
    {"recip-q16", LAB_RECIP_Q16, 16, 0},
    {"recip-q16", LAB_RECIP_Q16, 24, 0},
    {"clip-q16", LAB_CLIP_Q16, 16, 0},
    {"clip-q16", LAB_CLIP_Q16, 24, 0},
    {"log", LAB_LOG, 16, 0},
    {"log", LAB_LOG, 24, 0},
};

const uint32_t lab_format_count = sizeof lab_formats / sizeof lab_formats[0];
