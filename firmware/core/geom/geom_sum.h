/* geom_sum: sums of products, rounded once. */
#ifndef GEOM_SUM_H
#define GEOM_SUM_H

#include "fx.h"

#include <stdbool.h>

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

/*
 * Whether geom_near_row is exact for a row in Q2.30 times (x, y, z), plus c, all but the row in Q16.16: coordinates
 * from -8.0 to below 8.0, elements of the row above -1.0 and not above 1.0, c from -2^30 to below 2^30.
 */
static inline bool geom_row_is_near(const int32_t row[3], int32_t x, int32_t y, int32_t z, int32_t c)
{
    const uint32_t range = (uint32_t)1 << 19, one = FX_Q30_ONE - 1;
    const uint32_t large = ((uint32_t)x + range) | ((uint32_t)y + range) | ((uint32_t)z + range);
    const uint32_t steep = ((uint32_t)row[0] + one) | ((uint32_t)row[1] + one) | ((uint32_t)row[2] + one);
    return ((large >> 20) | ((steep | ((uint32_t)c + FX_Q30_ONE)) >> 31)) == 0;
}

/* Row times (x, y, z), plus c, rounded once (a tie upwards), where geom_row_is_near says yes. Products have 32 bits: an
 * element is low + 2^10 middle + 2^20 high. */
static inline int32_t geom_near_row(const int32_t row[3], int32_t x, int32_t y, int32_t z, int32_t c)
{
    const int32_t a = row[0], b = row[1], d = row[2];
    const int32_t low = (a & 1023) * x + (b & 1023) * y + (d & 1023) * z;
    const int32_t middle = (a >> 10 & 1023) * x + (b >> 10 & 1023) * y + (d >> 10 & 1023) * z;
    const int32_t high = (a >> 20) * x + (b >> 20) * y + (d >> 20) * z + (1 << 9);
    return (((((low >> 10) + middle) >> 10) + high) >> 10) + c;
}

/* ph_xform_mul, faster where b stands near the origin of a, at the price of ph_xform_point in the program. */
struct ph_xform ph_xform_mul_near(const struct ph_xform *a, const struct ph_xform *b);

#endif
