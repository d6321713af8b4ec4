/*
 * boot2: the second stage of the boot loader, in the first 256 bytes of flash. The ROM copies them to the end of RAM,
 * checks their CRC (RP2040 datasheet 2.8.1.3; boot2_seal.sh writes it into the last four bytes) and jumps to the first.
 *
 * It sets up the SSI (datasheet 4.10) so that flash appears at 0x10000000: serial reads with command 03h, 24 address
 * bits, no dummy bits, one data line. Every SPI flash understands that from power-on, whatever its status registers
 * hold. The clock is 125 / 4 = 31.25 MHz; a W25Q16 takes 50 MHz with 03h. Fast code runs from RAM, see rp2040.ld.
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb
    .section .boot2, "ax"
    .global rp2040_boot2
    .thumb_func
rp2040_boot2:
    ldr r3, =0x18000000         /* XIP_SSI */
    movs r1, #0
    str r1, [r3, #0x08]         /* SSIENR: off during set-up */
    movs r1, #4
    str r1, [r3, #0x14]         /* BAUDR */
    ldr r1, =(31 << 16 | 3 << 8) /* 32-bit frames, one line, TMOD 3: command and address out, then data in */
    str r1, [r3, #0x00]         /* CTRLR0 */
    movs r1, #0
    str r1, [r3, #0x04]         /* CTRLR1: one frame a read */
    ldr r1, =(0x03 << 24 | 2 << 8 | 6 << 2) /* command 03h of 8 bits, 6 x 4 address bits, all serial */
    ldr r2, =0x180000f4         /* SPI_CTRLR0 */
    str r1, [r2]
    movs r1, #1
    str r1, [r3, #0x08]
    ldr r0, =0x10000100         /* the image's vectors */
    ldr r1, =0xe000ed08         /* VTOR */
    str r0, [r1]
    ldmia r0!, {r1, r2}
    mov sp, r1
    bx r2
    .ltorg
