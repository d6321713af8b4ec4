@ ph_texel_run_rows (see texture_small.h) for ARMv7-M. A row takes 70 instructions beside those of its kernel.
@
@ Registers: r6 first column, r7 number of pixels, r8 the row's kernel, r9 the struct ph_texel_run, r10 the struct
@ ph_texel_row, r11 pixels so far; r0-r5, r12, lr scratch.
#include "../thumb.inc"
#include "../offsets.inc"

    .macro line from, to @ u or v at the first column; r12: its pair (see texture_tile.h); changes r7
    add lr, r9, #\from
    ldm lr, {r0-r5} @ at, step, at_dy, step_dy, at_ddy, bend
    mla r7, r5, r6, r1
    mla r5, r5, r12, r1
    mla r7, r7, r6, r0
    strd r7, r5, [r10, #\to]
    .endm

    .macro line_down
    add r0, r2
    add r1, r3
    add r2, r4
    stm lr, {r0-r2}
    .endm

    .global ph_texel_run_rows_lit
    .thumb_set ph_texel_run_rows_lit, ph_texel_run_rows
    function ph_texel_run_rows @ r0: struct ph_texel_run, r1: struct ph_texel_row
    push {r3-r11, lr}
    mov r9, r0
    mov r10, r1
    mov r11, #0
    ldr r8, [r9, #run_draw]
row:
    ldm r9, {r0-r5} @ left, right, d, left_dx, right_dx, d_dy
    asrs r6, r0, #16
    asrs r7, r1, #16
    add r0, r3
    add r1, r4
    add r5, r2
    stm r9, {r0, r1, r5}
    ldrd r0, r1, [r9, #texel_depth]
    ldr r5, [r9, #texel_stride]
    adds r3, r0, r5
    adds r5, r1, r5
    strd r3, r5, [r9, #texel_depth]
    ldrd r4, r5, [r9, #texel_light] @ and light_dy
    add r5, r4
    str r5, [r9, #texel_light]
    subs r7, r7, r6
    ble empty
    add r11, r7
    ldr r3, [r9, #texel_gd]
    mla r3, r3, r6, r2
    add r0, r0, r6, lsl #1
    add r1, r1, r6, lsl #1
    mov r2, r7
    stm r10, {r0-r3} @ depth, pixels, n, d
    ldr r5, [r9, #texel_glight]
    mla r4, r5, r6, r4
    subs r0, r7, #1
    mla r2, r5, r0, r4
    cmp r4, #33 << 24
    it lo
    cmplo r2, #33 << 24
    bhs shining
    and r0, r0, #3
    asrs r1, r5, #1
    mla r2, r0, r1, r4
    lsrs r2, r2, #24
    adds r0, #2
    mla r4, r0, r5, r4
    add r4, r1
1:  str r2, [r10, #row_level]
    str r4, [r10, #row_light]
    mvn r12, r7
    and r12, r12, #1
    add r12, r6
    lsl r12, r12, #1
    line run_u, row_u
    line_down
    line run_v, row_v
    line_down
    ldr r5, [r10, #row_level]
    mov r0, r10
    adds r5, #1
    beq 2f
    blx r8
2:  ldr r0, [r9, #texel_rows]
    subs r0, #1
    str r0, [r9, #texel_rows]
    beq 3f
    cmp r5, #0
    bne row
3:  mov r0, r11
    pop {r3-r11, pc}
shining:
    mov r2, #-1
    b 1b
empty:
    line run_u, row_u
    line_down
    line run_v, row_v
    line_down
    movs r5, #1
    b 2b
    .size ph_texel_run_rows, . - ph_texel_run_rows
