@ ph_rows_gouraud of hot.h for ARMv7-M: 26 instructions a row, 10 a pixel that is drawn, 6 a hidden one, some 25 a call.
@
@ r0 r1 scratch, r2 d, r3 light, r4 gd, r5 glight, r6 ramp, r7 depth, r8 pixels; r9 left, r10 right, r11 d and
@ r12 light at column 0; lr the struct ph_rows; on the stack: from depth to pixels
    .syntax unified
    .thumb

    .equ left_dx, 16
    .equ d_dy, 24
    .equ gd, 32
    .equ depth, 40
    .equ pixels, 48
    .equ ramp, 52
    .equ rows, 56
    .equ count, 60

    .macro pixel at
pixel_\at:
    ldrh r1, [r7, #2 * \at]
    lsrs r0, r2, #16
    cmp r0, r1
    bls 1f
    strh r0, [r7, #2 * \at]
    lsrs r0, r3, #25
    ldrh r0, [r6, r0, lsl #1]
    strh r0, [r8, #2 * \at]
1:  add r2, r4
    add r3, r5
    .endm

    .section .text.ph_rows_gouraud, "ax", %progbits
    .p2align 2
    .global ph_rows_gouraud
    .type ph_rows_gouraud, %function
    .thumb_func
ph_rows_gouraud: @ r0: struct ph_rows
    push {r4-r11, lr}
    mov lr, r0
    ldmia r0, {r9-r12}
    ldrd r4, r5, [lr, #gd]
    ldrd r8, r6, [lr, #pixels]
    ldr r7, [lr, #depth]
    sub r8, r8, r7
    sub r7, r7, #64 @ the last column's pixel is the last of 32
    str r7, [lr, #depth]
    push {r8}
row:
    lsr r1, r10, #16
    lsr r0, r9, #16
    ldrd r2, r3, [lr, #left_dx]
    add r9, r2
    add r10, r3
    ldrd r7, r8, [lr, #depth]
    add r8, r7
    str r8, [lr, #depth]
    add r7, r7, r1, lsl #1
    mla r2, r4, r0, r11
    mla r3, r5, r0, r12
    subs r1, r1, r0
    ldrd r0, r8, [lr, #d_dy]
    add r11, r0
    add r12, r8
    ble 2f
    ldr r0, [lr, #count]
    add r0, r1
    str r0, [lr, #count]
    ldr r8, [sp]
    add r8, r7
    tbh [pc, r1, lsl #1]
entries:
    .hword 0 @ no pixel is not drawn
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword (pixel_\at - entries) / 2
    .endr
    .p2align 1
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
2:  ldr r0, [lr, #rows]
    subs r0, #1
    str r0, [lr, #rows]
    bne row
    pop {r8}
    stmia lr, {r9-r12}
    ldr r7, [lr, #depth]
    add r7, r7, #64
    add r8, r7
    str r7, [lr, #depth]
    str r8, [lr, #pixels]
    pop {r4-r11, pc}
    .size ph_rows_gouraud, . - ph_rows_gouraud
