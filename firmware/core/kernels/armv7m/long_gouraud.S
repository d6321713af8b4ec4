@ ph_long_gouraud of kernels.h: a row takes some 14 instructions more than one of ph_small_gouraud, and 5 more for each
@ 32 pixels.
    .equ with_blocks, 1
#include "small_gouraud.S"
