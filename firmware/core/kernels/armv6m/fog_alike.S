@ ph_fog_alike of kernels.h for ARMv6-M. A pixel takes 5 instructions where no fog is, and 14 else.
@
@ Registers, first: r1 the end of the codes, r5 a code further, r2 -2 times the codes left, r3 from, r4 size; r6 scratch;
@ r7 n, then the result; r12 pixels. Then: r0 pixels, r1 their end, r2 - r5 as fog_pairs takes them; r6 r7 scratch; r12
@ pixels left
#include "../thumb.inc"

    function ph_fog_alike @ r0: pixels, r1: codes, r2: n, r3: from; stack: size, mix
    push {r4-r7, lr}
    mov r12, r0
    ldr r4, [sp, #20]
    movs r7, r2
    lsls r2, r2, #1
    beq 8f
    adds r1, r2
    adds r5, r1, #2
    rsbs r2, r2, #0
    lsls r6, r2, #30
    bpl 2f
    subs r2, #2 @ an odd one comes first, as the second of two
    b 3f
2:  ldrh r6, [r1, r2]
    subs r6, r3
    cmp r6, r4
    bhs 8f
3:  ldrh r6, [r5, r2]
    subs r6, r3
    cmp r6, r4
    bhs 7f
    adds r2, #4
    bmi 2b
    b 8f
7:  adds r2, #2
8:  asrs r2, r2, #1
    adds r7, r2
    push {r7}
    ldr r5, [sp, #28]
    beq 9f
    cmp r5, #0
    beq 9f
    ldr r3, channels
    ldmia r5, {r2, r4, r5}
    mov r0, r12
    mov r12, r7
    lsls r6, r0, #30
    bpl 4f
    bl fog_pixel
4:  mov r1, r12
    lsrs r1, r1, #1
    beq 5f
    lsls r1, r1, #2
    adds r1, r0
    bl fog_pairs
5:  mov r7, r12
    lsls r7, r7, #31
    bpl 9f
    bl fog_pixel
9:  pop {r0}
    pop {r4-r7, pc}

fog_pixel: @ fogs the pixel at r0, as the first one of a pair
    mov r1, r12
    subs r1, #1
    mov r12, r1
    ldrh r6, [r0]
    push {r0, r6, lr}
    add r0, sp, #4
    adds r1, r0, #4
    bl fog_pairs
    pop {r0, r6, r7}
    strh r6, [r0]
    adds r0, #2
    bx r7

fog_pairs: @ fogs pairs from r0 to r1; r2: rest, r3: PH_SPREAD, r4: spread, r5: others
    ldr r6, [r0]
    rev16 r6, r6
    movs r7, r6
    ands r7, r3
    muls r7, r2
    adds r7, r4
    lsrs r7, r7, #5
    ands r7, r3
    bics r6, r3
    lsrs r6, r6, #5
    muls r6, r2
    adds r6, r5
    bics r6, r3
    orrs r6, r7
    rev16 r6, r6
    stmia r0!, {r6}
    cmp r0, r1
    bne fog_pairs
    bx lr
    .p2align 2
channels:
    .word 0x07e0f81f
    .size ph_fog_alike, . - ph_fog_alike
