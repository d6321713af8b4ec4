/*
 * What gcc calls for a product of 64 bits and for a division. On an ESP8266 they lie in the ROM, so gcc's library has
 * none. These take about as many instructions: products of 16 bits, and a turn of a loop for each bit of a quotient.
 */
#include <stdint.h>

uint32_t __udivsi3(uint32_t n, uint32_t d);
uint32_t __umodsi3(uint32_t n, uint32_t d);
int32_t __divsi3(int32_t n, int32_t d);
int32_t __modsi3(int32_t n, int32_t d);
uint64_t __umulsidi3(uint32_t a, uint32_t b);
uint64_t __muldi3(uint64_t a, uint64_t b);
uint64_t __udivdi3(uint64_t n, uint64_t d);
uint64_t __umoddi3(uint64_t n, uint64_t d);
int64_t __divdi3(int64_t n, int64_t d);

/* The quotient of one bit after the other, as on paper; d > 0. */
static inline uint32_t divide(uint32_t n, uint32_t d, uint32_t *rest)
{
    uint32_t quotient = 0;
    if (n >= d) {
        const int shift = __builtin_clz(d) - __builtin_clz(n);
        const uint32_t last = d;
        for (d <<= shift;; d >>= 1) {
            quotient <<= 1;
            if (n >= d) {
                n -= d;
                quotient++;
            }
            if (d == last) {
                break;
            }
        }
    }
    *rest = n;
    return quotient;
}

uint32_t __udivsi3(uint32_t n, uint32_t d)
{
    uint32_t rest;
    return divide(n, d, &rest);
}

uint32_t __umodsi3(uint32_t n, uint32_t d)
{
    uint32_t rest;
    divide(n, d, &rest);
    return rest;
}

static inline uint32_t size_of(int32_t v)
{
    return v < 0 ? 0u - (uint32_t)v : (uint32_t)v;
}

int32_t __divsi3(int32_t n, int32_t d)
{
    uint32_t rest;
    const uint32_t q = divide(size_of(n), size_of(d), &rest);
    return (int32_t)((n ^ d) < 0 ? 0u - q : q);
}

int32_t __modsi3(int32_t n, int32_t d)
{
    uint32_t rest;
    divide(size_of(n), size_of(d), &rest);
    return (int32_t)(n < 0 ? 0u - rest : rest);
}

/* Four products of 16 bits; the sums of two never carry out of 32 bits. */
uint64_t __umulsidi3(uint32_t a, uint32_t b)
{
    const uint32_t al = a & 0xffff, ah = a >> 16;
    const uint32_t bl = b & 0xffff, bh = b >> 16;
    const uint32_t m1 = ah * bl + ((al * bl) >> 16);
    const uint32_t m2 = al * bh + (m1 & 0xffff);
    return (uint64_t)(ah * bh + (m1 >> 16) + (m2 >> 16)) << 32 | a * b;
}

uint64_t __muldi3(uint64_t a, uint64_t b)
{
    const uint32_t cross = (uint32_t)a * (uint32_t)(b >> 32) + (uint32_t)(a >> 32) * (uint32_t)b;
    return __umulsidi3((uint32_t)a, (uint32_t)b) + ((uint64_t)cross << 32);
}

static int zeros(uint64_t v)
{
    return v >> 32 != 0 ? __builtin_clz((uint32_t)(v >> 32)) : 32 + __builtin_clz((uint32_t)v);
}

static uint64_t divide_wide(uint64_t n, uint64_t d, uint64_t *rest)
{
    uint64_t quotient = 0;
    if (n >> 32 == 0 && d >> 32 == 0) {
        uint32_t r;
        quotient = divide((uint32_t)n, (uint32_t)d, &r);
        n = r;
    } else if (n >= d) {
        const int shift = zeros(d) - zeros(n);
        d <<= shift;
        for (int bit = 0; bit <= shift; bit++, d >>= 1) {
            quotient <<= 1;
            if (n >= d) {
                n -= d;
                quotient++;
            }
        }
    }
    *rest = n;
    return quotient;
}

uint64_t __udivdi3(uint64_t n, uint64_t d)
{
    uint64_t rest;
    return divide_wide(n, d, &rest);
}

uint64_t __umoddi3(uint64_t n, uint64_t d)
{
    uint64_t rest;
    divide_wide(n, d, &rest);
    return rest;
}

int64_t __divdi3(int64_t n, int64_t d)
{
    uint64_t rest;
    const uint64_t q =
        divide_wide(n < 0 ? 0u - (uint64_t)n : (uint64_t)n, d < 0 ? 0u - (uint64_t)d : (uint64_t)d, &rest);
    return (int64_t)((n ^ d) < 0 ? 0u - q : q);
}
