/* fx_mul: fx_mul_wide as a function, see fx.h. */
#include "fx.h"

int64_t fx_mul_far(int32_t a, int32_t b)
{
    return (int64_t)a * b;
}
