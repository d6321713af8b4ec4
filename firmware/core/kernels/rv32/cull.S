/*
 * ph_cull (see cull.h) for RV32. A triangle without clip codes that faces away takes 28 instructions, one that may have
 * codes 34; to list one takes some 40 more.
 *
 * Registers: a0 the struct ph_cull_run, a1 vertices, a2 index, a3 end, a4 codes, a5 to, a6 limit, a7 band_scale; t0 t1 t2
 * the corners' numbers, t3 t4 t5 the corners a, b, c; s0 s1: x, s2 s3: y from a to b and c; t6 s4 s5 scratch.
 */
#include "rv32.inc"
#include "../offsets.inc"

#define SAVED s0, s1, s2, s3, s4, s5

    /* Loads the corners of the next triangle. */
    .macro corners
    lhu t0, 0(a2)
    lhu t1, 2(a2)
    lhu t2, 4(a2)
    addi a2, a2, 6
    slli t3, t0, 4
    slli t4, t1, 4
    slli t5, t2, 4
    add t3, t3, a1
    add t4, t4, a1
    add t5, t5, a1
    .endm

    /* Goes to `found` if the corners run counter-clockwise; t6 is then y of a. */
    .macro turn
    lw t6, 0(t3)
    lw s0, 0(t4)
    lw s1, 0(t5)
    lw s2, vertex_y(t4)
    sub s0, s0, t6
    sub s1, s1, t6
    lw t6, vertex_y(t3)
    lw s3, vertex_y(t5)
    sub s2, s2, t6
    sub s3, s3, t6
    mulh s4, s0, s3
    mulh s5, s1, s2
    bne s4, s5, 1f
    mul s4, s0, s3
    mul s5, s1, s2
    bltu s4, s5, found
    j 2f
1:  blt s4, s5, found
2:
    .endm

    /* to = the smaller (op blt) or the larger one (bgt) of a and b. */
    .macro choose op, to, a, b
    mv \to, \a
    \op \a, \b, 1f
    mv \to, \b
1:
    .endm

    /* Marks a corner for the light, if it is not marked yet. */
    .macro mark corner
    lb t6, vertex_code(\corner)
    bltz t6, 1f
    or t6, t6, s4
    sh zero, vertex_light(\corner)
    sb t6, vertex_code(\corner)
1:
    .endm

    function ph_cull, loop // a0: struct ph_cull_run
    save 32, SAVED
    words lw, a0, cull_vertices, a1, a2, a3, a4, a5, a6, a7
next:
    bgeu a2, a3, none
    bnez a4, coded
no_codes:
    corners
    turn
    bne a2, a3, no_codes
none:
    li a4, 0
    j leave
coded:
    corners
    lbu s0, vertex_code(t3)
    lbu s1, vertex_code(t4)
    lbu s2, vertex_code(t5)
    or s3, s0, s1
    or s3, s3, s2
    andi s3, s3, 0x7f // is any bit set but PH_LIT?
    bnez s3, 3f
    turn
    bne a2, a3, coded
    j none
3:  and s0, s0, s1
    and s0, s0, s2
    andi s0, s0, 0x3f // do they share one of the six planes?
    bnez s0, next
look: // the caller must look at this triangle
    li a4, 1
leave:
    sw a2, cull_index(a0)
    sw a5, cull_to(a0)
    mv a0, a4
    restore 32, SAVED
found: // the rows of the highest and of the lowest corner, from a
    choose blt, s4, s2, s3
    choose bgt, s5, s2, s3
    blez s4, 1f
    li s4, 0
1:  bgez s5, 1f
    li s5, 0
1:  addi t6, t6, 127
    add s4, s4, t6
    add s5, s5, t6
    srai s4, s4, 8
    srai s5, s5, 8
    bge s4, s5, next
    addi s0, s0, 256 // is it less than 2 px wide?
    addi s1, s1, 256
    or s0, s0, s1
    srli s0, s0, 9
    beqz s0, look
    beq a5, a6, look
    mul s4, s4, a7
    addi a5, a5, -8
    sh t0, 0(a5)
    srli s4, s4, 20
    sh t1, 2(a5)
    sh t2, 4(a5)
    sh s4, 6(a5)
    lw s4, cull_mark(a0)
    beqz s4, next
    mark t3
    mark t4
    mark t5
    j next
    .size ph_cull, . - ph_cull
