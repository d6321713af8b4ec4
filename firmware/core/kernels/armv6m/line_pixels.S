@ ph_line_pixels of kernels.h for ARMv6-M. A pixel that is drawn takes 15 instructions, a hidden one 11.
@
@ Registers: r1 depth where the place across is 0, r4 place across, r5 d, r6 stride; r8 slope, r9 gd, r10 forward, r11 colour,
@ r12 from depth to pixels, lr end of depth; r0 r3 r7 scratch. Strides and distances are in bytes here.
#include "../thumb.inc"
#include "registers.inc"

    function ph_line_pixels, loop @ r0: run, r1: pixels, r2: depth, r3: n
    save_registers
    subs r1, r2
    mov r12, r1
    ldmia r0!, {r4-r7}
    lsls r6, r6, #1
    mov r8, r4
    mov r9, r5
    mov r10, r6
    mov r11, r7
    muls r3, r6
    adds r3, r2
    mov lr, r3
    movs r1, r2
    ldmia r0!, {r4-r6}
    lsls r6, r6, #1
pixel:
    asrs r0, r4, #16
    muls r0, r6
    ldrh r7, [r1, r0]
    lsrs r3, r5, #16
    cmp r3, r7
    bls 1f
    strh r3, [r1, r0]
    add r0, r12
    mov r7, r11
    strh r7, [r1, r0]
1:  add r4, r8
    add r5, r9
    add r1, r10
    cmp r1, lr
    bne pixel
    restore_and_return
    .size ph_line_pixels, . - ph_line_pixels
