/* fx_armv6m: the functions that ARMv6-M has of its own for fx.h, under other names, to compare both in one program. */
#ifndef FX_ARMV6M_H
#define FX_ARMV6M_H

#include "fx.h"

#undef FX_CPU_H
#undef FX_APART
#undef FX_DIVIDES_64
#undef FX_DIVIDES_32
#undef FX_MULTIPLIES
#define fx_clz32      armv6m_clz32
#define fx_mulhi_u32  armv6m_mulhi_u32
#define fx_mul_wide   armv6m_mul_wide
#define fx_mul_wide_u armv6m_mul_wide_u
#define fx_rcp16      armv6m_rcp16
#define fx_clz_table  armv6m_clz_table
#include "armv6m/fx_clz.c" /* NOLINT(bugprone-suspicious-include) */
#include "armv6m/fx_cpu.h"
#undef fx_clz32
#undef fx_mulhi_u32
#undef fx_mul_wide
#undef fx_mul_wide_u
#undef fx_rcp16
#undef fx_clz_table

#endif
