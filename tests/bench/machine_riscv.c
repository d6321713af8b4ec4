/*
 * QEMU's RISC-V machine virt under `-icount shift=0`: RAM at 0x80000000, where `-bios none` starts, and a 16550 UART at
 * 0x10000000. The CSR minstret counts instructions.
 */
#include "bench.h"
#include "machine_bare.h"

#define UART_THR (*(volatile uint8_t *)0x10000000)

void reset(void);
void fault(void);

/* RISC-V Semihosting 2.7: three instructions of 32 bits mark the call. */
__attribute__((naked, noinline, aligned(16))) void machine_semihost(uint32_t operation __attribute__((unused)),
                                                                    const void *argument __attribute__((unused)))
{
    __asm__ volatile(".option push\n"
                     ".option norvc\n"
                     "slli x0, x0, 0x1f\n"
                     "ebreak\n"
                     "srai x0, x0, 7\n"
                     ".option pop\n"
                     "ret\n");
}

__attribute__((used, aligned(4))) void fault(void)
{
    machine_print("fault\n");
    machine_quit(3);
}

__attribute__((naked, section(".vectors"))) void reset(void)
{
    __asm__ volatile("la sp, stack_top\n"
                     "la t0, fault\n"
                     "csrw mtvec, t0\n"
                     "j machine_run\n");
}

uint32_t machine_count(void)
{
    uint32_t count;
    __asm__ volatile("csrr %0, minstret" : "=r"(count));
    return count;
}

void machine_known_loop(void)
{
    uint32_t turns = 1000000;
    __asm__ volatile("1: addi %0, %0, -1\n bnez %0, 1b" : "+r"(turns));
}

void machine_print(const char *text)
{
    while (*text != '\0') {
        UART_THR = (uint8_t)*text++;
    }
}
