/*
 * ph_texture_small (see texture_small.h) for RV32. With Zba a pixel that is drawn takes 15 instructions, a hidden one 7,
 * a row 56, a call some 70.
 *
 * Registers: a0 the struct ph_texel_run, a1 depth at column 0, s0 s1 s2 at, step, at_dy of u, s3 s4 s5 of v, s6 left, s7
 * right, s8 d at column 0, ra: rows that are left << 16 | number of pixels so far; those of texels.inc; t2 scratch. The
 * stack begins with the distance from depth to pixels.
 */
#include "rv32.inc"
#include "../offsets.inc"
#include "texels.inc"

#define SAVED ra, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11

    /* Begins u or v, given its at, step and bend: the value at column t1 and, for pair t2, its step. */
    .macro begin_way value, by, at, step, bend
    mul \value, \bend, t1
    mul \by, \bend, t2
    add \value, \value, \step
    shadd 1, \by, \by, \step
    mul \value, \value, t1
    add \value, \value, \at
    .endm

    /* Steps the coefficients at, step and at_dy of u or v to the next row. */
    .macro down way, at, step, at_dy
    lw t0, \way + 12(a0)
    lw t1, \way + 16(a0)
    add \at, \at, \at_dy
    add \step, \step, t0
    add \at_dy, \at_dy, t1
    .endm

    function ph_texture_small, loop // a0: struct ph_texel_run
    save 64, SAVED
    words lw, a0, run_u, s0, s1, s2
    words lw, a0, run_v, s3, s4, s5
    words lw, a0, 0, s6, s7, s8
    words lw, a0, texel_depth, a1, t6
    words lw, a0, texel_gd, a2, t0, t1, s11, ra
    masks t0, t1
    sub t6, t6, a1
    sw t6, 52(sp)
    lw t0, to_top(sp)
    lw s9, run_u_bend(a0)
    lw s10, run_v_bend(a0)
    slli s9, s9, 2
    slli s10, s10, 2
    sll s9, s9, t0
    slli ra, ra, 16
row:
    srai t1, s6, 16
    srai t5, s7, 16
    sub t0, t1, t5
    bgez t0, below
    sub ra, ra, t0
    lw t3, run_u_bend(a0)
    lw t6, run_v_bend(a0)
    ori t2, t0, 1
    add t2, t2, t5 // half the pair of texture_tile.h
    mul a5, a2, t1
    add a5, a5, s8
    begin_way a6, a7, s0, s1, t3
    begin_way t3, t4, s3, s4, t6
    lw t6, 52(sp)
    lw t1, to_top(sp)
    sll a6, a6, t1
    sll a7, a7, t1
    slli t5, t5, 1
    add t5, t5, a1
    add t6, t6, t5
    pixels
below:
    down run_u, s0, s1, s2
    down run_v, s3, s4, s5
    words lw, a0, 12, t0, t1, t2
    lw t3, texel_stride(a0)
    add s6, s6, t0
    add s7, s7, t1
    add s8, s8, t2
    add a1, a1, t3
    lui t0, 0x10
    sub ra, ra, t0
    bgeu ra, t0, row
    words lw, a0, run_lower_rows, t0, t1, t2, t3
    beqz t0, done
    sw zero, run_lower_rows(a0)
    slli t0, t0, 16
    add ra, ra, t0
    bnez t1, 1f
    mv s6, t2
    sw t3, 12(a0)
    j row
1:  mv s7, t2
    sw t3, 16(a0)
    j row
done:
    words sw, a0, run_u, s0, s1, s2
    words sw, a0, run_v, s3, s4, s5
    mv a0, ra
    restore 64, SAVED
    .size ph_texture_small, . - ph_texture_small
