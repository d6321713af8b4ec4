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

#include <stdbool.h>
#include <stdio.h>

/* 128 bits, which not every machine has as a type. */
struct sim_wide {
    uint64_t high, low;
};

/* In lowest terms; under is more than 0, and 0 is not negative. */
struct sim_fraction {
    struct sim_wide over, under;
    bool is_negative;
};

/* value / 2^bits; bits: 0 .. 63. */
struct sim_fraction sim_fraction_of(int32_t value, int bits);

struct sim_fraction sim_fraction_add(struct sim_fraction a, struct sim_fraction b);
struct sim_fraction sim_fraction_times(struct sim_fraction a, struct sim_fraction b);
struct sim_fraction sim_fraction_minus(struct sim_fraction a);
struct sim_fraction sim_fraction_divide(struct sim_fraction a, struct sim_fraction b); /* b is not 0 */
bool sim_fraction_is_0(struct sim_fraction a);

/* The nearest Q16.16, half a step away from 0; it saturates. */
fx_t sim_fraction_code(struct sim_fraction a);

/* The value, to as many digits as a long double has. */
long double sim_fraction_real(struct sim_fraction a);

/* Prints the line. */
void sim_fraction_print(FILE *file, const char *name, struct sim_fraction exact, fx_t code);

/* Prints the line of a value that is no fraction: it has `-` there. */
void sim_decimal_print(FILE *file, const char *name, long double value, fx_t code);

#endif
