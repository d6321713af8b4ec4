@ ph_samples_gouraud of kernels.h for ARMv7-M. A row takes some 25 instructions, a sample that is drawn 9 or 10, a hidden one
@ 4 or 5, a call 18 to 40. As long as nothing is drawn where a row goes, two pixels' four samples take 21 together.
@
@ Registers: r0 column 0 of the row, r1 d there, and both scratch where samples are drawn; r2 d, r3 light, r4 gd, r5 glight,
@ r6 ramp, r7 depth, r8 pixels, r9 left, r10 right, whose bit 31 says that the row is the second one of its pixels, r11 scratch, r12 light at column 0, lr: rows that are left << 16 | number
@ of samples so far. The pointer `triangle` on the stack stands at gd.
#include "../thumb.inc"
#include "../offsets.inc"

    .equ base, 0 @ on the stack; a row loads these seven words at once
    .equ left_dx, 8 @ behind d at column 0
    .equ right_dx, 12 @ with bit 31 turned
    .equ light_dy, 20 @ from pixel to pixel
    .equ triangle, 28 @ 0 when the lower edge has taken over
    .equ to_pixels, 32 @ from depth
    .equ frame, 36

    .macro sample at
    ldrh r1, [r7, #2 * \at]
    cmp r1, r2, lsr #16
    bhs 1f
    lsrs r1, r2, #16
    strh r1, [r7, #2 * \at]
    lsrs r1, r3, #25
    ldrh r1, [r6, r1, lsl #1]
    strh r1, [r8, #2 * \at]
1:
    .endm

    .macro step at @ light stays within a pixel
    add r2, r4
    .if \at & 1
    add r3, r5
    .endif
    .endm

    .macro codes word, scratch @ of both samples of a pixel
    lsr \scratch, r2, #16
    add \word, r2, r4
    add r2, \word, r4
    bfi \word, \scratch, #0, #16
    .endm

    .macro colour word @ twice that of a pixel
    lsrs \word, r3, #25
    add r3, r5
    ldrh \word, [r6, \word, lsl #1]
    .endm

    .macro fresh at, scratch
    codes r1, \scratch
    str r1, [r7, #2 * \at]
    colour r1
    orr r1, r1, r1, lsl #16
    str r1, [r8, #2 * \at]
    .endm

    .macro pair at, next @ no code is 0: where both depths are 0, both samples are drawn
from_\at:
    ldr r1, [r7, #2 * \at]
    cbnz r1, 1f
    fresh \at, r0
    b from_\next
1:  b sample_\at
    .endm

    .macro pairs at @ `pair` for two pixels
from_\at:
    ldrd r0, r1, [r7, #2 * \at]
    orrs r0, r1
    bne sample_\at
    codes r1, r0
    codes r11, r0
    strd r1, r11, [r7, #2 * \at]
    colour r0
    colour r1
    orr r0, r0, r0, lsl #16
    orr r1, r1, r1, lsl #16
    strd r0, r1, [r8, #2 * \at]
    .endm

    .macro single at, next @ the second sample of the first pixel
from_\at:
    sample \at
    step \at
    b from_\next
    .endm

    .macro next_row
    ldmia sp, {r0-r3, r7, r8, r11} @ base, d at column 0, left_dx, right_dx, d_dy, light_dy, stride
    add r9, r2
    add r1, r7
    add r0, r11
    adds r10, r3
    it pl
    addpl r12, r8 @ the next row begins other pixels
    strd r0, r1, [sp, #base]
    subs lr, lr, #1 << 16
    bhs row
    .endm

    function ph_samples_gouraud, seldom @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    push {r4-r11, lr}
    ldmia r0!, {r4-r7}
    eor r5, r5, #1 << 31
    adds r7, #1 @ light is even, and a pixel's step
    subs r2, r2, r1
    push {r0, r2}
    push {r3}
    push {r4-r7}
    ldmia r0, {r4-r6, r9-r12}
    add r10, r10, r12, lsl #31
    bic r12, r12, #1
    ldrh lr, [r0, #small_upper_rows - small_gd]
    sub lr, lr, #1
    lsl lr, lr, #16
    sub r0, r1, #64 @ the last of the 32 unrolled samples is the last one of a whole pixel
    mov r1, r11
    push {r0, r1}
row:
    lsr r7, r9, #16
    ubfx r8, r10, #17, #10
    rsbs r11, r7, r8, lsl #1
    blt 3f
    add lr, lr, r11
    mla r2, r4, r7, r1
    lsrs r3, r7, #1
    mla r3, r5, r3, r12
    add r7, r0, r8, lsl #2
    ldr r8, [sp, #to_pixels]
    add r8, r8, r7
    tbh [pc, r11, lsl #1]
entries:
    .hword (last - entries) / 2
    .irp at, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
    .hword (from_\at - entries) / 2
    .endr
    .rept 34 @ a row has 64 samples at most, and one that edges are rounded to
    .hword (more - entries) / 2
    .endr
    .p2align 1
    .altmacro
    .set at, 1
    .rept 15
    single %at, %(at + 1)
    .set at, at + 2
    .endr
    .set at, 2
    .rept 7
    pair %at, %(at + 2)
    .set at, at + 4
    .endr
    pair 30, 32
    .set at, 0
    .rept 8
    pairs %at
    .set at, at + 4
    .endr
    .noaltmacro
from_32:
last:
    tst r10, #1 << 16
    bne 2f
3:  next_row
    b done
more: @ those before the last 32
    sub r0, r11, #32
    sub r7, r7, r0, lsl #1
    sub r8, r8, r0, lsl #1
    lsls r1, r0, #31
    bpl 4f
    sample 0
    step 1
    adds r7, #2
    add r8, r8, #2
    subs r0, #1
    beq from_0
4:  ldr r1, [r7]
    cbnz r1, 7f
    fresh 0, r11
5:  adds r7, #4
    add r8, r8, #4
    subs r0, #2
    bhi 4b
    b from_0
7:  sample 0
    step 0
    sample 1
    step 1
    b 5b
2:  add lr, lr, #1 @ the first sample of the last pixel
    sample 32
    next_row
    b done
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30
sample_\at:
    sample \at
    step \at
    .endr
from_31:
    sample 31
    step 31
    b last
done:
    ldr r7, [sp, #triangle]
    cbz r7, 5f
    ldrh r2, [r7, #small_lower_rows - small_gd]
    cbz r2, 5f
    add lr, lr, r2, lsl #16
    ldr r2, [r7, #small_lower_is_right - small_gd]
    ldrd r3, r8, [r7, #small_lower - small_gd]
    cbz r2, 3f
    ldr r12, [r7, #small_light - small_gd] @ behind its last row the edge may go anywhere, and so may its bit and light
    ldrh r2, [r7, #small_upper_rows - small_gd]
    and r10, r12, #1
    bic r12, r12, #1
    add r2, r10
    add r10, r3, r2, lsl #31
    ldr r3, [sp, #light_dy]
    lsrs r2, r2, #1
    mla r12, r2, r3, r12
    eor r8, r8, #1 << 31
    str r8, [sp, #right_dx]
    b 4f
3:  mov r9, r3
    str r8, [sp, #left_dx]
4:  movs r7, #0
    str r7, [sp, #triangle]
    b row
5:  uxth r0, lr
    add sp, sp, #frame
    pop {r4-r11, pc}
    .size ph_samples_gouraud, . - ph_samples_gouraud
