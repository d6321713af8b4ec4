@ ph_texel_row_nearest (see texel_row.h) for ARMv6-M. A pixel that is drawn takes 18.25 instructions, a hidden one 10.25, a
@ row some 70.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"
#include "texels.inc"

    .equ frame, 16

    @ Draws a row, four pixels a turn: r0 depth and r1 pixels, both behind the row's last pixel, r5 its pixels, others as in
    @ texels.inc. It leaves by `back`.
    .macro fours name, v_down
    str r0, [sp, #end]
    subs r5, #1
    lsrs r6, r5, #2
    adds r6, #1
    lsls r6, r6, #3
    subs r0, r0, r6
    subs r1, r1, r6
    movs r6, #3
    bics r6, r5
    lsls r6, r6, #1
    adr r5, \name\()_first
    ldrh r6, [r5, r6]
    adds r5, r5, r6
    bx r5
    .p2align 2
\name\()_first: @ indexed by the pixel that comes first
    .irp at, 0, 1, 2, 3
    .hword \name\()_\at - \name\()_first + 1
    .endr
    .irp at, 0, 1, 2, 3
    pixel \at, \name, \v_down
    .endr
    adds r0, #8
    adds r1, #8
    ldr r5, [sp, #end]
    cmp r0, r5
    bne \name\()_0
    ldr r5, [sp, #back]
    bx r5
    .endm

    function ph_texel_row_nearest, scenery @ r0: struct ph_texel_row
    save_registers
    sub sp, #frame
    ldmia r0!, {r1-r5} @ depth, pixels, n, d, gd
    mov r8, r5
    lsls r5, r3, #1
    adds r1, r1, r5
    adds r2, r2, r5
    push {r1-r4}
    ldmia r0!, {r1-r6} @ u, v
    mov r9, r2
    mov lr, r3
    mov r10, r5
    mov r12, r6
    ldmia r0!, {r2, r5, r6} @ u_mask, v_mask, texels
    mov r11, r6
    lsls r7, r2, #1
    lsls r6, r5, #1
    movs r3, r1
    pop {r0-r2, r5} @ depth, pixels, n, d
    str r6, [sp, #mask2]
    str r7, [sp, #mask1]
    adr r7, done
    adds r7, #1
    str r7, [sp, #back]
    ldr r7, [sp, #mask1]
    lsrs r6, r6, #17
    mov r6, r2
    mov r2, r5
    mov r5, r6
    bne ph_texel_large_pixels
    fours small, 16

    @ Draws a row of a texture of over 65,536 texels, of which v is in 2^-12, for other kernels, too.
    .global ph_texel_large_pixels
    .type ph_texel_large_pixels, %function
    .thumb_func
ph_texel_large_pixels:
    fours large, 12
    .p2align 2
done:
    add sp, #frame
    restore_and_return
    .size ph_texel_row_nearest, . - ph_texel_row_nearest
