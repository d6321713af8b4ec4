@ ph_small_knee of kernels.h: a pixel takes 5 instructions more than one of ph_small_gouraud.
#define NAME ph_small_knee
#define TIER scenery
    .equ with_knee, 1
#include "small_gouraud.S"
