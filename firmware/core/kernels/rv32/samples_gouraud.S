/*
 * ph_samples_gouraud of kernels.h for RV32. With Zba a row takes 29 instructions, and 13 or 8 more if its first or its last
 * pixel has one sample. As long as nothing is drawn where a row goes, both samples of a pixel take 13; behind that a
 * sample that is drawn takes 9 or 10, a hidden one 4 or 5. A call takes 50 to 65.
 *
 * Registers: a0 less the bytes of an unrolled pixel, a1 depth at column 0, a2 from there to the pixels, a3 bytes from row
 * to row; a4 left, a5 right, a6 d and a7 light at column 0, s0 .. s3 their steps from row to row; s4 gd, s5 glight, s6
 * ramp, s7 number of samples, s8 the end of depth, s9 behind the unrolled pixels, s10 what turns the step of light from
 * an even row into that from an odd one, and back, s11 the number of unrolled pixels, and scratch; t2 whole pixels, t3 d,
 * t4 light, and t5 depth, t6 pixels behind the last whole pixel; t0 t1 ra scratch. The triangle waits on the stack.
 */
#include "rv32.inc"
#include "../offsets.inc"

#define UNROLLED 16
#define TRIANGLE 56 // on the stack; 0 when the lower edge has taken over
#define SAVED ra, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11

    /* Draws a sample; d and light stay. If depth and pixels are one register, it is depth before and pixels behind. */
    .macro sample at, depth, pixels, code
    lhu t0, \at(\depth)
    srli \code, t3, 16
    bgeu t0, \code, 1f
    sh \code, \at(\depth)
    .ifc \depth, \pixels
    add \depth, \depth, a2
    .endif
    srli t0, t4, 25
    shadd 1, t0, t0, s6
    lhu t0, 0(t0)
    sh t0, \at(\pixels)
1:
    .endm

    .macro next_pixel
    add t3, t3, s4
    add t4, t4, s5
    .endm

    /* Draws the two samples of a pixel where nothing is drawn yet, in 40 bytes. The word of depth is d at the second
     * sample, whose code is the upper half; that of the first one takes the place of the lower half. */
    .macro fresh at, depth, pixels
    srli t0, t3, 16
    add t3, t3, s4
    sw t3, \at(\depth)
    sh t0, \at(\depth)
    .option norvc
    add t3, t3, s4
    .option rvc
    srli t0, t4, 25
    shadd 1, t0, t0, s6
    lhu t0, 0(t0)
    sh t0, \at(\pixels)
    sh t0, \at + 2(\pixels)
    add t4, t4, s5
    .endm

    /* Draws the two samples of a pixel, in 48 bytes. No code is 0: where both depths are 0, both samples are drawn. */
    .macro pixel at
    lw t0, 4 * \at - 64(t5)
    bnez t0, samples_\at
    fresh 4 * \at - 64, t5, t6
    .endm

    .macro samples at
samples_\at:
    sample 4 * \at - 64, t5, t6, t1
    add t3, t3, s4
    sample 4 * \at - 62, t5, t6, t1
    next_pixel
    .endm

    function ph_samples_gouraud, seldom
    save 64, SAVED
    words lw, a0, small_left_dx, s0, s1, s2, s3, s4, s5, s6, a4, a5, a6, a7
    lhu s8, small_upper_rows(a0)
    sub a2, a2, a1
    mul s8, s8, a3
    add s8, s8, a1
    li s7, 0
    la s9, last
    li s11, UNROLLED
    sw a0, TRIANGLE(sp)
    li a0, -48
    xori s10, s3, 1
    andi t0, a7, 1
    bnez t0, row
    li s3, 1 // light stays from an even row to the odd one
row:
    srli t1, a4, 16
    srli t2, a5, 16
    sub t0, t2, t1
    blez t0, below
    add s7, s7, t0
    mul t3, s4, t1
    srli t0, t1, 1
    mul t4, s5, t0
    srli t2, t2, 1
    shadd 2, t5, t2, a1
    sub t2, t2, t0
    add t6, t5, a2
    add t3, t3, a6
    add t4, t4, a7
    andi t0, t1, 1
    beqz t0, 2f
    shadd 1, ra, t1, a1 // the second sample of the first pixel
    addi t2, t2, -1
    sample 0, ra, ra, t1
    next_pixel
2:  bltu s11, t2, more
    mul t0, t2, a0
    add t0, t0, s9
    jr t0
more: // those before the last 16
    slli t0, t2, 2
    sub ra, t5, t0
    addi t2, t5, -64
3:  lw t0, 0(ra)
    add t1, ra, a2
    bnez t0, 5f
    fresh 0, ra, t1
4:  addi ra, ra, 4
    bne ra, t2, 3b
    li s11, UNROLLED
    j first
5:  sample 0, ra, t1, s11
    add t3, t3, s4
    sample 2, ra, t1, s11
    next_pixel
    j 4b
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    samples \at
    .endr
    j last
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
last:
    slli t0, a5, 15
    bgez t0, below
    sample 0, t5, t6, t1 // the first sample of the last pixel
below:
    add a4, a4, s0
    add a5, a5, s1
    add a6, a6, s2
    add a7, a7, s3
    xor s3, s3, s10
    add a1, a1, a3
    bne a1, s8, row
    lw ra, TRIANGLE(sp)
    beqz ra, done
    sw zero, TRIANGLE(sp)
    lower_edge ra
done:
    mv a0, s7
    restore 64, SAVED
    .size ph_samples_gouraud, . - ph_samples_gouraud
