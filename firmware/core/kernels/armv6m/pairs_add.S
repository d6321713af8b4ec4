@ ph_pairs_add of pairs.h for ARMv6-M. Two pixels take 37 instructions, 7 more where a channel is full, and 14 less if
@ share is 32.
@
@ Registers: r0 to, r1 from, r2 lowest and r3 top bit of each channel; r4 - r7 scratch; r8 end of `to`, r9 share, r10
@ PH_SPREAD, r11 r12 halves, lr 32
#include "../thumb.inc"

    function ph_pairs_add @ r2: n, r3: share
    cmp r2, #0
    beq 9f
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    mov r7, r11
    push {r4-r7}
    mov r9, r3
    lsls r2, r2, #2
    adds r2, r0
    mov r8, r2
    movs r4, #32
    mov lr, r4
    adr r4, constants
    ldmia r4!, {r2, r3, r5-r7}
    mov r10, r5
    mov r11, r6
    mov r12, r7
1:  ldmia r1!, {r5}
    rev16 r5, r5
    cmp r9, lr
    beq 2f
    mov r6, r10
    mov r7, r9
    movs r4, r5
    bics r4, r6
    lsrs r4, r4, #5
    muls r4, r7
    add r4, r12
    bics r4, r6
    ands r5, r6
    muls r5, r7
    add r5, r11
    lsrs r5, r5, #5
    ands r5, r6
    orrs r5, r4
2:  ldr r4, [r0]
    rev16 r4, r4
    movs r6, r4
    ands r6, r5
    eors r4, r5
    movs r5, r4
    bics r5, r2
    lsrs r5, r5, #1
    adds r6, r5 @ the mean of each channel, rounded down
    ands r4, r2
    movs r5, r6
    ands r5, r3
    beq 3f
    eors r6, r5
    lsrs r7, r5, #5
    ands r7, r2
    orrs r4, r7 @ the lowest bit of green, which has one bit more
    lsls r7, r5, #1
    lsrs r5, r5, #4
    subs r7, r5
    orrs r4, r7
3:  lsls r6, r6, #1
    orrs r4, r6
    rev16 r4, r4
    stmia r0!, {r4}
    cmp r0, r8
    bne 1b
    pop {r4-r7}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    mov r11, r7
    pop {r4-r7, pc}
9:  bx lr
    .p2align 2
constants:
    .word 0x08210821, 0x84108410, 0x07e0f81f, 0x02008010, 0x04008010
    .size ph_pairs_add, . - ph_pairs_add
