@ ph_setup_small and ph_setup_fast of kernels.h for ARMv7-M. A triangle takes some 185 instructions, and some 95 more
@ from its reference on.
#include "../thumb.inc"
#include "../offsets.inc"

    .equ side_bits, 0 @ on the stack; plus 1; it takes the place of the triangle
    .equ corners, 4
    .equ sides, 8
    .equ depths, 12
    .equ own_corners, triangle_slopes + 8 @ in the triangle: ph_setup_fast keeps what ph_setup_small takes
    .equ own_sides, triangle_slopes + 20 @ behind the slopes
    .equ own_depths, triangle_slopes + 40

    @ The edge from a down to b, whose first row is given: r1 becomes x at that row, r10 the slope, and r2 how far
    @ it is down from a to that row. r12 is 2^31 - 1. Changes r3, lr.
    .macro edge a, b, row
    ldrd r1, lr, [\a]
    rsb r2, lr, \row, lsl #8
    adds r2, #128
    edge_from \b
    .endm

    @ The rest of `edge`, from a corner whose x and y are in r1 and lr; r2 is set.
    .macro edge_from b
    ldrd r3, r10, [\b]
    subs r3, r3, r1
    sub r10, r10, lr
    clz lr, r10
    lsl r10, r10, lr
    lsr r10, r10, #16
    udiv r10, r12, r10
    add r10, r10, r3, lsr #31
    mul r10, r10, r3
    rsb lr, lr, #31
    asrs r3, r10, #8
    muls r3, r2, r3
    asr r3, r3, lr
    asr r10, r10, lr
    add r1, r3, r1, lsl #8
    add r1, r1, r12, lsr #16 @ .5 px, rounded up
    .endm

    @ Raises the shift `down` until it cuts the gradient r11, lr to `limit` bits. Changes \a and \b.
    .macro flatten down, limit, a, b
    eor \a, r11, r11, asr #31
    eor \b, lr, lr, asr #31
    orr \a, \a, \b
    clz \a, \a
    rsb \a, \a, #32 - \limit
    cmp \down, \a
    it lt
    movlt \down, \a
    cmp \down, #0
    .endm

    @ \v, a corner, becomes its depth in fixed16 for the bias r6. One of both shifts, by the low byte, is too long and
    @ gives 0. Changes r7, r8.
    .macro fixed_depth v
    ldrb r7, [\v, #vertex_s]
    ldr \v, [\v, #vertex_q]
    subs r7, #2
    lsr r8, \v, r7
    rsbs r7, r7, #0
    lsl r7, \v, r7
    orr \v, r7, r8
    add \v, \v, r6
    .endm

    @ Goes away if the corner \x, \y comes within a pixel of the borders. r9, r10: size less 2 pixels. Changes r8.
    .macro off_borders x, y
    sub r8, \x, #256
    cmp r8, r9
    itt ls
    subls r8, \y, #256
    cmpls r8, r10
    bhi general
    .endm

    function ph_setup_fast, loop @ r0: struct ph_fast, r1: struct ph_ref, r2: struct ph_triangle
    push {r4-r11, lr}
    ldrh r3, [r1]
    ldrh r4, [r1, #2]
    ldrh r5, [r1, #4]
    ldmia r0, {r1, r8-r10, r12} @ base, margin, inner_x, inner_y, side
    add r3, r1, r3, lsl #4
    add r4, r1, r4, lsl #4
    add r5, r1, r5, lsl #4
    @ Does the first corner stay far enough from the borders?
    ldrd r6, r7, [r3]
    sub r11, r6, r8
    cmp r11, r9
    itt lo
    sublo r11, r7, r8
    cmplo r11, r10
    bhs border
inside:
    @ The sides: r8, r9 from a to b, r10, r11 from a to c. Are they below r12?
    ldrd r8, r9, [r4]
    ldrd r10, r11, [r5]
    subs r8, r8, r6
    subs r9, r9, r7
    subs r10, r10, r6
    subs r11, r11, r7
    add r6, r8, r12
    add r7, r9, r12
    orrs r6, r7
    add r7, r10, r12
    orrs r6, r7
    add r7, r11, r12
    orrs r6, r7
    subs r7, r10, r8
    add r7, r7, r12
    orrs r6, r7
    cmp r6, r12, lsl #1
    bhs general
    mul r12, r10, r9
    mls r12, r8, r11, r12
    adds r2, #own_corners
    stmia r2!, {r3-r5, r8-r12}
    ldr r12, [r0, #fast_lens]
    cmp r12, #0
    beq fixed
    @ ph_float_depths, mostly of three corners with one exponent.
    ldrb r6, [r3, #vertex_s]
    ldrb r7, [r4, #vertex_s]
    ldrb r8, [r5, #vertex_s]
    cmp r6, r7
    it eq
    cmpeq r6, r8
    bne apart
    ldr r3, [r3, #vertex_q]
    ldr r4, [r4, #vertex_q]
    ldr r5, [r5, #vertex_q]
    ldr r7, [r12, #lens_far_q]
    ldrb r8, [r12, #lens_far_s]
    ldrb r12, [r12, #lens_float_down]
    subs r8, r8, r6
    lsr r7, r7, r8
    subs r3, r3, r7
    it hi
    subshi r4, r4, r7
    it hi
    subshi r5, r5, r7
    bls general
    clz r7, r3
    eor r8, r3, r4
    eor r9, r3, r5
    orr r8, r8, r9
    rsb r9, r7, #31
    lsrs r8, r8, r9
    bne general
    add r6, r6, r7
    lsr r8, r6, r12
    cmp r8, #2
    bhs general
    rsb r8, r12, #31
    ldr r9, [r0, #fast_bias]
    lsls r6, r6, r8
    subs r6, r9, r6
    lsls r3, r3, r7
    lsls r4, r4, r7
    lsls r5, r5, r7
    lsr r3, r3, r12
    lsr r4, r4, r12
    lsr r5, r5, r12
    adds r3, r3, r6
    adds r4, r4, r6
    adds r5, r5, r6
    stmia r2, {r3-r5}
known:
    ldrd r6, r7, [r0, #fast_ramp]
    sub r0, r2, #own_depths
    mov r3, r2
    sub r2, r2, #own_depths - own_sides
    sub r1, r2, #own_sides - own_corners
    str r6, [r0, #triangle_ramp]
    str r7, [r0, #triangle_material]
    mvn r4, #0xff @ PH_KIND_SMALL and PH_BLOCK_NONE, which stands beside it
    strh r4, [r0, #triangle_kind]
    push {r0-r3}
    b begin
border: @ do all corners keep a pixel away from the borders?
    add r9, r9, r12, lsl #1
    add r10, r10, r12, lsl #1
    off_borders r6, r7
    ldrd r11, r1, [r4]
    off_borders r11, r1
    ldrd r11, r1, [r5]
    off_borders r11, r1
    b inside
fixed:
    ldr r6, [r0, #fast_bias]
    fixed_depth r3
    fixed_depth r4
    fixed_depth r5
    stmia r2, {r3-r5}
    eors r4, r3
    eors r5, r3
    orrs r4, r5
    bpl known
    b general
apart: @ the corners have other exponents
    mov r4, r0
    mov r5, r2
    mov r3, r2
    sub r1, r2, #own_depths - own_corners
    ldr r2, [r0, #fast_bias]
    ldr r12, [r0, #fast_set_codes]
    ldr r0, [r0, #fast_lens]
    blx r12
    cmp r0, #0
    mov r0, r4
    mov r2, r5
    bne known
general:
    movs r0, #0
    pop {r4-r11, pc}
    .size ph_setup_fast, . - ph_setup_fast

    .p2align 2
    .global ph_setup_small
    .type ph_setup_small, %function
    .thumb_func
ph_setup_small: @ r0: struct ph_triangle, r1: corners, r2: struct ph_sides, r3: depths
    push {r0-r11, lr}
begin:
    ldmia r1, {r4-r6}
    ldr r7, [r4, #vertex_y]
    ldr r8, [r5, #vertex_y]
    ldr r9, [r6, #vertex_y]
    adds r7, #127
    add r8, r8, #127
    add r9, r9, #127
    asrs r7, r7, #8
    asr r8, r8, #8
    asr r9, r9, #8
    @ Turn the corners until r4 to r6 are the top, the left and the right one, and r7 to r9 their first rows.
    cmp r8, r7
    it ge
    cmpge r9, r7
    bge 2f
    mov r10, r4
    mov r11, r7
    cmp r9, r8
    blt 1f
    mov r4, r5
    mov r7, r8
    mov r5, r6
    mov r8, r9
    mov r6, r10
    mov r9, r11
    b 2f
1:  mov r4, r6
    mov r7, r9
    mov r6, r5
    mov r9, r8
    mov r5, r10
    mov r8, r11
    @ Make r5 the middle and r6 the lowest corner.
2:  mov r11, r0
    cmp r8, r9
    ble 3f
    mov r10, r5
    mov r5, r6
    mov r6, r10
    mov r10, r8
    mov r8, r9
    mov r9, r10
    adds r11, #4 @ the long edge is the left one
3:  cmp r7, r9
    bge none
    sub r1, r11, r0
    lsrs r1, r1, #2
    str r1, [r0, #triangle_lower_is_right]
    strh r7, [r0, #triangle_y_top]
    strh r9, [r0, #triangle_y_bottom]
    mvn r12, #1 << 31
    edge r4, r6, r7
    rsb lr, r11, r0, lsl #1
    str r1, [lr, #triangle_left + 4]
    str r10, [lr, #triangle_left_dx + 4]
    cmp r8, r7
    beq flat_top
    ldrd r1, lr, [r4]
    edge_from r5
    str r1, [r11, #triangle_left]
    str r10, [r11, #triangle_left_dx]
    sub r2, r8, r7
    strh r2, [r0, #triangle_upper_rows]
    subs r9, r9, r8
    strh r9, [r0, #triangle_lower_rows]
    beq planes
    edge r5, r6, r8
    strd r1, r10, [r0, #triangle_lower]
planes:
    @ The sides over the area, as struct slopes of setup_small.c has them: r4 c, r5 a, r6 d, r8 b, r10 shift.
    ldrd r1, r2, [sp, #corners]
    ldmia r2, {r4-r6, r8, r9}
    eor r10, r4, r4, asr #31
    eor r11, r5, r5, asr #31
    orr r10, r10, r11
    eor r11, r6, r6, asr #31
    orr r10, r10, r11
    eor r11, r8, r8, asr #31
    orr r10, r10, r11
    orr r10, r10, #31
    clz r10, r10
    clz r11, r9
    lsl r9, r9, r11
    lsr r9, r9, #16
    udiv r9, r12, r9
    rsb lr, r10, #33
    str lr, [sp, #side_bits]
    mul r4, r4, r9
    mul r5, r5, r9
    mul r6, r6, r9
    mul r8, r8, r9
    asr r4, r4, lr
    asr r5, r5, lr
    asr r6, r6, lr
    asr r8, r8, lr
    sub r10, r10, r11
    add r10, r10, #14
    ldr r3, [r0, #triangle_ramp]
    cbnz r3, light
    ldr r1, [r1]
    strd r5, r8, [r0, #triangle_slopes] @ it is textured
    strd r6, r4, [r0, #triangle_slopes + 8]
    str r10, [r0, #triangle_slopes + 16]
    ldrd r2, r3, [r1]
    rsb r2, r2, #128
    rsb r3, r3, r7, lsl #8
    adds r3, #128
    b depth
light: @ the plane of light
    ldmia r1, {r1-r3}
    ldrh r9, [r1, #vertex_light]
    ldrh r2, [r2, #vertex_light]
    ldrh r3, [r3, #vertex_light]
    sub r2, r2, r9
    sub r3, r3, r9
    asrs r2, r2, #1
    asrs r3, r3, #1
    mul r11, r3, r5
    mls r11, r2, r8, r11
    mul lr, r2, r6
    mls lr, r3, r4, lr
    sub r12, r10, #17
    cmp r12, #31 - 28
    blt steep_light
4:  asr r11, r11, r12
    asr lr, lr, r12
5:  ldrd r2, r3, [r1]
    rsb r2, r2, #128
    rsb r3, r3, r7, lsl #8
    adds r3, #128 @ r2, r3: from the first corner to column 0 of the first row
    lsl r9, r9, #16
    mla r9, r11, r2, r9
    mla r9, lr, r3, r9
    lsl r11, r11, #8
    lsl lr, lr, #8
    str r9, [r0, #triangle_light]
    str r11, [r0, #triangle_glight]
    str lr, [r0, #triangle_light_dy]
depth: @ the plane of depth
    ldr r1, [sp, #depths]
    ldmia r1, {r1, r7, r12}
    subs r7, r7, r1
    sub r12, r12, r1
    eor r9, r7, r7, asr #31
    eor r11, r12, r12, asr #31
    orr r9, r9, r11
    clz r9, r9
    rsbs r9, r9, #32 - 15
    it mi
    movmi r9, #0
    asr r7, r7, r9
    asr r12, r12, r9
    mul r11, r12, r5
    mls r11, r7, r8, r11
    mul lr, r7, r6
    mls lr, r12, r4, lr
    sub r9, r10, r9
    cmp r9, #16 @ FINE_DEPTH
    blt steep_depth
fine_depth:
    asr r11, r11, r9
    asr lr, lr, r9
7:  mla r1, r11, r2, r1
    mla r1, lr, r3, r1
    lsl r11, r11, #8
    lsl lr, lr, #8
    str r1, [r0, #triangle_d]
    str r11, [r0, #triangle_gd]
    str lr, [r0, #triangle_d_dy]
    movs r0, #1
8:  add sp, sp, #16
    pop {r4-r11, pc}
none:
    movs r0, #0
    b 8b
flat_top: @ the first edge is the lower one
    edge r5, r6, r8
    str r1, [r11, #triangle_left]
    str r10, [r11, #triangle_left_dx]
    subs r9, r9, r8
    movs r2, #0
    strh r9, [r0, #triangle_upper_rows]
    strh r2, [r0, #triangle_lower_rows]
    b planes
steep_light:
    flatten r12, 28, r2, r3
    bge 4b
    rsb r12, r12, #0
    lsl r11, r11, r12
    lsl lr, lr, r12
    b 5b
steep_depth:
    ldr r4, [sp, #side_bits]
    cmp r9, #31 - 17
    bge 1f @ such a gradient fits
    cmp r9, #0
    blt 9f
    mov r5, r9
    flatten r9, 17, r7, r12
    cmp r9, r5
    bne 9f
1:  adds r4, #1
    cmp r9, r4
    bgt fine_depth @ it is as fine as FINE_DEPTH for such sides
    asr r11, r11, r9
    asr lr, lr, r9
    ldr r7, [sp, #sides] @ is it right at the other two corners?
    ldmia r7, {r4-r7}
    ldr r8, [sp, #depths]
    ldrd r8, r9, [r8, #4]
    sub r8, r1, r8
    sub r9, r1, r9
    mla r8, r11, r4, r8
    mla r8, lr, r5, r8
    mla r9, r11, r6, r9
    mla r9, lr, r7, r9
    add r8, r8, #9 << 12 @ RIGHT_DEPTH
    add r9, r9, #9 << 12
    cmp r8, #9 << 13
    it lo
    cmplo r9, #9 << 13
    blo 7b
9:  movs r0, #2 @ PH_SMALL_STEEP
    b 8b
    .size ph_setup_small, . - ph_setup_small
