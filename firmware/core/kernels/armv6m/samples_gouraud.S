@ ph_samples_gouraud of kernels.h for ARMv6-M. A row takes some 50 instructions, a sample that is drawn 10 or 11, a hidden
@ one 5 or 6, a call some 40. As long as nothing is drawn where a row goes, a pixel's two samples take 15 together.
@
@ Registers: r0 depth, r1 pixels, r2 d, r3 light, r4 ramp, r5 r6 scratch, r7 depth of column 0, plus 1 if the row ends with
@ the first sample of a pixel, plus 2 before its last 32 samples; r8 gd, r9 glight, r10 left, r11 right, r12 d at
@ column 0, lr light at column 0.
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
    .equ pairs_end, 28 @ address in the code where the whole pixels of a row end
    .equ triangle, 32  @ 0 when the lower edge has taken over
    .equ to_pixels, 36 @ from depth
    .equ pairs, 40     @ whole pixels of a row, while a sample before them is drawn
    .equ frame, 44
    .equ pair_bytes, 30

    .macro sample at
    ldrh.n r5, [r0, #2 * \at]
    lsrs r6, r2, #16
    cmp r6, r5
    bls.n 1f
    strh.n r6, [r0, #2 * \at]
    lsrs r5, r3, #25
    lsls r5, r5, #1
    ldrh.n r5, [r4, r5]
    strh.n r5, [r1, #2 * \at]
1:
    .endm

    .macro pair at, second @ no code is 0: where both depths are 0, both samples are drawn
    ldr.n r5, [r0, #2 * \at]
    cmp.n r5, #0
    bne.n from_\at
    lsrs r5, r2, #16
    strh.n r5, [r0, #2 * \at]
    add r2, r8
    lsrs r5, r2, #16
    strh.n r5, [r0, #2 * \second]
    add r2, r8
    lsrs r5, r3, #25
    lsls r5, r5, #1
    ldrh.n r5, [r4, r5]
    strh.n r5, [r1, #2 * \at]
    strh.n r5, [r1, #2 * \second]
    add r3, r9
    .endm

    .macro both at, second @ light stays within a pixel
sample_\at:
    sample \at
    add r2, r8
    sample \second
    add r2, r8
    add r3, r9
    .endm

    function ph_samples_gouraud, seldom @ r0: struct ph_small_triangle, r1: depth, r2: pixels, r3: bytes from row to row
    save_registers
    subs r2, r2, r1
    push {r4}
    push {r0, r2}
    movs r4, #0
    ldrh r5, [r0, #small_upper_rows]
    ldr r6, =first + 16 * pair_bytes + 1
    push {r3-r6}
    subs r1, r1, r3 @ the row above
    subs r1, #64 @ the last of the unrolled samples is the last one of a whole pixel
    ldmia r0!, {r4-r7}
    push {r4-r7}
    movs r7, r1
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
    .irp at, 0, 2, 4, 6, 8, 10, 12, 14
from_\at:
    b.n sample_\at
    .endr
first:
    .altmacro
    .set at, 0
    .rept 16
    pair %at, %(at + 1)
    .set at, at + 2
    .endr
    .noaltmacro
    .if . - first - 16 * pair_bytes
    .error "pair_bytes is wrong"
    .endif
whole:
    lsls r5, r7, #30
    beq row_end
    b last
    .irp at, 16, 18, 20, 22, 24, 26, 28, 30
from_\at:
    b.n sample_\at
    .endr
last:
    adds r0, #64
    adds r1, #64
    lsrs r5, r7, #2
    bcs more
    subs r7, #1
    sample 0
row_end:
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    bne row
    ldr r0, [sp, #triangle]
    cmp r0, #0
    beq 9f
    ldrh r1, [r0, #small_lower_rows]
    cmp r1, #0
    beq 9f
    str r1, [sp, #rows]
    movs r1, #0
    str r1, [sp, #triangle]
    ldr r1, [r0, #small_lower]
    ldr r2, [r0, #small_lower + 4]
    ldr r3, [r0, #small_lower_is_right]
    cmp r3, #0
    beq 7f
    mov r11, r1
    str r2, [sp, #right_dx]
    b row
7:  mov r10, r1
    str r2, [sp, #left_dx]
    b row
9:  ldr r0, [sp, #count]
    add sp, #frame
    restore_and_return
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
    lsrs r6, r2, #1 @ light stays from an even row to the odd one
    bcs 1f
    movs r3, #1
1:  add lr, r3
    lsrs r5, r5, #16
    lsrs r0, r0, #16
    subs r6, r0, r5
    ble row_end
    ldr r3, [sp, #count]
    adds r3, r3, r6
    str r3, [sp, #count]
    lsrs r0, r0, #1
    bcs 3f
    lsls r0, r0, #2
    adds r0, r0, r7
10: mov r3, r8
    muls r3, r5
    adds r1, r1, r3
    lsrs r5, r5, #1
    mov r3, r9
    muls r3, r5
    adds r3, r3, r2
    mov r2, r1
    ldr r1, [sp, #to_pixels]
    adds r1, r1, r0
    cmp r6, #32
    bhi 8f
4:  lsrs r6, r6, #1
    bcs 5f
6:  movs r5, #pair_bytes
    muls r6, r5
    ldr r5, [sp, #pairs_end]
    subs r5, r5, r6
    bx r5 @ jump to as many pairs before the end as there are
3:  subs r6, #1
    lsls r0, r0, #2
    adds r0, r0, r7
    adds r7, #1
    b 10b
8:  subs r6, #32 @ first those before the last 32
    subs r0, #64
    subs r1, #64
    adds r7, #2
    b 4b
more:
    subs r7, #2
    ldr r5, [sp, #pairs_end]
    subs r5, #16 * pair_bytes / 2
    subs r5, #16 * pair_bytes / 2
    bx r5
5:  str r6, [sp, #pairs] @ the second sample of the first pixel
    lsls r6, r6, #2
    subs r0, r0, r6
    subs r1, r1, r6
    sample 31
    add r2, r8
    add r3, r9
    ldr r6, [sp, #pairs]
    lsls r5, r6, #2
    adds r0, r0, r5
    adds r1, r1, r5
    b 6b
    .altmacro
    .set at, 0
    .rept 16
    both %at, %(at + 1)
    .set at, at + 2
    .endr
    .noaltmacro
    b whole
    .size ph_samples_gouraud, . - ph_samples_gouraud
