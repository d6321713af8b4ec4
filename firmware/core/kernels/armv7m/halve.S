@ ph_halve of kernels.h for ARMv7-M. Four pixels take 18 instructions if each is of one colour, else 60; a pixel before or
@ behind them takes 19.
@ A sample pair is a word: its second sample stands in the upper half.
@
@ Registers: r0 to, r1 upper, r2 lower, r3 pixels that are left, less 4; r4-r7 upper samples, r8 r9 r11 r12 lower samples;
@ r10 the fields of a spread colour: red at bit 3, green at 13, blue at 24; lr scratch.
#include "../thumb.inc"

    @ \a becomes the sum of the samples in \a and \b, spread.
    .macro sum a b
    and lr, r10, \a
    and \a, r10, \a, ror #16
    add lr, \a
    and \a, r10, \b
    add lr, \a
    and \a, r10, \b, ror #16
    add \a, lr
    .endm

    @ \a becomes a pixel: a quarter of the sum \a, rounded. r8: half of 4 in each field.
    .macro mean a
    add \a, r8
    and \a, r10, \a, lsr #2
    orr \a, \a, \a, lsr #16
    .endm

    function ph_halve @ r3: n
    cmp r3, #0
    it eq
    bxeq lr
    push {r4-r11, lr}
    movw r10, #0xe0f8
    movt r10, #0x1f07
    subs r3, #4
    lsls r4, r0, #30
    bmi 1f @ a pixel comes before the first whole word
    cmp r3, #0
    bge 2f
1:  ldr r4, [r1], #4
    ldr r9, [r2], #4
    ldr r8, half
    sum r4, r9
    mean r4
    strh r4, [r0], #2
    subs r3, #1
    bpl 2f
    cmn r3, #4
    bne 1b
    pop {r4-r11, pc}
2:  ldm r1!, {r4-r7}
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
3:  bfi r4, r5, #16, #16
    bfi r6, r7, #16, #16
    strd r4, r6, [r0], #8
    subs r3, #4
    bpl 2b
    cmn r3, #4
    bne 1b
    pop {r4-r11, pc}
4:  sum r4, r8
    ldr r8, half
    sum r5, r9
    sum r6, r11
    sum r7, r12
    mean r4
    mean r5
    mean r6
    mean r7
    b 3b
    .p2align 2
half:
    .word 0x02004010
    .size ph_halve, . - ph_halve
