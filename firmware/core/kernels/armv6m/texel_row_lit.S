@ ph_texel_row_lit (see texel_row.h) for ARMv6-M. A pixel that is drawn takes 27.75 instructions, or 32 beside a hidden
@ one of its four, which takes 12; a row takes some 70.
@
@ Of four pixels with one light, which are mostly drawn all, two go through each product: in the order of the CPU's bytes
@ two pixels are six fields, of which each second one has five spare bits above.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"
#include "texel_lit.inc"

    @ on the stack, behind what ph_texel_lit_pixels needs
    .equ first, lit_frame @ depth, pixels, d, and twice the number of the first pixel
    .equ frame, lit_frame + 16

    .macro pixel at, name=pixel, v_down=16
\name\()_\at:
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    ldr.n r6, [sp, #mask1]
    lsrs r5, r3, #21
    ands r5, r6
    add r5, r11
    lsrs r6, r4, #\v_down - 1
    ands r6, r7
    ldrh.n r5, [r5, r6]
    lsls r6, r5, #16
    orrs r5, r6
    lsrs r5, r5, #3
    ldr.n r6, fields
    ands r5, r6
    ldr.n r6, [sp, #level]
    muls r5, r6
    ldr.n r6, wire
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

    .macro next_four first
    adds r0, #8
    adds r1, #8
    ldr r5, [sp, #light]
    ldr r6, [sp, #step]
    adds r6, r6, r5
    str r6, [sp, #light]
    lsrs r5, r5, #24
    str r5, [sp, #level]
    ldr r5, [sp, #end]
    cmp r0, r5
    bne \first
    ldr r5, [sp, #back]
    bx r5
    .endm

    .macro texel to @ and steps u and v; r0 u_mask times 2
    lsrs r5, r3, #21
    ands r5, r0
    add r5, r11
    lsrs r6, r4, #15
    ands r6, r7
    ldrh \to, [r5, r6]
    add r3, r9
    add r4, r10
    .endm

    .macro two to @ texels
    texel \to
    texel r5
    lsls r5, r5, #16
    orrs \to, r5
    add r9, lr
    add r10, r12
    .endm

    .macro light_two of @ r5 fields, r6 light; r0 is lost
    rev16 \of, \of
    movs r0, r5
    ands r0, \of
    bics \of, r5
    lsrs \of, \of, #5
    muls r0, r6
    muls \of, r6
    lsrs r0, r0, #5
    ands r0, r5
    bics \of, r5
    orrs \of, r0
    rev16 \of, \of
    .endm

    .macro depth_of at
    ldrh r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls hidden_\at
    strh r6, [r0, #2 * \at]
    add r2, r8
    .endm

    .macro forget at @ that a pixel was drawn: the depth that it left becomes one that it is nearer than
    ldrh r5, [r0, #2 * \at]
    subs r5, #1
    strh r5, [r0, #2 * \at]
    mov r5, r8
    subs r2, r2, r5
    .endm

    function ph_texel_row_lit @ r0: struct ph_texel_row
    save_registers
    sub sp, #frame
    ldmia r0!, {r1-r5} @ depth, pixels, n, d, gd
    mov r8, r5
    lsls r6, r3, #1
    adds r6, r6, r1
    str r6, [sp, #end]
    subs r3, #1
    movs r6, #3
    bics r6, r3
    lsls r6, r6, #1
    subs r1, r1, r6
    subs r2, r2, r6
    str r1, [sp, #first]
    str r2, [sp, #first + 4]
    str r4, [sp, #first + 8]
    str r6, [sp, #first + 12]
    ldmia r0!, {r1-r6} @ u, v
    mov r9, r2
    mov lr, r3
    mov r10, r5
    mov r12, r6
    ldmia r0!, {r2, r3, r5, r6} @ u_mask, v_mask, texels, level
    lsls r2, r2, #1
    str r2, [sp, #mask1]
    lsls r7, r3, #1
    adr r2, ph_texel_lit_entries
    lsrs r3, r3, #16
    beq 1f
    adds r2, #8
1:  str r2, [sp, #table]
    mov r11, r5
    str r6, [sp, #level]
    ldmia r0!, {r5, r6} @ light, step
    str r5, [sp, #light]
    str r6, [sp, #step]
    adr r5, done
    adds r5, #1
    str r5, [sp, #back]
    movs r3, r1
    ldr r0, [sp, #first]
    ldr r1, [sp, #first + 4]
    ldr r2, [sp, #first + 8]
    ldr r5, [sp, #first + 12]

    .global ph_texel_lit_pixels
    .type ph_texel_lit_pixels, %function
    .thumb_func
ph_texel_lit_pixels:
    ldr r6, [sp, #table]
    ldrh r5, [r6, r5]
dispatch:
    add pc, r5
    .p2align 2
    .global ph_texel_lit_entries
ph_texel_lit_entries: @ indexed by the pixel that comes first
    .hword four - dispatch - 4
    .irp at, 1, 2, 3
    .hword pixel_\at - dispatch - 4
    .endr
    .irp at, 0, 1, 2, 3
    .hword of_large_\at - dispatch - 4
    .endr
    .irp at, 0, 1, 2, 3
    pixel \at
    .endr
    b next
hidden_3:
    forget 2
hidden_2:
    forget 1
hidden_1:
    forget 0
hidden_0:
    b pixel_0
four:
    .irp at, 0, 1, 2, 3
    depth_of \at
    .endr
    push {r0-r2}
    ldr r0, [sp, #12 + mask1]
    two r1
    two r2
    ldr r5, fields_of_two
    ldr r6, [sp, #12 + level]
    light_two r1
    light_two r2
    ldr r0, [sp, #4] @ pixels
    strh r1, [r0]
    lsrs r1, r1, #16
    strh r1, [r0, #2]
    strh r2, [r0, #4]
    lsrs r2, r2, #16
    strh r2, [r0, #6]
    pop {r0-r2}
next:
    next_four four
    .irp at, 0, 1, 2, 3
    pixel \at, of_large, 12
    .endr
    next_four of_large_0
    .p2align 2
fields_of_two:
    .word 0x07e0f81f
fields: @ red, green, blue, each with five spare bits above
    .word 0x03e0fc1f
wire: @ red, green, blue where they lie in a pixel in wire order, or 16 bits higher
    .word 0x1f07e0f8
done:
    add sp, #frame
    restore_and_return
    .size ph_texel_row_lit, . - ph_texel_row_lit
