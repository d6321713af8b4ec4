/*
 * The start of an image on an Arm core, and what else C cannot express; vectors.S has the vectors. Symbols ld_... come
 * from the linker script.
 */
    .syntax unified
    .thumb

    .text
/*
 * Prepares memory for C: copies code and data to RAM, clears the rest, and paints the stack with its own addresses (see
 * port_stack_used()). Then it goes to rp2_start(), which does not return.
 */
    .global rp2_reset
    .thumb_func
rp2_reset:
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
    ldr r0, =rp2_start
    bx r0

/* Every fault comes here. Of its frame on the stack (r0 .. r3, r12, lr, pc, psr) pc and lr go to rp2_fault(). */
    .global rp2_on_fault
    .thumb_func
rp2_on_fault:
    mrs r2, msp
    ldr r0, [r2, #24]
    ldr r1, [r2, #20]
    ldr r2, =rp2_fault
    bx r2

/* The arguments are in r0 and r1. */
    .global rp2_semihosting
    .thumb_func
rp2_semihosting:
    bkpt 0xab
    bx lr
    .ltorg
