/* How an image for an RP2040 or RP2350 comes to main(), and what happens at a fault or at its end. The ROM comes here
 * through boot2.S and entry.S. */
#include "port.h"
#include <cpu.h>
#include "flash.h"
#include "rp2.h"

#define GUARD_BYTES_LOG2 16 /* below RAM, where it costs nothing */

extern uint32_t ld_stack[], ld_stack_top[]; /* rp2040.ld, rp2350.ld */

/* For entry.S, which has the third: a semihosting call (Arm, "Semihosting for AArch32 and AArch64"). */
_Noreturn void rp2_start(void);
_Noreturn void rp2_fault(uint32_t pc, uint32_t called_from);
void rp2_semihosting(uint32_t operation, uint32_t reason);
int main(void);

static void put_hex(uint32_t value)
{
    char text[11] = "0x";
    for (uint32_t i = 0; i < 8; i++) {
        text[2 + i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15];
    }
    text[10] = '\0';
    port_log(text);
}

static _Noreturn void stop(void)
{
    rp2_watchdog_stop();
    for (;;) {
        cpu_interrupts_off();
        __asm volatile("wfi");
    }
}

void rp2_fault(uint32_t pc, uint32_t called_from)
{
    rp2_dark();
    if (cpu_is_semihosting(pc)) {
        stop(); /* from port_exit, without a debugger */
    }
    port_log("\r\nfault at ");
    put_hex(pc);
    port_log(", called from ");
    put_hex(called_from);
    port_log(REG(SIO_CPUID) == 0 ? ", core 0\r\n" : ", core 1\r\n");
    stop();
}

void port_exit(int status)
{
    rp2_dark();
    rp2_semihosting(0x18, status == 0 ? 0x20026 : 0x20023); /* SYS_EXIT: application exit, or an error */
    stop();
}

/* The lowest word of the stack that no longer holds the paint of entry.S tells how far the stack came. */
uint32_t port_stack_used(void)
{
    const uint32_t top = (uint32_t)(uintptr_t)ld_stack_top;
    const uint32_t *low = ld_stack;
    while ((uint32_t)(uintptr_t)low < top && *low == (uint32_t)(uintptr_t)low) {
        low++;
    }
    return top - (uint32_t)(uintptr_t)low;
}

void rp2_start(void)
{
    const bool bit = rp2_watchdog_bit();
    rp2_watchdog_stop();
    rp2_flash_open();
    rp2_clocks_init();
    rp2_uart_init();
    if (bit) {
        rp2_dark();
        port_log("\r\nthe watchdog bit: a stack ran over, or a core hangs\r\n");
        stop();
    }
    rp2_guard((uint32_t)(uintptr_t)ld_stack - (1U << GUARD_BYTES_LOG2), GUARD_BYTES_LOG2);
    rp2_watchdog_start();
    port_exit(main());
    stop();
}
