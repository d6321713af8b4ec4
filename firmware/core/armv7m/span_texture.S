@ ph_span_texture of hot.h for ARMv7-M: 14 instructions a pixel that is drawn, 9 a hidden one, some 20 a run.
@
@ r2 d, r3 gd, r4 u, r5 du, r6 ddu, r7 v, r8 dv, r9 ddv, r10 row_mask, r11 texels, r12 depth, lr pixels; r0 r1 scratch
    .syntax unified
    .thumb

    .macro pixel at
pixel_\at:
    ldrh r0, [r12, #2 * \at]
    lsrs r1, r2, #16
    cmp r1, r0
    bls 1f
    strh r1, [r12, #2 * \at]
    and r0, r10, r7, lsr #16
    add r0, r0, r4, lsr #16
    ldrh r0, [r11, r0, lsl #1]
    strh r0, [lr, #2 * \at]
1:  add r2, r3
    add r4, r5
    add r5, r6
    add r7, r8
    add r8, r9
    .endm

    .section .text.ph_span_texture, "ax", %progbits
    .p2align 2
    .global ph_span_texture
    .type ph_span_texture, %function
    .thumb_func
ph_span_texture: @ r0: run, r1: n
    push {r0, r1, r4-r11, lr}
    ldmia r0, {r2-r12, lr}
    @ The first k = 1 .. 16 pixels are the last k of 16: n - k is 0 or 16.
    subs r1, #1
    and r0, r1, #15
    sub r1, r0, #15
    add r12, r12, r1, lsl #1
    add lr, lr, r1, lsl #1
    rsb r0, r0, #15
    tbh [pc, r0, lsl #1]
entries:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    .hword (pixel_\at - entries) / 2
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    add r12, #32
    add lr, #32
    ldr r1, [sp, #4] @ n
    cmp r1, #16
    bls 2f
    movs r1, #16
    str r1, [sp, #4]
    b pixel_0
2:  ldr r0, [sp] @ run
    str r2, [r0]
    strd r12, lr, [r0, #40]
    pop {r0, r1, r4-r11, pc}
    .size ph_span_texture, . - ph_span_texture
