@ ph_fill of kernels.h for ARMv7-M. 22 instructions store 960 bytes.
#include "../thumb.inc"

    .equ turn, 960

    function ph_fill, loop @ r0: to, r1: value, r2: pixels left
    push {r4-r11, lr}
    cmp r2, #0
    beq 9f
    tst r0, #2 @ half a word comes first
    beq 1f
    strh r1, [r0], #2
    subs r2, #1
1:  orr r1, r1, r1, lsl #16
    lsl r12, r2, #1 @ bytes
    mov r2, r1
    mov r3, r1
    mov r4, r1
    mov r5, r1
    mov r6, r1
    mov r7, r1
    mov r8, r1
    mov r9, r1
    mov r10, r1
    mov r11, r1
    mov lr, r1
    subs r12, #turn
    bcc 3f
2:  .rept turn / 48
    stmia r0!, {r1-r11, lr}
    .endr
    subs r12, #turn
    bcs 2b
3:  adds r12, #turn - 48
    bcc 5f
4:  stmia r0!, {r1-r11, lr}
    subs r12, #48
    bcs 4b
5:  adds r12, #48
    b 7f
6:  str r1, [r0], #4
7:  subs r12, #4
    bcs 6b
    lsls r12, r12, #30 @ a pixel is left
    bpl 9f
    strh r1, [r0]
9:  pop {r4-r11, pc}
    .size ph_fill, . - ph_fill
