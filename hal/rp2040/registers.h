/*
 * registers: the RP2040's base addresses and what else only it has; hal/rp2350/registers.h has the RP2350's, and
 * chips/rp2/peripherals.h what is the same in both. Names, addresses and bits are those of the RP2040 datasheet
 * (Raspberry Pi Ltd), sections 2.3 (SIO), 2.5 (DMA), 2.10 (voltage regulator and chip reset), 2.13 (power-on state
 * machine), 2.14 (resets), 2.15 .. 2.18 (clocks), 2.19 (GPIO), 2.20 (SYSINFO), 4.2 (UART), 4.3 (I2C), 4.4 (SPI), 4.6
 * (timer), 4.7 (watchdog).
 */
#ifndef RP2040_REGISTERS_H
#define RP2040_REGISTERS_H

#include <stdint.h>

#define RESETS_BASE     0x4000c000
#define CLOCKS_BASE     0x40008000
#define XOSC_BASE       0x40024000
#define PLL_SYS_BASE    0x40028000
#define PSM_BASE        0x40010000
#define WATCHDOG_BASE   0x40058000
#define TIMER_BASE      0x40054000
#define IO_BANK0_BASE   0x40014000
#define IO_BANK0_INTR0  0x400140f0
#define PADS_BANK0_BASE 0x4001c000
#define UART0_BASE      0x40034000
#define FC0_BASE        (CLOCKS_BASE + 0x80)
#define CHIP_RESET      0x40064008
#define SPI_BASE(unit)  (0x4003c000 + 0x4000 * (uint32_t)(unit))
#define I2C_BASE(unit)  (0x40044000 + 0x4000 * (uint32_t)(unit))

#include "chips/rp2/peripherals.h"

enum {
    RESET_DMA = 1 << 2,
    RESET_IO_BANK0 = 1 << 5,
    RESET_PADS_BANK0 = 1 << 8,
    RESET_PLL_SYS = 1 << 12,
    RESET_SPI0 = 1 << 16,
    RESET_SPI1 = 1 << 17,
    RESET_SYSINFO = 1 << 19,
    RESET_TIMER = 1 << 21,
    RESET_UART0 = 1 << 22,
};
#define RESET_I2C(unit) (1U << (3 + (unit)))
enum { PSM_OSCILLATORS = 3, PSM_PROC1 = 1 << 16, PSM_ALL = 0x1ffff };

#define WATCHDOG_TICK 0x4005802c
#define TIMER_INTR    0x40054034
#define TIMER_INTE    0x40054038

#define SIO_GPIO_OUT_SET  0xd0000014
#define SIO_GPIO_OUT_CLR  0xd0000018
#define SIO_GPIO_OE_SET   0xd0000024
#define SIO_GPIO_OE_CLR   0xd0000028
#define SIO_DIV_UDIVIDEND 0xd0000060
#define SIO_DIV_UDIVISOR  0xd0000064
#define SIO_DIV_SDIVIDEND 0xd0000068
#define SIO_DIV_SDIVISOR  0xd000006c
#define SIO_DIV_QUOTIENT  0xd0000070
#define SIO_DIV_REMAINDER 0xd0000074
#define SIO_DIV_CSR       0xd0000078

#define DMA_BSWAP             (1U << 22)
#define DMA_TREQ_SPI_TX(unit) ((16U + 2U * (uint32_t)(unit)) << 15)

enum { IRQ_TIMER_0 = 0, IRQ_DMA_0 = 11 };
#define IRQ_I2C(unit) (23 + (unit))

/* Bits of CHIP_RESET. Each of them is written as an element of an array. */
#define CHIP_RESETS                                                                                                    \
    {1 << 8, "power on, or brown-out"}, {1 << 16, "the RUN pin"},                                                      \
    {                                                                                                                  \
        1 << 20, "the debug port"                                                                                      \
    }
#define CHIP_NAME "RP2040"

#define CLK_HZ            125000000           /* clk_sys, see clocks.c */
#define CLK_PERI_HZ       125000000           /* of SPI and UART */
#define PLL_SYS_POST_DIV  (6 << 16 | 2 << 12) /* 1500 MHz / 6 / 2 */
#define WATCHDOG_TICKS_US 2                   /* the load counts down twice a microsecond (erratum RP2040-E1) */

#define CHIP_INFO      BOOT2_NAME /* of binary_info.c */
#define CHIP_INFO_TEXT "boot2.S, command EBh or 03h"

/* clk_peri is on, from clk_sys. */
static inline void start_clk_peri(void)
{
    REG(CLK_PERI_CTRL) = 1 << 11;
}

/* Timer and watchdog count microseconds. */
static inline void start_ticks(uint32_t crystal_mhz)
{
    REG(WATCHDOG_TICK) = 1 << 9 | crystal_mhz;
}

#endif
