/*
 * Functions whose products and quotients stall CBMC: here these may return anything within their range. No overflow,
 * for every input. What they return is proved apart, or tried with every input. See proof.h.
 */
#include "proof.h"

#include "fx_math.h"
#include "../../firmware/core/fx/fx_wide.h"

/* At most a (2^32 - 1). */
static uint64_t any_product(uint32_t a, uint32_t b)
{
    const uint64_t p = (uint64_t)i64_between(0, INT64_MAX);
    ASSUME(p <= ((uint64_t)a << 32) - a);
    (void)b;
    return p;
}

static uint32_t any_quotient(uint32_t n, uint32_t d)
{
    CLAIM(d > 1);
    return u32_between(0, n / 2);
}

/* fx.atan2 claims this range. */
static fx_t any_angle(fx_t y, fx_t x)
{
    (void)y;
    (void)x;
    return i32_between(-FX_HALF, FX_HALF);
}

static uint32_t any_u32(uint64_t a, uint64_t b)
{
    (void)a;
    (void)b;
    return nondet_u32();
}

static int64_t any_i64(int64_t a, int64_t b)
{
    (void)a;
    (void)b;
    return nondet_i64();
}

#define fx_mul_wide_u(a, b)   any_product(a, b)
#define fx_mulhi_u32(a, b)    any_u32(a, b)
#define fx_rcp_newton(d)      any_u32(d, 0)
#define fx_quotient_u32(n, d) any_quotient(n, d)
#include "../../firmware/core/fx/fx_tan.c"
#include "../../firmware/core/fx/fx_whole.c"

#define fx_atan2(y, x) any_angle(y, x)
#define fx_sqrt_u64(v) any_u32(v, 0)
#include "../../firmware/core/fx/fx_arcsin.c"

#undef fx_sqrt_u64
#undef fx_mul_wide_u
#define fx_mul_wide_u(a, b) ((uint64_t)any_i64((uint32_t)(a), (uint32_t)(b)))
#define fx_mul_wide(a, b)   any_i64(a, b)
#include "../../firmware/core/fx/fx_root.c"

void proof_tan(void)
{
    fx_tan_sat(nondet_i32());
}

void proof_fmod(void)
{
    fx_fmod(nondet_i32(), nondet_i32());
}

void proof_asin(void)
{
    fx_asin(nondet_i32());
}

void proof_acos(void)
{
    fx_acos(nondet_i32());
}

/* Gappa bounds what it narrows. */
void proof_sqrt_u64(void)
{
    fx_sqrt_u64((uint64_t)i64_between(INT64_MIN, INT64_MAX));
}

void proof_quotient(void)
{
    fx_quotient_rcp(nondet_u32(), u32_between(2, UINT32_MAX));
}
