/*
 * ph_setup_small and ph_setup_fast of kernels.h for RV32. With Zbb a triangle takes some 225 instructions, and some 85
 * more from its reference on.
 *
 * Registers: a0 the triangle, a3 a4 a5 its corners; s2 .. s6 its sides and their area, then the slopes; s7 s8 s9 depth;
 * s11 2^31 - 1. The rest is scratch.
 */
#include "rv32.inc"
#include "../offsets.inc"

    .equ own_corners, triangle_slopes // in the triangle: for ph_float_depths
    .equ own_depths, triangle_slopes + 12

#define SAVED ra, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11

    /* The edge from a down to b, whose first row is given: ra becomes x at that row, s10 the slope. */
    .macro edge ax, ay, bx, by, row
    sub s10, \by, \ay
    sub ra, \bx, \ax
    slli s0, \row, 8
    sub s0, s0, \ay
    addi s0, s0, 128
    normalise s10, a6, s1
    srli s10, s10, 16
    divu s10, s11, s10
    srli s1, ra, 31
    add s10, s10, s1
    mul s10, s10, ra
    xori a6, a6, 31
    srli s1, s11, 16 // .5 px, rounded up
    srai ra, s10, 8
    mul ra, ra, s0
    slli s0, \ax, 8
    add s0, s0, s1
    sra s10, s10, a6
    sra ra, ra, a6
    add ra, ra, s0
    .endm

    /* The magnitude of v. */
    .macro magnitude to, v
    srai \to, \v, 31
    xor \to, \to, \v
    .endm

    /* The gradient t4, t5 of a value with differences d1 and d2. Changes a1. */
    .macro gradient d1, d2
    mul t4, \d2, s3
    mul a1, \d1, s5
    mul t5, \d1, s4
    sub t4, t4, a1
    mul a1, \d2, s2
    sub t5, t5, a1
    .endm

    /* Raises the shift a1 until it cuts the gradient to `limit` bits. Changes a2, a6, a7. */
    .macro flatten limit
    magnitude a2, t4
    magnitude a6, t5
    or a2, a2, a6
    li a6, 32 - \limit
    beqz a2, 1f
    leading_zeros a7, a2, a2, ra
    sub a6, a6, a7
    j 2f
1:  li a6, -\limit
2:  bge a1, a6, 3f
    mv a1, a6
3:
    .endm

    // Goes away if the corner \x, \y comes within a pixel of the borders. t0, t1: size less 2 pixels. Changes t2.
    .macro off_borders x, y
    addi t2, \x, -256
    bgtu t2, t0, general
    addi t2, \y, -256
    bgtu t2, t1, general
    .endm

    // \to = the depth of corner \v in fixed16 for the bias t1. Changes t0.
    .macro fixed_depth to, v
    lb t0, vertex_s(\v)
    lw \to, vertex_q(\v)
    addi t0, t0, -2
    bltz t0, 1f
    srl \to, \to, t0
    j 2f
1:  neg t0, t0
    sll \to, \to, t0
2:  add \to, \to, t1
    .endm

    function ph_setup_fast, loop // a0: struct ph_fast, a1: struct ph_ref, a2: struct ph_triangle
    save 64, SAVED
    lhu a3, 0(a1)
    lhu a4, 2(a1)
    lhu a5, 4(a1)
    lw t0, fast_base(a0)
    slli a3, a3, 4
    slli a4, a4, 4
    slli a5, a5, 4
    add a3, a3, t0
    add a4, a4, t0
    add a5, a5, t0
    // Does the first corner stay far enough from the borders?
    words lw, a3, 0, s0, s1
    words lw, a0, fast_margin, t2, t0, t1 // and inner_x, inner_y
    sub t3, s0, t2
    bgeu t3, t0, border
    sub t3, s1, t2
    bgeu t3, t1, border
inside:
    // The sides. Are they short enough?
    words lw, a4, 0, s2, s3
    words lw, a5, 0, s4, s5
    lw t0, fast_side(a0)
    sub s2, s2, s0
    sub s3, s3, s1
    sub s4, s4, s0
    sub s5, s5, s1
    sub t5, s4, s2
    add t1, s2, t0
    add t2, s3, t0
    add t3, s4, t0
    add t4, s5, t0
    add t5, t5, t0
    or t1, t1, t2
    or t3, t3, t4
    or t1, t1, t5
    or t1, t1, t3
    slli t0, t0, 1
    bgeu t1, t0, general
    mul s6, s4, s3
    mul t1, s2, s5
    sub s6, s6, t1
    lw t1, fast_lens(a0)
    beqz t1, fixed
    // ph_float_depths, mostly of three corners with one exponent.
    lbu t0, vertex_s(a3)
    lbu t2, vertex_s(a4)
    lbu t3, vertex_s(a5)
    bne t0, t2, apart
    bne t0, t3, apart
    lw s7, vertex_q(a3)
    lw s8, vertex_q(a4)
    lw s9, vertex_q(a5)
    lw t2, lens_far_q(t1)
    lbu t3, lens_far_s(t1)
    lbu t4, lens_float_down(t1)
    sub t3, t3, t0
    srl t2, t2, t3
    bleu s7, t2, general
    bleu s8, t2, general
    bleu s9, t2, general
    sub s7, s7, t2
    sub s8, s8, t2
    sub s9, s9, t2
    leading_zeros t5, s7, t1, t3
    xor t1, s7, s8
    xor t3, s7, s9
    or t1, t1, t3
    xori t3, t5, 31
    srl t1, t1, t3
    bnez t1, general
    add t0, t0, t5
    srl t1, t0, t4
    srli t1, t1, 1
    bnez t1, general
    lw t1, fast_bias(a0)
    xori t3, t4, 31
    sll t0, t0, t3
    sub t0, t1, t0
    sll s7, s7, t5
    sll s8, s8, t5
    sll s9, s9, t5
    srl s7, s7, t4
    srl s8, s8, t4
    srl s9, s9, t4
    add s7, s7, t0
    add s8, s8, t0
    add s9, s9, t0
known:
    words lw, a0, fast_ramp, t0, t1
    li t2, ~0xff // PH_KIND_SMALL and PH_BLOCK_NONE, which stands beside it
    sw t0, triangle_ramp(a2)
    sw t1, triangle_material(a2)
    sh t2, triangle_kind(a2)
    mv a0, a2
    j begin
border: // do all corners keep a pixel away from the borders?
    lw t2, fast_side(a0)
    slli t2, t2, 1
    add t0, t0, t2
    add t1, t1, t2
    off_borders s0, s1
    words lw, a4, 0, s2, s3
    off_borders s2, s3
    words lw, a5, 0, s2, s3
    off_borders s2, s3
    j inside
fixed:
    lw t1, fast_bias(a0)
    fixed_depth s7, a3
    fixed_depth s8, a4
    fixed_depth s9, a5
    xor t0, s7, s8
    xor t1, s7, s9
    or t0, t0, t1
    bgez t0, known
    j general
apart: // the corners have other exponents
    mv s10, a0
    mv s11, a2
    words sw, a2, own_corners, a3, a4, a5
    addi a1, a2, own_corners
    addi a3, a2, own_depths
    lw a2, fast_bias(a0)
    lw t0, fast_set_codes(a0)
    lw a0, fast_lens(a0)
    jalr t0
    mv t0, a0
    mv a0, s10
    mv a2, s11
    words lw, a2, own_corners, a3, a4, a5, s7, s8, s9
    bnez t0, known
general:
none:
    li a0, 0
    j done
    .size ph_setup_fast, . - ph_setup_fast

    .balign 4
    .global ph_setup_small
    .type ph_setup_small, %function
ph_setup_small: // a0: struct ph_triangle, a1: corners, a2: struct ph_sides, a3: depths
    save 64, SAVED
    words lw, a2, 0, s2, s3, s4, s5, s6
    words lw, a3, 0, s7, s8, s9
    words lw, a1, 0, a3, a4, a5
    lw s1, vertex_y(a3)
begin:
    // Turn the corners until t0, t1, t2 are the top, the left and the right one, and t3, t4, t5 their first rows.
    mv t0, a3
    mv t1, a4
    mv t2, a5
    addi t3, s1, 127
    add t4, t3, s3
    add t5, t3, s5
    srai t3, t3, 8
    srai t4, t4, 8
    srai t5, t5, 8
    li s11, 0x7fffffff
    blt t4, t3, 1f
    bge t5, t3, 3f
1:  mv t6, t3
    blt t5, t4, 2f
    mv t0, a4
    mv t1, a5
    mv t2, a3
    mv t3, t4
    mv t4, t5
    mv t5, t6
    j 3f
2:  mv t0, a5
    mv t1, a3
    mv t2, a4
    mv t3, t5
    mv t5, t4
    mv t4, t6
    // Make t1 the middle and t2 the lowest corner.
3:  mv a7, a0
    ble t4, t5, 4f
    mv t6, t1
    mv t1, t2
    mv t2, t6
    mv t6, t4
    mv t4, t5
    mv t5, t6
    addi a7, a0, 4 // the long edge is the left one
4:  bge t3, t5, none
    words lw, t0, 0, a1, a2 // now a1 a2: the top, t6 t1: the middle, t0 t2: the lowest corner
    words lw, t1, 0, t6, t1
    words lw, t2, 0, t0, t2
    sub a6, a7, a0
    srli a6, a6, 2
    sw a6, triangle_lower_is_right(a0)
    sh t3, triangle_y_top(a0)
    sh t5, triangle_y_bottom(a0)
    edge a1, a2, t0, t2, t3
    slli a6, a0, 1
    sub a6, a6, a7
    sw ra, triangle_left + 4(a6)
    sw s10, triangle_left_dx + 4(a6)
    beq t4, t3, flat_top
    edge a1, a2, t6, t1, t3
    sw ra, triangle_left(a7)
    sw s10, triangle_left_dx(a7)
    sub a6, t4, t3
    sub t5, t5, t4
    sh a6, triangle_upper_rows(a0)
    sh t5, triangle_lower_rows(a0)
    beqz t5, planes
    edge t6, t1, t0, t2, t4
    words sw, a0, triangle_lower, ra, s10
planes:
    // The sides over the area, as struct ph_slopes has them: s2 c, s3 a, s4 d, s5 b, t6 shift.
    words lw, a3, 0, s0, s1
    magnitude t0, s2
    magnitude t1, s3
    magnitude t2, s4
    magnitude t4, s5
    or t0, t0, t1
    or t2, t2, t4
    or t0, t0, t2
    ori t0, t0, 31
    leading_zeros t1, t0, t0, t2
    normalise s6, t4, t0
    srli s6, s6, 16
    divu s6, s11, s6
    li s10, 33
    sub s10, s10, t1 // bits + 1
    sub t6, t1, t4
    addi t6, t6, 14
    mul s2, s2, s6
    mul s3, s3, s6
    mul s4, s4, s6
    mul s5, s5, s6
    sra s2, s2, s10
    sra s3, s3, s10
    sra s4, s4, s10
    sra s5, s5, s10
    slli t0, t3, 8
    sub s1, t0, s1
    lw t1, triangle_ramp(a0)
    neg s0, s0
    addi s0, s0, 128
    addi s1, s1, 128 // s0, s1: from the first corner to column 0 of the first row
    beqz t1, textured
    // Compute the plane of light.
    lhu t0, vertex_light(a3)
    lhu t1, vertex_light(a4)
    lhu t2, vertex_light(a5)
    sub t1, t1, t0
    sub t2, t2, t0
    srai t1, t1, 1
    srai t2, t2, 1
    gradient t1, t2
    addi a1, t6, -17
    li a2, 31 - 28
    blt a1, a2, steep_light
5:  sra t4, t4, a1
    sra t5, t5, a1
6:  mul t1, t4, s0
    mul t2, t5, s1
    slli t0, t0, 16
    slli t4, t4, 8
    slli t5, t5, 8
    add t0, t0, t1
    add t0, t0, t2
    sw t0, triangle_light(a0)
    sw t4, triangle_glight(a0)
    sw t5, triangle_light_dy(a0)
depth: // the plane of depth
    sub s8, s8, s7
    sub s9, s9, s7
    magnitude t0, s8
    magnitude t1, s9
    or t0, t0, t1
    srli t1, t0, 15 // mostly 0: nothing is dropped
    beqz t1, 7f
    leading_zeros t1, t0, t0, t2
    li t2, 32 - 15
    sub t1, t2, t1
7:  sra t0, s8, t1
    sra t2, s9, t1
    gradient t0, t2
    sub a1, t6, t1
    li a2, 16 // FINE_DEPTH
    blt a1, a2, steep_depth
fine_depth:
    sra t4, t4, a1
    sra t5, t5, a1
8:  mul t1, t4, s0
    mul t2, t5, s1
    slli t4, t4, 8
    slli t5, t5, 8
    add s7, s7, t1
    add s7, s7, t2
    sw s7, triangle_d(a0)
    sw t4, triangle_gd(a0)
    sw t5, triangle_d_dy(a0)
    li a0, 1
done:
    restore 64, SAVED
flat_top: // the first edge is the lower one
    edge t6, t1, t0, t2, t4
    sw ra, triangle_left(a7)
    sw s10, triangle_left_dx(a7)
    sub t5, t5, t4
    sh t5, triangle_upper_rows(a0)
    sh zero, triangle_lower_rows(a0)
    j planes
textured:
    words sw, a0, triangle_slopes, s3, s5, s4, s2, t6
    j depth
steep_light:
    flatten 28
    bgez a1, 5b
    neg a1, a1
    sll t4, t4, a1
    sll t5, t5, a1
    j 6b
steep_depth:
    bltz a1, 9f
    li t0, 31 - 17
    bge a1, t0, 4f // such a gradient fits
    mv t0, a1
    flatten 17
    bne a1, t0, 9f
4:  addi t0, s10, 1
    bgt a1, t0, fine_depth // it is as fine as FINE_DEPTH for such sides
    sra t4, t4, a1
    sra t5, t5, a1
    words lw, a3, 0, t0, t1 // is it right at the other two corners?
    words lw, a4, 0, t2, a1
    words lw, a5, 0, a2, a6
    sub t2, t2, t0
    sub a1, a1, t1
    sub a2, a2, t0
    sub a6, a6, t1
    mul t2, t2, t4
    mul a1, a1, t5
    mul a2, a2, t4
    mul a6, a6, t5
    add t2, t2, a1
    add a2, a2, a6
    sub t2, t2, s8
    sub a2, a2, s9
    lui a1, 9 // RIGHT_DEPTH
    add t2, t2, a1
    add a2, a2, a1
    slli a1, a1, 1
    bgeu t2, a1, 9f
    bltu a2, a1, 8b
9:  li a0, 2 // PH_SMALL_STEEP
    j done
    .size ph_setup_small, . - ph_setup_small
