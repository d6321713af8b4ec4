@ ph_cull (see cull.h) for ARMv6-M. A triangle without clip codes that faces away takes 29 instructions (38 if it is 16 px
@ high or more), one that may have codes 36; to list one takes some 67 more.
@
@ Registers: r0 vertices, r1 index; r3 r4 r5 the corners a, b, c; then their x, y: a in r3 r6, b in r4 r7, c in r2 r5;
@ r8 end, r9 2^12, r10 the struct ph_cull_run, r11 a row, lr where the loop begins.
#include "../thumb.inc"
#include "../offsets.inc"

    @ Loads the corners of the next triangle.
    .macro corners step
    ldrh r3, [r1]
    ldrh r4, [r1, #2]
    ldrh r5, [r1, #4]
    .if \step
    adds r1, #\step
    .endif
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

    @ Computes what turn does, divided by 256 and rounded down.
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

    @ Marks a corner for the light; r6 is PH_LIT, r7 is 0.
    .macro mark corner
    ldrb r2, [\corner, #vertex_code]
    tst r2, r6
    bne 5f
    orrs r2, r6
    strb r2, [\corner, #vertex_code]
    strh r7, [\corner, #vertex_light]
5:
    .endm

    function ph_cull, loop @ r0: struct ph_cull_run
    push {r4-r7, lr}
    mov r3, r8
    mov r4, r9
    mov r5, r10
    mov r6, r11
    push {r3-r6}
    mov r10, r0
    ldmia r0, {r0-r3}
    mov r8, r2
    movs r4, #1
    lsls r4, #12
    mov r9, r4
    cmp r1, r2
    bhs none
    cmp r3, #0
    bne with_codes
    ldr r4, =no_codes + 1
    mov lr, r4
no_codes:
    corners 6
    turn
    bne no_codes
    b none
1:  turn_high
    bne no_codes
    b none
with_codes:
    ldr r4, =coded + 1
    mov lr, r4
coded:
    corners 6
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
    beq look
    cmp r1, r8
    bne coded
none:
    movs r0, #0
    mov r2, r10
    str r1, [r2, #cull_index]
    b out
look_here:
    adds r1, #6
look: @ the caller must look at this triangle
    movs r0, #1
    mov r2, r10
    str r1, [r2, #cull_index]
out:
    pop {r3-r6}
    mov r8, r3
    mov r9, r4
    mov r10, r5
    mov r11, r6
    pop {r4-r7, pc}
found:
    subs r1, #6
    corners 0
    ldr r2, [r3, #vertex_y] @ the first row of the highest corner in r2, of the lowest in r6
    ldr r6, [r4, #vertex_y]
    ldr r7, [r5, #vertex_y]
    cmp r2, r6
    ble 1f
    eors r2, r6
    eors r6, r2
    eors r2, r6
1:  cmp r7, r2
    bge 2f
    mov r2, r7
2:  cmp r7, r6
    ble 3f
    mov r6, r7
3:  adds r2, #127
    asrs r2, #8
    adds r6, #127
    asrs r6, #8
    cmp r2, r6
    bge next
    mov r11, r2
    ldr r6, [r3] @ is it less than 2 px wide?
    ldr r7, [r4]
    ldr r2, [r5]
    subs r6, #255
    subs r6, #1
    subs r7, r6
    subs r2, r6
    orrs r2, r7
    lsrs r2, #9
    beq look_here
    mov r2, r10
    ldr r6, [r2, #cull_to]
    ldr r7, [r2, #cull_limit]
    cmp r6, r7
    beq look_here
    subs r6, #8
    str r6, [r2, #cull_to]
    ldr r7, [r2, #cull_band_scale]
    mov r2, r11
    muls r2, r7
    lsrs r2, #20
    strh r2, [r6, #6]
    ldrh r2, [r1]
    strh r2, [r6]
    ldrh r2, [r1, #2]
    strh r2, [r6, #2]
    ldrh r2, [r1, #4]
    strh r2, [r6, #4]
    mov r2, r10
    ldr r6, [r2, #cull_mark]
    cmp r6, #0
    beq next
    movs r7, #0
    mark r3
    mark r4
    mark r5
next:
    adds r1, #6
    cmp r1, r8
    beq none
    bx lr
    .size ph_cull, . - ph_cull
    .p2align 2
    .ltorg
