/* cpu: the RP2350's Cortex-M33 cores; see hal/rp2040/cpu.h. ARMv8-M Architecture Reference Manual D1.2 (MSPLIM). */
#ifndef RP2350_CPU_H
#define RP2350_CPU_H

#include "chips/rp2/arm.h"

/* The stack pointer of the core that calls it never goes below the end of the region: a push that would is a fault. */
static inline void guard_stack(uint32_t from, uint32_t bytes_log2)
{
    __asm volatile("msr msplim, %0" : : "r"(from + (1U << bytes_log2)));
}

typedef void *lookup_fn(uint32_t code, uint32_t mask);
typedef int reboot_fn(uint32_t flags, uint32_t delay_ms, uint32_t p0, uint32_t p1);

/* Calls the ROM's reboot(), which the ROM finds by two letters and the caller's state (RP2350 datasheet 5.4.8.24). The
 * asm hides the address: compilers expect no object so near to 0. */
static inline void start_boot_loader(void)
{
    uintptr_t at = 0x16;
    __asm("" : "+r"(at));
    lookup_fn *const lookup = (lookup_fn *)(uintptr_t) * (const uint16_t *)at;
    /* Secure Arm; boot loader, does not return. */
    ((reboot_fn *)lookup('R' | 'B' << 8, 4))(0x102, 10, 0, 0); /* calls rom */
}

#endif
