/*
 * The vectors, and the two entries that C cannot express. Symbols ld_... come from rp2040.ld.
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .section .vectors, "a"
    .word ld_stack_top, reset, on_fault, on_fault                /* reset, NMI, hard fault */
    .word 0, 0, 0, 0, 0, 0, 0, on_fault, 0, 0, on_fault, rp2040_tick /* SVC, PendSV, SysTick */
    .word rp2040_timer_interrupt                                /* IRQ 0: TIMER_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
    .word rp2040_spi_interrupt                                  /* IRQ 11: DMA_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0

    .text
/*
 * Prepares memory for C: copies code and data to RAM, clears the rest, and paints the stack with its own addresses (see
 * port_stack_used()). Then it goes to rp2040_start(), which does not return.
 */
    .thumb_func
reset:
    ldr r0, =ld_data_load
    ldr r1, =ld_data_start
    ldr r2, =ld_data_end
    b 2f
1:  ldmia r0!, {r3}
    stmia r1!, {r3}
2:  cmp r1, r2
    blo 1b
    ldr r1, =ld_bss_start
    ldr r2, =ld_bss_end
    movs r3, #0
    b 4f
3:  stmia r1!, {r3}
4:  cmp r1, r2
    blo 3b
    ldr r1, =ld_stack
    mov r2, sp
5:  str r1, [r1]
    adds r1, r1, #4
    cmp r1, r2
    blo 5b
    ldr r0, =rp2040_start
    bx r0

/* Every fault comes here. Its frame on the stack (r0 .. r3, r12, lr, pc, psr) goes to rp2040_fault(). */
    .thumb_func
on_fault:
    mrs r0, msp
    ldr r1, =rp2040_fault
    bx r1
    .ltorg
