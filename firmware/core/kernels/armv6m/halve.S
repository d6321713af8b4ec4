@ ph_halve of kernels.h for ARMv6-M. Pixels are made in pairs: 17 instructions if each is of one colour, else 60 at most.
@ A sample pair is a word: its second sample stands in the upper half.
@
@ Registers: r0 to, r1 upper, r2 lower, r3 16; r4 r5 upper samples, r6 r7 lower samples; r8 the end of whole pairs, r9
@ r10 upper and lower while samples are added, r11 the fields of a spread colour (red at bit 3, green at
@ 13, blue at 24), r12 half of 4 in each of them, lr n
#include "../thumb.inc"

    @ The mean of the samples in \a and \b to [r0, #\at]; r1: r11; r2: scratch
    .macro mean a b at
    movs r2, \a
    ands r2, r1
    rors \a, r3
    ands \a, r1
    adds \a, r2
    movs r2, \b
    ands r2, r1
    rors \b, r3
    ands \b, r1
    adds \a, r2
    adds \a, \b
    add \a, r12
    lsrs \a, \a, #2
    ands \a, r1
    lsrs \b, \a, #16
    orrs \a, \b
    strh \a, [r0, #\at]
    .endm

    function ph_halve @ r3: n
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    mov r7, r11
    push {r4-r7}
    mov lr, r3
    ldr r4, channels
    mov r11, r4
    ldr r4, half
    mov r12, r4
    lsrs r4, r3, #1
    lsls r4, r4, #2
    adds r4, r0
    mov r8, r4
    movs r3, #16
    cmp r0, r8
    bhs 4f
1:  ldmia r1!, {r4, r5}
    ldmia r2!, {r6, r7}
    cmp r4, r6
    bne 3f
    rors r6, r3 @ a mean is the same
    cmp r4, r6
    bne 3f
    cmp r5, r7
    bne 2f
    rors r7, r3
    cmp r5, r7
    bne 2f
    strh r4, [r0]
    strh r5, [r0, #2]
    adds r0, #4
    cmp r0, r8
    blo 1b
    b 4f
2:  strh r4, [r0]
    mov r9, r1
    mov r10, r2
    mov r1, r11
    b 7f
3:  mov r9, r1
    mov r10, r2
    mov r1, r11
    mean r4, r6, 0
    cmp r5, r7
    bne 7f
    rors r7, r3
    cmp r5, r7
    bne 7f
    strh r5, [r0, #2]
    b 8f
7:  mean r5, r7, 2
8:
    mov r1, r9
    mov r2, r10
    adds r0, #4
    cmp r0, r8
    blo 1b
4:  mov r4, lr @ the last pixel of an odd number
    lsls r4, r4, #31
    bpl 5f
    ldr r4, [r1]
    ldr r6, [r2]
    mov r1, r11
    mean r4, r6, 0
5:  pop {r4-r7}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    mov r11, r7
    pop {r4-r7, pc}
    .p2align 2
channels:
    .word 0x1f07e0f8
half:
    .word 0x02004010
    .size ph_halve, . - ph_halve
