/* fx_pow: powers. See fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"

fx_t fx_pow_sat(fx_t x, fx_t y)
{
    if (y == 0) {
        return FX_ONE;
    }
    if (x == 0) {
        return y < 0 ? FX_MAX : 0;
    }
    if (x < 0 && (y & 0xffff) != 0) {
        return 0;
    }
    const uint32_t size = fx_exp2_product(y, fx_log2_q58(fx_magnitude(x)));
    if (x < 0 && (y & FX_ONE) != 0) {
        return (fx_t)(0u - size);
    }
    return size > (uint32_t)FX_MAX ? FX_MAX : (fx_t)size;
}
