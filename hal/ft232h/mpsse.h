/*
 * mpsse: the FT232H's commands as bytes. Pure; private to hal/ft232h. Source: FTDI AN_108.
 *
 * Bytes go out highest bit first. Bits change at the falling edge of the clock and are read at its rising edge: that is
 * SPI mode 0 or 3, after the level at which the clock rests. FTDI promises modes 0 and 2; mode 3 ran on the model only.
 */
#ifndef HAL_FT232H_MPSSE_H
#define HAL_FT232H_MPSSE_H

#include <stddef.h>
#include <stdint.h>

enum {
    MPSSE_SET_LOW = 0x80, /* levels, then directions (1: output) of AD0 .. AD7 */
    MPSSE_GET_LOW = 0x81,
    MPSSE_SET_HIGH = 0x82, /* levels, then directions, of AC0 .. AC7 */
    MPSSE_GET_HIGH = 0x83,
    MPSSE_LOOPBACK_OFF = 0x85,
    MPSSE_DIVISOR = 0x86, /* low byte, high byte */
    MPSSE_SEND_NOW = 0x87,
    MPSSE_60_MHZ = 0x8A, /* no division by 5 before the divisor */
    MPSSE_ADAPTIVE_OFF = 0x97,
    MPSSE_OUT = 0x11, /* count - 1 as low byte, high byte; bytes */
    MPSSE_IN = 0x20,  /* count - 1 as low byte, high byte */
    MPSSE_BAD = 0xAA, /* not a command: the answer is MPSSE_BAD_ECHO and this byte */
    MPSSE_BAD_ECHO = 0xFA,
};

#define MPSSE_BLOCK_MAX 65536U /* bytes of one MPSSE_OUT or MPSSE_IN */
#define MPSSE_PINS_MAX  6
#define MPSSE_BLOCK     3
#define MPSSE_CLOCK     3

/* Writes the commands that set the `changed` pins (bit n: ADn, bit 8 + n: ACn) to their levels; returns their bytes. */
size_t ft232h_mpsse_pins(uint8_t out[MPSSE_PINS_MAX], uint16_t levels, uint16_t outputs, uint16_t changed);

/* Writes the head of a block of n bytes, 1 .. MPSSE_BLOCK_MAX; command: MPSSE_OUT or MPSSE_IN. */
void ft232h_mpsse_block(uint8_t out[MPSSE_BLOCK], uint8_t command, size_t n);

/* Writes the command for the fastest clock of at most hz; returns that clock, or 0 if none is that slow. */
uint32_t ft232h_mpsse_clock(uint8_t out[MPSSE_CLOCK], uint32_t hz);

/* Bit number of "AD0" .. "AD7" (0 .. 7), "AC0" .. "AC7" (8 .. 15); -1 for other names. */
int ft232h_mpsse_pin(const char *name);

#endif
