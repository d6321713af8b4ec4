@ ph_small_gouraud of kernels.h for ARMv6-M; small_knee.S makes ph_small_knee of it,
@ wide_gouraud.S ph_wide_gouraud. A row takes 37 instructions, a pixel that is drawn 11, a hidden one 6, a
@ call some 40.
@
@ Registers: r0 depth, r1 pixels, r2 d, r3 light, r4 ramp, r5 r6 scratch, r7 depth of column 0, r8 gd, r9 glight,
@ r10 left, r11 right, r12 d at column 0, lr light at column 0. r0 stands at gd when the struct is read.
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"

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
    .equ blocks, 40 @ of 32 pixels that are left in a wide row
    .equ frame, 44

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
    strh.n r6, [r0, #2 * \at]
    lsrs r5, r3, #25
    lsls r5, r5, #1
    ldrh.n r5, [r4, r5]
    strh.n r5, [r1, #2 * \at]
1:  add r2, r8
    add r3, r9
    .endm
    .ifdef with_knee
    .equ pixel_bytes, 32
    function ph_small_knee
    .else
    .equ pixel_bytes, 22
    .ifdef with_blocks
    function ph_wide_gouraud
    .else
    function ph_small_gouraud
    .endif
    .endif
    @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    save_registers
    .ifdef with_knee
    ldr r4, [r0, #small_knee]
    .endif
    push {r4}
    ldmia r0!, {r4-r7}
    subs r2, r2, r1
    push {r0, r2}
    mov lr, r3
    ldrh r2, [r0, #small_upper_rows - small_gd]
    ldr r3, =last + 1
    push {r2, r3}
    mov r2, lr
    movs r3, #0
    push {r2, r3}
    push {r4-r7}
    subs r7, r1, r2 @ the row above
    subs r7, #64 @ the last of the 32 unrolled pixels is the last pixel of the row
    ldmia r0!, {r1-r4}
    mov r8, r1
    mov r9, r2
    mov r10, r4
    movs r4, r3
    ldmia r0!, {r1-r3}
    mov r11, r1
    mov r12, r2
    mov lr, r3
    b row
    .p2align 2
    .ltorg
first:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
    .if . - first - 32 * pixel_bytes
    .error "pixel_bytes is wrong"
    .endif
last:
    .ifdef with_blocks
    ldr r5, [sp, #blocks]
    subs r5, #1
    bmi row_end
    str r5, [sp, #blocks]
    adds r0, #64
    adds r1, #64
    b first
row_end:
    .endif
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    beq 2f
row:
    mov r0, sp
    ldmia r0, {r0-r3, r5}
    adds r7, r7, r5
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
    mov r0, r7
    .else
    lsrs r5, r5, #16
    lsrs r0, r0, #16
    subs r6, r0, r5
    ble last
    lsls r0, r0, #1
    adds r0, r0, r7
    .endif
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
    lsls r5, r5, #1
    adds r0, r0, r5
    subs r6, #1
    lsrs r5, r6, #5
    str r5, [sp, #blocks]
    lsls r6, r6, #27
    lsrs r6, r6, #27
    adds r6, #1 @ the first 1 to 32 pixels
    lsls r5, r6, #1
    adds r0, r0, r5
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
    ldrh r1, [r0, #small_lower_rows - small_gd]
    cmp r1, #0
    beq 5f
    str r1, [sp, #rows]
    movs r1, #0
    str r1, [sp, #triangle]
    ldr r1, [r0, #small_lower - small_gd]
    ldr r2, [r0, #small_lower - small_gd + 4]
    ldr r3, [r0, #small_lower_is_right - small_gd]
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
    .ifdef with_knee
    .size ph_small_knee, . - ph_small_knee
    .else
    .ifdef with_blocks
    .size ph_wide_gouraud, . - ph_wide_gouraud
    .else
    .size ph_small_gouraud, . - ph_small_gouraud
    .endif
    .endif
