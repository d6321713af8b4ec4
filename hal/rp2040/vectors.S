/* The vector table of an RP2040's image: it lies in flash behind boot2. */
    .syntax unified
    .section .vectors, "a"
    .word ld_stack_top, rp2_reset, rp2_on_fault, rp2_on_fault /* reset, NMI, hard fault */
    .word 0, 0, 0, 0, 0, 0, 0, rp2_on_fault, 0, 0, rp2_on_fault, rp2_tick /* SVC, PendSV, SysTick */
    .word rp2_timer_interrupt                                /* IRQ 0: TIMER_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
    .word rp2_bus_interrupt                                  /* IRQ 11: DMA_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
    .word rp2_bus_interrupt, rp2_bus_interrupt               /* IRQ 23, 24: I2C0, I2C1 */
    .word 0
