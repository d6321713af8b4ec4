@ ph_texture_small (see texture_small.h) for ARMv7-M. A pixel that is drawn takes 14.5 instructions, a hidden one 9.5, a
@ row 47, a call some 28.
@
@ Registers: r0 dv, r2 d, r3 gd, r5 u_mask, r6 v_mask, r7 texels, r8 v, r9 the struct ph_texel_run, r10 u, r11 depth,
@ r12 du, lr pixels; r1 r4 scratch. Before the pixels r8 is their first column and r0 their pair (see texture_tile.h).
#include "../thumb.inc"
#include "../offsets.inc"
#include "texels.inc"

    @ on the stack
    .equ bends, 0 @ of u and v
    .equ ends, 8  @ number of pixels, column behind the last
    .equ count, 16
    .equ table, 20 @ of the entries
    .equ last_depth, 24 @ of a large texture's row
    .equ frame, 28

    function ph_texture_small, loop @ r0: struct ph_texel_run
    push {r4-r11, lr}
    sub sp, #frame
    mov r9, r0
    adds r0, #texel_depth
    ldm r0, {r0-r5} @ depth, pixels, stride, gd, u_mask, v_mask
    subs r1, r1, r0
    str r1, [r9, #texel_depth + 4] @ from a depth to its pixel
    ldr r0, [r9, #run_u_bend]
    ldr r1, [r9, #run_v_bend]
    strd r0, r1, [sp, #bends]
    movs r0, #0
    adr r1, entries
    usat r5, #1, r5, asr #16
    add r1, r1, r5, lsl #6 @ the other 32
    strd r0, r1, [sp, #count]
row:
    ldm r9, {r0, r1, r2, r4, r5, r7} @ left, right, d, left_dx, right_dx, d_dy
    asr r8, r0, #16
    asr r12, r1, #16
    add r0, r4
    add r1, r5
    add r7, r2
    stm r9, {r0, r1, r7}
    mla r2, r3, r8, r2
    add lr, r9, #run_u
    subs r4, r12, r8
    ble empty
    strd r4, r12, [sp, #ends]
    mvn r0, r4, lsl #31
    ldr r1, [sp, #count]
    add r0, r8, r0, lsr #31
    add r1, r4
    str r1, [sp, #count]
    lsls r0, r0, #1
    ldm lr, {r1, r4, r5, r6, r7, r12} @ at, step, at_dy, step_dy, at_ddy, bend
    mla r10, r12, r8, r4
    mla r10, r10, r8, r1 @ u
    mla r12, r12, r0, r4 @ du
    add r1, r5
    add r4, r6
    add r5, r7
    stm lr, {r1, r4, r5}
    adds lr, #run_v - run_u
    ldm lr, {r1, r4, r5, r6, r7, r11}
    mla r0, r11, r0, r4 @ dv
    mla r11, r11, r8, r4
    mla r8, r11, r8, r1 @ v
    add r1, r5
    add r4, r6
    add r5, r7
    stm lr, {r1, r4, r5}
    sub lr, #run_v - texel_stride
    ldm lr, {r1, r4-r7} @ stride, gd, u_mask, v_mask, texels
    ldrd r11, lr, [r9, #texel_depth]
    add r1, r11
    str r1, [r9, #texel_depth]
    ldrd r4, r1, [sp, #ends]
    add r11, r11, r1, lsl #1
    add lr, r11
    ldr r1, [sp, #table]
    tbh [r1, r4, lsl #1]
entries: @ indexed by the number of pixels, and of a large texture 32 further on
    .hword 0 @ not used
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword (pixel_\at - entries) / 2
    .endr
    .rept 32
    .hword (large - entries) / 2
    .endr
large:
    large_row r4, last_depth, r11, lr, r10, r12, r8, r0, r5, r6, r7, r4, r1, last
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at, 32, r11, lr, r10, r12, r8, r0, r5, r6, r7, r1, r4
    .endr
last:
    ldr r0, [r9, #texel_rows]
    subs r0, #1
    str r0, [r9, #texel_rows]
    bne row
    ldrd r0, r1, [r9, #run_lower_rows]
    cbz r0, 3f
    ldrd r4, r5, [r9, #run_lower_x]
    movs r2, #0
    str r0, [r9, #texel_rows]
    str r2, [r9, #run_lower_rows]
    cbnz r1, 2f
    str r4, [r9]
    str r5, [r9, #12]
    b row
2:  str r4, [r9, #4]
    str r5, [r9, #16]
    b row
3:  ldr r0, [sp, #count]
    add sp, #frame
    pop {r4-r11, pc}
empty:
    ldm lr, {r1, r4, r5, r6, r7}
    add r1, r5
    add r4, r6
    add r5, r7
    stm lr, {r1, r4, r5}
    adds lr, #run_v - run_u
    ldm lr, {r1, r4, r5, r6, r7}
    add r1, r5
    add r4, r6
    add r5, r7
    stm lr, {r1, r4, r5}
    ldr r0, [r9, #texel_depth]
    ldr r1, [r9, #texel_stride]
    add r0, r1
    str r0, [r9, #texel_depth]
    b last
    .size ph_texture_small, . - ph_texture_small
