@ ph_span_gouraud of kernels.h for ARMv7-M. A pixel that is drawn takes 10 instructions, a hidden one 6.
@
@ Registers: r0 pixels, r1 depth, r2 runs of 16 left, r3 d, r4 gd, r5 light, r6 glight, r7 ramp; r8 r12 scratch
#include "../thumb.inc"

    .macro pixel at
pixel_\at:
    ldrh r12, [r1, #2 * \at]
    lsr r8, r3, #16
    cmp r8, r12
    bls 1f
    strh r8, [r1, #2 * \at]
    lsr r8, r5, #25
    ldrh r8, [r7, r8, lsl #1]
    strh r8, [r0, #2 * \at]
1:  add r3, r4
    add r5, r6
    .endm

    function ph_span_gouraud, scenery @ r2: n; stack: gd, light, glight, ramp
    push {r4-r8, lr}
    ldrd r4, r5, [sp, #24]
    ldrd r6, r7, [sp, #32]
    @ The first turn runs only the last k = 1 .. 16 of the 16 unrolled pixels, so that whole sixteens are left.
    subs r2, #1
    and r12, r2, #15
    lsr r2, r2, #4
    sub r8, r12, #15
    add r0, r0, r8, lsl #1
    add r1, r1, r8, lsl #1
    rsb r12, r12, #15
    tbh [pc, r12, lsl #1]
entries:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    .hword (pixel_\at - entries) / 2
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    adds r0, #32
    adds r1, #32
    subs r2, #1
    bpl pixel_0
    pop {r4-r8, pc}
    .size ph_span_gouraud, . - ph_span_gouraud
