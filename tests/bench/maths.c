/*
 * maths: what the functions of fx.h and fx_math.h cost: one line a function, `NAME - - CALLS INSTRUCTIONS`
 * for the calls with inputs of all magnitudes, which the loop `empty` is to be subtracted from (run.sh with
 * PROGRAM=maths, maths.sh).
 */
#include "bench.h"

#include "fx_math.h"

#define CALLS 4000

static int32_t inputs[CALLS + 1];
static uint32_t sum;

#define UNARY(f)                                                                                                       \
    static __attribute__((noinline)) void run_##f(void)                                                                \
    {                                                                                                                  \
        for (int i = 0; i < CALLS; i++) {                                                                              \
            sum = sum * 3 + (uint32_t)f(inputs[i]);                                                                    \
        }                                                                                                              \
    }
#define BINARY(f)                                                                                                      \
    static __attribute__((noinline)) void run_##f(void)                                                                \
    {                                                                                                                  \
        for (int i = 0; i < CALLS; i++) {                                                                              \
            sum = sum * 3 + (uint32_t)f(inputs[i], inputs[i + 1]);                                                     \
        }                                                                                                              \
    }

static int32_t empty(int32_t a)
{
    return a;
}

/* Functions with other arguments, and those whose results saturate for most inputs. */
static int32_t exp_in_range(int32_t a)
{
    return fx_exp_sat(a % (10 * FX_ONE));
}

static int32_t exp2_in_range(int32_t a)
{
    return fx_exp2_sat(a % (15 * FX_ONE));
}

static int32_t sinh_in_range(int32_t a)
{
    return fx_sinh_sat(a % (11 * FX_ONE));
}

static int32_t cosh_in_range(int32_t a)
{
    return fx_cosh_sat(a % (11 * FX_ONE));
}

static int32_t tanh_in_range(int32_t a)
{
    return fx_tanh(a % (6 * FX_ONE));
}

static int32_t log_of_positive(int32_t a)
{
    return fx_log_sat(a & INT32_MAX);
}

static int32_t log2_of_positive(int32_t a)
{
    return fx_log2_sat(a & INT32_MAX);
}

static int32_t remainder_of_ten(int32_t a)
{
    return a % (10 * FX_ONE);
}

static int32_t pow_in_range(int32_t a, int32_t b)
{
    return fx_pow_sat((a & 0x7ffff) + 1, b >> 15);
}

static int32_t asin_in_range(int32_t a)
{
    return fx_asin(a >> 15);
}

static int32_t sqrt_u64(int32_t a, int32_t b)
{
    return (int32_t)fx_sqrt_u64((uint64_t)(uint32_t)a << 32 | (uint32_t)b);
}

/* Arrays: what one element takes. */
static fx_t array[CALLS];

static void run_add_array(void)
{
    fx_add_array_sat(array, inputs, inputs + 1, CALLS);
    sum = (uint32_t)array[CALLS / 2];
}

static void run_mul_array(void)
{
    fx_mul_array_sat(array, inputs, inputs + 1, CALLS);
    sum = (uint32_t)array[CALLS / 2];
}

static void run_scale_array(void)
{
    fx_scale_array_sat(array, inputs, inputs[3], CALLS);
    sum = (uint32_t)array[CALLS / 2];
}

static void run_sum_array(void)
{
    sum = (uint32_t)(fx_sum_array_sat(inputs, CALLS) >> 16);
}

static void run_dot_array(void)
{
    sum = (uint32_t)(fx_dot_array_sat(inputs, inputs + 1, CALLS) >> 16);
}

static int32_t sum_add(int32_t a, int32_t b)
{
    return (int32_t)(fx_sum_add_sat(fx_sum_of(a), fx_sum_of(b)) >> 16);
}

static int32_t sum_mul(int32_t a, int32_t b)
{
    return (int32_t)(fx_sum_mul_sat(fx_sum_of(a), a, b) >> 16);
}

static int32_t sincos(int32_t a)
{
    int32_t s, c;
    fx_sincos_q30((uint32_t)a, &s, &c);
    return s + c;
}

static int32_t convert(int32_t a)
{
    return fx_convert_sat(a, 16, 24);
}

static int32_t cot_half(int32_t a)
{
    return fx_cot_half_q20((a & 0x7fffff) + FX_ONE);
}

static int32_t text_of_3_places(int32_t a)
{
    char text[FX_TEXT_SIZE];
    return fx_to_text_rounded(a, 3, text);
}

UNARY(empty)
UNARY(remainder_of_ten)
UNARY(fx_rcp_sat)
UNARY(fx_sqrt)
UNARY(fx_sin)
UNARY(fx_tan_sat)
UNARY(sincos)
UNARY(exp_in_range)
UNARY(exp2_in_range)
UNARY(sinh_in_range)
UNARY(cosh_in_range)
UNARY(tanh_in_range)
UNARY(log_of_positive)
UNARY(log2_of_positive)
UNARY(asin_in_range)
UNARY(cot_half)
UNARY(fx_turns_from_rad)
UNARY(fx_rad_from_turns_sat)
UNARY(fx_turn32_from_rad)
UNARY(fx_ceil_sat)
UNARY(fx_round_sat)
UNARY(convert)
UNARY(text_of_3_places)
BINARY(fx_mul_sat)
BINARY(fx_div_sat)
BINARY(fx_atan2)
BINARY(fx_hypot_sat)
BINARY(fx_fmod)
BINARY(pow_in_range)
BINARY(sqrt_u64)
BINARY(sum_add)
BINARY(sum_mul)

#define ROW(f)                                                                                                         \
    {                                                                                                                  \
#f, run_##f                                                                                                    \
    }

static const struct row {
    const char *name;
    void (*run)(void);
} rows[] = {
    ROW(empty),
    ROW(remainder_of_ten),
    ROW(fx_mul_sat),
    ROW(fx_div_sat),
    ROW(fx_rcp_sat),
    ROW(fx_sqrt),
    ROW(sqrt_u64),
    ROW(fx_hypot_sat),
    ROW(fx_sin),
    ROW(sincos),
    ROW(fx_tan_sat),
    ROW(fx_atan2),
    ROW(asin_in_range),
    ROW(exp_in_range),
    ROW(exp2_in_range),
    ROW(sinh_in_range),
    ROW(cosh_in_range),
    ROW(tanh_in_range),
    ROW(log_of_positive),
    ROW(log2_of_positive),
    ROW(pow_in_range),
    ROW(cot_half),
    ROW(fx_turns_from_rad),
    ROW(fx_rad_from_turns_sat),
    ROW(fx_turn32_from_rad),
    ROW(fx_ceil_sat),
    ROW(fx_round_sat),
    ROW(fx_fmod),
    ROW(convert),
    ROW(text_of_3_places),
    ROW(sum_add),
    ROW(sum_mul),
    ROW(add_array),
    ROW(mul_array),
    ROW(scale_array),
    ROW(sum_array),
    ROW(dot_array),
};

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"};
    uint32_t noise = 1;
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    for (int i = 0; i <= CALLS; i++) {
        noise = noise * 1664525u + 1013904223u;
        inputs[i] = (int32_t)noise >> (noise >> 4 & 15);
    }
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct row *row = &rows[i];
        sum = 0;
        row->run();
        char text[9] = "";
        for (int k = 0; k < 8; k++) {
            text[k] = "0123456789abcdef"[sum >> (28 - 4 * k) & 15];
        }
        const char *const what[3] = {row->name, text, "-"};
        machine_start();
        row->run();
        machine_stop(what, CALLS);
    }
    return 0;
}
