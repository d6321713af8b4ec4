@ See texel_row.h and texel_smooth.inc.
#include "texel_smooth.inc"

    smooth_row ph_texel_row_smooth, 0

    @ Four texels round the border of a texture that repeats: r0 to r2 masks and width, r3 u, r4 v, r5 offset of the
    @ column to the right. It returns a, b, c, d in r0, r1, r5, r6, and halves in lr; r2 is lost.
    function ph_texel_border
    push {r4}
    lsrs r6, r4, #22
    muls r6, r2
    ands r6, r1
    subs r3, r5, #2
    ands r3, r0
    subs r4, r6, r2
    ands r4, r1
    add r2, r11
    adds r2, #2
    adds r4, r4, r2
    adds r6, r6, r2
    ldrh r0, [r4, r3]
    ldrh r1, [r4, r5]
    ldrh r2, [r6, r3]
    ldrh r6, [r6, r5]
    movs r5, r2
    ldr r2, 1f
    mov r4, lr
    mov lr, r2
    mov r2, r4
    pop {r4}
    ldr r3, [sp, #12] @ as the pixel saved it
    bx r2
    .p2align 2
1:  .word halves
    .size ph_texel_border, . - ph_texel_border
