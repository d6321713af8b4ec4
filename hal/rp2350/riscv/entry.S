/*
 * The image definition for the RP2350's RISC-V cores (RP2350 datasheet 5.9.3, 5.9.5), reset, the vectors of traps, and
 * what else C cannot express. hal/chips/rp2/entry.S has the same for Arm. Symbols ld_... come from the linker script.
 */
    .section .vectors, "a"
    .word 0xffffded3
    .byte 0x42, 1                       /* image type, one word */
    .hword 1 << 12 | 1 << 8 | 1         /* RP2350, RISC-V, a program */
    .byte 0x44, 3                       /* entry point, three words */
    .hword 0
    .word rp2_reset, ld_stack_top
    .byte 0xff                          /* the last item */
    .hword 4                            /* words of all items before */
    .byte 0
    .word 0                             /* the next block is this one: there is no other */
    .word 0xab123579

    .section .reset, "ax"
/*
 * Prepares memory for C: copies code and data to RAM, clears the rest, and paints the stack with its own addresses (see
 * port_stack_used()). Then it goes to rp2_start(), which does not return.
 */
    .global rp2_reset
rp2_reset:
    csrci mstatus, 8
    csrw mie, zero
    la sp, ld_stack_top
    csrw mscratch, sp
    la a0, ld_data_load
    la a1, ld_data_start
    la a2, ld_data_end
    j 2f
1:  lw a3, 0(a0)
    sw a3, 0(a1)
    addi a0, a0, 4
    addi a1, a1, 4
2:  bltu a1, a2, 1b
    la a1, ld_bss_start
    la a2, ld_bss_end
    j 4f
3:  sw zero, 0(a1)
    addi a1, a1, 4
4:  bltu a1, a2, 3b
    la a1, ld_stack
5:  sw a1, 0(a1)
    addi a1, a1, 4
    bltu a1, sp, 5b
    la a1, vectors + 1                  /* by cause */
    csrw mtvec, a1
    tail rp2_start

    .text
    .balign 64
    .option push
    .option norvc
vectors:
    j fault
    .word 0, 0, 0, 0, 0, 0
    j rp2350_timer                      /* 7 */
    .word 0, 0, 0
    j rp2350_external                   /* 11 */
    .option pop

/* Every exception comes here. The stack may be full, so this takes the core's place for that, see guard_stack(). */
fault:
    csrr sp, mscratch
    csrr a0, mepc
    mv a1, ra
    tail rp2_fault

/* The arguments are in a0 and a1. Debuggers know the call by the instructions around it (RISC-V semihosting). */
    .global rp2_semihosting
    .balign 16
    .option push
    .option norvc
rp2_semihosting:
    slli x0, x0, 0x1f
    ebreak
    srai x0, x0, 7
    ret
    .option pop
