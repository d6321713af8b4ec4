/* The vectors, behind boot2. */
    .syntax unified
    .section .vectors, "a"
    .word ld_stack_top, rp2040_reset, rp2040_on_fault, rp2040_on_fault /* reset, NMI, hard fault */
    .word 0, 0, 0, 0, 0, 0, 0, rp2040_on_fault, 0, 0, rp2040_on_fault, rp2040_tick /* SVC, PendSV, SysTick */
    .word rp2040_timer_interrupt                                /* IRQ 0: TIMER_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
    .word rp2040_spi_interrupt                                  /* IRQ 11: DMA_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
