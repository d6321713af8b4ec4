/* fx_cpu: the functions of fx.h that depend on the CPU, in their portable form. fx.h says what each returns. */
#ifndef FX_CPU_H
#define FX_CPU_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef FX_DIVIDES_64 /* 1: a 64-bit division is one instruction */
#define FX_DIVIDES_64 0
#endif
#define FX_DIVIDES_32 1                                     /* 1: a 32-bit division is */
#define FX_MULTIPLIES 1                                     /* 1: a product of 64 bits takes a few instructions */
#define FX_APART      inline __attribute__((always_inline)) /* 13 registers or more: calls are what costs */

inline int fx_clz32(uint32_t v)
{
    return v != 0 ? __builtin_clz(v) : 32;
}

inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b)
{
    return (uint32_t)((uint64_t)a * b >> 32);
}

static inline int64_t fx_mul_wide(int32_t a, int32_t b)
{
    return (int64_t)a * b;
}

static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b)
{
    return (uint64_t)a * b;
}

static inline uint32_t fx_rcp16(uint32_t d)
{
    return 0x7fffffffu / d; /* NOLINT(clang-analyzer-core.DivideZero): d > 0, see fx.h */
}

#ifdef __cplusplus
}
#endif

#endif
