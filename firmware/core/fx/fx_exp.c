/* fx_exp: powers of two and of e. See fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"

/* Entry i is 2^(i/16) in 2^-63. */
const uint64_t fx_exp2_coarse[16] = {
    0x8000000000000000, 0x85aac367cc487b15, 0x8b95c1e3ea8bd6e7, 0x91c3d373ab11c336,
    0x9837f0518db8a96f, 0x9ef5326091a111ae, 0xa5fed6a9b15138ea, 0xad583eea42a14ac6,
    0xb504f333f9de6484, 0xbd08a39f580c36bf, 0xc5672a115506dadd, 0xce248c151f8480e4,
    0xd744fccad69d6af4, 0xe0ccdeec2a94e111, 0xeac0c6e7dd24392f, 0xf5257d152486cc2c,
};

/* Entry i is 2^(i/256) in 2^-63. */
const uint64_t fx_exp2_fine[16] = {
    0x8000000000000000, 0x8058d7d2d5e5f6b1, 0x80b1ed4fd999ab6c, 0x810b40a1d81406d4,
    0x8164d1f3bc030773, 0x81bea1708dde6056, 0x8218af4373fc25ec, 0x8272fb97b2a5894c,
    0x82cd8698ac2ba1d7, 0x83285071e0fc4547, 0x8383594eefb6ee37, 0x83dea15b9541b132,
    0x843a28c3acde4046, 0x8495efb3303efd30, 0x84f1f656379c1a29, 0x854e3cd8f9c8c95d,
};

/* 2^(f / 2^64) in 2^-62, with a relative error < 2^-57: the two nodes below f, times e^u = 1 + u + u^2/2 + .. +
 * u^5/120. */
static uint64_t exp2_fraction(uint64_t f)
{
    const uint64_t node = fx_mulhi_u64(fx_exp2_coarse[f >> 60], fx_exp2_fine[f >> 56 & 15]);
    const uint64_t u = fx_mulhi_u64(f << 8, 0xb17217f7d1cf79ac); /* ln 2 times the rest, in 2^-72; below 2^-8.5 */
    const uint64_t square = fx_mulhi_u64(u, u);                  /* 2^-80 */
    const uint32_t short_u = (uint32_t)(u >> 32);                /* 2^-40 */
    const uint32_t cube = fx_mulhi_u32((uint32_t)(square >> 32), short_u); /* 2^-56 */
    uint32_t sum = 143165577 + (fx_mulhi_u32(short_u, 23860929) >> 8);     /* 1/120 + u/720 in 2^-34 */
    sum = 715827883 + (fx_mulhi_u32(short_u, sum) >> 8);                   /* 1/24 + .. */
    sum = 2863311531u + (fx_mulhi_u32(short_u, sum) >> 8);                 /* 1/6 + .. */
    const uint64_t grown = u + (square >> 9) + (fx_mul_wide_u(cube, sum) >> 18);
    return node + (fx_mulhi_u64(node, grown) >> 8);
}

uint64_t fx_exp2_parts(int32_t y, int64_t l_q58, int32_t *exponent)
{
    const uint64_t l = l_q58 < 0 ? 0u - (uint64_t)l_q58 : (uint64_t)l_q58;
    const uint32_t size = fx_magnitude(y);
    const uint64_t low = fx_mul_wide_u(size, (uint32_t)l);                                  /* 2^-74 */
    const uint64_t high = fx_mul_wide_u(size, (uint32_t)(l >> 32)) + (uint32_t)(low >> 32); /* 2^-42 */
    uint64_t f = high << 22 | (uint32_t)low >> 10;
    int32_t n = (int32_t)(high >> 42);
    if ((y < 0) != (l_q58 < 0)) { /* -(n + f) */
        n = f != 0 ? -n - 1 : -n;
        f = 0u - f;
    }
    *exponent = n;
    return exp2_fraction(f);
}

uint32_t fx_exp2_product(int32_t y, int64_t l_q58)
{
    int32_t n;
    const uint64_t fraction = fx_exp2_parts(y, l_q58, &n);
    if (n < -17 || n > 14) {
        return n < 0 ? 0 : (uint32_t)1 << 31;
    }
    const int shift = 46 - n;
    return (uint32_t)((fraction + ((uint64_t)1 << (shift - 1))) >> shift);
}

static fx_t clamped(uint32_t v)
{
    return v > (uint32_t)FX_MAX ? FX_MAX : (fx_t)v;
}

fx_t fx_exp2_sat(fx_t a)
{
    return clamped(fx_exp2_product(a, (int64_t)1 << 58));
}

fx_t fx_exp_sat(fx_t a)
{
    return clamped(fx_exp2_product(a, FX_LOG2_E_Q58));
}
