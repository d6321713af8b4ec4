/* fx_whole: whole numbers and remainders. See fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"

#define WHOLE_MAX FX_INT(32767)

fx_t fx_ceil_sat(fx_t a)
{
    return a > WHOLE_MAX ? FX_MAX : fx_floor(a + 0xffff);
}

fx_t fx_round_sat(fx_t a)
{
    return a >= WHOLE_MAX + FX_HALF ? FX_MAX : fx_floor(a + FX_HALF);
}

fx_t fx_fmod(fx_t a, fx_t b)
{
    const uint32_t n = fx_magnitude(a), d = fx_magnitude(b);
    if (d <= 1) { /* 0, or one LSB, which divides all */
        return 0;
    }
    const uint32_t rest = n - fx_quotient_u32(n, d) * d;
    return a < 0 ? (fx_t)(0u - rest) : (fx_t)rest;
}
