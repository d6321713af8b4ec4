@ ph_span_texture of hot.h for ARMv6-M: 18 instructions a pixel that is drawn, 9 a hidden one, some 45 a run.
@
@ r0 depth, r1 pixels, r2 d, r3 u, r4 v, r5 r6 scratch, r7 row_mask; r8 gd, r9 du, r10 ddu, r11 dv, r12 ddv, lr texels
    .syntax unified
    .thumb

    .macro pixel at
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    lsrs r5, r3, #16
    lsrs r6, r4, #16
    ands r6, r7
    adds r5, r6
    adds r5, r5
    add r5, lr
    ldrh.n r5, [r5]
    strh.n r5, [r1, #2 * \at]
1:  add r2, r8
    add r3, r9
    add r9, r10
    add r4, r11
    add r11, r12
    .endm
    .equ pixel_bytes, 36

    .section .text.ph_span_texture, "ax", %progbits
    .p2align 2
    .global ph_span_texture
    .type ph_span_texture, %function
    .thumb_func
ph_span_texture: @ r0: run, r1: n
    push {r0, r1, r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    mov r7, r11
    push {r4-r7}
    ldmia r0!, {r2-r7} @ d gd u du ddu v
    mov r8, r3
    mov r9, r5
    mov r10, r6
    movs r3, r4
    movs r4, r7
    ldmia r0!, {r5-r7} @ dv ddv row_mask
    mov r11, r5
    mov r12, r6
    ldmia r0!, {r5, r6} @ texels depth
    mov lr, r5
    ldr r5, [r0] @ pixels
    @ The first k = 1 .. 16 pixels are the last k of 16: n - k is 0 or 16.
    subs r1, #1
    movs r0, #15
    ands r0, r1
    lsls r1, r0, #1
    subs r1, #30
    adds r6, r1
    adds r1, r5
    movs r5, #15
    subs r5, r0
    movs r0, #pixel_bytes
    muls r5, r0
    movs r0, r6
    add pc, r5 @ to `first` and as far behind it
    nop
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    .if . - first - 16 * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
    adds r0, #32
    adds r1, #32
    ldr r5, [sp, #20] @ n
    cmp r5, #16
    bls 2f
    movs r5, #16
    str r5, [sp, #20]
    b first
2:  ldr r5, [sp, #16] @ run
    str r2, [r5]
    str r0, [r5, #40]
    str r1, [r5, #44]
    pop {r4-r7}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    mov r11, r7
    pop {r0, r1, r4-r7, pc}
    .size ph_span_texture, . - ph_span_texture
