@ ph_span_flat of kernels.h for ARMv7-M and ARMv8-M. Pixels go in pairs, each in a half of a word, where the core has the
@ DSP instructions: a pair takes 12 instructions, a hidden one 6. Else a pixel takes 7, a hidden one 4.
@
@ Registers: r0 pixels, r1 depth, r2 runs of 16 left, r3 d, r4 gd, r5 colour; r12 lr scratch. In pairs: r2 has the runs
@ times 2, plus the odd pixel, r4 2 gd, r5 the colour twice, r6 d of the second pixel, r7 scratch.
#include "../thumb.inc"

#ifdef __ARM_FEATURE_DSP
    .macro single @ changes r12
    ldrh r12, [r1], #2
    cmp r12, r3, lsr #16
    bhs 1f
    lsr r12, r3, #16
    strh r12, [r1, #-2]
    strh r5, [r0]
1:  adds r0, #2
    .endm

    .macro pair at
pair_\at:
    ldr r12, [r1, #4 * \at]
    pkhtb lr, r6, r3, asr #16 @ both codes
    uqsub16 r7, lr, r12
    cbz r7, 1f
    add r7, r12 @ the nearer of each two depths
    usub16 r12, r12, lr @ GE: hidden
    str r7, [r1, #4 * \at]
    ldr lr, [r0, #4 * \at]
    sel lr, lr, r5
    str lr, [r0, #4 * \at]
1:  add r3, r4
    add r6, r4
    .endm

    function ph_span_flat, scenery @ r2: n; stack: gd, colour
    push {r4-r7, lr}
    ldrd r4, r5, [sp, #20]
    orr r5, r5, r5, lsl #16
    lsls r12, r1, #30 @ a depth that shares its word comes first
    bpl 2f
    single
    add r3, r4
    subs r2, #1
2:  lsrs r7, r2, #1
    beq last
    add r6, r3, r4
    lsls r4, r4, #1
    and r2, r2, #1
    @ The first turn runs only the last k = 1 .. 8 of the 8 unrolled pairs, so that whole sixteens are left.
    subs r7, #1
    and r12, r7, #7
    lsrs r7, r7, #3
    orr r2, r2, r7, lsl #1
    rsb r12, r12, #7
    sub r0, r0, r12, lsl #2
    sub r1, r1, r12, lsl #2
    tbh [pc, r12, lsl #1]
entries:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7
    .hword (pair_\at - entries) / 2
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7
    pair \at
    .endr
    adds r0, #32
    adds r1, #32
    subs r2, #2
    bpl pair_0
last:
    lsls r2, r2, #31
    bpl 2f
    single
2:  pop {r4-r7, pc}
#else
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

    function ph_span_flat, scenery @ r2: n; stack: gd, colour
    push {r4, r5, lr}
    ldrd r4, r5, [sp, #12]
    @ The first turn runs only the last k = 1 .. 16 of the 16 unrolled pixels, so that whole sixteens are left.
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
#endif
    .size ph_span_flat, . - ph_span_flat
