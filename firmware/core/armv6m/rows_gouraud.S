@ ph_rows_gouraud of hot.h for ARMv6-M: 44 instructions a row, 11 a pixel that is drawn, 6 a hidden one, some 45 a call.
@
@ r0 depth, r1 pixels, r2 d, r3 light, r4 ramp, r5 r6 scratch, r7 the struct ph_rows; r8 gd, r9 glight, r10 left,
@ r11 right, r12 d and lr light at column 0; on the stack: from depth to pixels, and where a row's pixels end
    .syntax unified
    .thumb

    .equ left_dx, 16
    .equ right_dx, 20
    .equ d_dy, 24
    .equ light_dy, 28
    .equ gd, 32
    .equ glight, 36
    .equ depth, 40
    .equ stride, 44
    .equ pixels, 48
    .equ ramp, 52
    .equ rows, 56
    .equ count, 60

    .macro pixel at
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    lsrs r5, r3, #25
    lsls r5, r5, #1
    ldrh.n r5, [r4, r5]
    strh.n r5, [r1, #2 * \at]
1:  add r2, r8
    add r3, r9
    .endm
    .equ pixel_bytes, 22

    .section .text.ph_rows_gouraud, "ax", %progbits
    .p2align 2
    .global ph_rows_gouraud
    .type ph_rows_gouraud, %function
    .thumb_func
ph_rows_gouraud: @ r0: struct ph_rows
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    mov r7, r11
    push {r4-r7}
    movs r7, r0
    ldmia r0!, {r1-r4}
    mov r10, r1
    mov r11, r2
    mov r12, r3
    mov lr, r4
    ldr r1, [r7, #gd]
    mov r8, r1
    ldr r1, [r7, #glight]
    mov r9, r1
    ldr r4, [r7, #ramp]
    ldr r0, [r7, #depth]
    ldr r1, [r7, #pixels]
    subs r1, r0
    subs r0, #64 @ the last column's pixel is the last of 32
    str r0, [r7, #depth]
    ldr r2, =last + 1
    push {r1, r2}
row:
    mov r5, r10
    ldr r6, [r7, #left_dx]
    add r10, r6
    mov r1, r11
    ldr r6, [r7, #right_dx]
    add r11, r6
    lsrs r5, r5, #16
    lsrs r1, r1, #16
    ldr r0, [r7, #depth]
    lsls r6, r1, #1
    adds r6, r6, r0
    ldr r2, [r7, #stride]
    adds r0, r0, r2
    str r0, [r7, #depth]
    mov r2, r12
    ldr r0, [r7, #d_dy]
    add r12, r0
    mov r3, lr
    ldr r0, [r7, #light_dy]
    add lr, r0
    subs r1, r1, r5
    ble 2f
    mov r0, r8
    muls r0, r5
    adds r2, r2, r0
    mov r0, r9
    muls r0, r5
    adds r3, r3, r0
    ldr r0, [r7, #count]
    adds r0, r0, r1
    str r0, [r7, #count]
    movs r0, #pixel_bytes
    muls r1, r0
    ldr r5, [sp, #4]
    subs r5, r5, r1
    movs r0, r6
    ldr r1, [sp]
    adds r1, r1, r0
    bx r5 @ as far before `last` as there are pixels
2:  b last
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
    .if . - first - 32 * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
last:
    ldr r0, [r7, #rows]
    subs r0, #1
    str r0, [r7, #rows]
    beq 3f
    b row
3:  pop {r1, r2}
    mov r2, r10
    mov r3, r11
    mov r4, r12
    mov r5, lr
    movs r0, r7
    stmia r0!, {r2-r5}
    ldr r0, [r7, #depth]
    adds r0, #64
    adds r1, r1, r0
    str r0, [r7, #depth]
    str r1, [r7, #pixels]
    pop {r4-r7}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    mov r11, r7
    pop {r4-r7, pc}
    .size ph_rows_gouraud, . - ph_rows_gouraud
    .p2align 2
    .ltorg
