/*
 * ph_small_colours of kernels.h for RV32. With Zba and Zbb a row takes 34 instructions, a pixel that is drawn 14, a hidden
 * one 6, a call some 80; in a long row 8 pixels take 4 more.
 *
 * Registers: a0 green at column 0, a1 depth and a2 pixels at column 0, a3 bytes from row to row; a4 left, a5 right, a6 d
 * and a7 red and blue at column 0, s0 .. s3 their steps from row to row; s4 gd, s5 and s10 steps of red and blue and of
 * green, s11 that of green from row to row; s6 s9 masks of red and blue and of green, s7 number of pixels, s8 the end of
 * depth; ra the end of the row; t3 d, t4 red and blue, t2 green, and t5 depth, t6 pixels behind the 8 unrolled ones; t0 t1
 * scratch.
 */
#include "rv32.inc"
#include "../offsets.inc"

#define SAVED s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11, ra

    .equ triangle, 52 // on the stack: 0 when the lower edge has taken over
    .equ frame, 64
    .equ unrolled, 8
#ifdef __riscv_zbb
    .equ pixel_bytes, 48
#else
    .equ pixel_bytes, 56
#endif

    .macro pixel at
    lhu t0, 2 * \at - 2 * unrolled(t5)
    srli t1, t3, 16
    bgeu t0, t1, 2f
    sh t1, 2 * \at - 2 * unrolled(t5)
    and t0, t4, s6 // see ph_pixel_colour
    slli t1, t0, 5
    add t0, t0, t1
    and t1, t2, s9
    or t0, t0, t1
#ifdef __riscv_zbb
    rev8 t0, t0
    sh t0, 2 * \at - 2 * unrolled(t6)
#else
    srli t1, t0, 16
    srli t0, t0, 24
    sb t0, 2 * \at - 2 * unrolled(t6)
    sb t1, 2 * \at - 2 * unrolled + 1(t6)
#endif
2:  add t3, t3, s4
    add t4, t4, s5
    add t2, t2, s10
    .endm

    function ph_small_colours
    save frame, SAVED
    sw a0, triangle(sp)
    words lw, a0, small_left_dx, s0, s1, s2, s3, s4, s5, s6, a4, a5, a6, a7
    words lw, a0, small_green, t0, s10, s11
    lhu s8, small_upper_rows(a0)
    mul s8, s8, a3
    add s8, s8, a1
    mv a0, t0
    li s6, 0xf800f800
    li s9, 0x07e00000
    li s7, 0
row:
    srli t1, a4, 16
    srli t2, a5, 16
    sub t0, t1, t2
    bgez t0, below
    sub s7, s7, t0
    shadd 1, ra, t2, a1
    mul t3, s4, t1
    mul t4, s5, t1
    mul t2, s10, t1
    add t3, t3, a6
    add t4, t4, a7
    add t2, t2, a0
    not t0, t0
    andi t0, t0, unrolled - 1
    not t0, t0 // the first 1 to 8 pixels
    sub t1, t1, t0
    shadd 1, t5, t1, a1
    shadd 1, t6, t1, a2
    li t1, pixel_bytes
    mul t0, t0, t1
    la t1, last
    add t1, t1, t0
    jr t1
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7
    pixel \at
    .endr
last:
    beq t5, ra, below
    addi t5, t5, 2 * unrolled
    addi t6, t6, 2 * unrolled
    j first
below:
    add a4, a4, s0
    add a5, a5, s1
    add a6, a6, s2
    add a7, a7, s3
    add a0, a0, s11
    add a1, a1, a3
    add a2, a2, a3
    bne a1, s8, row
    lw t6, triangle(sp)
    beqz t6, done
    sw zero, triangle(sp)
    lower_edge t6
done:
    mv a0, s7
    restore frame, SAVED
    .size ph_small_colours, . - ph_small_colours
