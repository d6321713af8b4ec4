/* ref_random: random numbers, directions and rotations for tests, in double; the same on every machine for a seed. */
#ifndef REF_RANDOM_H
#define REF_RANDOM_H

#include <stdint.h>

void ref_seed(uint64_t seed);

/* low <= result < high */
double ref_uniform(double low, double high);

/* A unit vector, every direction alike. */
void ref_direction(double out[3]);

/* A rotation about any axis by up to `turn` radians either way. */
void ref_rotation(double turn, double r[3][3]);

/* v in Q16.16, to nearest. */
int32_t ref_q16(double v);

/* v in Q2.30, to nearest. */
int32_t ref_q30(double v);

#endif
