@ ph_small_gouraud of kernels.h for ARMv7-M; small_knee.S makes ph_small_knee of it,
@ wide_gouraud.S ph_wide_gouraud. A row takes 23 instructions, a pixel that is drawn 10, a hidden one 6, a
@ call 15 to 30.
@
@ Registers: r0 r1 scratch, r2 d, r3 light, r4 gd, r5 glight, r6 ramp, r7 depth, r8 pixels, r9 left, r10 right, r11 d at
@ column 0, r12 light at column 0, lr: rows that are left << 16 | number of pixels so far. The pointer `triangle` on the
@ stack stands at gd.
#include "../thumb.inc"
#include "../offsets.inc"

    .equ left_dx, 0 @ on the stack
    .equ right_dx, 4
    .equ d_dy, 8
    .equ triangle, 16 @ 0 when the lower edge has taken over
    .equ to_pixels, 20 @ from depth
    .equ stride, 24
    .equ knee, 28
    .equ blocks, 28 @ of 32 pixels that are left in a wide row
    .equ base, 32 @ column 0 of a wide row
    .equ frame, 36

    .macro pixel at
pixel_\at:
    ldrh r1, [r7, #2 * \at]
    .ifdef with_knee
    ldr r0, [sp, #knee]
    subs r0, r2, r0
    it hs
    movhs r0, #0
    add r0, r2
    lsrs r0, r0, #16
    .else
    lsrs r0, r2, #16
    .endif
    cmp r0, r1
    bls 1f
    strh r0, [r7, #2 * \at]
    lsrs r0, r3, #25
    ldrh r0, [r6, r0, lsl #1]
    strh r0, [r8, #2 * \at]
1:  add r2, r4
    add r3, r5
    .endm

    .ifdef with_knee
    function ph_small_knee
    .else
    .ifdef with_blocks
    function ph_wide_gouraud
    .else
    function ph_small_gouraud
    .endif
    .endif
    @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    push {r4-r11, lr}
    .ifdef with_knee
    ldr r4, [r0, #small_knee]
    .endif
    push {r4, r5}
    ldmia r0!, {r4-r7}
    subs r2, r2, r1
    push {r0, r2, r3}
    push {r4-r7}
    ldmia r0, {r4-r6, r9-r12}
    sub r7, r1, #64 @ the last of the 32 unrolled pixels is the last pixel of the row
    ldrh lr, [r0, #small_upper_rows - small_gd]
    sub lr, lr, #1
    lsl lr, lr, #16
row:
    .ifdef with_blocks
    asrs r0, r9, #16 @ cut to the picture
    bic r0, r0, r0, asr #31
    ldr r8, [sp, #stride]
    asr r1, r10, #16
    cmp r1, r8, lsr #1
    it gt
    lsrgt r1, r8, #1
    str r7, [sp, #base]
    subs r1, r1, r0
    ble 3f
    .else
    lsr r0, r9, #16
    lsr r1, r10, #16
    add r7, r7, r1, lsl #1
    subs r1, r1, r0
    ble 2f
    .endif
    mla r2, r4, r0, r11
    mla r3, r5, r0, r12
    ldr r8, [sp, #to_pixels]
    add lr, lr, r1
    .ifdef with_blocks
    add r7, r7, r0, lsl #1
    subs r1, #1
    lsrs r0, r1, #5
    str r0, [sp, #blocks]
    and r1, r1, #31
    adds r1, #1 @ the first 1 to 32 pixels
    add r7, r7, r1, lsl #1
    .endif
    add r8, r8, r7
    tbh [pc, r1, lsl #1]
entries:
    .hword 0 @ not used: a row without pixels is skipped
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword (pixel_\at - entries) / 2
    .endr
    .p2align 1
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
    pixel \at
    .endr
2:
    .ifdef with_blocks
    ldr r0, [sp, #blocks]
    subs r0, #1
    bmi 3f
    str r0, [sp, #blocks]
    adds r7, #64
    add r8, r8, #64
    b pixel_0
3:  ldr r7, [sp, #base]
    .endif
    ldrd r0, r1, [sp, #left_dx]
    .ifndef with_blocks
    lsr r8, r10, #16
    .endif
    add r9, r9, r0
    add r10, r10, r1
    ldrd r0, r1, [sp, #d_dy]
    add r11, r11, r0
    add r12, r12, r1
    ldr r0, [sp, #stride]
    .ifndef with_blocks
    sub r7, r7, r8, lsl #1
    .endif
    add r7, r7, r0
    subs lr, lr, #1 << 16
    bhs row
    ldr r0, [sp, #triangle]
    cbz r0, 5f
    ldrh r1, [r0, #small_lower_rows - small_gd]
    cbz r1, 5f
    add lr, lr, r1, lsl #16
    ldr r2, [r0, #small_lower_is_right - small_gd]
    ldrd r0, r1, [r0, #small_lower - small_gd]
    cbz r2, 3f
    mov r10, r0
    str r1, [sp, #right_dx]
    b 4f
3:  mov r9, r0
    str r1, [sp, #left_dx]
4:  movs r0, #0
    str r0, [sp, #triangle]
    b row
5:  uxth r0, lr
    add sp, sp, #frame
    pop {r4-r11, pc}
    .ifdef with_knee
    .size ph_small_knee, . - ph_small_knee
    .else
    .ifdef with_blocks
    .size ph_wide_gouraud, . - ph_wide_gouraud
    .else
    .size ph_small_gouraud, . - ph_small_gouraud
    .endif
    .endif
