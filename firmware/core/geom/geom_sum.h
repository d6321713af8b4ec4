/* geom_sum: sums of products, rounded once. */
#ifndef GEOM_SUM_H
#define GEOM_SUM_H

#include "fx.h"

/*
 * (p[0] + .. + p[n - 1]) / 2^bits, rounded to nearest, a tie upwards, even where the sum does not fit 64 bits: what is
 * above 2^bits and what is below are added apart. bits <= 30, n <= 3, or 16 bits and n <= 4.
 */
static inline int64_t geom_sum_rounded(const int64_t *p, int n, int bits)
{
    int64_t high = 0;
    uint32_t low = (uint32_t)1 << (bits - 1);
    for (int i = 0; i < n; i++) {
        high += p[i] >> bits;
        low += (uint32_t)p[i] & (((uint32_t)1 << bits) - 1);
    }
    return high + (low >> bits);
}

#endif
