/* Vectors, the way to main(), faults. The ROM comes here through boot2.S and entry.S. */
#include "port.h"
#include "registers.h"
#include "rp2040.h"

#define BKPT_OPCODE 0xbeab /* of rp2040_end_emulator */

extern uint32_t ld_stack[], ld_stack_top[]; /* rp2040.ld */

void rp2040_reset(void);                       /* entry.S */
void rp2040_on_fault(void);                    /* entry.S */
void rp2040_end_emulator(uint32_t reason);     /* entry.S */
_Noreturn void rp2040_start(void);             /* for entry.S */
_Noreturn void rp2040_fault(const uint32_t *); /* for entry.S */
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
    for (;;) {
        __asm volatile("cpsid i\n wfi");
    }
}

void rp2040_fault(const uint32_t *frame)
{
    rp2040_dark();
    if (*(const uint16_t *)(uintptr_t)frame[6] == BKPT_OPCODE) {
        stop(); /* port_exit, without a debugger */
    }
    port_log("\r\nfault at ");
    put_hex(frame[6]);
    port_log(", called from ");
    put_hex(frame[5]);
    port_log(REG(SIO_CPUID) == 0 ? ", core 0\r\n" : ", core 1\r\n");
    stop();
}

void port_exit(int status)
{
    rp2040_dark();
    rp2040_end_emulator(status == 0 ? 0x20026 : 0x20023); /* as wished; an error */
    stop();
}

/* What the paint of entry.S has left. */
uint32_t port_stack_used(void)
{
    const uint32_t top = (uint32_t)(uintptr_t)ld_stack_top;
    const uint32_t *low = ld_stack;
    while ((uint32_t)(uintptr_t)low < top && *low == (uint32_t)(uintptr_t)low) {
        low++;
    }
    return top - (uint32_t)(uintptr_t)low;
}

void rp2040_start(void)
{
    rp2040_clocks_init();
    rp2040_uart_init();
    port_exit(main());
    stop();
}

struct vectors {
    uint32_t *stack_top;
    void (*handlers[15 + 26])(void);
};

extern const struct vectors vectors;
const __attribute__((section(".vectors"), used)) struct vectors vectors = {
    .stack_top = ld_stack_top,
    .handlers =
        {
            [0] = rp2040_reset,
            [1] = rp2040_on_fault, /* NMI */
            [2] = rp2040_on_fault,
            [10] = rp2040_on_fault, /* SVC */
            [13] = rp2040_on_fault, /* PendSV */
            [14] = rp2040_on_fault, /* SysTick */
            [15 + IRQ_TIMER_0] = rp2040_timer_interrupt,
            [15 + IRQ_DMA_0] = rp2040_spi_interrupt,
        },
};
