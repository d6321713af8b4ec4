@ ph_span_flat of kernels.h for ARMv6-M. A pixel that is drawn takes 7 instructions, a hidden one 5.
@
@ Registers: r0 pixels, r1 depth, r2 runs of 16 left, r3 d, r4 gd, r5 colour; r6 r7 scratch
#include "../thumb.inc"

    .macro pixel at
    ldrh.n r6, [r1, #2 * \at]
    lsrs r7, r3, #16
    cmp r7, r6
    bls.n 1f
    strh.n r7, [r1, #2 * \at]
    strh.n r5, [r0, #2 * \at]
1:  adds r3, r4
    .endm
    .equ pixel_bytes, 14

    function ph_span_flat, scenery @ r2: n; stack: gd, colour
    push {r4-r7, lr}
    ldr r4, [sp, #20]
    ldr r5, [sp, #24]
    @ The first turn runs only the last k = 1 .. 16 of the 16 unrolled pixels, so that whole sixteens are left.
    subs r2, #1
    movs r6, #15
    ands r6, r2
    lsrs r2, r2, #4
    subs r6, #15 @ k - 16
    lsls r7, r6, #1
    adds r0, r7
    adds r1, r7
    rsbs r6, r6, #0
    movs r7, #pixel_bytes
    muls r6, r7
    add pc, r6 @ jump into the 16 pixels: r6 bytes behind `first`
    nop
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    .if . - first - 16 * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
    adds r0, #32
    adds r1, #32
    subs r2, #1
    bpl first
    pop {r4-r7, pc}
    .size ph_span_flat, . - ph_span_flat
