/* Quotients: no overflow, any products and reciprocals taken. Gappa bounds the turns of the loop. See proof.h. */
#include "proof.h"

#include "fx.h"

static uint64_t any_product(uint32_t a, uint32_t b)
{
    (void)a;
    (void)b;
    return (uint64_t)i64_between(INT64_MIN, INT64_MAX);
}

#define fx_mul_wide_u(a, b) any_product(a, b)
#include "../../firmware/core/fx/fx.c"

void proof_div(void)
{
    fx_div_sat(nondet_i32(), nondet_i32());
}
