@ ph_fill of kernels.h for ARMv6-M. 18 instructions store 448 bytes.
#include "../thumb.inc"

    .equ turn, 448

    function ph_fill, loop @ r0: to, r1: value, r2: pixels left
    push {r4-r7, lr}
    cmp r2, #0
    beq 9f
    lsls r3, r0, #30 @ bit 1 of the address: half a word comes first
    bpl 1f
    strh r1, [r0]
    adds r0, #2
    subs r2, #1
1:  lsls r3, r1, #16
    orrs r1, r3
    lsls r2, r2, #1 @ bytes
    adds r6, r0, r2
    mov r12, r6 @ the end
    movs r7, #turn / 2
    lsls r7, r7, #1
    subs r6, r6, r7
    mov lr, r6 @ the last place where a turn may begin
    movs r3, r1
    movs r4, r1
    movs r5, r1
    movs r6, r1
    cmp r2, r7
    mov r7, r1
    blo 3f
    mov r2, r1
2:  .rept turn / 28
    stmia r0!, {r1-r7}
    .endr
    cmp r0, lr
    bls 2b
    mov r2, r12
    subs r2, r2, r0
3:  subs r2, #24
    bcc 5f
4:  stmia r0!, {r1, r3-r7}
    subs r2, #24
    bcs 4b
5:  adds r2, #24
    b 7f
6:  stmia r0!, {r1}
7:  subs r2, #4
    bcs 6b
    lsls r2, r2, #30 @ a pixel is left
    bpl 9f
    strh r1, [r0]
9:  pop {r4-r7, pc}
    .size ph_fill, . - ph_fill
