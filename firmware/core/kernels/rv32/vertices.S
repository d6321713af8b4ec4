/*
 * ph_vertices (see vertices.h) for RV32. With Zbb a vertex takes 132 instructions.
 *
 * Registers: a0 the struct ph_vertex_run, a1 from, a2 to, a3 end; s0 .. s8 the matrix, row by row; s9 s10 s11 its
 * translation, of which a4 a5 a6 have the high words; t3 t4 t5: x, y, w before the divide; t0 t1 t2 t6 a7 ra scratch.
 */
#include "rv32.inc"
#include "../offsets.inc"
#include "matvec_offsets.inc"

#define SAVED ra, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11

    /* A row of the matrix: its translation is in 2^-32, and 2^-28 is enough for the low word. */
    .macro load_row row, x, y, z, low, high
    words lw, a0, run_row + 24 * \row, \low, \high, \x, \y, \z
    srli \low, \low, 4
    slli t0, \high, 28
    or \low, \low, t0
    .endm

    /* The low word of the product in 2^-28: its upper four bits are the result modulo 16. */
    .macro row_low to, x, y, z, translation
    mul \to, \x, t0
    mul t6, \y, t1
    mul a7, \z, t2
    add \to, \to, \translation
    add \to, \to, t6
    add \to, \to, a7
    .endm

    /* The sum of the high words is at most 3 below the result. */
    .macro row_high to, x, y, z, translation
    mulh t6, \x, t0
    mulh a7, \y, t1
    mulh ra, \z, t2
    srli \to, \to, 28
    add t6, t6, \translation
    add a7, a7, ra
    add t6, t6, a7
    sub \to, \to, t6
    andi \to, \to, 15
    add \to, \to, t6
    .endm

    function ph_vertices, loop // a0: struct ph_vertex_run
    save 64, SAVED
    words lw, a0, run_from, a1, a2
    lw a3, run_end(a0)
    load_row 0, s0, s1, s2, s9, a4
    load_row 1, s3, s4, s5, s10, a5
    load_row 2, s6, s7, s8, s11, a6
    bgeu a1, a3, done
next:
    words lw, a1, 0, t0, t1, t2 // x y z
    li t3, 1 << 27 // are they within PH_MATVEC_RANGE?
    add t4, t0, t3
    add t5, t1, t3
    add t3, t3, t2
    or t4, t4, t5
    or t4, t4, t3
    srli t4, t4, 28
    bnez t4, done
    row_low t3, s0, s1, s2, s9
    row_low t4, s3, s4, s5, s10
    row_low t5, s6, s7, s8, s11
    slli t0, t0, 4
    slli t1, t1, 4
    slli t2, t2, 4
    row_high t3, s0, s1, s2, a4
    row_high t4, s3, s4, s5, a5
    row_high t5, s6, s7, s8, a6
    // Leave if the vertex is outside the near plane, the far plane or the guard band.
    words lw, a0, run_near, t0, t1
    sub t0, t5, t0
    bgtu t0, t1, hand_back
    lw t6, run_guard_up(a0)
    srai t0, t3, 31
    srai t1, t4, 31
    xor t0, t0, t3
    xor t1, t1, t4
    srl t6, t5, t6
    or t0, t0, t1
    slli t6, t6, 3
    bgeu t0, t6, hand_back
    // fx_rcp_norm(w), d = w << t0: t1 = 2^32 / (d >> 15), and t2 = (t1 d - 2^47) / 2. d is even, as w is below 2^28.
    normalise t5, t0, t1
    li t2, -1
    srli t1, t5, 15
    srli t6, t5, 1
    divu t1, t2, t1
    mul t2, t1, t6
    // 2^62 / d = 2^15 t1 (1 - m) with m = t2 - t2^2 in 2^-46, |t2| < 2^31. A little less than m is taken, so that the
    // result may be one too large but is never too small.
    mulh t6, t2, t2
    slli t1, t1, 15
    srai t6, t6, 14
    sub t2, t2, t6
    addi t2, t2, -16
    mulh t2, t1, t2
    srai t6, t2, 14
    slli t2, t2, 31 - 13
    sub t1, t1, t6
    addi t1, t1, -1
    bgez t2, 1f // a half above the whole number or more
    mul t2, t1, t5
    neg t2, t2
    srli t2, t2, 31
    sub t1, t1, t2
    // The place on the screen, x / w and y / w plus the centre: the low words of round_x and round_y are 0.
1:  addi t2, t0, -4
    sll t3, t3, t2
    sll t4, t4, t2
    srli t2, t1, 1
    lw t5, run_round_x + 4(a0)
    lw t6, run_round_y + 4(a0)
    mulh t3, t3, t2
    mulh t4, t4, t2
    lw t2, run_down(a0)
    add t3, t3, t5
    add t4, t4, t6
    sra t3, t3, t2
    sra t4, t4, t2
    // Store the depth q, with its upper bit at 30.
    words lw, a0, run_depth_scale, t5, t6
    mulhu t5, t5, t1
    sub t6, t6, t0
    srli t0, t5, 30
    xori t0, t0, 1
    sll t5, t5, t0
    add t6, t6, t0
    andi t6, t6, 255
    li t0, 0xf7000000 // full light
    or t6, t6, t0
    words lw, a0, run_right, t0, t1
    words sw, a2, 0, t3, t4, t5, t6
    addi a1, a1, 12
    bgtu t3, t0, outside
    bgtu t4, t1, outside
put:
    addi a2, a2, 16
    bne a1, a3, next
done:
    sw a1, run_from(a0)
    sw a2, run_to(a0)
    restore 64, SAVED
hand_back:
    words sw, a0, run_at, t3, t4, t5
    j done
outside: // clip codes: left, right, top, bottom = 1, 2, 4, 8
    sgt t0, t3, t0
    sgt t1, t4, t1
    slli t0, t0, 1
    slli t1, t1, 3
    or t0, t0, t1
    srli t3, t3, 31
    srli t4, t4, 31
    slli t4, t4, 2
    or t0, t0, t3
    or t0, t0, t4
    sb t0, vertex_code(a2)
    lw t1, run_codes(a0)
    or t1, t1, t0
    sw t1, run_codes(a0)
    j put
    .size ph_vertices, . - ph_vertices
