@ ph_fill of kernels.h for ARMv6-M (and ARMv7-M). Each stmia stores 24 bytes.
#include "../thumb.inc"
    function ph_fill @ r0: to, r1: value, r2: pixels left
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
    movs r3, r1
    movs r4, r1
    movs r5, r1
    movs r6, r1
    movs r7, r1
    subs r2, #48
    bcc 3f
2:  stmia r0!, {r1, r3-r7}
    stmia r0!, {r1, r3-r7}
    stmia r0!, {r1, r3-r7}
    stmia r0!, {r1, r3-r7}
    subs r2, #48
    bcs 2b
3:  adds r2, #48
    b 5f
4:  stmia r0!, {r1}
5:  subs r2, #2
    bcs 4b
    lsls r2, r2, #31 @ one pixel is left if the difference is odd
    beq 9f
    strh r1, [r0]
9:  pop {r4-r7, pc}
    .size ph_fill, . - ph_fill
