@ ph_span_blend of kernels.h for ARMv6-M. A pixel that is blended takes 18 instructions, a hidden one 5, and a fourth of
@ them one more.
@
@ Registers: r0 pixels, r1 depth, r2 runs of 4 left, r3 d, r4 the channels of a spread colour, r5 rest; r6 r7 scratch;
@ r8 gd, r9 source
#include "../thumb.inc"

    .macro pixel at
    ldrh.n r6, [r1, #2 * \at]
    lsrs r7, r3, #16
    cmp r7, r6
    bls.n 1f
    ldrh.n r6, [r0, #2 * \at]
    rev16 r6, r6
    lsls r7, r6, #16
    orrs r6, r7
    ands r6, r4
    muls r6, r5
    add r6, r9
    lsrs r6, r6, #5
    ands r6, r4
    lsrs r7, r6, #16
    orrs r6, r7
    rev16 r6, r6
    strh.n r6, [r0, #2 * \at]
1:  add r3, r8
    .endm
    .equ pixel_bytes, 36

    function ph_span_blend @ r2: n; stack: gd, source, rest
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    push {r4, r5}
    ldr r4, [sp, #28]
    mov r8, r4
    ldr r4, [sp, #32]
    mov r9, r4
    ldr r5, [sp, #36]
    ldr r4, channels
    @ The first turn runs only the last k = 1 .. 4 of the 4 unrolled pixels, so that whole fours are left.
    subs r2, #1
    movs r6, #3
    ands r6, r2
    lsrs r2, r2, #2
    subs r6, #3 @ k - 4
    lsls r7, r6, #1
    adds r0, r7
    adds r1, r7
    rsbs r6, r6, #0
    movs r7, #pixel_bytes
    muls r6, r7
    add pc, r6 @ jump into the 4 pixels: r6 bytes behind `first`
    nop
first:
    .irp at, 0, 1, 2, 3
    pixel \at
    .endr
    .if . - first - 4 * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
    adds r0, #8
    adds r1, #8
    subs r2, #1
    bpl first
    pop {r4, r5}
    mov r8, r4
    mov r9, r5
    pop {r4-r7, pc}
    .p2align 2
channels:
    .word 0x07e0f81f
    .size ph_span_blend, . - ph_span_blend
