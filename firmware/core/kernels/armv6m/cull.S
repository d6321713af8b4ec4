@ ph_cull (see cull.h) for ARMv6-M. A triangle without clip codes takes 29 instructions (38 if it is 16 px high or
@ more), a triangle that may have codes 36, a call some 65.
@
@ Registers: r0 vertices, r1 index; r3 r4 r5 the corners a, b, c; then their x, y: a in r3 r6, b in r4 r7, c in r2 r5;
@ r8 end, r9 2^12, r10 the struct ph_cull_run.
#include "../thumb.inc"
#include "../offsets.inc"

    @ Loads the corners of the next triangle.
    .macro corners
    ldrh r3, [r1]
    ldrh r4, [r1, #2]
    ldrh r5, [r1, #4]
    adds r1, #6
    lsls r3, #4
    lsls r4, #4
    lsls r5, #4
    adds r3, r0
    adds r4, r0
    adds r5, r0
    .endm

    @ Computes (b - a).x (c - a).y + (a - c).x (b - a).y, which is negative if a, b, c run counter-clockwise.
    .macro turn
    ldmia r3, {r3, r6}
    ldmia r4, {r4, r7}
    ldmia r5, {r2, r5}
    subs r4, r3
    subs r7, r6
    subs r5, r6
    subs r3, r2
    mov r2, r9
    adds r6, r7, r2
    adds r2, r5
    orrs r2, r6
    lsrs r2, #13
    bne 1f @ the height is 2^12 or more: products may take 38 bits
    muls r4, r5
    muls r3, r7
    adds r3, r4
    bmi found
    cmp r1, r8
    .endm

    @ The same divided by 256, rounded down.
    .macro turn_high
    asrs r2, r5, #8
    uxtb r5, r5
    asrs r6, r7, #8
    uxtb r7, r7
    muls r2, r4
    muls r6, r3
    adds r2, r6
    muls r4, r5
    muls r3, r7
    adds r3, r4
    asrs r3, #8
    adds r3, r2
    bmi found
    cmp r1, r8
    .endm

    function ph_cull @ r0: struct ph_cull_run
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    push {r4-r6}
    mov r10, r0
    ldmia r0, {r0-r3}
    mov r8, r2
    movs r4, #1
    lsls r4, #12
    mov r9, r4
    cmp r1, r2
    bhs none
    cmp r3, #0
    bne coded
plain:
    corners
    turn
    bne plain
    b none
1:  turn_high
    bne plain
    b none
coded:
    corners
    ldrb r2, [r3, #vertex_code]
    ldrb r6, [r4, #vertex_code]
    ldrb r7, [r5, #vertex_code]
    orrs r2, r6
    orrs r2, r7
    lsls r2, #25 @ is any bit set but PH_LIT?
    bne 2f
    turn
    bne coded
    b none
1:  turn_high
    bne coded
    b none
2:  ldrb r2, [r3, #vertex_code]
    ands r2, r6
    ands r2, r7
    lsls r2, #26 @ do they share one of the six planes?
    beq some
    cmp r1, r8
    bne coded
none:
    movs r0, #0
    mov r2, r10
    str r1, [r2, #cull_index]
    b out
some:
    movs r0, #1
    mov r2, r10
    str r1, [r2, #cull_index]
    adds r2, #cull_v
    stmia r2!, {r3-r5}
    b out
found:
    subs r1, #6
    corners
    mov r2, r10
    str r1, [r2, #cull_index]
    adds r2, #cull_v
    stmia r2!, {r3-r5}
    ldmia r3!, {r0, r1}
    ldmia r4, {r3, r4}
    ldmia r5, {r5, r6}
    subs r3, r0
    subs r4, r1
    subs r5, r0
    subs r6, r1
    stmia r2!, {r3-r6}
    movs r0, #1 @ is -2^14 <= d < 2^14 for each difference? Then the sides are short.
    lsls r0, #14
    adds r1, r3, r0
    adds r7, r4, r0
    orrs r1, r7
    adds r7, r5, r0
    orrs r1, r7
    adds r7, r6, r0
    orrs r1, r7
    movs r0, #1
    lsrs r1, #15
    beq 3f
    movs r1, #0
    b 4f
3:  muls r5, r4
    muls r3, r6
    subs r0, r5, r3
    movs r1, #1
4:  stmia r2!, {r0, r1}
    movs r0, #1
out:
    pop {r4-r6}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    pop {r4-r7, pc}
    .size ph_cull, . - ph_cull
