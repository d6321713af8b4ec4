/* fx_wide: products of 64 bits, quotients, powers and logarithms with more bits than an fx_t, for the rest of fx. */
#ifndef FX_WIDE_H
#define FX_WIDE_H

#include "fx.h"

/* High 64 bits of the 128-bit product, rounded down. */
uint64_t fx_mulhi_u64(uint64_t a, uint64_t b);

/* floor(n / d), d > 1, by the reciprocal. */
static inline uint32_t fx_quotient_rcp(uint32_t n, uint32_t d)
{
    int shift;
    const uint32_t r = fx_rcp_norm(d, &shift);
    const uint32_t q = fx_mulhi_u32(n, r) >> (30 - shift); /* right, or one too small */
    return q + (n - q * d >= d);
}

/* floor(n / d), d > 1. */
static inline uint32_t fx_quotient_u32(uint32_t n, uint32_t d)
{
    /* NOLINTNEXTLINE(clang-analyzer-core.DivideZero): d > 1 */
    return FX_DIVIDES_32 ? n / d : fx_quotient_rcp(n, d);
}

/* 2^(y l) in 2^-16, 0 .. 2^31 (which stands for anything larger, too), where y is in 2^-16 and l in 2^-58, |l| <= 16.
 */
uint32_t fx_exp2_product(int32_t y, int64_t l_q58);

/* 2^(y l) of the same y and l, as a number of 1 to below 2, in 2^-62 with a relative error < 2^-57, times 2^*exponent.
 */
uint64_t fx_exp2_parts(int32_t y, int64_t l_q58, int32_t *exponent);

/* log2(a) in 2^-58 of a number in 2^-16, a > 0; error < 2^-53. Exact where a is a power of two. */
int64_t fx_log2_q58(uint32_t a);

#define FX_LOG2_E_Q58 415828534307635078 /* log2(e) */

/* The tables of fx_exp.c and fx_log.c, which say what they hold. */
extern const uint64_t fx_exp2_coarse[16], fx_exp2_fine[16], fx_log_first[16], fx_log_second[19];
extern const uint8_t fx_log_factor_first[16], fx_log_factor_second[19];

#endif
