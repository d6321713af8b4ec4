/*
 * ph_halve of kernels.h for RV32. With Zbb a pixel of one colour takes 6 instructions, any other one 19; eight of them
 * take 4 more. A word has two samples, the second one in the upper half.
 *
 * Registers: a0 to, a1 upper, a2 lower, a3 the end, a4 the fields of a spread colour (red at bit 3, green at 13, blue at
 * 24), a5 half of 4 in each field, a6 pixels before the eights; t0 upper samples, t2 the same turned, t1 lower samples,
 * t3 the same turned; t4 scratch.
 */
#include "rv32.inc"

    .macro turn rd, rs // by half a word
#ifdef __riscv_zbb
    rori \rd, \rs, 16
#else
    slli t4, \rs, 16
    srli \rd, \rs, 16
    or \rd, \rd, t4
#endif
    .endm

    .macro pixel at, name
    lw t0, 4 * \at(a1)
    lw t1, 4 * \at(a2)
    turn t2, t0
    bne t0, t1, mean_\name
    bne t0, t2, mean_\name
store_\name:
    sh t0, 2 * \at(a0)
    .endm

    .macro mean name
mean_\name:
    turn t3, t1
    and t0, t0, a4
    and t1, t1, a4
    and t2, t2, a4
    and t3, t3, a4
    add t0, t0, t1
    add t2, t2, t3
    add t0, t0, t2
    add t0, t0, a5
    srli t0, t0, 2
    and t0, t0, a4
    srli t1, t0, 16
    or t0, t0, t1
    j store_\name
    .endm

    function ph_halve // a3: pixels
    andi a6, a3, 7
    shadd 1, a3, a3, a0
    li a4, 0x1f07e0f8
    li a5, 0x02004010
    beqz a6, 2f
1:  pixel 0, alone
    addi a0, a0, 2
    addi a1, a1, 4
    addi a2, a2, 4
    addi a6, a6, -1
    bnez a6, 1b
2:  beq a0, a3, 4f
3:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7
    pixel \at, \at
    .endr
    addi a0, a0, 16
    addi a1, a1, 32
    addi a2, a2, 32
    bne a0, a3, 3b
4:  ret
    .irp name, alone, 0, 1, 2, 3, 4, 5, 6, 7
    mean \name
    .endr
    .size ph_halve, . - ph_halve
