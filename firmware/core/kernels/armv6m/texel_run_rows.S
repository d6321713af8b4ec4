@ ph_texel_run_rows (see texture_small.h) for ARMv6-M. A row takes 123 instructions beside those of its kernel.
@
@ Registers: r7 first column, r8 the struct ph_texel_run, r9 the struct ph_texel_row, r10 pixels so far, r11 r12 lr
@ scratch: lr first column, r12 its pair (see texture_tile.h).
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

    .macro line to @ u or v at r0 at the first column
    ldmia r0!, {r1-r6} @ at, step, at_dy, step_dy, at_ddy, bend
    mov r7, r12
    muls r7, r6
    adds r7, r7, r2
    mov r11, r7
    mov r7, lr
    muls r6, r7
    adds r6, r6, r2
    muls r6, r7
    adds r6, r6, r1
    line_down
    mov r1, r9
    str r6, [r1, #\to]
    mov r2, r11
    str r2, [r1, #\to + 4]
    .endm

    .macro line_down
    adds r1, r1, r3
    adds r2, r2, r4
    adds r3, r3, r5
    subs r0, #24
    stmia r0!, {r1-r3}
    .endm

    function ph_texel_run_rows @ r0: struct ph_texel_run, r1: struct ph_texel_row
    save_registers
    mov r8, r0
    mov r9, r1
    movs r1, #0
    mov r10, r1
    adds r0, #run_kind
    ldr r0, [r0]
    lsls r0, r0, #2
    adr r1, kernels
    ldr r0, [r1, r0]
    push {r0}
row:
    mov r0, r8
    ldmia r0!, {r1-r6} @ left, right, d, left_dx, right_dx, d_dy
    asrs r7, r1, #16
    adds r1, r1, r4
    asrs r4, r2, #16
    adds r2, r2, r5
    adds r6, r6, r3
    subs r0, #24
    stmia r0!, {r1, r2, r6}
    adds r0, #run_depth - 12
    ldmia r0!, {r1, r2, r5} @ depth, pixels, stride
    subs r0, #12
    adds r6, r2, r5
    adds r5, r1, r5
    stmia r0!, {r5, r6}
    ldr r5, [r0, #run_light - run_stride]
    ldr r6, [r0, #run_light + 4 - run_stride]
    adds r6, r6, r5
    str r6, [r0, #run_light - run_stride]
    subs r4, r4, r7
    ble empty
    add r10, r4
    lsls r6, r7, #1
    adds r1, r1, r6
    adds r2, r2, r6
    ldr r6, [r0, #run_gd - run_stride]
    muls r6, r7
    adds r6, r6, r3
    mov r3, r9
    stmia r3!, {r1, r2, r4, r6} @ depth, pixels, n, d
    ldr r6, [r0, #run_glight - run_stride]
    movs r1, r6
    muls r1, r7
    adds r5, r5, r1 @ the first light
    subs r1, r4, #1
    movs r2, r1
    muls r2, r6
    adds r2, r2, r5 @ and the last
    movs r0, #33
    lsls r0, r0, #24
    cmp r5, r0
    bhs shining
    cmp r2, r0
    bhs shining
    asrs r0, r6, #1
    movs r2, #3
    ands r1, r2
    movs r2, r0
    muls r2, r1
    adds r2, r2, r5
    lsrs r2, r2, #24
    adds r1, #2
    muls r1, r6
    adds r5, r5, r1
    adds r5, r5, r0
1:  str r2, [r3, #row_level - 16]
    str r5, [r3, #row_light - 16]
    movs r1, #1
    bics r1, r4
    adds r1, r1, r7
    lsls r1, r1, #1
    mov r12, r1
    mov lr, r7
    mov r0, r8
    adds r0, #run_u
    line row_u
    adds r0, #run_v - run_u - 12
    line row_v
    mov r0, r9
    ldr r4, [r0, #row_level]
    adds r4, #1
    beq 2f
    ldr r1, [sp]
    blx r1
2:  mov r0, r8
    adds r0, #run_rows
    ldr r1, [r0]
    subs r1, #1
    str r1, [r0]
    beq 3f
    cmp r4, #0
    bne row
3:  mov r0, r10
    pop {r1}
    restore_and_return
shining:
    movs r2, #0
    mvns r2, r2
    b 1b
empty:
    mov r0, r8
    adds r0, #run_u
    ldmia r0!, {r1-r5}
    adds r0, #4
    line_down
    adds r0, #run_v - run_u - 12
    ldmia r0!, {r1-r5}
    adds r0, #4
    line_down
    movs r4, #1
    b 2b
    .p2align 2
kernels:
    .word ph_texel_row_nearest, ph_texel_row_lit, ph_texel_row_smooth, ph_texel_row_smooth_lit
    .size ph_texel_run_rows, . - ph_texel_run_rows
