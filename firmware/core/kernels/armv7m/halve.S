@ ph_halve of kernels.h for ARMv7-M. Pixels are made in pairs: 12 instructions if each is of one colour, else 38 at most.
@ A sample pair is a word: its second sample stands in the upper half.
@
@ Registers: r0 to, r1 upper, r2 lower, r3 scratch; r4 r5 upper samples, r6 r7 lower samples; r8 the end of whole pairs,
@ r9 half of 4 in each field, r10 the fields of a spread colour: red at bit 3, green at 13, blue at 24; r12 n
#include "../thumb.inc"

    @ The mean of the samples in \a and \b to [r0], which goes on
    .macro mean a b
    and r3, r10, \a
    and \a, r10, \a, ror #16
    add r3, \a
    and \a, r10, \b
    add r3, \a
    and \a, r10, \b, ror #16
    add r3, \a
    add r3, r9
    and r3, r10, r3, lsr #2
    orr r3, r3, r3, lsr #16
    strh r3, [r0], #2
    .endm

    function ph_halve @ r3: n
    push {r4-r10, lr}
    mov r12, r3
    lsrs r4, r3, #1
    add r8, r0, r4, lsl #2
    movw r10, #0xe0f8
    movt r10, #0x1f07
    movw r9, #0x4010
    movt r9, #0x0200
    b 2f
1:  ldm r1!, {r4, r5}
    ldm r2!, {r6, r7}
    cmp r4, r6
    ittt eq
    cmpeq r4, r4, ror #16
    cmpeq r5, r7
    cmpeq r5, r5, ror #16
    bne 3f
    strh r4, [r0], #2
    strh r5, [r0], #2
2:  cmp r0, r8
    blo 1b
    b 4f
3:  cmp r4, r6
    it eq
    cmpeq r4, r4, ror #16
    bne 6f
    strh r4, [r0], #2
    b 7f
6:  mean r4, r6
    cmp r5, r7
    it eq
    cmpeq r5, r5, ror #16
    bne 7f
    strh r5, [r0], #2
    b 2b
7:  mean r5, r7
    cmp r0, r8
    blo 1b
4:  lsls r12, r12, #31 @ the last pixel of an odd number
    bpl 5f
    ldr r4, [r1]
    ldr r6, [r2]
    mean r4, r6
5:  pop {r4-r10, pc}
    .size ph_halve, . - ph_halve
