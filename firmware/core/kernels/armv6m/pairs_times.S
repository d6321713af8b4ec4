@ ph_pairs_times of pairs.h for ARMv6-M. Two pixels take 66 instructions.
@
@ Registers: r0 to, r1 from, r2 a channel of 5 bits of both pixels; r3 r4 the pixels, r5 - r7 scratch; r8 end of `to`,
@ r9 r10 halves of 5 and of 6 bits, r11 a channel of 6 bits of both, r12 what is done of the result
#include "../thumb.inc"

    @ r5 = the products of the channels that lie so many bits below the top of the pixels, of 5 or 6 bits
    .macro products down, bits
    .if \down
    lsls r5, r3, #\down
    lsls r6, r4, #\down
    lsrs r5, r5, #32 - \bits
    lsrs r6, r6, #32 - \bits
    .else
    lsrs r5, r3, #32 - \bits
    lsrs r6, r4, #32 - \bits
    .endif
    muls r5, r6
    lsls r5, r5, #16
    lsls r6, r3, #16 + \down
    lsls r7, r4, #16 + \down
    lsrs r6, r6, #32 - \bits
    lsrs r7, r7, #32 - \bits
    muls r6, r7
    adds r5, r6
    .endm

    @ r5 = the products over a full channel
    .macro round half, mask, bits
    add r5, \half
    lsrs r6, r5, #\bits
    ands r6, \mask
    adds r5, r6
    lsrs r5, r5, #\bits
    ands r5, \mask
    .endm

    function ph_pairs_times @ r2: n
    cmp r2, #0
    beq 9f
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    mov r7, r11
    push {r4-r7}
    lsls r2, r2, #2
    adds r2, r0
    mov r8, r2
    adr r3, constants
    ldmia r3!, {r2, r5-r7}
    mov r9, r5
    mov r10, r6
    mov r11, r7
1:  ldr r3, [r0]
    ldmia r1!, {r4}
    rev16 r3, r3
    rev16 r4, r4
    products 0, 5
    round r9, r2, 5
    lsls r5, r5, #11
    mov r12, r5
    products 11, 5
    round r9, r2, 5
    add r12, r5
    products 5, 6
    mov r7, r11
    round r10, r7, 6
    lsls r5, r5, #5
    add r5, r12
    rev16 r5, r5
    stmia r0!, {r5}
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
    .word 0x001f001f, 0x00100010, 0x00200020, 0x003f003f
    .size ph_pairs_times, . - ph_pairs_times
