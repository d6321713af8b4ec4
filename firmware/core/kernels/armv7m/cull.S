@ ph_cull (see cull.h) for ARMv7-M. A triangle without clip codes that faces away takes 19 instructions, one that may have
@ codes 28; to list one takes some 55 more.
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

    @ Marks a corner for the light; r7 is PH_LIT, r8 is 0.
    .macro mark corner
    ldrb r6, [\corner, #vertex_code]
    tst r6, r7
    bne 3f
    orrs r6, r7
    strb r6, [\corner, #vertex_code]
    strh r8, [\corner, #vertex_light]
3:
    .endm

    function ph_cull, loop @ r0: struct ph_cull_run
    push {r4-r11, lr}
    mov lr, r0
    ldmia r0, {r0-r3}
    cmp r1, r2
    bhs none
    cmp r3, #0
    bne coded
no_codes:
    corners
    turn
    bmi found
    cmp r1, r2
    bne no_codes
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
    beq look
    cmp r1, r2
    bne coded
    b none
look: @ the caller must look at this triangle
    str r1, [lr, #cull_index]
    movs r0, #1
    pop {r4-r11, pc}
found: @ r8, r9: b - a; r10: (a - c).x; r11: (c - a).y. The rows of the highest and the lowest corner, from a
    ldr r12, [r3, #vertex_y]
    cmp r9, r11
    ite lt
    movlt r6, r9
    movge r6, r11
    ite lt
    movlt r7, r11
    movge r7, r9
    and r6, r6, r6, asr #31 @ the least of it and 0
    bic r7, r7, r7, asr #31 @ the most
    add r6, r12
    add r7, r12
    adds r6, #127
    asr r6, #8
    adds r7, #127
    cmp r6, r7, asr #8
    bge next
    add r8, #256 @ is it less than 2 px wide?
    rsb r10, r10, #256
    orr r8, r10
    lsrs r8, #9
    beq look
    ldrd r7, r8, [lr, #cull_to]
    cmp r7, r8
    beq look
    ldr r8, [lr, #cull_band_scale]
    mul r6, r8, r6
    lsrs r6, #20
    strh r6, [r7, #-2]!
    ldrh r6, [r1, #-2]
    strh r6, [r7, #-2]!
    ldrh r6, [r1, #-4]
    strh r6, [r7, #-2]!
    ldrh r6, [r1, #-6]
    strh r6, [r7, #-2]!
    str r7, [lr, #cull_to]
    ldr r7, [lr, #cull_mark]
    movs r8, #0
    cbz r7, next
    mark r3
    mark r4
    mark r5
next:
    ldr r6, [lr, #cull_codes]
    cmp r1, r2
    beq none
    cmp r6, #0
    beq no_codes
    b coded
    .size ph_cull, . - ph_cull
