@ ph_span_seen of kernels.h for ARMv6-M. A pixel that is seen takes 5 instructions, a hidden one 6.
@
@ Registers: r0 and r1 the ends of codes and depth, r6 and r7 a pixel further, r2 -2 times the pixels left; r4 r5 scratch;
@ r12 n
#include "../thumb.inc"

    @ Passes over what is seen, two pixels a turn; unless: the condition of a hidden one
    .macro seen unless
    lsls r4, r2, #30
    bpl 2f
    subs r2, #2
    b 3f
2:  ldrh r4, [r0, r2]
    ldrh r5, [r1, r2]
    cmp r4, r5
    \unless 8f
3:  ldrh r4, [r6, r2]
    ldrh r5, [r7, r2]
    cmp r4, r5
    \unless 7f
    adds r2, #4
    bmi 2b
    b 8f
    .endm

    .macro hidden unless
4:  ldrh r4, [r0, r2]
    ldrh r5, [r1, r2]
    cmp r4, r5
    \unless 8f
    adds r2, #2
    bmi 4b
    b 8f
    .endm

    function ph_span_seen, scenery @ r3: same; stack: seen
    push {r4-r7, lr}
    mov r12, r2
    lsls r2, r2, #1
    beq 8f
    adds r0, r2
    adds r1, r2
    adds r6, r0, #2
    adds r7, r1, #2
    rsbs r2, r2, #0
    ldr r4, [sp, #20]
    cmp r4, #0
    beq 5f
    cmp r3, #0
    beq 1f
    seen blo
1:  seen bls
5:  cmp r3, #0
    beq 6f
    hidden bhs
6:  hidden bhi
7:  adds r2, #2
8:  asrs r2, r2, #1
    mov r0, r12
    adds r0, r2
    pop {r4-r7, pc}
    .size ph_span_seen, . - ph_span_seen
