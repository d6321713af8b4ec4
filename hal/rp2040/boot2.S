/*
 * boot2: the second stage of the boot loader, in the first 256 bytes of flash. The ROM copies them to the end of RAM,
 * checks their CRC (RP2040 datasheet 2.8.1.3; boot2_seal.sh writes it into the last four bytes) and jumps to the first.
 *
 * It sets up the SSI (datasheet 4.10) so that flash appears at 0x10000000. The W25Q16JV of a Pico, and every flash whose
 * JEDEC id is that of a Winbond W25Q and that takes the bit QE, is read on four lines with command EBh (W25Q16JV
 * datasheet, "Fast Read Quad I/O"): 24 address bits, mode bits A0h, 4 dummy clocks, 32 bits. After these mode bits the
 * flash expects the next address without a command, until the ROM, which does so before it uses the flash, ends this
 * (datasheet 2.8.1.2). At 125 MHz the clock is 62.5 MHz (flash: 133 MHz), for which the pads are fast and sampling is a
 * cycle later; flash_margin.h has the divider and the delay, and proves their margin. Pads, commands and dummy clocks are
 * those of Raspberry Pi's pico-sdk, boot2_w25q080.S. QE is set only until power-off (command 50h), so the flash is never
 * worn.
 *
 * Every other flash is read with command 03h: 24 address bits, no dummy bits, one data line, 31.25 MHz. Any SPI flash
 * understands that from power-on, whatever its status registers hold. rp2_flash_open() (flash.h) may find a faster
 * read for it.
 *
 * The SSI disregards a write to a register of its set-up, RX_SAMPLE_DLY among them, while SSIENR is 1.
 */
#include "chips/rp2/flash_margin.h"

    .syntax unified
    .cpu cortex-m0plus
    .thumb
    .equ SSIENR, 0x08
    .equ BAUDR, 0x14
    .equ SR, 0x28
    .equ DR, 0x60
    .equ RX_SAMPLE_DLY, 0xf0
    .equ SPI_CTRLR0, 0xf4
    .equ READ, 31 << 16 | 3 << 8                /* CTRLR0: 32-bit frames, TMOD 3: command and address out, then data in */
    .equ QUAD, 2 << 21                          /* SPI_FRF */
    .equ QUAD_ADDRESS, 4 << 11 | 8 << 2         /* dummy clocks; 8 x 4 bits of address and mode */

    .section .boot2, "ax"
    .global rp2040_boot2
    .thumb_func
rp2040_boot2:
    ldr r3, =0x40020000         /* PADS_QSPI */
    movs r0, #2 << 4 | 1        /* clock: 8 mA, fast */
    str r0, [r3, #0x04]
    ldr r0, [r3, #0x08]
    movs r1, #2                 /* data: no Schmitt trigger */
    bics r0, r0, r1
    str r0, [r3, #0x08]
    str r0, [r3, #0x0c]
    str r0, [r3, #0x10]
    str r0, [r3, #0x14]
    ldr r3, =0x18000000         /* XIP_SSI */
    movs r7, #RP2040_FLASH_UNKNOWN_DIVIDER
    ldr r1, =7 << 16            /* frames of a byte, out and in */
    movs r2, #0
    bl set_up
    movs r0, #0x9f              /* JEDEC id */
    bl transfer
    cmp r1, #0xef               /* Winbond */
    bne serial
    cmp r2, #0x40               /* W25Q; W25X has 30h */
    blo serial
    movs r0, #0x05              /* status register 1 */
    bl transfer
    mov r8, r1
    movs r0, #0x35              /* status register 2: QE is bit 1 */
    bl transfer
    movs r7, #2                 /* QE */
    tst r1, r7
    bne quad
    movs r0, #0x50              /* the next write is volatile */
    str r0, [r3, #DR]
    bl wait
    ldr r0, [r3, #DR]
    movs r2, r1
    orrs r2, r2, r7
    mov r1, r8
    movs r0, #0x01              /* both status registers */
    bl transfer
    movs r0, #0x35
    bl transfer
    tst r1, r7
    bne quad
serial:
    movs r7, #RP2040_FLASH_UNKNOWN_DIVIDER
    ldr r1, =READ
    ldr r2, =0x03 << 24 | 2 << 8 | 6 << 2 /* command 03h of 8 bits, 6 x 4 address bits, all on one line */
    bl set_up
    b start
quad:
    movs r7, #RP2040_FLASH_W25Q_DIVIDER
    ldr r1, =QUAD | READ
    ldr r2, =2 << 8 | QUAD_ADDRESS | 1 /* a command of 8 bits on one line */
    bl set_up
    movs r0, #0xeb
    str r0, [r3, #DR]
    movs r0, #0xa0              /* address 0, mode bits */
    str r0, [r3, #DR]
    bl wait
    ldr r2, =0xa0 << 24 | QUAD_ADDRESS | 2 /* no command */
    bl set_up
start:
    ldr r0, =0x10000100         /* the image's vectors */
    ldr r1, =0xe000ed08         /* VTOR */
    str r0, [r1]
    ldmia r0!, {r1, r2}
    mov sp, r1
    bx r2

/* r7: BAUDR, r1: CTRLR0, r2: SPI_CTRLR0; changes r0 and r4. CTRLR1 is 0: one frame a read; RX_SAMPLE_DLY is 1. While it
 * is on the SSI ignores all of them. */
set_up:
    movs r0, #0
    str r0, [r3, #SSIENR]       /* off during set-up; empties the FIFOs */
    str r7, [r3, #BAUDR]
    str r1, [r3, #0x00]
    str r0, [r3, #0x04]
    movs r0, #RP2040_FLASH_DELAY
    movs r4, #RX_SAMPLE_DLY
    str r0, [r3, r4]
    movs r4, #SPI_CTRLR0
    str r2, [r3, r4]
    str r0, [r3, #SSIENR]
    bx lr

/* Sends the bytes r0, r1, r2 and receives as many into them. */
transfer:
    mov r9, lr
    str r0, [r3, #DR]
    str r1, [r3, #DR]
    str r2, [r3, #DR]
    bl wait
    ldr r0, [r3, #DR]
    ldr r1, [r3, #DR]
    ldr r2, [r3, #DR]
    bx r9

wait:
    ldr r0, [r3, #SR]
    movs r4, #5                 /* BUSY, and TFE: all is sent */
    ands r0, r0, r4
    cmp r0, #4
    bne wait
    bx lr
    .ltorg
