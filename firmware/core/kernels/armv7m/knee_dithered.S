@ ph_knee_dithered of kernels.h: it takes what ph_small_knee takes.
#define NAME ph_knee_dithered
#define TIER scenery
#define LIGHT_DOWN 22
    .equ with_knee, 1
#include "small_gouraud.S"
