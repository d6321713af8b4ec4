/* The handlers of interrupts on the RP2350's RISC-V cores. None interrupts another. RP2350 datasheet 3.8.4.2,
 * 3.8.6.1. */
#include <cpu.h>

#include "chips/rp2/rp2.h"

/* For entry.S. */
void rp2350_timer(void);
void rp2350_external(void);

__attribute__((interrupt("machine"))) void rp2350_timer(void)
{
    cpu_tick_next(TICK_CYCLES);
    rp2_tick();
}

/* Ends by an event for a core that is about to wait for what the interrupt did. */
__attribute__((interrupt("machine"))) void rp2350_external(void)
{
    int32_t next;
    CSR_READ(MEINEXT, next);
    while (next >= 0) {
        if (next / 4 == IRQ_TIMER_0) {
            rp2_timer_interrupt();
        } else {
            rp2_bus_interrupt();
        }
        CSR_READ(MEINEXT, next);
    }
    cpu_send_event();
}
