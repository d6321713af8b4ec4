@ ph_small_gouraud of kernels.h for ARMv6-M; small_knee.S makes ph_small_knee of it,
@ long_gouraud.S ph_long_gouraud. A row takes 35 instructions, a pixel that is drawn 11, a hidden one 6, a
@ call some 40. After the first 1 to 16 pixels a long row takes 36 instructions for every 4 that are still empty.
@
@ Registers: r0 depth, r1 pixels, r2 d, r3 light, r4 ramp, r5 r6 scratch, r7 depth of column 0; long rows: twice the blocks of
@ 16 pixels that are left, plus 1 if a single pixel follows; r8 gd, r9 glight,
@ r10 left, r11 right, r12 d at column 0, lr light at column 0.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

#ifndef NAME
#define NAME ph_small_gouraud
#define TIER loop
#endif
#ifndef LIGHT_DOWN
#define LIGHT_DOWN 25
#endif

    .equ left_dx, 0 @ on the stack; five words that a row loads at once
    .equ right_dx, 4
    .equ d_dy, 8
    .equ light_dy, 12
    .equ stride, 16
    .equ count, 20
    .equ rows, 24
    .equ pixels_end, 28 @ address in the code where the pixels of a row end
    .equ triangle, 32   @ 0 when the lower edge has taken over
    .equ to_pixels, 36  @ from depth
    .equ knee, 40
    .equ base, 40 @ column 0 of a long row
    .ifdef with_knee
    .equ frame, 44
    .else
    .ifdef with_blocks
    .equ frame, 44
    .else
    .equ frame, 40
    .endif
    .endif

    .macro draw at
    strh.n r6, [r0, #2 * \at]
    lsrs r5, r3, #LIGHT_DOWN
    lsls r5, r5, #1
    ldrh.n r5, [r4, r5]
    strh.n r5, [r1, #2 * \at]
    .endm

    .macro pixel at
    ldrh.n r5, [r0, #2 * \at]
    .ifdef with_knee
    ldr.n r6, [sp, #knee]
    subs.n r6, r2, r6
    bcc.n 2f
    movs.n r6, #0
2:  adds.n r6, r6, r2
    lsrs r6, r6, #16
    .else
    lsrs r6, r2, #16
    .endif
    cmp r6, r5
    bls.n 1f
    draw \at
1:
    .if \at < last_pixel
    add r2, r8
    add r3, r9
    .endif
    .endm

    .macro fresh at
    lsrs r6, r2, #16
    draw \at
    add r2, r8
    add r3, r9
    .endm

    .macro four at @ no code is 0: where four depths are 0, four pixels are drawn
    ldr.n r5, [r0, #2 * \at]
    ldr.n r6, [r0, #2 * \at + 4]
    orrs r5, r6
    bne from_\at
    .irp after, 0, 1, 2, 3
    fresh (\at + \after)
    .endr
    .endm

    .ifdef with_blocks
    .equ unrolled, 16
    .equ last_pixel, 16 @ that has no step; here all have
    .else
    .equ unrolled, 32
    .equ last_pixel, 31
    .endif
    .ifdef with_knee
    .equ pixel_bytes, 32
    .else
    .equ pixel_bytes, 22
    .endif
    function NAME, TIER
    @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    save_registers
    subs r2, r2, r1
    .ifdef with_knee
    ldr r4, [r0, #small_knee]
    push {r4}
    .endif
    .ifdef with_blocks
    push {r4}
    .endif
    push {r0, r2}
    movs r4, #0
    ldrh r5, [r0, #small_upper_rows]
    ldr r6, =first + unrolled * pixel_bytes + 1
    push {r3-r6}
    subs r1, r1, r3 @ the row above
    subs r1, #2 * unrolled @ the last of the unrolled pixels is the last pixel of the row
    ldmia r0!, {r4-r7}
    push {r4-r7}
    movs r7, r1
    .ifdef with_blocks
    str r7, [sp, #base]
    .endif
    ldmia r0!, {r2-r5}
    mov r8, r2
    mov r9, r3
    mov r10, r5
    ldmia r0!, {r1-r3}
    mov r11, r1
    mov r12, r2
    mov lr, r3
    b row
    .p2align 2
    .ltorg
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
pixel_\at:
    pixel \at
    .endr
    .ifdef with_blocks
    .if . - first - unrolled * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
    b last
    .irp at, 0, 4, 8, 12
from_\at:
    b pixel_\at
    .endr
    .p2align 2
fours:
    .irp at, 0, 4, 8, 12
    four \at
    .endr
last:
    subs r7, #2
    bmi 1f
    adds r0, #32
    adds r1, #32
    b fours
1:  adds r7, #1
    bne row_end
    adds r0, #2
    adds r1, #2
    b pixel_15
row_end:
    .else
    .irp at, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
    .if . + 4 - first - unrolled * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
last:
    .endif
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    beq 2f
row:
    mov r0, sp
    ldmia r0, {r0-r3, r5}
    .ifdef with_blocks
    ldr r7, [sp, #base]
    adds r7, r7, r5
    str r7, [sp, #base]
    .else
    adds r7, r7, r5
    .endif
    mov r5, r10
    add r10, r0
    mov r0, r11
    add r11, r1
    mov r1, r12
    add r12, r2
    mov r2, lr
    add lr, r3
    .ifdef with_blocks
    asrs r5, r5, #16 @ cut to the picture
    asrs r0, r0, #16
    asrs r3, r5, #31
    bics r5, r3
    ldr r3, [sp, #stride]
    lsrs r3, r3, #1
    cmp r0, r3
    ble 1f
    mov r0, r3
1:  subs r6, r0, r5
    ble row_end
    .else
    lsrs r5, r5, #16
    lsrs r0, r0, #16
    subs r6, r0, r5
    ble last
    .endif
    lsls r0, r0, #1
    adds r0, r0, r7
    mov r3, r9
    muls r3, r5
    adds r3, r3, r2
    mov r2, r8
    muls r2, r5
    adds r2, r2, r1
    ldr r1, [sp, #count]
    adds r1, r1, r6
    str r1, [sp, #count]
    .ifdef with_blocks
    movs r7, #0
    cmp r6, #16
    ble 1f
    movs r7, #2 @ blocks are at whole words: one pixel may be left behind them
    ands r7, r0
    subs r0, r0, r7
    lsrs r7, r7, #1
    subs r6, r6, r7
    subs r5, r6, #1
    lsrs r5, r5, #4
    lsls r5, r5, #4
    subs r6, r6, r5 @ the first 1 to 16 pixels
    lsls r5, r5, #1
    subs r0, r0, r5
    lsrs r5, r5, #4
    adds r7, r7, r5
1:
    .endif
    movs r1, #pixel_bytes
    muls r6, r1
    ldr r5, [sp, #pixels_end]
    subs r5, r5, r6
    ldr r1, [sp, #to_pixels]
    adds r1, r1, r0
    bx r5 @ jump to as many pixels before `last` as there are
2:  ldr r0, [sp, #triangle]
    cmp r0, #0
    beq 5f
    ldrh r1, [r0, #small_lower_rows]
    cmp r1, #0
    beq 5f
    str r1, [sp, #rows]
    movs r1, #0
    str r1, [sp, #triangle]
    ldr r1, [r0, #small_lower]
    ldr r2, [r0, #small_lower + 4]
    ldr r3, [r0, #small_lower_is_right]
    cmp r3, #0
    beq 3f
    mov r11, r1
    str r2, [sp, #right_dx]
    b row
3:  mov r10, r1
    str r2, [sp, #left_dx]
    b row
5:  ldr r0, [sp, #count]
    add sp, #frame
    restore_and_return
    .size NAME, . - NAME
