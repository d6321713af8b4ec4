@ ph_pairs_mix of pairs.h for ARMv6-M. Two pixels take 29 instructions.
@
@ Registers: r0 to, r1 from, r2 PH_SPREAD, r3 share, r4 32 - share; r5 r6 r7 lr scratch; r8 end of `to`, r9 r10 halves
#include "../thumb.inc"

    function ph_pairs_mix @ r2: n, r3: share
    cmp r2, #0
    beq 9f
    push {r4-r7, lr}
    mov r4, r8
    mov r5, r9
    mov r6, r10
    push {r4-r6}
    movs r4, #32
    subs r4, r3
    lsls r2, r2, #2
    adds r2, r0
    mov r8, r2
    adr r2, constants
    ldmia r2!, {r5-r7}
    mov r9, r5
    mov r10, r6
    mov r2, r7
1:  ldmia r1!, {r5}
    ldr r6, [r0]
    rev16 r5, r5
    rev16 r6, r6
    movs r7, r5
    bics r7, r2
    lsrs r7, r7, #5
    muls r7, r3
    mov lr, r7
    ands r5, r2
    muls r5, r3
    movs r7, r6
    ands r7, r2
    muls r7, r4
    adds r5, r7
    add r5, r9
    lsrs r5, r5, #5
    ands r5, r2
    bics r6, r2
    lsrs r6, r6, #5
    muls r6, r4
    add r6, lr
    add r6, r10
    bics r6, r2
    orrs r5, r6
    rev16 r5, r5
    stmia r0!, {r5}
    cmp r0, r8
    bne 1b
    pop {r4-r6}
    mov r8, r4
    mov r9, r5
    mov r10, r6
    pop {r4-r7, pc}
9:  bx lr
    .p2align 2
constants:
    .word 0x02008010, 0x04008010, 0x07e0f81f
    .size ph_pairs_mix, . - ph_pairs_mix
