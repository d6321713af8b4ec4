@ ph_small_gouraud of kernels.h for ARMv7-M; small_knee.S makes ph_small_knee of it,
@ long_gouraud.S ph_long_gouraud. A row takes 18 instructions, a pixel that is drawn 10, a hidden one 5, a
@ call 15 to 30. As long as nothing is drawn where a row goes, its pixels come in pairs, of 17 instructions.
@
@ Registers: r0 column 0 of the row; long rows: blocks of 32 pixels that are left; with a knee: scratch, r1 scratch, r2 d,
@ r3 light, r4 gd, r5 glight, r6 ramp, r7 depth, r8 pixels, r9 left, r10 right, r11 d at column 0, r12 light at
@ column 0, lr: rows that are left << 16 | number of pixels so far. The pointer `triangle` on the stack stands at gd.
#include "../thumb.inc"
#include "../offsets.inc"

#ifndef NAME
#define NAME ph_small_gouraud
#define TIER loop
#endif
#ifndef LIGHT_DOWN
#define LIGHT_DOWN 25
#endif

    .equ left_dx, 0 @ on the stack
    .equ right_dx, 4
    .equ d_dy, 8
    .equ light_dy, 12
    .equ stride, 16 @ a row loads these five words at once
    .equ triangle, 20 @ 0 when the lower edge has taken over
    .equ to_pixels, 24 @ from depth
    .equ knee, 28
    .equ base, 32 @ column 0 of a row, where r0 has something else
    .equ frame, 36
    .ifdef with_knee
    .equ base_is_kept, 1
    .endif
    .ifdef with_blocks
    .equ base_is_kept, 1
    .endif

    .macro colour at
    lsrs r1, r3, #LIGHT_DOWN
    ldrh r1, [r6, r1, lsl #1]
    strh r1, [r8, #2 * \at]
    .endm

    .macro step at @ the last pixel of a row needs no step, unless a block follows
    .ifdef with_blocks
    .equ steps, 1
    .else
    .equ steps, 31 - \at
    .endif
    .if steps
    add r2, r4
    add r3, r5
    .endif
    .endm

    .macro pixel at
    ldrh r1, [r7, #2 * \at]
    .ifdef with_knee
    ldr r0, [sp, #knee]
    subs r0, r2, r0
    it hs
    movhs r0, #0
    add r0, r2
    lsrs r0, r0, #16
    cmp r0, r1
    bls 1f
    strh r0, [r7, #2 * \at]
    .else
    cmp r1, r2, lsr #16
    bhs 1f
    lsrs r1, r2, #16
    strh r1, [r7, #2 * \at]
    .endif
    colour \at
1:  step \at
    .endm

    .macro fresh at
    lsrs r1, r2, #16
    strh r1, [r7, #2 * \at]
    colour \at
    step \at
    .endm

    .macro pair at, second @ no code is 0: where both depths are 0, both pixels are drawn
from_\at:
    ldr r1, [r7, #2 * \at] @ its address is even, at least
    cmp r1, #0
    bne pixel_\at
    fresh \at
    fresh \second
    .endm

    .macro single at, next @ the first of an odd number
from_\at:
    pixel \at
    b from_\next
    .endm

    .macro step_row
    .ifdef base_is_kept
    ldr r0, [sp, #base]
    .endif
    ldmia sp, {r1-r3, r7, r8}
    add r9, r1
    add r10, r2
    add r11, r3
    add r12, r7
    add r0, r8
    subs lr, lr, #1 << 16
    bhs row
    .endm

    function NAME, TIER
    @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    push {r4-r11, lr}
    .ifdef with_knee
    ldr r4, [r0, #small_knee]
    .endif
    push {r4, r5}
    ldmia r0!, {r4-r7}
    subs r2, r2, r1
    push {r0, r2}
    push {r3}
    push {r4-r7}
    ldmia r0, {r4-r6, r9-r12}
    ldrh lr, [r0, #small_upper_rows - small_gd]
    sub lr, lr, #1
    lsl lr, lr, #16
    sub r0, r1, #64 @ the last of the 32 unrolled pixels is the last pixel of the row
row:
    .ifdef base_is_kept
    str r0, [sp, #base]
    .endif
    .ifdef with_blocks
    mov r7, r0
    usat r0, #15, r9, asr #16 @ cut to the picture
    ldr r8, [sp, #stride]
    asr r1, r10, #16
    cmp r1, r8, lsr #1
    it gt
    lsrgt r1, r8, #1
    subs r1, r1, r0
    ble 3f
    add r7, r7, r0, lsl #1
    mla r2, r4, r0, r11
    mla r3, r5, r0, r12
    add lr, lr, r1
    subs r1, #1
    lsrs r0, r1, #5
    and r1, r1, #31
    adds r1, #1 @ the first 1 to 32 pixels
    add r7, r7, r1, lsl #1
    .else
    lsr r8, r9, #16
    lsr r1, r10, #16
    add r7, r0, r1, lsl #1
    subs r1, r1, r8
    ble 2f
    mla r2, r4, r8, r11
    mla r3, r5, r8, r12
    add lr, lr, r1
    .endif
    ldr r8, [sp, #to_pixels]
    add r8, r8, r7
    tbh [pc, r1, lsl #1]
entries:
    .hword 0 @ not used: a row without pixels is skipped
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword (from_\at - entries) / 2
    .endr
    .p2align 1
    .ifdef with_knee
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
from_\at:
    pixel \at
    .endr
    .else
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30
pixel_\at:
    pixel \at
    .endr
from_31:
    pixel 31
    .ifdef with_blocks
    b 2f
    .else
    step_row
    b done
    .endif
    .altmacro
    .set at, 1
    .rept 15
    single %at, %(at + 1)
    .set at, at + 2
    .endr
    .set at, 0
    .rept 16
    pair %at, %(at + 1)
    .set at, at + 2
    .endr
    .noaltmacro
    .endif
2:
    .ifdef with_blocks
    subs r0, #1
    bmi 3f
    adds r7, #64
    add r8, r8, #64
    b from_0
3:
    .endif
    step_row
done:
    ldr r7, [sp, #triangle]
    cbz r7, 5f
    ldrh r1, [r7, #small_lower_rows - small_gd]
    cbz r1, 5f
    add lr, lr, r1, lsl #16
    ldr r2, [r7, #small_lower_is_right - small_gd]
    ldrd r3, r1, [r7, #small_lower - small_gd]
    cbz r2, 3f
    mov r10, r3
    str r1, [sp, #right_dx]
    b 4f
3:  mov r9, r3
    str r1, [sp, #left_dx]
4:  movs r7, #0
    str r7, [sp, #triangle]
    b row
5:  uxth r0, lr
    add sp, sp, #frame
    pop {r4-r11, pc}
    .size NAME, . - NAME
