@ ph_cull (see cull.h) for ARMv7-M. A triangle without clip codes takes 19 instructions, one that may have codes 28, a
@ call some 35.
@
@ Registers: r0 vertices, r1 index, r2 end, lr the struct ph_cull_run; r3 r4 r5 the corners a, b, c; r6 r7 r12 scratch.
#include "../thumb.inc"
#include "../offsets.inc"

    @ Loads the corners of the next triangle.
    .macro corners
    ldrh r3, [r1], #2
    ldrh r4, [r1], #2
    ldrh r5, [r1], #2
    add r3, r0, r3, lsl #4
    add r4, r0, r4, lsl #4
    add r5, r0, r5, lsl #4
    .endm

    @ With r8, r9: b - a, r10: (a - c).x, r11: (c - a).y, computes r8 r11 + r10 r9. It is negative if a, b, c run
    @ counter-clockwise.
    .macro turn
    ldrd r6, r7, [r3]
    ldrd r8, r9, [r4]
    ldrd r10, r11, [r5]
    subs r8, r6
    subs r9, r7
    subs r10, r6, r10
    subs r11, r7
    smull r6, r7, r8, r11
    smlal r6, r7, r10, r9
    cmp r7, #0
    .endm

    function ph_cull @ r0: struct ph_cull_run
    push {r4-r11, lr}
    mov lr, r0
    ldmia r0, {r0-r3}
    cmp r1, r2
    bhs none
    cmp r3, #0
    bne coded
plain:
    corners
    turn
    bmi found
    cmp r1, r2
    bne plain
    b none
coded:
    corners
    ldrb r6, [r3, #vertex_code]
    ldrb r7, [r4, #vertex_code]
    ldrb r8, [r5, #vertex_code]
    orr r9, r6, r7
    orr r9, r8
    tst r9, #0x7f @ is any bit set but PH_LIT?
    bne 1f
    turn
    bmi found
    cmp r1, r2
    bne coded
none:
    str r1, [lr, #cull_index]
    movs r0, #0
    pop {r4-r11, pc}
1:  ands r6, r7
    and r6, r8
    tst r6, #0x3f @ do they share one of the six planes?
    beq some
    cmp r1, r2
    bne coded
    b none
some:
    add r0, lr, #cull_v
    str r1, [lr, #cull_index]
    stmia r0, {r3-r5}
    movs r0, #1
    pop {r4-r11, pc}
found:
    add r0, lr, #cull_v
    str r1, [lr, #cull_index]
    rsb r10, r10, #0
    add r1, r8, #0x4000 @ is -2^14 <= d < 2^14 for each difference? Then the sides are short.
    add r2, r9, #0x4000
    orrs r1, r2
    add r2, r10, #0x4000
    orrs r1, r2
    add r2, r11, #0x4000
    orrs r1, r2
    lsrs r1, #15
    ite eq
    rsbeq r12, r6, #0
    movne r12, #1
    clz r1, r1
    lsr lr, r1, #5
    stmia r0, {r3-r5, r8-r12, lr}
    movs r0, #1
    pop {r4-r11, pc}
    .size ph_cull, . - ph_cull
