@ ph_texture_small (see texture_small.h) for ARMv6-M. A pixel that is drawn takes 17 instructions, a hidden one 9, a row
@ 84, a call some 60.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"
#include "texels.inc"
#include "texel_line.inc"

    @ on the stack, behind the masks of texels.inc
    .equ self, 16  @ the struct ph_texel_run
    .equ apart, 20 @ from depth to pixels
    .equ stride, 24
    .equ below, 28 @ depth of column -32 of the next row: the last of the 32 unrolled pixels is the last of a row
    .equ rows, 32
    .equ count, 36
    .equ from, 40 @ of the row: first column, number of pixels, pair (see texture_tile.h), and r0, r2 and r3
    .equ n, 44
    .equ pair, 48
    .equ row_depth, 52
    .equ row_d, 56
    .equ row_u, 60
    .equ table, 64 @ of the entries
    .equ frame, 68

    function ph_texture_small, loop @ r0: struct ph_texel_run
    save_registers
    sub sp, #frame
    str r0, [sp, #self]
    run_begin
    subs r1, #64
    str r1, [sp, #below]
    ldmia r0!, {r1, r2} @ texels, rows
    mov r11, r1
    str r2, [sp, #rows]
    adr r1, entries
    lsrs r6, r6, #17
    beq 1f
    adr r1, next
    adds r1, #1
    str r1, [sp, #back]
    adr r1, large_entries
1:  str r1, [sp, #table]
    movs r1, #0
    str r1, [sp, #count]
row:
    ldr r0, [sp, #self]
    row_ends
    ble empty
    str r7, [sp, #from]
    str r3, [sp, #n]
    lsls r4, r4, #1
    adds r1, r1, r4
    str r1, [sp, #row_depth]
    ldr r1, [sp, #count]
    adds r1, r1, r3
    str r1, [sp, #count]
    row_pair
    line_at r9
    str r6, [sp, #row_u]
    adds r0, #12
    line_at r10
    movs r4, r6
    ldr r5, [sp, #n]
    lsls r5, r5, #1
    ldr r6, [sp, #table]
    ldrh r5, [r6, r5]
    ldr r0, [sp, #row_depth]
    ldr r1, [sp, #apart]
    adds r1, r1, r0
    ldr r2, [sp, #row_d]
    ldr r3, [sp, #row_u]
    ldr r7, [sp, #mask1]
dispatch:
    add pc, r5
empty:
    lines_down
    b last
    .p2align 2
entries: @ indexed by the number of pixels; the first is not used
    .hword 0
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword pixel_\at - dispatch - 4
    .endr
    .p2align 2
large_entries:
    .rept 33
    .hword large - dispatch - 4
    .endr
large:
    adds r0, #64
    adds r1, #64
    ldr r5, [sp, #n]
    ldr r6, large_pixels
    bx r6
    .p2align 2
large_pixels:
    .word ph_texel_large_pixels
next:
    b last
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
last:
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    beq 2f
    b row
2:  ldr r0, [sp, #self]
    movs r1, r0
    adds r1, #run_lower_rows
    ldmia r1!, {r3-r6} @ lower_rows, lower_is_right, lower_x, lower_dx
    cmp r3, #0
    beq 4f
    movs r2, #0
    str r2, [r0, #run_lower_rows]
    str r3, [sp, #rows]
    cmp r4, #0
    bne 3f
    str r5, [r0]
    str r6, [r0, #12]
    b row
3:  str r5, [r0, #4]
    str r6, [r0, #16]
    b row
4:  ldr r0, [sp, #count]
    add sp, #frame
    restore_and_return
    .size ph_texture_small, . - ph_texture_small
