/* fx_cpu: the functions of fx.h that depend on the CPU, for the small profile: what is long is called, not inlined. It
 * stands in place of kernels/portable/fx_cpu.h. */
#ifndef FX_CPU_H
#define FX_CPU_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FX_DIVIDES_64 1 /* slowly; the other way has a table and takes 800 bytes */
#define FX_DIVIDES_32 0
#define FX_MULTIPLIES 1 /* no second way for what is near */
#define FX_APART      __attribute__((noinline))

int fx_clz_far(uint32_t v);
uint32_t fx_mulhi_far(uint32_t a, uint32_t b);
uint32_t fx_rcp16_far(uint32_t d);

inline int fx_clz32(uint32_t v)
{
    return fx_clz_far(v);
}

inline uint32_t fx_mulhi_u32(uint32_t a, uint32_t b)
{
    return fx_mulhi_far(a, b);
}

static inline int64_t fx_mul_wide(int32_t a, int32_t b)
{
    return fx_mul_far(a, b);
}

static inline uint64_t fx_mul_wide_u(uint32_t a, uint32_t b)
{
    return (uint64_t)fx_mulhi_far(a, b) << 32 | a * b;
}

static inline uint32_t fx_rcp16(uint32_t d)
{
    return fx_rcp16_far(d);
}

#ifdef __cplusplus
}
#endif

#endif
