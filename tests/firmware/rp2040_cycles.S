/* For test_rp2040_cycles.sh, which says what the emulated RP2040 must count from one mark to the next. */
    .syntax unified
    .cpu cortex-m0plus
    .thumb
    .section .vectors, "a"
    .word ld_stack_top, start + 1
    .macro mark name
    .global \name
\name: nop
    .endm
    .macro loads n /* words of flash that are 8 KB apart, and so lie in the same set of the cache, ten times */
    ldr r1, =data
    ldr r2, =8192
    movs r0, #10
1:  ldr r1, =data
    .rept \n
    ldr r3, [r1]
    adds r1, r1, r2
    .endr
    subs r0, r0, #1
    bne 1b
    .endm

    .text
    .balign 8192
    .skip 256 /* another set than that of data */
start:
    mark mark0
    .rept 63
    nop
    .endr
    mark mark1
    movs r0, #100
1:  .rept 12
    nop
    .endr
    subs r0, r0, #1
    bne 1b
    mark mark2
    movs r4, #2
1:  bl function
    subs r4, r4, #1
    bne 1b
    mark mark3
    loads 2
    mark mark4
    loads 3
    mark mark5
    b .
    .balign 4
    .ltorg
function:
    push {r4, r5, lr}
    push {r5}
    pop {r5}
    pop {r4, r5, pc}
    .balign 8192
data:
    .skip 3 * 8192
