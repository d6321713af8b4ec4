@ ph_setup_small and ph_setup_fast of kernels.h for ARMv6-M. A triangle takes some 370 instructions, and some 130 more
@ from its reference on.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

    .equ side_bits, 0 @ on the stack; plus 1; it takes the place of the triangle
    .equ corners, 4
    .equ sides, 8
    .equ depths, 12
    .equ own_corners, triangle_slopes + 8 @ in the triangle: ph_setup_fast keeps what ph_setup_small takes
    .equ own_sides, triangle_slopes + 20 @ behind the slopes
    .equ own_depths, triangle_slopes + 40

    @ Puts fx_rcp16(d) into \to; changes r7.
    .macro rcp16 to, d
    lsrs \to, \d, #7
    lsls \to, \to, #1
    ldr r7, =fx_rcp_table - 512
    ldrh \to, [r7, \to]
    movs r7, \to
    muls r7, \d
    lsls r7, r7, #5
    rsbs r7, r7, #0
    asrs r7, r7, #11 @ (1 - to d) in 2^-21
    muls r7, \to
    asrs r7, r7, #17
    lsls \to, \to, #4
    adds \to, \to, r7
    adds \to, #1
    movs r7, \to
    muls r7, \d
    lsrs r7, r7, #31
    subs \to, \to, r7
    .endm

    @ r2, r7 and lr become the distance from the first corner, at r1, to column 0 of the first row.
    .macro to_first_row
    movs r3, #128
    ldmia r1, {r1, r2}
    ldrh r7, [r0, #triangle_y_top]
    lsls r7, r7, #8
    adds r7, r7, r3
    subs r7, r7, r2
    subs r2, r3, r1
    mov lr, r7
    .endm

    @ Sets up the long edge; r5 is the lowest corner.
    .macro long_edge
    mov r4, r10
    mov r6, r8
    bl edge
    ldr r2, [sp]
    mov r3, r12
    lsls r2, r2, #1
    subs r2, r2, r3
    str r1, [r2, #triangle_left + 4]
    str r0, [r2, #triangle_left_dx + 4]
    .endm

    section_of ph_setup_fast, loop
    .p2align 2
    .thumb_func
apart: @ part of ph_setup_fast: the corners have other exponents
    mov r0, r10
    movs r1, r5
    ldr r2, [r0, #fast_bias]
    ldr r4, [r0, #fast_set_codes]
    ldr r0, [r0, #fast_lens]
    movs r3, r5
    adds r3, #own_depths - own_corners
    blx r4
    cmp r0, #0
    beq general
    mov r2, r11
    movs r5, r2
    adds r5, #own_depths + 12
    b known
below_24: @ the depth of the first corner is below 2^24
    lsrs r5, r1, #16
    beq 1f
    ldrb r5, [r7, r5]
    adds r5, #8
    b leading
1:  lsrs r5, r1, #8
    beq general
    ldrb r5, [r7, r5]
    adds r5, #16
    b leading
general:
    movs r0, #0
    restore_and_return

    function ph_setup_fast, loop @ r0: struct ph_fast, r1: struct ph_ref, r2: struct ph_triangle
    save_registers
    mov r10, r0
    mov r11, r2
    ldrh r3, [r1]
    ldrh r4, [r1, #2]
    ldrh r5, [r1, #4]
    lsls r3, r3, #4
    lsls r4, r4, #4
    lsls r5, r5, #4
    ldmia r0!, {r1} @ base
    adds r3, r3, r1
    adds r4, r4, r1
    adds r5, r5, r1
    adds r2, #own_corners
    stmia r2!, {r3-r5}
    @ Does the first corner stay far enough from the borders?
    ldmia r3!, {r6, r7}
    ldmia r0, {r0-r2} @ margin, inner_x, inner_y
    subs r3, r6, r0
    cmp r3, r1
    bhs border
    subs r3, r7, r0
    cmp r3, r2
    bhs border
inside:
    @ The sides: r1, r2 from a to b, r6, r7 from a to c. Are they short enough?
    ldmia r4!, {r1, r2}
    ldmia r5, {r0, r5}
    subs r1, r1, r6
    subs r2, r2, r7
    subs r6, r0, r6
    subs r7, r5, r7
    mov r0, r10
    ldr r0, [r0, #fast_side]
    adds r3, r1, r0
    adds r4, r2, r0
    orrs r3, r4
    adds r4, r6, r0
    orrs r3, r4
    adds r4, r7, r0
    orrs r3, r4
    subs r4, r6, r1
    adds r4, r4, r0
    orrs r3, r4
    lsls r0, r0, #1
    cmp r3, r0
    bhs general
    movs r3, r6
    muls r3, r2
    movs r4, r1
    muls r4, r7
    subs r3, r3, r4
    mov r5, r11
    adds r5, #own_sides
    stmia r5!, {r1, r2, r6, r7}
    str r3, [r5]
    @ ph_float_depths, mostly of three corners with one exponent.
    subs r5, #own_sides + 16 - own_corners
    ldmia r5!, {r1-r3}
    subs r5, #12
    mov r0, r10
    ldr r0, [r0, #fast_lens]
    cmp r0, #0
    beq fixed
    ldrb r4, [r1, #vertex_s]
    ldrb r6, [r2, #vertex_s]
    ldrb r7, [r3, #vertex_s]
    cmp r4, r6
    bne apart
    cmp r4, r7
    bne apart
    ldr r6, [r0, #lens_far_q]
    ldrh r7, [r0, #lens_far_s] @ and float_down in its upper byte
    subs r7, r7, r4
    lsrs r6, r7
    ldr r1, [r1, #vertex_q]
    ldr r2, [r2, #vertex_q]
    ldr r3, [r3, #vertex_q]
    subs r1, r1, r6
    bls general
    subs r2, r2, r6
    bls general
    subs r3, r3, r6
    bls general
    ldr r7, =fx_clz_table
    lsrs r5, r1, #24
    beq below_24
    ldrb r5, [r7, r5]
leading:
    movs r6, r1
    eors r6, r2
    movs r7, r1
    eors r7, r3
    orrs r6, r7
    movs r7, #31
    subs r7, r7, r5
    lsrs r6, r7
    bne general
    adds r4, r4, r5
    ldrh r7, [r0, #lens_far_s]
    lsrs r7, r7, #8
    movs r6, r4
    lsrs r6, r7
    cmp r6, #2
    bhs general
    movs r6, #31
    subs r6, r6, r7
    lsls r4, r6
    mov r0, r10
    ldr r6, [r0, #fast_bias]
    subs r6, r6, r4
    lsls r1, r5
    lsls r2, r5
    lsls r3, r5
    lsrs r1, r7
    lsrs r2, r7
    lsrs r3, r7
    adds r1, r1, r6
    adds r2, r2, r6
    adds r3, r3, r6
    mov r5, r11
    adds r5, #own_depths
    stmia r5!, {r1-r3}
known:
    mov r3, r10
    mov r0, r11
    ldr r1, [r3, #fast_material]
    ldr r2, [r3, #fast_ramp]
    str r1, [r0, #triangle_material]
    str r2, [r0, #triangle_ramp]
    movs r1, #0xff
    mvns r1, r1 @ PH_KIND_SMALL and PH_BLOCK_NONE, which stands beside it
    strh r1, [r0, #triangle_kind]
    subs r5, #12
    movs r3, r5
    subs r5, #own_depths - own_sides
    movs r2, r5
    subs r5, #own_sides - own_corners
    movs r1, r5
    b begin
border: @ do all corners keep a pixel away from the borders?
    mov r0, r10
    ldr r2, [r0, #fast_inner_x]
    ldr r3, [r0, #fast_inner_y]
    ldr r1, [r0, #fast_side]
    lsls r1, r1, #1 @ two sides
    adds r2, r2, r1
    adds r3, r3, r1
    mov r0, r11
    adds r0, #own_corners + 12
1:  subs r0, #4
    ldr r1, [r0]
    ldmia r1!, {r6, r7}
    movs r1, #1
    lsls r1, r1, #8
    subs r6, r6, r1
    cmp r2, r6
    blo 2f
    subs r7, r7, r1
    cmp r3, r7
    blo 2f
    adds r6, r6, r1
    adds r7, r7, r1
    mov r1, r11
    adds r1, #own_corners
    cmp r0, r1
    bne 1b
    b inside
2:  b general
fixed: @ depth in fixed16; the one shift that is too long, as it is below zero, gives 0
    mov r0, r10
    ldr r6, [r0, #fast_bias]
    movs r0, #3
1:  ldmia r5!, {r4}
    ldr r1, [r4, #vertex_q]
    ldrb r4, [r4, #vertex_s]
    subs r4, #2
    movs r2, r1
    lsrs r1, r4
    rsbs r4, r4, #0
    lsls r2, r4
    orrs r1, r2
    adds r1, r1, r6
    str r1, [r5, #own_depths - own_corners - 4]
    subs r0, #1
    bne 1b
    adds r5, #own_depths - own_corners - 12
    ldmia r5!, {r1-r3}
    eors r2, r1
    eors r3, r1
    orrs r2, r3
    bpl known
    b general
    .size ph_setup_fast, . - ph_setup_fast

    .p2align 2
    .ltorg

    .thumb_func
edge: @ r4: upper corner, r5: lower one, r6: first row. Returns r1: x at that row, r0: slope; changes r0-r3, r6, r7
    ldr r0, [r4]
    ldr r2, [r5]
    subs r2, r2, r0
    ldr r1, [r4, #vertex_y]
    ldr r3, [r5, #vertex_y]
    subs r3, r3, r1
    lsls r6, r6, #8
    subs r6, r6, r1
    adds r6, #128
    ldr r7, =fx_clz_table
    lsrs r1, r3, #8
    beq 2f
    ldrb r1, [r7, r1]
1:  lsls r3, r1
    rcp16 r0, r3
    lsrs r7, r2, #31
    adds r0, r0, r7
    muls r0, r2
    movs r7, #15
    subs r7, r7, r1
    asrs r2, r0, #8
    muls r2, r6
    asrs r2, r7
    asrs r0, r7
    ldr r1, [r4]
    lsls r1, r1, #8
    adds r1, r1, r2
    ldr r2, =32767 @ .5 px, rounded up
    adds r1, r1, r2
    bx lr
2:  ldrb r1, [r7, r3]
    adds r1, #8
    b 1b

    .thumb_func
flatten: @ cuts the gradient r5, r6, which is to be shifted by r7, to 32 - r4 bits; changes r4
    push {r0-r3}
    asrs r0, r5, #31
    eors r0, r5
    asrs r1, r6, #31
    eors r1, r6
    orrs r0, r1
    movs r1, #0
    lsrs r2, r0, #16
    bne 1f
    movs r1, #16
    movs r2, r0
1:  lsrs r3, r2, #8
    bne 2f
    adds r1, #8
    movs r3, r2
2:  ldr r2, =fx_clz_table
    ldrb r3, [r2, r3]
    adds r1, r1, r3
    subs r4, r4, r1
    cmp r7, r4
    bge 3f
    movs r7, r4
3:  pop {r0-r3}
    cmp r7, #0
    blt 4f
    asrs r5, r7
    asrs r6, r7
    bx lr
4:  rsbs r7, r7, #0
    lsls r5, r7
    lsls r6, r7
    bx lr

flat_top: @ part of ph_setup_small: the first edge is the lower one
    strh r3, [r0]
    strh r2, [r0, #triangle_lower_rows - triangle_upper_rows]
    mov r4, r11
    mov r6, r9
    bl edge
    mov r3, r12
    str r1, [r3, #triangle_left]
    str r0, [r3, #triangle_left_dx]
    long_edge
    b planes

none:
    movs r0, #0
    b leave

long: @ part of ph_setup_small: a side has 14 bits
    movs r0, #0
    subs r0, #1
    b known_sides

    .p2align 2
    .global ph_setup_small
    .type ph_setup_small, %function
    .thumb_func
ph_setup_small: @ r0: struct ph_triangle, r1: corners, r2: struct ph_sides, r3: depths
    save_registers
begin:
    push {r0-r3}
    ldmia r1!, {r4-r6}
    ldr r1, [r4, #vertex_y]
    ldr r2, [r5, #vertex_y]
    ldr r3, [r6, #vertex_y]
    adds r1, #127
    adds r2, #127
    adds r3, #127
    asrs r1, r1, #8
    asrs r2, r2, #8
    asrs r3, r3, #8
    @ Turn the corners until r4 to r6 are the top, the left and the right one, and r1 to r3 their first rows.
    cmp r2, r1
    blt 1f
    cmp r3, r1
    bge 3f
1:  movs r0, r4
    movs r7, r1
    cmp r3, r2
    blt 2f
    movs r4, r5
    movs r1, r2
    movs r5, r6
    movs r2, r3
    movs r6, r0
    movs r3, r7
    b 3f
2:  movs r4, r6
    movs r1, r3
    movs r6, r5
    movs r3, r2
    movs r5, r0
    movs r2, r7
    @ Make r5 the middle and r6 the lowest corner. r12 tells where the first edge is stored (the one that is
    @ not the long one).
3:  ldr r0, [sp]
    mov r12, r0
    movs r7, #0
    cmp r2, r3
    ble 4f
    movs r7, r5
    movs r5, r6
    movs r6, r7
    movs r7, r2
    movs r2, r3
    movs r3, r7
    movs r7, #4
    add r12, r7 @ the long edge is the left one
    movs r7, #1
4:  cmp r1, r3
    bge none
    strh r1, [r0, #triangle_y_top]
    strh r3, [r0, #triangle_y_bottom]
    mov r8, r1
    mov r9, r2
    mov r10, r4
    mov r11, r5
    movs r5, r6
    adds r0, #triangle_upper_rows
    str r7, [r0, #triangle_lower_is_right - triangle_upper_rows]
    subs r3, r3, r2
    subs r2, r2, r1
    beq flat_top
    strh r2, [r0]
    strh r3, [r0, #triangle_lower_rows - triangle_upper_rows]
    cmp r3, #0
    beq 5f
    mov r4, r11
    mov r6, r9
    bl edge
    ldr r2, [sp]
    str r1, [r2, #triangle_lower]
    str r0, [r2, #triangle_lower + 4]
5:  long_edge
    mov r5, r11
    mov r6, r8
    bl edge
    mov r3, r12
    str r1, [r3, #triangle_left]
    str r0, [r3, #triangle_left_dx]
planes:
    @ The sides over the area, as struct slopes of setup_small.c has them: r8 c, r9 a, r10 d, r11 b, r12 shift.
    ldr r1, [sp, #sides]
    ldmia r1!, {r2-r6}
    asrs r7, r2, #31
    eors r7, r2
    asrs r0, r3, #31
    eors r0, r3
    orrs r7, r0
    asrs r0, r4, #31
    eors r0, r4
    orrs r7, r0
    asrs r0, r5, #31
    eors r0, r5
    orrs r7, r0
    lsrs r7, r7, #5
    ldr r1, =fx_clz_table
    lsrs r0, r7, #8
    bne long
    ldrb r0, [r1, r7]
known_sides:
    mov r8, r0 @ 13 - bits
    movs r0, #0
    lsrs r7, r6, #24
    bne 2f
    movs r0, #8
    lsrs r7, r6, #16
    bne 2f
    movs r0, #16
    lsrs r7, r6, #8
    bne 2f
    movs r0, #24
    movs r7, r6
2:  ldrb r7, [r1, r7]
    adds r0, r0, r7
    lsls r6, r0
    lsrs r6, r6, #16
    rcp16 r1, r6
    mov r6, r8
    movs r7, #14
    subs r7, r7, r6
    muls r2, r1
    muls r3, r1
    muls r4, r1
    muls r5, r1
    asrs r2, r7
    asrs r3, r7
    asrs r4, r7
    asrs r5, r7
    mov r8, r2
    mov r9, r3
    mov r10, r4
    mov r11, r5
    movs r6, #47
    subs r6, r6, r0
    subs r6, r6, r7
    mov r12, r6
    ldr r0, [sp]
    str r7, [sp, #side_bits]
    ldr r1, [sp, #corners]
    ldmia r1, {r1-r3}
    ldr r4, [r0, #triangle_ramp]
    cmp r4, #0
    beq textured
    @ Compute the plane of light.
    ldrh r4, [r1, #vertex_light]
    ldrh r2, [r2, #vertex_light]
    ldrh r3, [r3, #vertex_light]
    subs r2, r2, r4
    subs r3, r3, r4
    asrs r2, r2, #1
    asrs r3, r3, #1
    mov r5, r9
    muls r5, r3
    mov r7, r11
    muls r7, r2
    subs r5, r5, r7
    mov r7, r8
    muls r7, r3
    mov r3, r10
    muls r3, r2
    subs r6, r3, r7
    mov r7, r12
    subs r7, #17
    cmp r7, #31 - 28
    blt steep_light
    asrs r5, r7
    asrs r6, r7
5:  to_first_row
    lsls r4, r4, #16
    movs r3, r5
    muls r3, r2
    adds r4, r4, r3
    muls r7, r6
    adds r4, r4, r7
    lsls r5, r5, #8
    lsls r6, r6, #8
    str r4, [r0, #triangle_light]
    str r5, [r0, #triangle_glight]
    str r6, [r0, #triangle_light_dy]
depth: @ the plane of depth
    ldr r3, [sp, #depths]
    ldmia r3, {r3-r5}
    subs r1, r4, r3
    subs r4, r5, r3
    asrs r6, r1, #31
    eors r6, r1
    asrs r7, r4, #31
    eors r7, r4
    orrs r6, r7
    lsrs r6, r6, #15
    beq 9f
    ldr r5, =fx_clz_table
    lsrs r7, r6, #8
    beq 8f
    ldrb r7, [r5, r7]
    movs r6, #16
6:  subs r6, r6, r7
    asrs r1, r6
    asrs r4, r6
7:  mov r7, r12
    subs r7, r7, r6
    mov r5, r9
    muls r5, r4
    mov r6, r11
    muls r6, r1
    subs r5, r5, r6
    mov r6, r10
    muls r6, r1
    mov r1, r8
    muls r1, r4
    subs r6, r6, r1
    cmp r7, #16 @ FINE_DEPTH
    blt steep_depth
fine_depth:
    asrs r5, r7
    asrs r6, r7
10: muls r2, r5
    adds r3, r3, r2
    mov r2, lr
    muls r2, r6
    adds r3, r3, r2
    lsls r5, r5, #8
    lsls r6, r6, #8
    str r3, [r0, #triangle_d]
    str r5, [r0, #triangle_gd]
    str r6, [r0, #triangle_d_dy]
    movs r0, #1
leave:
    add sp, #16
    restore_and_return
8:  ldrb r7, [r5, r6]
    movs r6, #8
    b 6b
9:  b 7b @ r6 is 0: nothing to drop
textured: @ r6: shift
    mov r2, r9
    mov r3, r11
    mov r4, r10
    mov r5, r8
    adds r0, #triangle_slopes
    stmia r0!, {r2-r6}
    subs r0, #triangle_slopes + 20
    to_first_row
    b depth
steep_light:
    push {r4}
    movs r4, #32 - 28
    bl flatten
    pop {r4}
    b 5b
steep_depth:
    ldr r4, [sp, #side_bits]
    cmp r7, #31 - 17
    bge 2f
    cmp r7, #0
    blt 1f
    movs r4, #17 @ whether the gradient fits r7 + 17 bits
    adds r4, r4, r7
    movs r1, r5
    asrs r1, r4
    adds r1, #1
    mov r8, r1
    movs r1, r6
    asrs r1, r4
    adds r1, #1
    mov r4, r8
    orrs r1, r4
    cmp r1, #1
    bhi 1f
    ldr r4, [sp, #side_bits]
2:  adds r4, #1
    cmp r7, r4
    bgt 3f @ it is as fine as FINE_DEPTH for such sides
    asrs r5, r7
    asrs r6, r7
    ldr r4, [sp, #sides] @ whether it is right at the other two corners
    movs r1, r5
    movs r7, r6
    push {r2}
    ldmia r4!, {r2}
    muls r1, r2
    ldmia r4!, {r2}
    muls r7, r2
    adds r7, r7, r1
    adds r7, r7, r3
    ldmia r4!, {r1, r2}
    muls r1, r5
    muls r2, r6
    adds r1, r1, r2
    adds r1, r1, r3
    pop {r2}
    ldr r4, [sp, #depths]
    mov r8, r5
    ldmia r4, {r3-r5}
    subs r7, r7, r4
    subs r1, r1, r5
    mov r5, r8
    movs r4, #9 @ RIGHT_DEPTH
    lsls r4, #12
    adds r7, r7, r4
    adds r1, r1, r4
    lsls r4, #1
    cmp r7, r4
    bhs 1f
    cmp r1, r4
    bhs 1f
    b 10b
3:  b fine_depth
1:  movs r0, #2 @ PH_SMALL_STEEP
    b leave
    .size ph_setup_small, . - ph_setup_small
    .p2align 2
    .ltorg
