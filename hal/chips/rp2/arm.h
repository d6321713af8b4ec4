/*
 * arm: what the port needs of an Arm core, Cortex-M0+ or M33, in its cpu.h. Architecture Reference Manuals of ARMv6-M,
 * B3.3 (SysTick), and ARMv8-M, B11.
 */
#ifndef RP2_ARM_H
#define RP2_ARM_H

#include <registers.h>

#include <stdbool.h>

#define SYST_CSR  0xe000e010
#define SYST_RVR  0xe000e014
#define SYST_CVR  0xe000e018
#define NVIC_ISER 0xe000e100
#define VTOR      0xe000ed08

#define BKPT_OPCODE 0xbeab /* of rp2_semihosting */

/* Sleeps until an interrupt ends or the other core sends an event; not at all if one of them came since the last time.
 */
static inline void cpu_wait_event(void)
{
    __asm volatile("wfe" ::: "memory");
}

static inline void cpu_send_event(void)
{
    __asm volatile("sev" ::: "memory");
}

static inline void cpu_interrupts_off(void)
{
    __asm volatile("cpsid i" ::: "memory");
}

static inline void cpu_interrupts_on(void)
{
    __asm volatile("cpsie i" ::: "memory");
}

static inline void cpu_interrupt_enable(uint32_t irq)
{
    REG(NVIC_ISER) = 1U << irq;
}

/* rp2_tick runs each time so many cycles have passed. */
static inline void cpu_tick_start(uint32_t cycles)
{
    REG(SYST_RVR) = cycles - 1;
    REG(SYST_CVR) = 0;
    REG(SYST_CSR) = 7; /* on, interrupt, the core's clock */
}

static inline void cpu_tick_stop(void)
{
    REG(SYST_CSR) = 0;
}

static inline uint32_t cpu_vectors(void)
{
    return REG(VTOR);
}

/* The fault at pc is a call of a debugger that is not there. */
static inline bool cpu_is_semihosting(uint32_t pc)
{
    return *(const uint16_t *)(uintptr_t)pc == BKPT_OPCODE;
}

#endif
