/* ph_long_gouraud of kernels.h: a row takes some 10 instructions more than one of ph_small_gouraud, and 4 more for each
 * 32 pixels. */
#define NAME ph_long_gouraud
#define WITH_BLOCKS
#include "small_gouraud.S"
