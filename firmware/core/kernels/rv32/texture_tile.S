/*
 * ph_texture_tile (see texture_tile.h) for RV32. With Zba a pixel that is drawn takes 15 instructions, a hidden one 7, a
 * row 80 (20 more in a clamped texture), a call some 70.
 *
 * Registers: a0 the struct ph_tile_rows, a1 depth at column 0, s0 s1 s2 s3 at, step, bend, at_dy of u, s4 s5 s6 s7 of v,
 * s8 left, ra right, t2 d at column 0; those of texels.inc. 52(sp) is the distance from depth to
 * pixels, 56(sp) below 0 when more than 32 pixels follow.
 */
#include "rv32.inc"
#include "../offsets.inc"
#include "texels.inc"

#define SAVED ra, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11

    /* The value of u or v at column i. */
    .macro value to, i, at, step, bend
    mul \to, \bend, \i
    add \to, \to, \step
    mul \to, \to, \i
    add \to, \to, \at
    .endm

    /* Steps the coefficients at, step, bend and at_dy of u or v to the next row; step_dy stays in memory. */
    .macro down way, at, step, bend, at_dy
    words lw, a0, \way + 16, t0, t1, t3, t4
    add \at, \at, \at_dy
    add \step, \step, t0
    add \bend, \bend, t1
    add \at_dy, \at_dy, t3
    add t0, t0, t4
    sw t0, \way + 16(a0)
    .endm

    function ph_texture_tile, scenery // a0: struct ph_tile_rows
    save 64, SAVED
    words lw, a0, tile_u, s0, s1, s2, s3
    words lw, a0, tile_v, s4, s5, s6, s7
    lw s8, texel_left(a0)
    lw ra, texel_right(a0)
    lw t2, texel_d(a0)
    words lw, a0, texel_depth, a1, t6
    words lw, a0, texel_gd, a2, t0, t1, s11
    masks t0, t1
    sub t6, t6, a1
    sw t6, 52(sp)
row:
    srai t1, s8, 16
    srai t5, ra, 16
    lw t3, tile_columns(a0)
    bgez t1, 1f
    li t1, 0
1:  ble t5, t3, 1f
    mv t5, t3
1:  sub t0, t1, t5
    bgez t0, below
    lw t4, tile_outside(a0)
    value a6, t1, s0, s1, s2
    value t3, t1, s4, s5, s6
    bnez t4, clamped
inside:
    lw a5, tile_count(a0)
    ori t4, t0, 1
    add t4, t4, t5 // half the pair of texture_tile.h
    sub a5, a5, t0
    sw a5, tile_count(a0)
    mul a7, s2, t4
    mul t4, s6, t4
    mul a5, a2, t1
    lw t1, to_top(sp)
    shadd 1, a7, a7, s1
    shadd 1, t4, t4, s5
    add a5, a5, t2
    lw t6, 52(sp)
    slli s9, s2, 2
    slli s10, s6, 2
    slli t5, t5, 1
    sll a6, a6, t1
    sll a7, a7, t1
    sll s9, s9, t1
    add t5, t5, a1
    add t6, t6, t5
    addi t1, t0, 32
    sw t1, 56(sp)
    bgez t1, unrolled
    mv t0, t1 // first those that are more than 32
    addi t5, t5, -64
    addi t6, t6, -64
unrolled:
    pixels
    lw t0, 56(sp)
    bgez t0, below
    sw zero, 56(sp)
    addi t5, t5, 64
    addi t6, t6, 64
    li t0, -32
    j unrolled
below:
    down tile_u, s0, s1, s2, s3
    down tile_v, s4, s5, s6, s7
    lw t0, texel_rows(a0)
    lw t1, texel_left_dx(a0)
    lw t3, texel_right_dx(a0)
    lw t4, texel_d_dy(a0)
    lw t5, texel_stride(a0)
    addi t0, t0, -1
    add s8, s8, t1
    add ra, ra, t3
    add t2, t2, t4
    add a1, a1, t5
    sw t0, texel_rows(a0)
    bnez t0, row
done:
    words sw, a0, tile_u, s0, s1, s2, s3
    words sw, a0, tile_v, s4, s5, s6, s7
    lw t6, 52(sp)
    sw s8, texel_left(a0)
    sw ra, texel_right(a0)
    sw t2, texel_d(a0)
    add t6, t6, a1
    words sw, a0, texel_depth, a1, t6
    restore 64, SAVED
clamped: // does the first or the last pixel lie outside? In a row of even length the last is one bend off.
    addi t6, t5, -1
    andi a7, t0, 1 // t0: minus the length
    lw t4, tile_u_outside(a0)
    value a5, t6, s0, s1, s2
    bnez a7, 1f
    add a5, a5, s2
1:  or a5, a5, a6
    and a5, a5, t4
    bnez a5, done
    value a5, t6, s4, s5, s6
    lw t4, tile_v_outside(a0)
    bnez a7, 1f
    add a5, a5, s6
1:  or a5, a5, t3
    and a5, a5, t4
    bnez a5, done
    j inside
    .size ph_texture_tile, . - ph_texture_tile
