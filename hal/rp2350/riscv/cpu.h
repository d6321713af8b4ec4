/*
 * cpu: the RP2350's Hazard3 cores; hal/chips/rp2/arm.h says what each function does. RP2350 datasheet 3.1.8 (timer of
 * the SIO), 3.4 (events), 3.8.3 (memory protection), 3.8.6.1 (interrupts), 5.4 (ROM).
 */
#ifndef RP2350_CPU_H
#define RP2350_CPU_H

#include <registers.h>

#include <stdbool.h>

#define SIO_MTIME_CTRL 0xd00001a4
#define SIO_MTIME      0xd00001b0
#define SIO_MTIMEH     0xd00001b4
#define SIO_MTIMECMP   0xd00001b8 /* each core's own */
#define SIO_MTIMECMPH  0xd00001bc

#define MSTATUS_MIE  8
#define MIE_TIMER    (1 << 7)
#define MIE_EXTERNAL (1 << 11)
enum { MCAUSE_BREAKPOINT = 3 };

/* Registers of the core, by name or number. */
#define CSR_READ(name, value)  __asm volatile("csrr %0, " name : "=r"(value))
#define CSR_WRITE(name, value) __asm volatile("csrw " name ", %0" : : "r"(value) : "memory")
#define CSR_SET(name, value)   __asm volatile("csrs " name ", %0" : : "r"(value) : "memory")
#define CSR_CLEAR(name, value) __asm volatile("csrc " name ", %0" : : "r"(value) : "memory")
#define MEIEA                  "0xbe0" /* external interrupts that are enabled, in windows of 16 */
#define MEINEXT                "0xbe4" /* the next external interrupt, x 4; negative: none */
#define PMPADDR0               "0x3b0"
#define PMPCFG0                "0x3a0"
#define PMPCFGM0               "0xbd0" /* regions that count for machine mode, too */

/* h3.block: ends at once if an event came since the last one. An interrupt's handler sends one, see trap.c. */
static inline void cpu_wait_event(void)
{
    __asm volatile("slt x0, x0, x0" ::: "memory");
}

/* h3.unblock: for both cores. */
static inline void cpu_send_event(void)
{
    __asm volatile("slt x0, x0, x1" ::: "memory");
}

static inline void cpu_interrupts_off(void)
{
    CSR_CLEAR("mstatus", MSTATUS_MIE);
}

static inline void cpu_interrupts_on(void)
{
    CSR_SET("mstatus", MSTATUS_MIE);
}

static inline void cpu_interrupt_enable(uint32_t irq)
{
    CSR_SET(MEIEA, 1U << (16 + irq % 16) | irq / 16);
    CSR_SET("mie", MIE_EXTERNAL);
}

/* The calling core's next tick. Until its compare register has all of the new time, it holds a later one. */
static inline void cpu_tick_next(uint32_t cycles)
{
    uint32_t high, low;
    do {
        high = REG(SIO_MTIMEH);
        low = REG(SIO_MTIME);
    } while (high != REG(SIO_MTIMEH));
    const uint64_t at = ((uint64_t)high << 32 | low) + cycles;
    REG(SIO_MTIMECMP) = UINT32_MAX;
    REG(SIO_MTIMECMPH) = (uint32_t)(at >> 32);
    REG(SIO_MTIMECMP) = (uint32_t)at;
}

static inline void cpu_tick_start(uint32_t cycles)
{
    REG(SIO_MTIME_CTRL) = 3; /* on, counts cycles */
    cpu_tick_next(cycles);
    CSR_SET("mie", MIE_TIMER);
    cpu_interrupts_on();
}

static inline void cpu_tick_stop(void)
{
    CSR_CLEAR("mie", MIE_TIMER);
}

static inline uint32_t cpu_vectors(void)
{
    uint32_t mtvec;
    CSR_READ("mtvec", mtvec);
    return mtvec;
}

static inline bool cpu_is_semihosting(uint32_t pc)
{
    uint32_t mcause;
    CSR_READ("mcause", mcause);
    (void)pc;
    return mcause == MCAUSE_BREAKPOINT;
}

/*
 * No access within the region, a power of two (NAPOT), elsewhere as without one. What a fault reports it needs a stack
 * for: it takes the place where the stack pointer is now (entry.S).
 */
static inline void guard_stack(uint32_t from, uint32_t bytes_log2)
{
    __asm volatile("csrw mscratch, sp");
    CSR_WRITE(PMPADDR0, from >> 2 | ((1U << (bytes_log2 - 3)) - 1));
    CSR_WRITE(PMPCFG0, 3U << 3);
    CSR_SET(PMPCFGM0, 1);
}

typedef void *lookup_fn(uint32_t code, uint32_t mask);
typedef int reboot_fn(uint32_t flags, uint32_t delay_ms, uint32_t p0, uint32_t p1);

/* Starts the boot loader in the ROM, as the Arm cores do. For RISC-V the ROM has the pointer to its look-up in its last
 * words (pico-sdk, bootrom_constants.h). */
static inline void start_boot_loader(void)
{
    uintptr_t at = 0x7dfa;
    __asm("" : "+r"(at));
    lookup_fn *const lookup = (lookup_fn *)(uintptr_t) * (const uint16_t *)at;
    /* RISC-V; boot loader, does not return. */
    ((reboot_fn *)lookup('R' | 'B' << 8, 1))(0x102, 10, 0, 0); /* calls rom */
}

#endif
