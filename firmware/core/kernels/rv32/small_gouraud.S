/*
 * ph_small_gouraud of kernels.h for RV32; small_knee.S makes ph_small_knee of it, long_gouraud.S ph_long_gouraud. With
 * Zba a row takes 22 instructions, a pixel that is drawn 10, a hidden one 5, a call 50 to 65.
 *
 * Registers: a0 the triangle, a1 depth and a2 pixels at column 0, a3 bytes from row to row; a4 left, a5 right, a6 d and
 * a7 light at column 0, s0 .. s3 their steps from row to row; s4 gd, s5 glight, s6 ramp, s7 number of pixels, s8 the
 * end of depth, s9 behind the unrolled pixels, s10 knee or width, s11 the end of a long row; t3 d, t4 light, and t5
 * depth, t6 pixels behind the 32 unrolled ones; t0 t1 t2 scratch.
 */
#include "rv32.inc"
#include "../offsets.inc"

#ifndef NAME
#define NAME ph_small_gouraud
#endif
#ifndef LIGHT_DOWN
#define LIGHT_DOWN 25
#endif
#ifdef WITH_KNEE
#define SAVED s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10
#elif defined WITH_BLOCKS
#define SAVED s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11
#else
#define SAVED s0, s1, s2, s3, s4, s5, s6, s7, s8, s9
#endif

    .macro pixel at
    lhu t0, 2 * \at - 64(t5)
#ifdef WITH_KNEE
    mv t1, t3
    bgeu t3, s10, 1f
    add t1, t1, t3
    sub t1, t1, s10
1:  srli t1, t1, 16
#else
    srli t1, t3, 16
#endif
    bgeu t0, t1, 2f
    sh t1, 2 * \at - 64(t5)
    srli t0, t4, LIGHT_DOWN
    shadd 1, t0, t0, s6
    lhu t0, 0(t0)
    sh t0, 2 * \at - 64(t6)
2:  add t3, t3, s4
    add t4, t4, s5
    .endm

    function NAME
    save 48, SAVED
    words lw, a0, small_left_dx, s0, s1, s2, s3, s4, s5, s6, a4, a5, a6, a7
    lhu s8, small_upper_rows(a0)
    mul s8, s8, a3
    add s8, s8, a1
    li s7, 0
    la s9, last
#ifdef WITH_KNEE
    lw s10, small_knee(a0)
#endif
#ifdef WITH_BLOCKS
    srli s10, a3, 1
#endif
row:
#ifdef WITH_BLOCKS
    srai t1, a4, 16 // cut to the picture
    srai t2, a5, 16
    bgez t1, 1f
    li t1, 0
1:  ble t2, s10, 1f
    mv t2, s10
1:
#else
    srli t1, a4, 16
    srli t2, a5, 16
#endif
    sub t0, t1, t2
    bgez t0, below
    sub s7, s7, t0
    mul t3, s4, t1
    mul t4, s5, t1
    add t3, t3, a6
    add t4, t4, a7
#ifdef WITH_BLOCKS
    shadd 1, s11, t2, a1
    not t0, t0
    andi t0, t0, 31
    not t0, t0 // the first 1 to 32 pixels
    sub t2, t1, t0
#endif
    shadd 1, t5, t2, a1
    shadd 1, t6, t2, a2
#ifdef WITH_KNEE
    shadd 1, t1, t0, t0 // a pixel takes 48 bytes
    slli t1, t1, 4
    add t1, t1, s9
#else
    shadd 3, t2, t0, t0 // 36 bytes
    shadd 2, t1, t2, s9
#endif
    jr t1
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
last:
#ifdef WITH_BLOCKS
    beq t5, s11, below
    addi t5, t5, 64
    addi t6, t6, 64
    j first
#endif
below:
    add a4, a4, s0
    add a5, a5, s1
    add a6, a6, s2
    add a7, a7, s3
    add a1, a1, a3
    add a2, a2, a3
    bne a1, s8, row
    beqz a0, done // the lower edge has taken over
    lower_edge a0
done:
    mv a0, s7
    restore 48, SAVED
    .size NAME, . - NAME
