/*
 * ph_span_gouraud of kernels.h for RV32. With Zba a pixel that is drawn takes 10 instructions, a hidden one 5.
 *
 * Registers: a0 pixels, a1 depth, a2 the end of depth, a3 d, a4 gd, a5 light, a6 glight, a7 ramp; t0 t1 scratch.
 */
#include "rv32.inc"

    .macro pixel at
    lhu t0, 2 * \at - 32(a1)
    srli t1, a3, 16
    bgeu t0, t1, 1f
    sh t1, 2 * \at - 32(a1)
    srli t0, a5, 25
    shadd 1, t0, t0, a7
    lhu t0, 0(t0)
    sh t0, 2 * \at - 32(a0)
1:  add a3, a3, a4
    add a5, a5, a6
    .endm

    function ph_span_gouraud, scenery // a2: pixels
    // The first turn runs only the last 1 .. 16 of the 16 unrolled pixels, so that whole sixteens are left.
    addi t0, a2, -1
    slli a2, a2, 1
    add a2, a2, a1
    andi t0, t0, 15
    addi t0, t0, 1
    slli t1, t0, 1
    add a0, a0, t1
    add a1, a1, t1
    shadd 3, t1, t0, t0
    slli t1, t1, 2 // a pixel takes 36 bytes
    la t0, last
    sub t0, t0, t1
    jr t0
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
last:
    beq a1, a2, 2f
    addi a0, a0, 32
    addi a1, a1, 32
    j first
2:  ret
    .size ph_span_gouraud, . - ph_span_gouraud
