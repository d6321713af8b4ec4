/*
 * rp2040: the port for Raspberry Pi's RP2040, bare metal. See port.h for what it gives to an image.
 *
 *   boot2.S    second stage of the boot loader   entry.S, start.c     reset, vectors, faults
 *   clocks.c   12 MHz crystal -> 125 MHz         spi.c                the bus: SPI and one channel of DMA
 *   rp2040.c   struct hal_ops: pins, time        uart.c               log: UART0, TX GP0, RX GP1
 *   divide.c   / and % by the SIO's divider      cores1.c, cores2.c   without and with the second core (CORES=)
 *
 * Core 0 sleeps (WFE) while it waits for the bus or an alarm. Its two handlers wake it; that of
 * the DMA also starts what is next on the bus.
 */
#ifndef RP2040_H
#define RP2040_H

#include "board.h"

/* Crystal, PLL, clk_sys = clk_peri = 125 MHz, 1 MHz timer; takes what the port uses out of reset. */
void rp2040_clocks_init(void);

void rp2040_uart_init(void);

/* A pin as output of the SIO at a level, as input with pull-up, as a function of IO_BANK0. */
void rp2040_pin_output(uint32_t pin, bool level);
void rp2040_pin_input(uint32_t pin);
void rp2040_pin_function(uint32_t pin, uint32_t function);
void rp2040_pin_write(uint32_t pin, bool level);

/* The bus of struct hal_ops; one at a time. */
void rp2040_spi_open(const struct board *board);
int32_t rp2040_spi_clock(uint32_t hz);
void rp2040_spi_write(enum hal_dc dc, const uint8_t *bytes, uint32_t n);
void rp2040_spi_write_rows(const uint8_t *bytes, uint32_t n, uint32_t stride, uint32_t rows);
void rp2040_spi_queue(bool on);
uint32_t rp2040_spi_written(void);
void rp2040_spi_until(uint32_t written);
void rp2040_spi_wait(void);
void rp2040_spi_close(void);

/* Handlers of DMA_IRQ_0 and TIMER_IRQ_0. */
void rp2040_spi_interrupt(void);
void rp2040_timer_interrupt(void);

/* Dark at once, whatever state the bus is in: backlight off, panel in reset where these are wired. */
void rp2040_dark(void);

#endif
