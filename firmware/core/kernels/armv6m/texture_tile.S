@ ph_texture_tile (see texture_tile.h) for ARMv6-M. A pixel that is drawn takes 17 instructions, a hidden one 9, a row
@ 113 (46 more in a clamped texture), a call some 60.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"
#include "texels.inc"

    .equ way, 32 @ bytes

    @ on the stack, behind the masks of texels.inc
    .equ self, 16  @ the struct ph_tile_rows
    .equ apart, 20 @ from depth to pixels
    .equ entry, 24 @ of the row
    .equ n, 28
    .equ more, 32  @ sixteens of pixels that follow
    .equ table, 36 @ of the entries
    .equ frame, 40

    .macro value at, step, bend, i, scratch @ at += i (step + i bend)
    movs \scratch, \bend
    muls \scratch, \i
    adds \scratch, \scratch, \step
    muls \scratch, \i
    adds \at, \at, \scratch
    .endm

    .macro down @ steps the coefficients at r0 to the next row
    ldmia r0!, {r1-r6}
    adds r1, r1, r4
    adds r2, r2, r5
    adds r3, r3, r6
    ldr r6, [r0]
    adds r4, r4, r6
    ldr r6, [r0, #4]
    adds r5, r5, r6
    subs r0, #24
    stmia r0!, {r1-r5}
    adds r0, #way - 20
    .endm

    function ph_texture_tile, scenery @ r0: struct ph_tile_rows
    save_registers
    sub sp, #frame
    movs r7, r0
    str r7, [sp, #self]
    adds r0, #texel_depth
    ldmia r0!, {r1-r6} @ depth, pixels, stride, gd, u_mask, v_mask
    ldr r0, [r0] @ texels
    mov r11, r0
    mov r8, r4
    lsls r5, r5, #1
    str r5, [sp, #mask1]
    lsls r6, r6, #1
    str r6, [sp, #mask2]
    subs r2, r2, r1
    str r2, [sp, #apart]
    adr r1, entries
    lsrs r6, r6, #17
    beq 1f
    adr r1, rows_of_large
    adds r1, #1
    str r1, [sp, #back]
    adr r1, large_entries
1:  str r1, [sp, #table]
row: @ r7: self
    ldr r0, [r7, #texel_left]
    ldr r1, [r7, #texel_right]
    asrs r0, r0, #16
    asrs r1, r1, #16
    asrs r2, r0, #31
    bics r0, r2
    ldr r2, [r7, #tile_columns]
    cmp r1, r2
    ble 1f
    movs r1, r2
1:  subs r2, r1, r0
    bgt 2f
    b down_rows
2:  ldr r3, [r7, #tile_outside]
    cmp r3, #0
    beq inside
    b clamped
inside: @ r0: first column, r1: the column behind the last, r2: how many
    str r2, [sp, #n]
    subs r3, r2, #1
    lsrs r4, r3, #4
    str r4, [sp, #more]
    lsls r5, r4, #4
    subs r1, r1, r5
    subs r4, r2, r5
    lsls r4, r4, #1
    ldr r3, [sp, #table]
    ldrh r3, [r3, r4]
    str r3, [sp, #entry]
    movs r3, #1
    bics r3, r2
    adds r2, r3, r0
    adds r2, r2, r2 @ pair
    movs r6, r7
    adds r6, #tile_u
    ldmia r6!, {r3-r5}
    movs r7, r5
    muls r7, r2
    adds r7, r7, r4
    mov r9, r7
    value r3, r4, r5, r0, r7
    lsls r5, r5, #2
    mov lr, r5
    adds r6, #way - 12
    ldmia r6!, {r4, r5, r7}
    movs r6, r7
    muls r6, r2
    adds r6, r6, r5
    mov r10, r6
    value r4, r5, r7, r0, r6
    lsls r7, r7, #2
    mov r12, r7
    ldr r7, [sp, #self]
    ldr r2, [r7, #texel_d]
    mov r5, r8
    muls r5, r0
    adds r2, r2, r5
    lsls r0, r1, #1
    subs r0, #32 @ behind the pixels that come first
    ldr r1, [r7, #texel_depth]
    adds r0, r0, r1
    ldr r1, [sp, #apart]
    adds r1, r1, r0
    ldr r7, [sp, #mask1]
    ldr r5, [sp, #entry]
    .p2align 2
    add pc, r5
    nop
entries: @ indexed by the pixels that come first, 1 .. 16: the last ones of the 16 unrolled
    .hword 0
    .irp at, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword pixel_\at - entries
    .endr
    .p2align 2
large_entries:
    .rept 17
    .hword large - entries
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    pixel \at
    .endr
    ldr r5, [sp, #more]
    subs r5, #1
    bmi rows_of_large
    str r5, [sp, #more]
    adds r0, #32
    adds r1, #32
    b pixel_0
large:
    ldr r5, [sp, #more]
    adds r5, #1
    lsls r5, r5, #5
    adds r0, r0, r5
    adds r1, r1, r5
    ldr r5, [sp, #n]
    ldr r6, large_pixels
    bx r6
    .p2align 2
large_pixels:
    .word ph_texel_large_pixels
    .p2align 2
rows_of_large:
    ldr r7, [sp, #self]
    ldr r0, [sp, #n]
    ldr r1, [r7, #tile_count]
    adds r1, r1, r0
    str r1, [r7, #tile_count]
down_rows:
    movs r0, r7
    adds r0, #tile_u
    down
    down
    movs r0, r7
    ldmia r0!, {r1-r6} @ left, right, d, left_dx, right_dx, d_dy
    adds r1, r1, r4
    adds r2, r2, r5
    adds r3, r3, r6
    subs r0, #24
    stmia r0!, {r1-r3}
    ldr r1, [r7, #texel_depth]
    ldr r2, [r7, #texel_stride]
    adds r1, r1, r2
    str r1, [r7, #texel_depth]
    ldr r1, [r7, #texel_rows]
    subs r1, #1
    str r1, [r7, #texel_rows]
    beq done
    b row
done:
    ldr r0, [r7, #texel_depth]
    ldr r1, [sp, #apart]
    adds r0, r0, r1
    str r0, [r7, #texel_pixels]
    add sp, #frame
    restore_and_return

    @ Tests the first and the last pixel of a row in a clamped texture.
clamped:
    mov r9, r2
    mov r10, r7
    subs r1, #1
    movs r6, r7
    adds r6, #tile_u
    bl bits_at_ends
    ldr r2, [r7, #tile_u_outside]
    ands r2, r5
    bne done
    adds r6, #way - 12
    bl bits_at_ends
    ldr r2, [r7, #tile_v_outside]
    ands r2, r5
    bne done
    adds r1, #1
    mov r2, r9
    b inside
bits_at_ends: @ r5: of u or v, whose coefficients are at r6, at columns r0 and r1. In a row of even length (r9) r1 is one bend off.
    ldmia r6!, {r2-r4}
    movs r5, r2
    value r2, r3, r4, r0, r7
    value r5, r3, r4, r1, r7
    mov r7, r9
    lsrs r7, r7, #1
    bcs 1f
    adds r5, r5, r4
1:  orrs r5, r2
    mov r7, r10
    bx lr
    .size ph_texture_tile, . - ph_texture_tile
