/* ph_fill of kernels.h for RV32: 33 instructions store 128 bytes, and what is left of them takes one a word. */
#include "rv32.inc"

    function ph_fill, loop // a0: to, a1: value, a2: pixels
    beqz a2, 4f
    andi t0, a0, 2 // half a word comes first
    beqz t0, 1f
    sh a1, 0(a0)
    addi a0, a0, 2
    addi a2, a2, -1
1:  slli t0, a1, 16
    slli a3, a2, 1
    or a1, a1, t0
    add a3, a3, a0 // the end
    li t0, 64
    bltu a2, t0, 3f
    addi a4, a3, -128 // the last place for as many
2:
    .irp at, 0, 16, 32, 48, 64, 80, 96, 112
    words sw, a0, \at, a1, a1, a1, a1
    .endr
    addi a0, a0, 128
    bleu a0, a4, 2b
3:  andi a4, a3, -4
    sub a0, a0, a4 // a store takes as many bytes as it stores
    la t0, last
    add t0, t0, a0
    jr t0
    words sw, a4, -124, a1, a1, a1
    .irp at, 112, 96, 80, 64, 48, 32, 16
    words sw, a4, -\at, a1, a1, a1, a1
    .endr
last:
    beq a4, a3, 4f
    sh a1, 0(a4)
4:  ret
    .size ph_fill, . - ph_fill
