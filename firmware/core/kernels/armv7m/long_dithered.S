@ ph_long_dithered of kernels.h: it takes what ph_long_gouraud takes.
#define NAME ph_long_dithered
#define TIER scenery
#define LIGHT_DOWN 22
    .equ with_blocks, 1
#include "small_gouraud.S"
