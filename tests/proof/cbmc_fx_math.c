/* The rest of the maths: no overflow, no bad shift, no index outside a table, for every input. See proof.h. */
#include "proof.h"

#include "../../firmware/core/fx/fx.c"
#include "../../firmware/core/fx/fx_arcsin.c"
#include "../../firmware/core/fx/fx_atan.c"
#include "../../firmware/core/fx/fx_exp.c"
#include "../../firmware/core/fx/fx_array.c"
#include "../../firmware/core/fx/fx_hyperbolic.c"
#include "../../firmware/core/fx/fx_hypot.c"
#include "../../firmware/core/fx/fx_log.c"
#include "../../firmware/core/fx/fx_pow.c"
#include "../../firmware/core/fx/fx_root.c"
#include "../../firmware/core/fx/fx_tan.c"
#include "../../firmware/core/fx/fx_tangent.c"
#include "../../firmware/core/fx/fx_trig.c"
#include "../../firmware/core/fx/fx_unit.c"
#include "../../firmware/core/fx/fx_whole.c"
#include "../../firmware/core/fx/fx_wide.c"

void proof_exp2(void)
{
    fx_exp2_sat(nondet_i32());
}

void proof_exp(void)
{
    fx_exp_sat(nondet_i32());
}

void proof_sinh(void)
{
    fx_sinh_sat(nondet_i32());
    fx_cosh_sat(nondet_i32());
}

void proof_tanh(void)
{
    fx_tanh(nondet_i32());
}

void proof_arrays(void)
{
    const fx_t a[2] = {nondet_i32(), nondet_i32()}, b[2] = {nondet_i32(), nondet_i32()};
    fx_t to[2];
    fx_add_array_sat(to, a, b, 2);
    fx_sub_array_sat(to, a, b, 2);
    fx_mul_array_sat(to, a, b, 2);
    fx_scale_array_sat(to, a, b[0], 2);
    fx_map_array(to, a, 2, fx_neg_sat);
    fx_sum_array_sat(a, 2);
    fx_dot_array_sat(a, b, 2);
}

void proof_sums(void)
{
    fx_sum_add_sat(nondet_i64(), nondet_i64());
    fx_sum_mul_sat(nondet_i64(), nondet_i32(), nondet_i32());
    fx_from_sum_sat(nondet_i64());
    fx_sum_of(nondet_i32());
}

void proof_log2(void)
{
    fx_log2_sat(nondet_i32());
}

void proof_log(void)
{
    fx_log_sat(nondet_i32());
}

void proof_pow(void)
{
    fx_pow_sat(nondet_i32(), nondet_i32());
}

void proof_hypot(void)
{
    fx_hypot_sat(nondet_i32(), nondet_i32());
}

void proof_units(void)
{
    fx_turns_from_rad(nondet_i32());
    fx_rad_from_turns_sat(nondet_i32());
    fx_turn32_from_rad(nondet_i32());
}

void proof_cot_half(void)
{
    fx_cot_half_q20(nondet_i32());
}

void proof_whole(void)
{
    fx_floor(nondet_i32());
    fx_ceil_sat(nondet_i32());
    fx_round_sat(nondet_i32());
}

void proof_convert(void)
{
    fx_convert_sat(nondet_i32(), i32_between(0, 31), i32_between(0, 31));
    fx_from_q30(nondet_i32());
    fx_to_q30_sat(nondet_i32());
}
