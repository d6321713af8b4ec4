/* fx_hypot: the length of a vector in the plane. See fx_math.h. */
#include "fx_math.h"

fx_t fx_hypot_sat(fx_t x, fx_t y)
{
    const uint32_t ax = fx_magnitude(x), ay = fx_magnitude(y);
    const uint64_t sum = fx_mul_wide_u(ax, ax) + fx_mul_wide_u(ay, ay); /* <= 2^63 */
    const uint32_t root = fx_sqrt_u64(sum);
    if (root >= (uint32_t)FX_MAX) {
        return FX_MAX;
    }
    return (fx_t)(root + (sum - fx_mul_wide_u(root, root) > root)); /* nearer to root + 1 */
}
