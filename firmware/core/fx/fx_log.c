/* fx_log: logarithms. See fx_math.h. */
#include "fx_math.h"
#include "fx_wide.h"

/*
 * Two factors take a number of 1 .. 2 down to 1 .. 1.005, and their logarithms are added up. Entry i of the first
 * serves for 1 + i/16 and above, up to the next one: the smallest 6-bit factor that keeps the product at 1 or more.
 */
const uint8_t fx_log_factor_first[16] = {64, 61, 57, 54, 52, 49, 47, 45, 43, 41, 40, 38, 37, 36, 35, 34}; /* 2^-6 */

/* Entry i is -log2(fx_log_factor_first[i] / 64) in 2^-64. */
const uint64_t fx_log_first[16] = {
    0x0000000000000000, 0x11bb32a600549d0d, 0x2ac7b853ff596419, 0x3ebfb1520c7c6921,
    0x4caffb8dc3b9a197, 0x62a2602afef4c99a, 0x7206770b517f90e2, 0x8215ea5cd3e4c4c8,
    0x92e050231df57d70, 0xa47778c98bcc86a2, 0xad961ed0cb91d407, 0xc087d28dfb2febb9,
    0xca6143a49626d820, 0xd47fcb8c0852f0c1, 0xdee74ee64b0c38d4, 0xe99c090536ece983,
};

/* Entry i serves for 1 + i/256 and above: the smallest 10-bit factor that leaves at least 1 is 1 - entry / 1024. */
const uint8_t fx_log_factor_second[19] = {0, 3, 7, 11, 15, 19, 23, 27, 31, 34, 38, 42, 45, 49, 53, 56, 60, 63, 67};

/* Entry i is -log2(1 - fx_log_factor_second[i] / 1024) in 2^-64. */
const uint64_t fx_log_second[19] = {
    0x0000000000000000, 0x0115676c8c7a8c0c, 0x02888bef9791fa3d, 0x03fd26e1ded1c357, 0x05733b39e292a789,
    0x06eacbf72d1bb1b3, 0x0863dc22778bca6a, 0x09de6ecdcf80799b, 0x0b5a8714bd7e6703, 0x0c789adc083c88cf,
    0x0df7648a8d561729, 0x0f77bc92845b4eb1, 0x109905f797047bd6, 0x121c1ef55f06c205, 0x13a0cf56a06c4aa4,
    0x14c560fe68af880e, 0x164ce26c067156b4, 0x177394c9d958d55e, 0x18fdf1ca8eea6a0d,
};

/* ln(1 + r) in 2^-71 of an r in 2^-71 below 2^-7.6: r - r^2/2 + r^3/3 - .. - r^6/6. */
static uint64_t log_near_one(uint64_t r)
{
    const uint64_t square = fx_mulhi_u64(r, r);                            /* 2^-78 */
    const uint32_t short_r = (uint32_t)(r >> 32);                          /* 2^-39 */
    const uint32_t cube = fx_mulhi_u32((uint32_t)(square >> 32), short_r); /* 2^-53 */
    uint32_t sum = 858993459 - (fx_mulhi_u32(short_r, 715827883) >> 7);    /* 1/5 - r/6 in 2^-32 */
    sum = ((uint32_t)1 << 30) - (fx_mulhi_u32(short_r, sum) >> 7);         /* 1/4 - .. */
    sum = 1431655765 - (fx_mulhi_u32(short_r, sum) >> 7);                  /* 1/3 - .. */
    return r - (square >> 8) + (fx_mul_wide_u(cube, sum) >> 14);
}

int64_t fx_log2_q58(uint32_t a)
{
    const int shift = fx_clz32(a);
    const uint32_t m = a << shift;
    const uint32_t i = m >> 27 & 15;
    const uint64_t first = fx_mul_wide_u(m, fx_log_factor_first[i]); /* 2^-37 */
    const uint32_t j = (uint32_t)(first >> 29) & 255;
    const uint64_t second = (first << 10) - first * fx_log_factor_second[j]; /* 2^-47 */
    /* The shift by 24 drops the leading 1. */
    const uint64_t rest = fx_mulhi_u64(log_near_one(second << 24), 0xb8aa3b295c17f0bc); /* times log2(e): 2^-70 */
    const uint64_t fraction = (fx_log_first[i] >> 6) + (fx_log_second[j] >> 6) + (rest >> 12);
    return (int64_t)(fraction + ((uint64_t)(int64_t)(15 - shift) << 58));
}

fx_t fx_log2_sat(fx_t a)
{
    return a <= 0 ? FX_MIN : (fx_t)((fx_log2_q58((uint32_t)a) + ((int64_t)1 << 41)) >> 42);
}

fx_t fx_log_sat(fx_t a)
{
    if (a <= 0) {
        return FX_MIN;
    }
    const int64_t log2 = fx_log2_q58((uint32_t)a);
    const uint64_t size = fx_mulhi_u64((uint64_t)(log2 < 0 ? -log2 : log2), 0xb17217f7d1cf79ac); /* times ln 2 */
    const fx_t log = (fx_t)((size + ((uint64_t)1 << 41)) >> 42);
    return log2 < 0 ? -log : log;
}
