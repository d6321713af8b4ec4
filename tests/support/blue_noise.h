/* blue_noise: an 8x8 matrix for ordered dither, made by R. Ulichney's void-and-cluster method (1993). */
#ifndef BLUE_NOISE_H
#define BLUE_NOISE_H

/* The rank 0 .. 63 of column x and row y, which repeat every 8. */
unsigned blue_noise_rank(unsigned x, unsigned y);

#endif
