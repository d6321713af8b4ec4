@ ph_span_blend of kernels.h for ARMv7-M. A pixel that is blended takes 15 instructions, a hidden one 7.
@
@ Registers: r0 pixels, r1 depth, r2 n, r3 d, r4 gd, r5 source, r6 rest, r7 the channels of a spread colour; r12 scratch
#include "../thumb.inc"

    function ph_span_blend @ stack: gd, source, rest
    push {r4-r7, lr}
    ldrd r4, r5, [sp, #20]
    ldr r6, [sp, #28]
    movw r7, #0xf81f
    movt r7, #0x07e0
1:  ldrh r12, [r1], #2
    cmp r12, r3, lsr #16
    bhs 2f
    ldrh r12, [r0]
    rev16 r12, r12
    orr r12, r12, r12, lsl #16
    and r12, r12, r7
    mla r12, r12, r6, r5
    and r12, r7, r12, lsr #5
    orr r12, r12, r12, lsr #16
    rev16 r12, r12
    strh r12, [r0]
2:  add r3, r4
    adds r0, #2
    subs r2, #1
    bne 1b
    pop {r4-r7, pc}
    .size ph_span_blend, . - ph_span_blend
