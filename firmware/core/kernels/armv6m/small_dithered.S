@ ph_small_dithered of kernels.h: it takes what ph_small_gouraud takes.
#define NAME ph_small_dithered
#define TIER loop
#define LIGHT_DOWN 22
#include "small_gouraud.S"
