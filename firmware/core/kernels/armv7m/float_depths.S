@ ph_float_depths of kernels.h for ARMv7-M. A triangle takes some 50 instructions.
@
@ Registers: r2 the bias, then the offset of the octave; r3 results; r4 far_q, r5 far_s, r6 d and r7 s of a corner, r8
@ octave + 2, r12 float_down.
#include "../thumb.inc"
#include "../offsets.inc"

    @ Puts d of the vertex at r0 into r6, its s into r7. Changes r0.
    .macro own_depth
    ldr r6, [r0, #vertex_q]
    ldrb r7, [r0, #vertex_s]
    subs r0, r5, r7
    lsr r0, r4, r0
    subs r6, r6, r0
    bls none
    .endm

    @ Stores the code of corner `at`.
    .macro corner at
    ldr r0, [r1, #4 * \at]
    own_depth
    sub r7, r8, r7
    rsb r0, r7, #31
    lsr r0, r6, r0
    cmp r0, #1
    bne none
    lsls r6, r6, r7
    lsr r6, r6, r12
    add r6, r6, r2
    str r6, [r3, #4 * \at]
    .endm

    function ph_float_depths @ r0: struct ph_lens, r1: corners, r2: bias, r3: results
    push {r4-r8, lr}
    ldr r4, [r0, #lens_far_q]
    ldrb r5, [r0, #lens_far_s]
    ldrb r12, [r0, #lens_float_down]
    ldr r0, [r1]
    own_depth
    clz r0, r6
    add r8, r7, r0
    lsr r7, r8, r12
    cmp r7, #2
    bhs none
    rsb r7, r12, #31
    lsl r7, r8, r7
    subs r2, r2, r7
    lsls r6, r6, r0
    lsr r6, r6, r12
    add r6, r6, r2
    str r6, [r3]
    corner 1
    corner 2
    movs r0, #1
    pop {r4-r8, pc}
none:
    movs r0, #0
    pop {r4-r8, pc}
    .size ph_float_depths, . - ph_float_depths
