@ ph_texture_tile (see texture_tile.h) for ARMv7-M. A pixel that is drawn takes 14.5 instructions, a hidden one 9.5, a
@ row 61 (21 more in a clamped texture), a call some 25.
@
@ Registers: r2 d, r3 gd, r4 u, r5 du, r6 u_mask, r7 v, r8 dv, r9 the struct ph_tile_rows, r10 v_mask, r11 texels,
@ r12 depth, lr pixels; r0 r1 scratch. The stack has the bends of u and v, the entries, and where a large texture's row ends.
#include "../thumb.inc"
#include "../offsets.inc"
#include "texels.inc"

    .macro down way @ steps the coefficients of u or v to the next row
    add lr, r9, #\way
    ldm lr, {r0, r1, r2, r4, r5, r7, r8, r12}
    add r0, r4
    add r1, r5
    add r2, r7
    add r4, r8
    add r5, r12
    stm lr, {r0, r1, r2, r4, r5}
    .endm

    .macro first_pixel @ u and v at column r0; r2 and r12 the bends, r5 the step of u
    ldrd r4, r5, [r9, #tile_u]
    ldr r2, [r9, #tile_u + way_bend]
    mla r8, r2, r0, r5
    mla r4, r8, r0, r4
    ldrd r7, r8, [r9, #tile_v]
    ldr r12, [r9, #tile_v + way_bend]
    mla r8, r12, r0, r8
    mla r7, r8, r0, r7
    .endm

    function ph_texture_tile, scenery @ r0: struct ph_tile_rows
    push {r4-r11, lr}
    sub sp, #20
    mov r9, r0
    adds r0, #texel_gd
    ldm r0, {r3, r6, r10, r11} @ gd, u_mask, v_mask, texels
    adr r0, entries
    usat r1, #1, r10, asr #16
    add r0, r0, r1, lsl #7 @ the other 64
    str r0, [sp, #8]
row:
    ldrd r0, r1, [r9, #texel_left]
    usat r0, #7, r0, asr #16
    usat r1, #7, r1, asr #16
    ldr r2, [r9, #tile_columns]
    cmp r1, r2
    it gt
    movgt r1, r2
    subs lr, r1, r0
    ble down_rows
    ldr r4, [r9, #tile_outside]
    cbz r4, 2f
    first_pixel
    subs r8, r1, #1 @ the last pixel, which is one bend off in a row of even length
    mla r5, r2, r8, r5
    ldr r1, [r9, #tile_u]
    mla r5, r5, r8, r1
    tst lr, #1
    it eq
    addeq r5, r2
    orrs r5, r4
    ldr r1, [r9, #tile_u_outside]
    ands r5, r1
    bne done
    ldrd r1, r5, [r9, #tile_v]
    mla r5, r12, r8, r5
    mla r5, r5, r8, r1
    tst lr, #1
    it eq
    addeq r5, r12
    orrs r5, r7
    ldr r1, [r9, #tile_v_outside]
    ands r5, r1
    bne done
    ldr r5, [r9, #tile_u + 4]
    adds r1, r8, #1
    b 3f
2:  first_pixel
3:  mvn r8, lr, lsl #31
    add r8, r0, r8, lsr #31
    lsl r8, r8, #1 @ pair
    mla r5, r2, r8, r5
    strd r2, r12, [sp]
    ldr r2, [r9, #tile_v + 4]
    mla r8, r12, r8, r2
    ldr r2, [r9, #texel_d]
    mla r2, r3, r0, r2
    ldr r0, [r9, #tile_count]
    add r0, lr
    str r0, [r9, #tile_count]
    rsb r0, lr, #64
    ldrd r12, lr, [r9, #texel_depth]
    add r12, r12, r1, lsl #1
    add lr, lr, r1, lsl #1
    ldr r1, [sp, #8]
    tbh [r1, r0, lsl #1]
entries:
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63
    .hword (pixel_\at - entries) / 2
    .endr
    .rept 64
    .hword (large - entries) / 2
    .endr
    .irp at, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63
    pixel \at, 64, r12, lr, r4, r5, r7, r8, r6, r10, r11, r0, r1
    .endr
    b down_rows
large:
    rsb r0, r0, #64
    large_row r0, 12, r12, lr, r4, r5, r7, r8, r6, r10, r11, r0, r1, down_rows
down_rows:
    down tile_u
    down tile_v
    ldm r9, {r0, r1, r2, r4, r5, r7, r8, r12, lr} @ left, right, d, left_dx, right_dx, d_dy, depth, pixels, stride
    add r0, r4
    add r1, r5
    add r2, r7
    add r8, lr
    add r12, lr
    stm r9, {r0-r2}
    strd r8, r12, [r9, #texel_depth]
    ldr r0, [r9, #texel_rows]
    subs r0, #1
    str r0, [r9, #texel_rows]
    bne row
done:
    add sp, #20
    pop {r4-r11, pc}
    .size ph_texture_tile, . - ph_texture_tile
