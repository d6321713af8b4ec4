/* fx_cpu for x86-64: the portable form, but a 64-bit division is one instruction. */
#define FX_DIVIDES_64 1
#include "../portable/fx_cpu.h"
