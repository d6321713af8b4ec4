/*
 * QEMU mps2-an385 (Cortex-M3), mps2-an386 (M4F) or mps2-an505 (M33) under `-icount shift=0`: one instruction takes 1
 * ns. Application notes AN385, AN386: CMSDK timer 0 at 0x40000000 counts at 25 MHz, so a tick is 40 instructions, and
 * UART 0 is at 0x40004000. AN505: 0x50000000, 20 MHz, 50 instructions, 0x50200000 (their secure addresses). run.sh
 * gives these to the linker.
 */
#include "bench.h"
#include "machine_bare.h"

extern volatile uint32_t timer_base[], uart_base[];
extern char instructions_a_tick[];

enum { TIMER_CTRL, TIMER_VALUE, TIMER_RELOAD };
enum { UART_DATA = 0, UART_CTRL = 2, UART_BAUDDIV = 4 };

extern uint32_t stack_top[];
void reset(void);

/* The operation in r0, its argument in r1, where the calling convention puts them. */
__attribute__((naked, noinline)) void machine_semihost(uint32_t operation __attribute__((unused)),
                                                       const void *argument __attribute__((unused)))
{
    __asm__ volatile("bkpt 0xAB\n"
                     "bx lr\n");
}

static void fault(void)
{
    machine_print("fault\n");
    machine_quit(3);
}

__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    (void (*)(void))stack_top, reset, fault, fault, fault, fault, fault};

void reset(void)
{
    uart_base[UART_BAUDDIV] = 16;
    uart_base[UART_CTRL] = 1;
    timer_base[TIMER_RELOAD] = UINT32_MAX;
    timer_base[TIMER_VALUE] = UINT32_MAX;
    timer_base[TIMER_CTRL] = 1;
    machine_run();
}

/* The timer counts down; differences of products modulo 2^32 are right. */
uint32_t machine_count(void)
{
    return (0u - timer_base[TIMER_VALUE]) * (uint32_t)(uintptr_t)instructions_a_tick;
}

void machine_known_loop(void)
{
    uint32_t turns = 1000000;
    __asm__ volatile(".syntax unified\n1: subs %0, #1\n bne 1b" : "+l"(turns) : : "cc");
}

void machine_print(const char *text)
{
    while (*text != '\0') {
        uart_base[UART_DATA] = (uint8_t)*text++;
    }
}
