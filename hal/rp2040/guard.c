/* See rp2040.h: what happens when a stack runs over. RP2040 datasheet 4.7 (watchdog), 2.13 (what it resets). */
#include <registers.h>
#include "rp2040.h"

#define TICK_US     100000 /* of each core */
#define WATCHDOG_US 500000
#define ARMED       0x50696e68 /* in SCRATCH0: a boot loader starts images by the watchdog, too */

static volatile struct {
    bool seen, alive; /* since it started, since the last tick of core 0 */
} core1;

static void feed(void)
{
    REG(WATCHDOG_LOAD) = WATCHDOG_TICKS_US * WATCHDOG_US;
}

void rp2040_tick(void)
{
    if (REG(SIO_CPUID) != 0) {
        core1.seen = core1.alive = true;
    } else if (core1.alive || !core1.seen) {
        core1.alive = false;
        feed();
    }
}

/* SysTick: on, interrupt, the core's clock. */
void rp2040_guard(uint32_t from, uint32_t bytes_log2)
{
    guard_stack(from, bytes_log2);
    REG(SYST_RVR) = CLK_HZ / 1000000 * TICK_US - 1;
    REG(SYST_CVR) = 0;
    REG(SYST_CSR) = 7;
}

void rp2040_watchdog_start(void)
{
    REG(PSM_WDSEL) = PSM_ALL & ~PSM_OSCILLATORS;
    REG(WATCHDOG_SCRATCH0) = ARMED;
    feed();
    REG_SET(WATCHDOG_CTRL) = WATCHDOG_ENABLE;
}

void rp2040_watchdog_stop(void)
{
    REG_CLEAR(WATCHDOG_CTRL) = WATCHDOG_ENABLE;
    REG(WATCHDOG_SCRATCH0) = 0;
    REG(SYST_CSR) = 0;
}

bool rp2040_watchdog_bit(void)
{
    return (REG(WATCHDOG_REASON) & REASON_TIMER) != 0 && REG(WATCHDOG_SCRATCH0) == ARMED;
}
