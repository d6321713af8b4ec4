@ ph_float_depths of kernels.h for ARMv6-M. A triangle takes some 80 instructions.
@
@ Registers: r2 the bias, then the offset of the octave; r3 results; r4 far_q, r5 far_s + 256 float_down; r12 corners,
@ lr octave + 2. Shifts take the low byte of a register.
#include "../thumb.inc"
#include "../offsets.inc"

    @ Puts d of the vertex at r0 into r6, its s into r7. Changes r0, r1.
    .macro own_depth
    ldr r6, [r0, #vertex_q]
    ldrb r7, [r0, #vertex_s]
    subs r0, r5, r7
    movs r1, r4
    lsrs r1, r0
    subs r6, r6, r1
    bls none
    .endm

    @ Stores the code of corner `at`.
    .macro corner at
    mov r0, r12
    ldr r0, [r0, #4 * \at]
    own_depth
    mov r0, lr
    subs r0, r0, r7
    movs r1, #31
    subs r1, r1, r0
    movs r7, r6
    lsrs r7, r1
    cmp r7, #1
    bne none
    lsls r6, r0
    lsrs r0, r5, #8
    lsrs r6, r0
    adds r6, r6, r2
    str r6, [r3, #4 * \at]
    .endm

    function ph_float_depths, scenery @ r0: struct ph_lens, r1: corners, r2: bias, r3: results
    push {r4-r7, lr}
    mov r12, r1
    ldr r4, [r0, #lens_far_q]
    ldrh r5, [r0, #lens_far_s]
    ldr r0, [r1]
    own_depth
    ldr r1, =fx_clz_table
    lsrs r0, r6, #24
    beq 2f
    ldrb r0, [r1, r0]
1:  adds r7, r7, r0
    mov lr, r7
    lsls r6, r0
    lsrs r0, r5, #8
    lsrs r6, r0
    movs r1, r7
    lsrs r1, r0
    cmp r1, #2
    bhs none
    movs r1, #31
    subs r1, r1, r0
    lsls r7, r1
    subs r2, r2, r7
    adds r6, r6, r2
    str r6, [r3]
    corner 1
    corner 2
    movs r0, #1
    pop {r4-r7, pc}
2:  lsrs r0, r6, #16
    beq 3f
    ldrb r0, [r1, r0]
    adds r0, #8
    b 1b
3:  lsrs r0, r6, #8
    beq 4f
    ldrb r0, [r1, r0]
    adds r0, #16
    b 1b
4:  ldrb r0, [r1, r6]
    adds r0, #24
    b 1b
none:
    movs r0, #0
    pop {r4-r7, pc}
    .size ph_float_depths, . - ph_float_depths
    .p2align 2
    .ltorg
