@ ph_halve of kernels.h for ARMv7-M. Four pixels take 19 instructions if each is of one colour; else the mean of one takes 11.
@ A sample pair is a word: its second sample stands in the upper half.
@
@ Registers: r0 to, r1 upper, r2 lower, r3 the end; r4-r7 upper samples, r8 r9 r11 r12 lower samples; r10 the fields of a
@ spread colour: red at bit 3, green at 13, blue at 24; lr scratch. n stands on the stack.
#include "../thumb.inc"

    @ \a becomes a pixel: the mean of the samples in \a and \b, unless all are one colour.
    .macro pixel a b
    cmp \a, \b
    it eq
    cmpeq \a, \a, ror #16
    beq 9f
    and lr, r10, \a
    and \a, r10, \a, ror #16
    add lr, \a
    and \a, r10, \b
    add lr, \a
    and \a, r10, \b, ror #16
    add lr, \a
    ldr \b, =0x02004010 @ half of 4 in each field
    add lr, \b
    and lr, r10, lr, lsr #2
    orr \a, lr, lr, lsr #16
9:
    .endm

    function ph_halve @ r3: n
    push {r3-r11, lr}
    bic r3, r3, #3
    add r3, r0, r3, lsl #1
    movw r10, #0xe0f8
    movt r10, #0x1f07
    b 3f
1:  ldm r1!, {r4-r7}
    ldm r2!, {r8, r9, r11, r12}
    cmp r4, r8
    itttt eq
    cmpeq r4, r4, ror #16
    cmpeq r5, r9
    cmpeq r5, r5, ror #16
    cmpeq r6, r11
    ittt eq
    cmpeq r6, r6, ror #16
    cmpeq r7, r12
    cmpeq r7, r7, ror #16
    bne 4f
2:  strh r4, [r0], #2
    strh r5, [r0], #2
    strh r6, [r0], #2
    strh r7, [r0], #2
3:  cmp r0, r3
    blo 1b
    ldr r4, [sp]
    and r4, r4, #3
    add r3, r3, r4, lsl #1
    b 6f
4:  pixel r4, r8
    pixel r5, r9
    pixel r6, r11
    pixel r7, r12
    b 2b
5:  ldr r4, [r1], #4
    ldr r8, [r2], #4
    pixel r4, r8
    strh r4, [r0], #2
6:  cmp r0, r3 @ up to three more
    blo 5b
    pop {r3-r11, pc}
    .p2align 2
    .ltorg
    .size ph_halve, . - ph_halve
