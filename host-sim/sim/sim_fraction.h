/*
 * sim_fraction: exact numbers of cameras, and the line that shows one beside Pinhole's:
 *
 *   view.x 3/5 0.6 39322 +0.4
 *
 * is a name, the exact value as a fraction and as a decimal, the Q16.16 code, and how far the code is off in steps of
 * 1/65536. Numerators and denominators must stay below 2^115: a coordinate has 63 bits, a scale 32, a side 11.
 */
#ifndef SIM_FRACTION_H
#define SIM_FRACTION_H

#include "fx.h"

#include <stdio.h>

typedef __int128 sim_wide;

/* In lowest terms; under is more than 0. */
struct sim_fraction {
    sim_wide over, under;
};

/* over / under in lowest terms. Either may be below 0; 0 / 0 is 0. */
struct sim_fraction sim_fraction_reduced(sim_wide over, sim_wide under);

/* value / 2^bits. */
struct sim_fraction sim_fraction_of(int32_t value, int bits);

struct sim_fraction sim_fraction_add(struct sim_fraction a, struct sim_fraction b);
struct sim_fraction sim_fraction_times(struct sim_fraction a, struct sim_fraction b);
struct sim_fraction sim_fraction_minus(struct sim_fraction a);
struct sim_fraction sim_fraction_divide(struct sim_fraction a, struct sim_fraction b); /* b is not 0 */

/* The nearest Q16.16, half a step away from 0; it saturates. */
fx_t sim_fraction_code(struct sim_fraction a);

/* Prints the line. */
void sim_fraction_print(FILE *file, const char *name, struct sim_fraction exact, fx_t code);

/* Prints the line of a value that is no fraction: it has `-` there. */
void sim_decimal_print(FILE *file, const char *name, long double value, fx_t code);

#endif
