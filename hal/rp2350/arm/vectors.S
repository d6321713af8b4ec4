/*
 * The vectors and, behind them, the image definition: a block within the first 4 KB of flash that tells the ROM that this
 * is a program for the RP2350's Arm cores in secure mode (RP2350 datasheet 5.9.5). The ROM takes the vectors from the
 * beginning of flash, where no block says otherwise, and needs no second stage: it has set up the flash.
 */
    .syntax unified
    .section .vectors, "a"
    .word ld_stack_top, rp2_reset, rp2_on_fault, rp2_on_fault /* reset, NMI, hard fault */
    .word rp2_on_fault, rp2_on_fault, rp2_on_fault, rp2_on_fault /* memory, bus, usage, secure fault */
    .word 0, 0, 0, rp2_on_fault, rp2_on_fault, 0, rp2_on_fault, rp2_tick /* SVC, debug, PendSV, SysTick */
    .word rp2_timer_interrupt                                /* IRQ 0: TIMER0_0 */
    .word 0, 0, 0, 0, 0, 0, 0, 0, 0
    .word rp2_bus_interrupt                                  /* IRQ 10: DMA_0 */
    .fill 41, 4, 0                                              /* to IRQ 51 */

    .word 0xffffded3
    .byte 0x42, 1                                               /* image type, one word */
    .hword 1 << 12 | 2 << 4 | 1                                 /* RP2350, Arm, secure, a program */
    .byte 0xff                                                  /* the last item */
    .hword 1                                                    /* words of all items before */
    .byte 0
    .word 0                                                     /* the next block is this one: there is no other */
    .word 0xab123579
