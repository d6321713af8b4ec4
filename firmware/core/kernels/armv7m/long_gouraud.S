@ ph_long_gouraud of kernels.h: a row takes some 14 instructions more than one of ph_small_gouraud, and 5 more for each
@ 32 pixels.
#define NAME ph_long_gouraud
#define TIER scenery
    .equ with_blocks, 1
#include "small_gouraud.S"
