/* ph_knee_dithered of kernels.h: it takes what ph_small_knee takes. */
#define NAME ph_knee_dithered
#define LIGHT_DOWN 22
#define WITH_KNEE
#include "small_gouraud.S"
