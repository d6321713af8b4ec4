@ ph_texel_run_rows and ph_texel_run_rows_lit (see texture_small.h) for ARMv6-M. A row takes 123 instructions beside those of
@ its kernel; with light alone 95, and 29 more if the light changes.
@
@ Registers: r7 first column, r8 the struct ph_texel_run, r9 the struct ph_texel_row, r10 pixels so far, r11 r12 lr
@ scratch: lr first column, r12 its pair (see texture_tile.h).
#include "../thumb.inc"
#include "../offsets.inc"
#include "registers.inc"
#include "texel_lit.inc"
#include "texel_line.inc"

    @ on the stack of rows with light alone, behind what ph_texel_lit_pixels needs
    .equ self, lit_frame @ the struct ph_texel_run
    .equ row_of, lit_frame + 4
    .equ apart, lit_frame + 8   @ from depth to pixels
    .equ stride, lit_frame + 12
    .equ below, lit_frame + 16  @ depth of column 0 of the next row
    .equ rows, lit_frame + 20
    .equ count, lit_frame + 24
    .equ from, lit_frame + 28   @ of the row: first column, pair, and r0, r2, r3, r5
    .equ pair, lit_frame + 32
    .equ row_depth, lit_frame + 36
    .equ row_d, lit_frame + 40
    .equ lit_u, lit_frame + 44
    .equ entry, lit_frame + 48
    .equ mask2, lit_frame + 52  @ v_mask times 2
    .equ varies, lit_frame + 56 @ whether light does
    .equ frame, lit_frame + 60

    .macro line to @ u or v at r0 at the first column
    ldmia r0!, {r1-r6} @ at, step, at_dy, step_dy, at_ddy, bend
    mov r7, r12
    muls r7, r6
    adds r7, r7, r2
    mov r11, r7
    mov r7, lr
    muls r6, r7
    adds r6, r6, r2
    muls r6, r7
    adds r6, r6, r1
    line_down
    mov r1, r9
    str r6, [r1, #\to]
    mov r2, r11
    str r2, [r1, #\to + 4]
    .endm

    function ph_texel_run_rows @ r0: struct ph_texel_run, r1: struct ph_texel_row
    save_registers
    movs r2, #0
any: @ r2 pixels so far
    mov r8, r0
    mov r9, r1
    mov r10, r2
    adds r0, #run_draw
    ldr r0, [r0]
    push {r0}
row:
    mov r0, r8
    ldmia r0!, {r1-r6} @ left, right, d, left_dx, right_dx, d_dy
    asrs r7, r1, #16
    adds r1, r1, r4
    asrs r4, r2, #16
    adds r2, r2, r5
    adds r6, r6, r3
    subs r0, #24
    stmia r0!, {r1, r2, r6}
    adds r0, #texel_depth - 12
    ldmia r0!, {r1, r2, r5} @ depth, pixels, stride
    subs r0, #12
    adds r6, r2, r5
    adds r5, r1, r5
    stmia r0!, {r5, r6}
    ldr r5, [r0, #texel_light - texel_stride]
    ldr r6, [r0, #texel_light + 4 - texel_stride]
    adds r6, r6, r5
    str r6, [r0, #texel_light - texel_stride]
    subs r4, r4, r7
    ble empty
    add r10, r4
    lsls r6, r7, #1
    adds r1, r1, r6
    adds r2, r2, r6
    ldr r6, [r0, #texel_gd - texel_stride]
    muls r6, r7
    adds r6, r6, r3
    mov r3, r9
    stmia r3!, {r1, r2, r4, r6} @ depth, pixels, n, d
    ldr r6, [r0, #texel_glight - texel_stride]
    movs r1, r6
    muls r1, r7
    adds r5, r5, r1 @ the first light
    subs r1, r4, #1
    movs r2, r1
    muls r2, r6
    adds r2, r2, r5 @ and the last
    movs r0, #33
    lsls r0, r0, #24
    cmp r5, r0
    bhs shining
    cmp r2, r0
    bhs shining
    asrs r0, r6, #1
    movs r2, #3
    ands r1, r2
    movs r2, r0
    muls r2, r1
    adds r2, r2, r5
    lsrs r2, r2, #24
    adds r1, #2
    muls r1, r6
    adds r5, r5, r1
    adds r5, r5, r0
1:  str r2, [r3, #row_level - 16]
    str r5, [r3, #row_light - 16]
    movs r1, #1
    bics r1, r4
    adds r1, r1, r7
    lsls r1, r1, #1
    mov r12, r1
    mov lr, r7
    mov r0, r8
    adds r0, #run_u
    line row_u
    adds r0, #run_v - run_u - 12
    line row_v
    mov r0, r9
    ldr r4, [r0, #row_level]
    adds r4, #1
    beq 2f
    ldr r1, [sp]
    blx r1
2:  mov r0, r8
    adds r0, #texel_rows
    ldr r1, [r0]
    subs r1, #1
    str r1, [r0]
    beq 3f
    cmp r4, #0
    bne row
3:  mov r0, r10
    pop {r1}
    restore_and_return
shining:
    movs r2, #0
    mvns r2, r2
    b 1b
empty:
    mov r0, r8
    adds r0, #run_u
    ldmia r0!, {r1-r5}
    adds r0, #4
    line_down
    adds r0, #run_v - run_u - 12
    ldmia r0!, {r1-r5}
    adds r0, #4
    line_down
    movs r4, #1
    b 2b
    .size ph_texel_run_rows, . - ph_texel_run_rows

    @ The light of a row and all that its pixels need stay on the stack.
    function ph_texel_run_rows_lit @ r0: struct ph_texel_run, r1: struct ph_texel_row
    save_registers
    sub sp, #frame
    str r0, [sp, #self]
    str r1, [sp, #row_of]
    movs r1, #0
    str r1, [sp, #count]
    adr r1, lit_back
    adds r1, #1
    str r1, [sp, #back]
    run_begin
    str r1, [sp, #below]
    ldmia r0!, {r1, r2} @ texels, rows
    mov r11, r1
    str r2, [sp, #rows]
    ldr r1, entries_here
    lsrs r6, r6, #17 @ v_mask
    beq 1f
    adds r1, #8
1:  str r1, [sp, #table]
    ldmia r0!, {r1-r3} @ light, light_dy, glight
    str r1, [sp, #light]
    lsrs r4, r1, #24
    str r4, [sp, #level]
    lsls r4, r3, #2
    str r4, [sp, #step]
    orrs r2, r3
    movs r4, #33
    lsls r4, r4, #24
    cmp r1, r4
    blo 1f
    movs r2, #1 @ it is looked at in each row
1:  str r2, [sp, #varies]
lit_row:
    ldr r0, [sp, #self]
    ldr r1, [sp, #varies]
    cmp r1, #0
    bne set_light
set:
    row_ends
    ble lit_empty
    str r7, [sp, #from]
    lsls r4, r4, #1
    adds r4, r4, r1
    str r4, [sp, #end]
    ldr r5, [sp, #count]
    adds r5, r5, r3
    str r5, [sp, #count]
    subs r5, r3, #1
    movs r2, #3
    bics r2, r5
    lsls r2, r2, #1
    str r2, [sp, #entry]
    lsls r5, r7, #1
    adds r1, r1, r5
    subs r1, r1, r2
    str r1, [sp, #row_depth]
    row_pair
    line_at r9
    str r6, [sp, #lit_u]
    adds r0, #12
    line_at r10
    movs r4, r6
    ldr r0, [sp, #row_depth]
    ldr r1, [sp, #apart]
    adds r1, r1, r0
    ldr r2, [sp, #row_d]
    ldr r3, [sp, #lit_u]
    ldr r5, [sp, #entry]
    ldr r7, [sp, #mask2]
    ldr r6, pixels_here
    bx r6
lit_empty:
    lines_down
    .p2align 2
lit_back:
    ldr r0, [sp, #rows]
    subs r0, #1
    str r0, [sp, #rows]
    bne lit_row
    bl store_lit
    ldr r0, [sp, #count]
    add sp, #frame
    restore_and_return
pixels_here:
    .word ph_texel_lit_pixels
entries_here:
    .word ph_texel_lit_entries
store_lit: @ what the caller finds of the rows
    ldr r0, [sp, #self]
    adds r0, #texel_depth
    ldr r1, [sp, #below]
    ldr r2, [sp, #apart]
    adds r2, r2, r1
    stmia r0!, {r1, r2}
    ldr r1, [sp, #rows]
    str r1, [r0, #texel_rows - texel_stride]
    bx lr
set_light: @ of the row's first four, and of the next
    ldr r1, [r0]
    ldr r2, [r0, #4]
    asrs r1, r1, #16
    asrs r2, r2, #16
    subs r2, r2, r1
    adds r0, #texel_light
    ldmia r0!, {r3, r5, r6} @ light, light_dy, glight
    adds r5, r5, r3
    subs r2, #1
    bmi 1f @ no pixels
    muls r1, r6
    adds r3, r3, r1 @ the first light
    movs r1, r2
    muls r1, r6
    adds r1, r1, r3 @ and the last
    movs r4, #33
    lsls r4, r4, #24
    cmp r3, r4
    bhs lit_shining
    cmp r1, r4
    bhs lit_shining
    asrs r4, r6, #1
    movs r1, #3
    ands r1, r2
    movs r2, r4
    muls r2, r1
    adds r2, r2, r3
    lsrs r2, r2, #24
    str r2, [sp, #level]
    adds r1, #2
    muls r1, r6
    adds r1, r1, r3
    adds r1, r1, r4
    str r1, [sp, #light]
1:  subs r0, #12
    str r5, [r0]
    subs r0, #texel_light
    b set
lit_shining: @ this row and the next ones are drawn as at `any`
    bl store_lit
    ldr r0, [sp, #self]
    ldr r1, [sp, #row_of]
    ldr r2, [sp, #count]
    add sp, #frame
    ldr r3, any_here
    bx r3
    .p2align 2
any_here:
    .word any + 1
    .size ph_texel_run_rows_lit, . - ph_texel_run_rows_lit
