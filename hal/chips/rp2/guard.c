/* See rp2.h: what happens when a stack runs over. RP2040 datasheet 4.7 (watchdog), 2.13 (what it resets). */
#include <cpu.h>
#include "rp2.h"

#define WATCHDOG_US 500000
#define ARMED       0x50696e68 /* in SCRATCH0: a boot loader starts images by the watchdog, too */

static volatile struct {
    bool seen, alive; /* since it started, since the last tick of core 0 */
} core1;

static void feed(void)
{
    REG(WATCHDOG_LOAD) = WATCHDOG_TICKS_US * WATCHDOG_US;
}

void rp2_tick(void)
{
    if (REG(SIO_CPUID) != 0) {
        core1.seen = core1.alive = true;
    } else if (core1.alive || !core1.seen) {
        core1.alive = false;
        feed();
    }
}

void rp2_guard(uint32_t from, uint32_t bytes_log2)
{
    guard_stack(from, bytes_log2);
    cpu_tick_start(TICK_CYCLES);
}

void rp2_watchdog_start(void)
{
    REG(PSM_WDSEL) = PSM_ALL & ~PSM_OSCILLATORS;
    REG(WATCHDOG_SCRATCH0) = ARMED;
    feed();
    REG_SET(WATCHDOG_CTRL) = WATCHDOG_ENABLE;
}

void rp2_watchdog_stop(void)
{
    REG_CLEAR(WATCHDOG_CTRL) = WATCHDOG_ENABLE;
    REG(WATCHDOG_SCRATCH0) = 0;
    cpu_tick_stop();
}

bool rp2_watchdog_bit(void)
{
    return (REG(WATCHDOG_REASON) & REASON_TIMER) != 0 && REG(WATCHDOG_SCRATCH0) == ARMED;
}
