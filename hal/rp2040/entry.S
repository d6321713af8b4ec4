/*
 * Where boot2 and the vectors enter: what cannot be said in C. Symbols ld_... are from rp2040.ld.
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb
    .text

/*
 * Memory for C: code and data copied to RAM, the rest cleared, the stack painted with its own addresses (see
 * port_stack_used()); then rp2040_start(), which does not return.
 */
    .global rp2040_reset
    .thumb_func
rp2040_reset:
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

/* Every fault: its frame, r0 .. r3, r12, lr, pc, psr as the core has put them on its stack, to rp2040_fault(). */
    .global rp2040_on_fault
    .thumb_func
rp2040_on_fault:
    mrs r0, msp
    ldr r1, =rp2040_fault
    bx r1

/* rp2040_end_emulator(reason): the semihosting call SYS_EXIT (Arm, "Semihosting for AArch32 and AArch64"). */
    .global rp2040_end_emulator
    .thumb_func
rp2040_end_emulator:
    movs r1, r0
    movs r0, #0x18
    bkpt 0xab
    bx lr
    .ltorg
