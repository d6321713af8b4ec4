/* fx_arcsin: the angles of a sine and of a cosine. See fx_math.h. */
#include "fx_math.h"

fx_t fx_asin(fx_t a)
{
    if (a >= FX_ONE || a <= -FX_ONE) {
        return a < 0 ? -FX_ONE / 4 : FX_ONE / 4;
    }
    const uint64_t square = fx_mul_wide_u(fx_magnitude(a), fx_magnitude(a));
    const uint32_t cosine = fx_sqrt_u64(((((uint64_t)1 << 32) - square) << 30) - 1); /* 2^-31, below 1 */
    return fx_atan2(a * 32768, (fx_t)cosine);
}

fx_t fx_acos(fx_t a)
{
    return FX_ONE / 4 - fx_asin(a);
}
