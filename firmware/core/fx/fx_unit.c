/* fx_unit: radians and other Q formats. See fx_math.h. */
#include "fx_math.h"

#define TURNS_PER_RADIAN 0xa2f9836e4e44152a /* 1 / (2 pi) in 2^-66 */
#define RADIANS_PER_TURN 0xc90fdaa22168c235 /* 2 pi in 2^-61 */

/* |a| factor / 2^drop, rounded to nearest; 32 <= drop <= 66. */
static uint64_t scaled(uint32_t a, uint64_t factor, int drop)
{
    const uint64_t high = fx_mul_wide_u(a, (uint32_t)(factor >> 32)) + fx_mulhi_u32(a, (uint32_t)factor);
    return (high + ((uint64_t)1 << (drop - 33))) >> (drop - 32);
}

fx_t fx_turns_from_rad(fx_t rad)
{
    const uint32_t turns = (uint32_t)scaled(fx_magnitude(rad), TURNS_PER_RADIAN, 66);
    return rad < 0 ? -(fx_t)turns : (fx_t)turns;
}

uint32_t fx_turn32_from_rad(fx_t rad)
{
    const uint32_t turn32 = (uint32_t)scaled(fx_magnitude(rad), TURNS_PER_RADIAN, 50);
    return rad < 0 ? 0u - turn32 : turn32;
}

fx_t fx_rad_from_turns_sat(fx_t turns)
{
    const uint64_t rad = scaled(fx_magnitude(turns), RADIANS_PER_TURN, 61);
    return fx_sat64(turns < 0 ? -(int64_t)rad : (int64_t)rad);
}

int32_t fx_convert_sat(int32_t a, int from_bits, int to_bits)
{
    const int up = to_bits - from_bits;
    if (up >= 0) {
        return fx_sat64((int64_t)((uint64_t)(int64_t)a << up));
    }
    return (int32_t)(((int64_t)a + ((int64_t)1 << (-up - 1))) >> -up);
}
