/* ph_fill of kernels.h for RV32: 17 instructions store 64 bytes. */
#include "rv32.inc"

    function ph_fill // a0: to, a1: value, a2: pixels
    beqz a2, 5f
    andi t0, a0, 2 // half a word comes first
    beqz t0, 1f
    sh a1, 0(a0)
    addi a0, a0, 2
    addi a2, a2, -1
1:  slli t0, a1, 16
    slli a3, a2, 1
    or a1, a1, t0
    add a3, a3, a0 // the end
    li t0, 32
    bltu a2, t0, 3f
    addi a4, a3, -64 // of the last sixteen words
2:  words sw, a0, 0, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1, a1
    addi a0, a0, 64
    bleu a0, a4, 2b
3:  addi a4, a3, -4
    bgtu a0, a4, 4f
    sw a1, 0(a0)
    addi a0, a0, 4
    j 3b
4:  beq a0, a3, 5f
    sh a1, 0(a0)
5:  ret
    .size ph_fill, . - ph_fill
