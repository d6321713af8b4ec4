@ ph_span_flat of kernels.h for ARMv7-M. A pixel that is drawn takes 7 instructions, a hidden one 4.
@
@ Registers: r0 pixels, r1 depth, r2 runs of 16 left, r3 d, r4 gd, r5 colour; r12 lr scratch
#include "../thumb.inc"

    .macro pixel at
pixel_\at:
    ldrh r12, [r1, #2 * \at]
    cmp r12, r3, lsr #16
    bhs 1f
    lsr r12, r3, #16
    strh r12, [r1, #2 * \at]
    strh r5, [r0, #2 * \at]
1:  add r3, r4
    .endm

    function ph_span_flat @ r2: n; stack: gd, colour
    push {r4, r5, lr}
    ldrd r4, r5, [sp, #12]
    @ Of the 16 unrolled pixels only the last k = 1 .. 16 are run at first, so that whole sixteens are left.
    subs r2, #1
    and r12, r2, #15
    lsr r2, r2, #4
    sub lr, r12, #15
    add r0, r0, lr, lsl #1
    add r1, r1, lr, lsl #1
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
    pop {r4, r5, pc}
    .size ph_span_flat, . - ph_span_flat
