/* ph_small_knee of kernels.h: a pixel takes 2 to 4 instructions more than one of ph_small_gouraud. */
#define NAME ph_small_knee
#define WITH_KNEE
#include "small_gouraud.S"
