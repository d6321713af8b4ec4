@ ph_vertices (see vertices.h) for ARMv6-M. A vertex takes some 240 instructions, 215 within a cube of 1.0 each way.
@
@ Registers: r10 the struct ph_vertex_run, r8 from, r9 to, r11 r12 x, y before the divide, lr full light at its place in
@ the word; r7 the struct from `near` to `round_x`, then its member `bottom`.
#include "../thumb.inc"
#include "../offsets.inc"
#include "matvec_offsets.inc"
#include "registers.inc"

    @ r3 = a row of three digits times (r0, r1, r2); see matvec.h. Steps r7 to the next row.
    .macro row_times
    ldmia r7!, {r3-r6}
    muls r3, r0
    muls r4, r1
    muls r5, r2
    adds r3, r4
    adds r3, r5
    adds r3, r6
    asrs r3, #10
    ldmia r7!, {r4-r6}
    muls r4, r0
    muls r5, r1
    muls r6, r2
    adds r3, r4
    adds r3, r5
    adds r3, r6
    asrs r3, #10
    ldmia r7!, {r4-r6}
    muls r4, r0
    muls r5, r1
    muls r6, r2
    adds r3, r4
    adds r3, r5
    adds r3, r6
    asrs r3, #8
    ldmia r7!, {r4}
    adds r3, r4
    .endm

    @ r3 = a row of two digits times (r0, r1, r2); see matvec.h. Steps r7 to the next row.
    .macro short_row_times
    ldmia r7!, {r3-r6}
    muls r3, r0
    muls r4, r1
    muls r5, r2
    adds r3, r4
    adds r3, r5
    adds r3, r6
    asrs r3, #14
    ldmia r7!, {r4-r6}
    muls r4, r0
    muls r5, r1
    muls r6, r2
    adds r3, r4
    adds r3, r5
    adds r3, r6
    asrs r3, #14
    ldmia r7!, {r4}
    adds r3, r4
    .endm

    @ \v = \v (signed) times (2^16 r5 + r2) / 2^32, rounded down. Changes \l, r3, r6.
    .macro times_high v, l
    uxth \l, \v
    asrs \v, #16
    movs r3, \l
    muls r3, r2
    lsrs r3, #16
    movs r6, \v
    muls r6, r2
    adds r3, r6
    muls \l, r5
    uxth r6, r3
    adds \l, r6
    muls \v, r5
    asrs r3, #16
    adds \v, r3
    asrs \l, #16
    adds \v, \l
    .endm

    function ph_vertices, loop @ r0: struct ph_vertex_run
    save_registers
    mov r10, r0
    movs r7, r0
    ldr r1, [r0, #run_from]
    mov r8, r1
    ldr r2, [r0, #run_to]
    mov r9, r2
    movs r2, #0xf7
    lsls r2, #24
    mov lr, r2
    adds r7, #run_bottom
    b until
hand_back:
    movs r2, r3
    mov r0, r11
    mov r1, r12
    stmia r7!, {r0-r2} @ `at`, which is the first member
stop:
    mov r3, r8
    subs r3, #12
    mov r8, r3
    b done
next:
    mov r3, r8
    ldmia r3!, {r0-r2} @ x y z
    mov r8, r3
    ldr r4, [r7, #run_short_range - run_bottom]
    adds r5, r0, r4
    adds r6, r1, r4
    orrs r5, r6
    adds r6, r2, r4
    orrs r5, r6
    lsls r4, #1
    cmp r5, r4
    blo 1f
    b large
1:  adds r7, #run_short_row - run_bottom
    short_row_times
    mov r11, r3
    short_row_times
    mov r12, r3
    short_row_times
placed:
    @ Leave if the vertex is outside the near plane, the far plane or the guard band.
    ldmia r7!, {r4-r6} @ near, range, guard_up
    mov r7, r10
    subs r4, r3, r4
    cmp r4, r5
    bhi hand_back
    mov r0, r11
    mov r1, r12
    asrs r4, r0, #31
    eors r4, r0
    asrs r5, r1, #31
    eors r5, r1
    orrs r4, r5
    movs r5, r3
    lsrs r5, r6
    lsls r5, #3
    cmp r4, r5
    bhs hand_back
    @ fx_rcp_norm(r3): r5 becomes the result, r4 the leading zeros.
    ldr r6, =fx_clz_table
    lsrs r4, r3, #16
    beq 1f
    lsrs r5, r4, #8
    beq 2f
    ldrb r4, [r6, r5] @ 2^24 and more
    b 4f
1:  lsrs r5, r3, #8
    beq 3f
    ldrb r4, [r6, r5] @ below 2^16
    adds r4, #16
    b 4f
3:  ldrb r4, [r6, r3] @ below 2^8
    adds r4, #24
    b 4f
2:  ldrb r4, [r6, r4]
    adds r4, #8
4:
    lsls r3, r4 @ d
    lsrs r5, r3, #23
    lsls r5, #1
    ldr r6, =fx_rcp_table - 512
    ldrh r5, [r6, r5] @ r0
    lsrs r6, r3, #4
    muls r6, r5
    rsbs r6, r6, #0 @ e0
    asrs r2, r6, #16
    muls r2, r2
    lsrs r2, #19
    asrs r6, #12
    adds r6, r2
    adds r6, #6 @ u
    muls r6, r5
    asrs r6, #15
    lsls r5, #12
    adds r5, r6 @ r1
    lsrs r6, r3, #1 @ carry: the last bit of d
    muls r6, r5
    bcc 1f
    lsrs r2, r5, #1
    adds r6, r2
1:  rsbs r6, r6, #0 @ e1
    asrs r6, #16
    adds r6, #48
    lsrs r2, r5, #9
    muls r6, r2
    lsls r5, #7
    asrs r6, #22 @ carry: the half
    add r5, r6
    bcs 2f
    movs r6, r5
    muls r6, r3
    rsbs r6, r6, #0
    lsrs r6, #31
    subs r5, r6
2:  @ Depth: q is the high word of depth_scale times the reciprocal, with its upper bit at 30.
    ldrh r2, [r7, #run_depth_scale]
    ldrh r1, [r7, #run_depth_scale + 2]
    uxth r3, r5
    lsrs r6, r5, #16
    movs r0, r2
    muls r0, r3
    lsrs r0, #16
    muls r3, r1
    adds r3, r0
    muls r2, r6
    uxth r0, r3
    adds r2, r0
    muls r1, r6
    lsrs r3, #16
    adds r1, r3
    lsrs r2, #16
    adds r1, r2
    ldr r2, [r7, #run_near_shift]
    subs r2, r4
    lsrs r3, r1, #30
    bne 3f
    lsls r1, #1
    adds r2, #1
3:  mov r3, r9
    mov r6, lr
    str r1, [r3, #vertex_q]
    str r6, [r3, #vertex_s]
    strb r2, [r3, #vertex_s]
    @ The place on the screen: x / w and y / w, plus the centre.
    lsrs r5, #1
    subs r4, #4
    uxth r2, r5
    lsrs r5, #16
    mov r0, r11
    lsls r0, r4
    mov r1, r12
    lsls r1, r4
    times_high r0, r4
    times_high r1, r4
    adds r7, #run_round_x + 4
    ldmia r7!, {r2-r6} @ the high words of round_x and, in r4, round_y; down, right
    adds r0, r2
    adds r1, r4
    asrs r0, r5
    asrs r1, r5
    cmp r0, r6
    bhi outside
    ldr r5, [r7]
    cmp r1, r5
    bhi outside
    mov r3, r9
put:
    stmia r3!, {r0, r1}
    adds r3, #8
    mov r9, r3
until:
    ldr r4, [r7, #run_end - run_bottom]
    cmp r8, r4
    beq done
    b next
large: @ beyond the cube of 1.0: are all coordinates within -2^20 .. 2^20?
    movs r4, #1
    lsls r4, #20
    adds r5, r0, r4
    adds r6, r1, r4
    orrs r5, r6
    adds r6, r2, r4
    orrs r5, r6
    lsrs r5, #21
    beq 1f
    b stop
1:  adds r7, #run_row - run_bottom
    row_times
    mov r11, r3
    row_times
    mov r12, r3
    row_times
    adds r7, #run_near - run_short_row
    b placed
outside: @ clip codes: left, right, top, bottom = 1, 2, 4, 8
    ldr r5, [r7]
    movs r2, #1
    cmp r0, #0
    blt 1f
    movs r2, #2
    cmp r0, r6
    bgt 1f
    movs r2, #0
1:  movs r3, #4
    cmp r1, #0
    blt 2f
    movs r3, #8
    cmp r1, r5
    bgt 2f
    movs r3, #0
2:  orrs r2, r3
    mov r3, r9
    strb r2, [r3, #vertex_code]
    mov r5, r10
    ldr r4, [r5, #run_codes]
    orrs r4, r2
    str r4, [r5, #run_codes]
    b put
done:
    mov r7, r10
    mov r1, r8
    str r1, [r7, #run_from]
    mov r2, r9
    str r2, [r7, #run_to]
    restore_and_return
    .size ph_vertices, . - ph_vertices
    .p2align 2
    .ltorg
