/* ph_long_dithered of kernels.h: it takes what ph_long_gouraud takes. */
#define NAME ph_long_dithered
#define LIGHT_DOWN 22
#define WITH_BLOCKS
#include "small_gouraud.S"
