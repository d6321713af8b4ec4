@ fx_mul_far of fx.h for ARMv6-M: four products of 16 bits, 21 instructions and the return. A sum of two parts never
@ carries out of 32 bits.
#include "../thumb.inc"

    function fx_mul_far, loop @ r0: a, r1: b; r2: low half of a, r3: low half of b, r4: high half of a
    push {r4}
    uxth r2, r0
    uxth r3, r1
    asrs r4, r0, #16
    muls r0, r1
    mov r12, r0 @ the low word
    asrs r1, r1, #16 @ high half of b
    movs r0, r2
    muls r0, r3
    lsrs r0, r0, #16
    muls r3, r4
    adds r3, r0 @ what begins at bit 16, in two sums
    muls r2, r1
    muls r1, r4
    uxth r0, r3
    asrs r3, r3, #16
    adds r1, r3
    adds r2, r0
    asrs r2, r2, #16
    adds r1, r2
    mov r0, r12
    pop {r4}
    bx lr
