@ ph_texel_row_lit (see texel_row.h) for ARMv7-M. A pixel that is drawn takes 22.3 instructions, a hidden one 10.3, a row
@ 60, one of up to 4 pixels 44.
@
@ Registers: r0 r1 scratch, r2 d, r3 gd, r4 u, r5 du, r6 u_mask, r7 v, r8 dv, r9 fields, r10 v_mask, r11 texels, r12
@ depth, lr pixels.
#include "../thumb.inc"
#include "../offsets.inc"

    @ on the stack
    .equ steps, 0   @ of du and dv
    .equ levels, 8  @ light of the four fours of pixels
    .equ light, 24  @ of the four that follow, and its step
    .equ more, 32   @ sixteens of pixels that follow
    .equ frame, 36

    .macro pixel at, name=pixel, v_down=16
\name\()_\at:
    ldrh r0, [r12, #2 * \at]
    lsrs r1, r2, #16
    cmp r1, r0
    bls 1f
    strh r1, [r12, #2 * \at]
    and r0, r10, r7, lsr #\v_down
    and r1, r6, r4, lsr #22
    add r0, r1
    ldrh r0, [r11, r0, lsl #1]
    ldr r1, [sp, #levels + \at / 4 * 4]
    orr r0, r0, r0, lsl #16
    and r0, r9, r0, lsr #3 @ red, green, blue, each with five spare bits above
    mul r0, r1, r0
    and r0, r9, r0, lsr #5
    lsls r1, r0, #3
    orr r0, r1, r0, lsr #13
    strh r0, [lr, #2 * \at]
1:  add r2, r3
    add r4, r5
    add r7, r8
    .if \at & 1
    ldrd r0, r1, [sp, #steps]
    add r5, r0
    add r8, r1
    .endif
    .endm

    .macro next_levels light, step, scratch
    .irp at, 0, 4, 8, 12
    lsr \scratch, \light, #24
    str \scratch, [sp, #levels + \at]
    add \light, \step
    .endr
    .endm

    function ph_texel_row_lit @ r0: struct ph_texel_row
    push {r4-r11, lr}
    sub sp, #frame
    ldr r4, [r0, #8] @ n
    subs r4, #1
    lsrs r5, r4, #4
    str r5, [sp, #more]
    cmp r4, #4
    and r4, r4, #15
    rsb r4, r4, #15 @ the pixel that comes first
    lsr r6, r4, #2 @ its four
    blo 3f @ one four has one light
    add r1, r0, #row_light
    ldm r1, {r2, r3} @ light, step
    adds r7, r6, #1
    mls r2, r7, r3, r2
    next_levels r2, r3, r7
    strd r2, r3, [sp, #light]
3:  ldr r7, [r0, #row_level]
    add r6, sp, r6, lsl #2
    str r7, [r6, #levels]
    ldrd r12, lr, [r0]
    sub r12, r12, r4, lsl #1
    sub lr, lr, r4, lsl #1
    mov r1, r4
    ldrd r2, r3, [r0, #12]
    add r0, #row_u
    ldm r0!, {r4, r5, r6, r7, r8, r9}
    strd r6, r9, [sp, #steps]
    ldm r0, {r6, r10, r11} @ u_mask, v_mask, texels
    lsrs r9, r10, #16
    bne large
    movw r9, #0xfc1f
    movt r9, #0x03e0
    tbh [pc, r1, lsl #1]
entries: @ indexed by the pixel that comes first
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    .hword (pixel_\at - entries) / 2
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    ldr r0, [sp, #more]
    subs r0, #1
    bmi 2f
    str r0, [sp, #more]
    add r12, #32
    add lr, #32
    ldrd r0, r1, [sp, #light]
    next_levels r0, r1, r9
    str r0, [sp, #light]
    movw r9, #0xfc1f
    movt r9, #0x03e0
    b pixel_0
2:  add sp, #frame
    pop {r4-r11, pc}
large: @ over 65,536 texels: four pixels a turn, from the first four of r1 on; `more` becomes the end of depth
    bic r9, r1, #3
    and r1, r1, #3
    add r12, r12, r9, lsl #1
    add lr, lr, r9, lsl #1
    ldr r9, [r0, #8 - row_u_mask] @ n
    add r9, r1
    add r9, r12, r9, lsl #1
    str r9, [sp, #more]
    ldr r9, [r0, #row_level - row_u_mask]
    str r9, [sp, #levels]
    ldrd r0, r9, [r0, #row_light - row_u_mask]
    strd r0, r9, [sp, #light]
    movw r9, #0xfc1f
    movt r9, #0x03e0
    tbh [pc, r1, lsl #1]
large_entries:
    .irp at, 0, 1, 2, 3
    .hword (large_\at - large_entries) / 2
    .endr
    .irp at, 0, 1, 2, 3
    pixel \at, large, 12
    .endr
    add r12, #8
    add lr, #8
    ldrd r0, r1, [sp, #light]
    add r1, r0
    lsrs r0, r0, #24
    str r1, [sp, #light]
    str r0, [sp, #levels]
    ldr r0, [sp, #more]
    cmp r12, r0
    bne large_0
    b 2b
    .size ph_texel_row_lit, . - ph_texel_row_lit
