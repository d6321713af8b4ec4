@ ph_vertices (see vertices.h) for ARMv7-M. A vertex takes 82 instructions.
@
@ Registers: r0 the struct ph_vertex_run, r1 from, r2 to; r7 r8 r9: x, y, w before the divide.
#include "../thumb.inc"
#include "../offsets.inc"
#include "matvec_offsets.inc"

    function ph_vertices, loop @ r0: struct ph_vertex_run
    push {r4-r11, lr}
    ldr r1, [r0, #run_from]
    ldr r2, [r0, #run_to]
    ldr r3, [r0, #run_end]
    movs r4, #0
    msr apsr_nzcvq, r4
    cmp r1, r3
    bhs done
next:
    ldmia r1!, {r3-r5} @ x y z
    ssat r3, #28, r3 @ sets Q if a coordinate is beyond the reach
    ssat r4, #28, r4
    ssat r5, #28, r5
    mrs r6, apsr
    lsls r6, #4
    bmi stop
    lsls r3, #4
    lsls r4, #4
    lsls r5, #4
    @ The rows of the matrix: each has 64 bits of translation, then its elements.
    add r12, r0, #run_row
    ldmia r12!, {r6-r11}
    smlal r6, r7, r8, r3
    smlal r6, r7, r9, r4
    smlal r6, r7, r10, r5
    ldmia r12!, {r6, r8-r11, lr}
    smlal r6, r8, r9, r3
    smlal r6, r8, r10, r4
    smlal r6, r8, r11, r5
    ldmia r12, {r6, r9-r11, lr}
    smlal r6, r9, r10, r3
    smlal r6, r9, r11, r4
    smlal r6, r9, lr, r5
    @ Leave if the vertex is outside the near plane, the far plane or the guard band.
    ldrd r3, r4, [r0, #run_near]
    subs r3, r9, r3
    cmp r3, r4
    bhi hand_back
    eor r3, r7, r7, asr #31
    eor r4, r8, r8, asr #31
    orrs r3, r4
    ldr r4, [r0, #run_guard_up]
    lsr r4, r9, r4
    cmp r3, r4, lsl #3
    bhs hand_back
    @ fx_rcp_norm(w), d = w << shift: r0 = 2^32 / (d >> 15), and n = (r0 d - 2^47) / 2.
    clz r3, r9
    lsl r9, r9, r3
    lsr r4, r9, #15
    mov r5, #-1
    udiv r5, r5, r4
    umull r6, r10, r5, r9
    lsrs r6, #1
    orr r6, r6, r10, lsl #31
    @ 2^62 / d = 2^15 r0 (1 - m) with m = n - n^2 in 2^-46, |n| < 2^31. A little less than m is taken, so that the
    @ result may be one too large but is never too small.
    smull r10, r11, r6, r6
    sub r6, r6, r11, asr #14
    subs r6, #16
    lsls r5, #15
    smull r10, r11, r5, r6
    mvns r11, r11, asr #14 @ carry: less than a half above the whole number
    add r5, r11
    mul r6, r5, r9
    rsb r6, r6, #0
    it cs
    subcs r5, r5, r6, lsr #31
    @ The place on the screen: x / w and y / w, plus the centre.
    subs r4, r3, #4
    lsls r7, r4
    lsl r8, r8, r4
    lsrs r4, r5, #1
    ldrd r10, r11, [r0, #run_round_x]
    smlal r10, r11, r7, r4
    ldrd r6, r12, [r0, #run_round_y]
    smlal r6, r12, r8, r4
    ldr r4, [r0, #run_down]
    asr r8, r11, r4
    asr r9, r12, r4
    @ Store the depth q, with its upper bit at 30.
    ldrd r6, r7, [r0, #run_depth_scale]
    umull r6, r10, r6, r5
    subs r7, r3
    tst r10, #0x40000000
    itt eq
    lsleq r10, r10, #1
    addeq r7, #1
    uxtb r11, r7
    orr r11, #0xf7000000 @ full light
    ldrd r3, r4, [r0, #run_right]
    cmp r8, r3
    bhi outside
    cmp r9, r4
    bhi outside
put:
    stmia r2!, {r8-r11}
    ldr r3, [r0, #run_end]
    cmp r1, r3
    bne next
    b done
outside: @ clip codes: left, right, top, bottom = 1, 2, 4, 8
    movs r5, #0
    cmp r8, r3
    it gt
    movgt r5, #2
    cmp r8, #0
    it lt
    movlt r5, #1
    cmp r9, r4
    it gt
    orrgt r5, #8
    cmp r9, #0
    it lt
    orrlt r5, #4
    orr r11, r11, r5, lsl #8
    ldr r6, [r0, #run_codes]
    orrs r6, r5
    str r6, [r0, #run_codes]
    b put
hand_back:
    add r12, r0, #run_at
    stmia r12, {r7-r9}
stop:
    subs r1, #12
done:
    str r1, [r0, #run_from]
    str r2, [r0, #run_to]
    pop {r4-r11, pc}
    .size ph_vertices, . - ph_vertices
