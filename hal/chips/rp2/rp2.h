/*
 * rp2: the port for Raspberry Pi's RP2040 and RP2350, bare metal. See port.h for what it gives to an image.
 *
 *   entry.S    reset (of Arm cores)                start.c              start, faults, the end
 *   clocks.c   12 MHz crystal -> 125 or 150 MHz    facts.c              what the chip says of itself
 *   rp2.c      struct hal_ops, USB boot loader     spi.c                the bus: SPI and one channel of DMA
 *                                                  i2c.c                .. or I2C, by PORT_BUS of board.mk
 *   pins.c     pins                                uart.c               log: UART0, TX GP0, RX GP1
 *   cores2.c   the second core (CORES=2)           guard.c              what ends a stack that runs over
 *   binary_info.c   what picotool shows of an image
 *
 * hal/rp2040 and hal/rp2350 have what each chip has of its own: registers.h and cpu.h, which are what the files here
 * need to know of chip and core, vectors, linker script and flash.c. The RP2040 also has boot2.S, the second stage of
 * its boot loader, and divide.c, / and % by the SIO's divider.
 *
 * Calls run one way: entry.S, start.c, rp2.c, spi.c (or i2c.c) and uart.c, pins.c.
 *
 * Core 0 sleeps (WFE) while it waits for the bus or an alarm. Two interrupts wake it. The handler of the bus (of the
 * DMA, or of the I2C unit) also starts the next write.
 */
#ifndef RP2_H
#define RP2_H

#include "board.h"

/* Starts crystal and PLL: clk_sys = CLK_HZ, clk_peri = CLK_PERI_HZ, timer 1 MHz. Takes the blocks that the port uses
 * out of reset.
 */
void rp2_clocks_init(void);

void rp2_uart_init(void);

/* Makes a pin an output of the SIO at a level, an input with pull-up, or a function of IO_BANK0. */
void rp2_pin_output(uint32_t pin, bool level);
void rp2_pin_input(uint32_t pin);
void rp2_pin_function(uint32_t pin, uint32_t function);
void rp2_pin_write(uint32_t pin, bool level);

/* The bus; there is one. Operations of struct hal_ops ignore their context. */
int rp2_bus_open(const struct board *board);
void rp2_bus_close(void);
int32_t rp2_bus_clock(void *context, uint32_t hz);
int rp2_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n);
int rp2_bus_write_rows(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows);
int rp2_bus_wait(void *context);
/* spi.c keeps a queue, i2c.c copies. What a bus does not define is NULL in struct hal_ops. */
__attribute__((weak)) void rp2_bus_queue(void *context, bool on);
__attribute__((weak)) uint32_t rp2_bus_written(void *context);
__attribute__((weak)) int rp2_bus_until(void *context, uint32_t written);
__attribute__((weak)) void rp2_bus_flush(void *context);

/*
 * A stack that runs over meets a region that the MPU forbids. An ARMv6-M core stacks the frame of its fault there, too,
 * and locks up: no handler ever runs. So each core ticks, core 0 feeds the watchdog while both do, and 0.5 to 0.7 s
 * after the last tick the watchdog resets the chip. The next start then makes the panel dark and stops.
 *
 * rp2_guard: for the core that calls it; the region begins at a multiple of its size. watchdog_bit: this start was
 * the watchdog's work.
 */
void rp2_guard(uint32_t from, uint32_t bytes_log2);
void rp2_watchdog_start(void);
void rp2_watchdog_stop(void);
bool rp2_watchdog_bit(void);

/* Handler of SysTick on both cores. */
void rp2_tick(void);

/* Handlers of the bus's interrupt and of TIMER_IRQ_0. */
void rp2_bus_interrupt(void);
void rp2_timer_interrupt(void);

/* Makes the panel dark at once, whatever bus and pins do: turns off its backlight and resets it, where these are wired.
 */
void rp2_dark(void);

#endif
