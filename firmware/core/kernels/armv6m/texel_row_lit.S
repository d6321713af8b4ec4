@ ph_texel_row_lit (see texel_row.h) for ARMv6-M. A pixel that is drawn takes 30.4 instructions, a hidden one 10.4, a row
@ 95.
@
@ Registers are those of texels.inc, but r7 is v_mask times 2.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

    @ on the stack
    .equ mask1, 0   @ u_mask times 2
    .equ fields, 4  @ red, green, blue, each with five spare bits above
    .equ wire, 8    @ the same where they lie in a pixel, or 16 bits higher
    .equ levels, 12 @ light of the four fours of pixels
    .equ light, 28  @ of the four that follow
    .equ step, 32
    .equ mask2, 36  @ v_mask times 2
    .equ more, 40   @ sixteens of pixels that follow
    .equ first, 44  @ depth, pixels, d, and where to begin
    .equ begin, 56
    .equ frame, 60

    .macro pixel at
pixel_\at:
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    ldr.n r6, [sp, #mask1]
    lsrs r5, r3, #21
    ands r5, r6
    add r5, r11
    lsrs r6, r4, #15
    ands r6, r7
    ldrh.n r5, [r5, r6]
    lsls r6, r5, #16
    orrs r5, r6
    lsrs r5, r5, #3
    ldr.n r6, [sp, #fields]
    ands r5, r6
    ldr.n r6, [sp, #levels + \at / 4 * 4]
    muls r5, r6
    ldr.n r6, [sp, #wire]
    lsrs r5, r5, #2
    ands r5, r6
    lsrs r6, r5, #16
    orrs r5, r6
    strh.n r5, [r1, #2 * \at]
1:  add r2, r8
    add r3, r9
    add r4, r10
    .if \at & 1
    add r9, lr
    add r10, r12
    .endif
    .endm

    .macro next_levels @ r5: light, r6: step; changes r7
    .irp at, 0, 4, 8, 12
    lsrs r7, r5, #24
    str r7, [sp, #levels + \at]
    adds r5, r5, r6
    .endr
    str r5, [sp, #light]
    .endm

    function ph_texel_row_lit @ r0: struct ph_texel_row
    save_registers
    sub sp, #frame
    ldmia r0!, {r1-r5} @ depth, pixels, n, d, gd
    mov r8, r5
    str r4, [sp, #first + 8]
    subs r3, #1
    lsrs r4, r3, #4
    str r4, [sp, #more]
    movs r4, #15
    bics r4, r3 @ the pixel that comes first
    lsls r6, r4, #1
    subs r1, r1, r6
    subs r2, r2, r6
    str r1, [sp, #first]
    str r2, [sp, #first + 4]
    adr r3, entries
    ldrh r1, [r3, r6]
    adds r1, r1, r3
    str r1, [sp, #begin]
    lsrs r7, r4, #2 @ its four
    ldmia r0!, {r1-r6} @ u, v
    mov r9, r2
    mov lr, r3
    mov r10, r5
    mov r12, r6
    movs r2, r4
    ldmia r0!, {r3-r6} @ u_mask, v_mask, texels, level
    lsls r3, r3, #1
    str r3, [sp, #mask1]
    lsls r4, r4, #1
    str r4, [sp, #mask2]
    mov r11, r5
    movs r3, r1
    movs r4, r2
    movs r2, r6
    lsls r1, r7, #2
    adds r7, #1
    ldmia r0!, {r5, r6} @ light, step
    str r6, [sp, #step]
    muls r7, r6
    subs r5, r5, r7
    next_levels
    add r1, sp
    str r2, [r1, #levels]
    ldr r1, fields_here
    str r1, [sp, #fields]
    lsls r1, r1, #3
    str r1, [sp, #wire]
    ldr r7, [sp, #mask2]
    ldr r5, [sp, #begin]
    add r0, sp, #first
    ldmia r0!, {r1, r2, r6}
    movs r0, r1
    movs r1, r2
    movs r2, r6
    bx r5
    .p2align 2
fields_here:
    .word 0x03e0fc1f
entries: @ indexed by the pixel that comes first
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    .hword pixel_\at - entries + 1
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    ldr r5, [sp, #more]
    subs r5, #1
    bmi 2f
    str r5, [sp, #more]
    ldr r5, [sp, #light]
    ldr r6, [sp, #step]
    next_levels
    ldr r7, [sp, #mask2]
    adds r0, #32
    adds r1, #32
    b pixel_0
2:  add sp, #frame
    restore_and_return
    .size ph_texel_row_lit, . - ph_texel_row_lit
