@ ph_small_colours of kernels.h for ARMv6-M. A row takes 50 instructions, a pixel that is drawn 16, a hidden one 8, a call
@ some 60; in a long row 8 pixels take 6 more.
@
@ Registers: r0 depth, r1 pixels, r2 d, r3 red and blue, r4 green, r5 r6 scratch, r7 33; r8 r9 r10 their steps; r11 r12 masks
@ of red and blue, and of green; lr blocks of 8 pixels that are left in the row.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

    .equ left, 0 @ on the stack: what changes from row to row, and by how much
    .equ right, 4
    .equ d, 8
    .equ light, 12
    .equ green, 16
    .equ depth, 20
    .equ steps, 24 @ from one of them to its step
    .equ count, 48
    .equ rows, 52
    .equ triangle, 56  @ 0 when the lower edge has taken over
    .equ to_pixels, 60 @ from depth
    .equ frame, 64

    .equ unrolled, 8
    .equ pixel_bytes, 32

    .macro pixel at
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    mov r5, r11 @ see ph_pixel_colour
    ands r5, r3
    muls r5, r7
    mov r6, r12
    ands r6, r4
    orrs r5, r6
    rev r5, r5 @ its upper half in wire order
    strh.n r5, [r1, #2 * \at]
1:  add r2, r8
    add r3, r9
    add r4, r10
    .endm

    .macro down at, value @ a row down
    ldr r6, [sp, #\at + steps]
    adds r6, r6, \value
    str r6, [sp, #\at]
    .endm

    .macro along value, step @ r0 columns on
    mov r6, \step
    muls r6, r0
    adds \value, \value, r6
    .endm

    function ph_small_colours, few @ r0: struct ph_small, r1: depth, r2: pixels, r3: bytes from row to row
    save_registers
    sub sp, #frame
    subs r2, r2, r1
    str r1, [sp, #depth]
    str r3, [sp, #depth + steps]
    str r2, [sp, #to_pixels]
    str r0, [sp, #triangle]
    movs r4, #0
    str r4, [sp, #count]
    ldrh r4, [r0, #small_upper_rows]
    str r4, [sp, #rows]
    ldmia r0!, {r2-r5} @ the steps
    mov r1, sp
    adds r1, #steps
    stmia r1!, {r2-r5}
    ldmia r0!, {r2-r7} @ gd, glight, a ramp, left, right, d
    mov r8, r2
    mov r9, r3
    mov r1, sp
    stmia r1!, {r5-r7}
    ldr r2, [r0]
    adds r0, #small_green - small_light
    ldmia r0!, {r3-r5} @ green: base, gx, gy
    mov r10, r4
    stmia r1!, {r2, r3}
    str r5, [sp, #green + steps]
    ldr r0, =0xf800f800
    mov r11, r0
    ldr r0, =0x07e00000
    mov r12, r0
    movs r7, #33
    b row
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7
    pixel \at
    .endr
last:
    .if last - first - unrolled * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
    mov r5, lr
    subs r5, #1
    bmi row_end
    mov lr, r5
    adds r0, #2 * unrolled
    adds r1, #2 * unrolled
    b first
row_end:
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    beq half_end
row:
    mov r6, sp
    ldmia r6!, {r0-r5} @ left, right, d, light, green, depth
    down left, r0
    down right, r1
    down d, r2
    down light, r3
    down green, r4
    down depth, r5
    lsrs r0, r0, #16
    lsrs r1, r1, #16
    subs r1, r1, r0
    ble row_end
    ldr r6, [sp, #count]
    adds r6, r6, r1
    str r6, [sp, #count]
    along r2, r8
    along r3, r9
    along r4, r10
    lsls r0, r0, #1
    adds r0, r0, r5
    subs r1, #1
    lsrs r5, r1, #3
    mov lr, r5
    movs r6, #7
    ands r1, r6 @ the first 1 to 8 pixels, less one
    subs r6, r6, r1 @ so many are left out of a block
    lsls r1, r6, #1
    subs r0, r0, r1
    ldr r1, [sp, #to_pixels]
    adds r1, r1, r0
    lsls r6, r6, #5 @ their bytes
    ldr r5, =first + 1
    adds r5, r5, r6
    bx r5
half_end:
    ldr r0, [sp, #triangle]
    cmp r0, #0
    beq done
    ldrh r1, [r0, #small_lower_rows]
    cmp r1, #0
    beq done
    str r1, [sp, #rows]
    movs r1, #0
    str r1, [sp, #triangle]
    ldr r1, [r0, #small_lower]
    ldr r2, [r0, #small_lower + 4]
    ldr r3, [r0, #small_lower_is_right]
    lsls r3, r3, #2
    add r3, sp
    str r1, [r3, #left]
    str r2, [r3, #left + steps]
    b row
done:
    ldr r0, [sp, #count]
    add sp, #frame
    restore_and_return
    .p2align 2
    .ltorg
    .size ph_small_colours, . - ph_small_colours
