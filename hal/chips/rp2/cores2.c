/*
 * See port.h: the second core takes a function and its argument from the FIFO between the cores, runs it and answers
 * with 0. While core 0 waits for that, core 1 can give it work in the same way. RP2040 datasheet 2.3.1.4 (FIFO), 2.8.2
 * (how core 1 is started), 2.13 (power-on state machine).
 *
 * A core that waits on an empty FIFO sleeps; the core that pushes sends an event to wake it.
 */
#include "port.h"
#include <cpu.h>
#include "rp2.h"

#define GUARD_BYTES_LOG2 8 /* the MPU's least region; the lowest bytes of the stack, see PORT_CORE1_EXTRA */

extern uint64_t ld_stack_core1[], ld_stack_core1_top[]; /* rp2040.ld, rp2350.ld */

static struct {
    bool started, busy;
} core1;

static volatile bool core0_waits; /* for core 1: it takes work from it */

HAL_TIER(loop) static void push(uint32_t word)
{
    __asm volatile("" ::: "memory"); /* all that the other core reads is in memory by now */
    while ((REG(SIO_FIFO_ST) & FIFO_WRITABLE) == 0) {
    }
    REG(SIO_FIFO_WR) = word;
    cpu_send_event();
}

HAL_TIER(loop) static uint32_t pull(void)
{
    while ((REG(SIO_FIFO_ST) & FIFO_READABLE) == 0) {
        cpu_wait_event();
    }
    return REG(SIO_FIFO_RD);
}

static void drain(void)
{
    while ((REG(SIO_FIFO_ST) & FIFO_READABLE) != 0) {
        (void)REG(SIO_FIFO_RD);
    }
}

HAL_TIER(loop) static void give(void (*run)(void *argument), void *argument)
{
    push((uint32_t)run);
    push((uint32_t)argument);
}

/* A core's turn: its run and argument come from the other core, which gets a 0. */
HAL_TIER(loop) static inline void take(uint32_t run)
{
    void *const argument = (void *)pull();
    ((void (*)(void *))run)(argument);
    push(0);
}

/* The main loop of core 1. */
static _Noreturn void serve(void) /* called as vector */ /* calls run, each, ahead */
{
    rp2_guard((uint32_t)(uintptr_t)ld_stack_core1, GUARD_BYTES_LOG2);
    for (;;) {
        take(pull());
    }
}

/* Puts core 1 into the waiting loop of its ROM, wherever it was. */
static void reset_core1(void)
{
    REG_SET(PSM_FRCE_OFF) = PSM_PROC1;
    while ((REG(PSM_FRCE_OFF) & PSM_PROC1) == 0) {
    }
    REG_CLEAR(PSM_FRCE_OFF) = PSM_PROC1;
}

/* The ROM echoes each word of the sequence; after a wrong echo the sequence starts again. */
static void start_core1(void)
{
    const uint32_t vector_table = cpu_vectors();
    const uint32_t words[] = {0, 0, 1, vector_table, (uint32_t)(uintptr_t)ld_stack_core1_top, (uint32_t)serve};
    reset_core1();
    for (uint32_t i = 0; i < sizeof words / sizeof *words;) {
        if (words[i] == 0) {
            drain();
            cpu_send_event();
        }
        push(words[i]);
        i = pull() == words[i] ? i + 1 : 0;
    }
    core1.started = true;
}

static bool is_core1(void)
{
    return REG(SIO_CPUID) != 0;
}

HAL_TIER(loop) void port_core_join(void) /* calls run */
{
    if (is_core1()) {
        (void)pull();
    } else if (core1.busy) {
        core0_waits = true;
        for (uint32_t run = pull(); run != 0; run = pull()) {
            take(run);
        }
        core0_waits = core1.busy = false;
    }
}

HAL_TIER(loop) bool port_core_run(void (*run)(void *argument), void *argument)
{
    if (is_core1() ? !core0_waits : core1.busy && (REG(SIO_FIFO_ST) & FIFO_READABLE) == 0) {
        return false;
    }
    if (!is_core1()) {
        if (core1.busy) {
            (void)pull(); /* it is there: core 1 has returned */
        }
        core1.busy = true;
        if (!core1.started) {
            start_core1();
        }
    }
    give(run, argument);
    return true;
}
