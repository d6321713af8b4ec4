/* fx_array: sums in Q32.32, and arrays. See fx_math.h. */
#include "fx_math.h"

fx_sum_t fx_sum_add_sat(fx_sum_t a, fx_sum_t b)
{
    const uint64_t sum = (uint64_t)a + (uint64_t)b, overflow = ((uint64_t)a ^ sum) & ((uint64_t)b ^ sum);
    return (int64_t)overflow >= 0 ? (fx_sum_t)sum : a < 0 ? INT64_MIN : INT64_MAX;
}

fx_sum_t fx_sum_mul_sat(fx_sum_t sum, fx_t a, fx_t b)
{
    return fx_sum_add_sat(sum, fx_mul_wide(a, b));
}

fx_t fx_from_sum_sat(fx_sum_t sum)
{
    return fx_sat64((sum >> 16) + (sum >> 15 & 1));
}

void fx_add_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        to[i] = fx_add_sat(a[i], b[i]);
    }
}

void fx_sub_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        to[i] = fx_sub_sat(a[i], b[i]);
    }
}

void fx_mul_array_sat(fx_t *to, const fx_t *a, const fx_t *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        to[i] = fx_mul_sat(a[i], b[i]);
    }
}

void fx_scale_array_sat(fx_t *to, const fx_t *a, fx_t by, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        to[i] = fx_mul_sat(a[i], by);
    }
}

void fx_map_array(fx_t *to, const fx_t *a, size_t n, fx_t (*f)(fx_t))
{
    for (size_t i = 0; i < n; i++) {
        to[i] = f(a[i]);
    }
}

fx_sum_t fx_sum_array_sat(const fx_t *a, size_t n)
{
    fx_sum_t sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum = fx_sum_add_sat(sum, fx_sum_of(a[i]));
    }
    return sum;
}

fx_sum_t fx_dot_array_sat(const fx_t *a, const fx_t *b, size_t n)
{
    fx_sum_t sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum = fx_sum_mul_sat(sum, a[i], b[i]);
    }
    return sum;
}
