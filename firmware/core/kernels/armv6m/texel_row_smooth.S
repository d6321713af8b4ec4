@ ph_texel_row_smooth of texel_row.h: bilinear texels as they are. texel_smooth.inc has its loop.
#include "texel_smooth.inc"

    smooth_row ph_texel_row_smooth, 0

    @ Four texels round the border of a texture that repeats: r0 to r2 masks and width, r3 u, r4 v, r5 offset of the
    @ column to the right, r7 where the texels are. It returns a, b, c, d in r5, r6, r0, r1, and halves in lr; r2 is lost.
    @ Meanwhile v lies on the stack in place of r7, which is what sp was before the pixel.
    function ph_texel_border
    str r4, [sp, #16]
    lsrs r6, r4, #22
    muls r6, r2
    ands r6, r1
    subs r3, r5, #2
    ands r3, r0
    subs r4, r6, r2
    ands r4, r1
    ldr r1, [r7, #4]
    adds r7, #8
    adds r2, r2, r1
    adds r4, r4, r2
    adds r6, r6, r2
    ldrh r0, [r6, r3]
    ldrh r1, [r6, r5]
    ldrh r6, [r4, r5]
    ldrh r5, [r4, r3]
    ldr r2, 1f
    mov r3, lr
    mov lr, r2
    mov r2, r3
    ldr r3, [sp, #16]
    add r4, sp, #20
    str r4, [sp, #16]
    movs r4, r3
    ldr r3, [sp, #12] @ as the pixel saved it
    bx r2
    .p2align 2
1:  .word halves
    .size ph_texel_border, . - ph_texel_border
