/* Arithmetic: no overflow, no bad shift, no index outside a table, for every input. See proof.h. */
#include "proof.h"

#include "../../firmware/core/fx/fx.c"
#include "../../firmware/core/fx/fx_atan.c"
#include "../../firmware/core/fx/fx_root.c"
#include "../../firmware/core/fx/fx_tan.c"
#include "../../firmware/core/fx/fx_trig.c"
#include "../../firmware/core/fx/fx_wide.c"
#include "../../firmware/core/kernels/portable/fx_mul.c"

void proof_sums(void)
{
    const fx_t a = nondet_i32(), b = nondet_i32();
    const int64_t sum = (int64_t)a + b;
    const fx_t sat = fx_add_sat(a, b);
    CLAIM(sat == (sum > FX_MAX ? FX_MAX : sum < FX_MIN ? FX_MIN : sum));
    CLAIM(fx_sub_sat(a, b) == fx_sat64((int64_t)a - b));
    CLAIM(((int64_t)fx_add_wrap(a, b) - sum) % POWER(32) == 0);
    CLAIM(fx_sub_wrap(fx_add_wrap(a, b), b) == a);
    CLAIM(fx_neg_sat(a) == fx_sub_sat(0, a));
    CLAIM(fx_abs_sat(a) >= 0);
}

void proof_products(void)
{
    fx_mul_sat(nondet_i32(), nondet_i32());
    fx_mul_wrap(nondet_i32(), nondet_i32());
    fx_mul_far(nondet_i32(), nondet_i32());
}

void proof_rcp(void)
{
    int shift;
    fx_rcp_sat(nondet_i32());
    fx_rcp_far(nondet_u32(), &shift);
    CLAIM(shift >= 0 && shift < 32);
}

/* It ends; that its result is the quotient, test_fx and fuzz_total compare with the compiler's division. */
void proof_quotient_bits(void)
{
    const int64_t d = i64_between(1, INT64_MAX);
    fx_quotient_bits((uint64_t)nondet_i64(), (uint64_t)d);
}

void proof_quotient_far(void)
{
    fx_quotient_far(nondet_u32(), u32_between(1, UINT32_MAX));
}

void proof_rcp_newton(void)
{
    fx_rcp_newton(u32_between((uint32_t)1 << 31, UINT32_MAX));
}

/* The contract that the stages of the renderer count on. */
void proof_rcp16(void)
{
    const uint32_t r = fx_rcp16(u32_between(1 << 15, (1 << 16) - 1));
    CLAIM(r >= 1 << 15 && r < 1 << 16);
}

void proof_rsqrt_norm(void)
{
    fx_rsqrt_norm(u32_between((uint32_t)1 << 30, UINT32_MAX));
}

void proof_rsqrt16(void)
{
    const uint32_t r = fx_rsqrt16(u32_between((uint32_t)1 << 30, UINT32_MAX));
    CLAIM(r >= 1 << 15 && r <= 1 << 16);
}

void proof_lerp(void)
{
    fx_lerp_sat(nondet_i32(), nondet_i32(), nondet_i32());
}

void proof_turn32_from_deg(void)
{
    fx_turn32_from_deg(nondet_i32());
}

void proof_sqrt(void)
{
    fx_sqrt(nondet_i32());
}

void proof_rsqrt(void)
{
    fx_rsqrt_sat(nondet_i32());
}

void proof_sincos(void)
{
    int32_t s, c;
    fx_sincos_q30(nondet_u32(), &s, &c);
    fx_sin(nondet_i32());
    fx_cos(nondet_i32());
}

void proof_atan2(void)
{
    const fx_t turns = fx_atan2(nondet_i32(), nondet_i32());
    CLAIM(turns >= -FX_HALF && turns <= FX_HALF);
}
