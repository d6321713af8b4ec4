/*
 * registers: the RP2350's base addresses and what else only it has; see hal/rp2040/registers.h. Names, addresses and
 * bits are those of the RP2350 datasheet (Raspberry Pi Ltd), sections 3.1 (SIO), 5.4 (ROM), 6.4 (POWMAN), 7.5 (resets),
 * 8.1 .. 8.6 (clocks), 7.4 (power-on state machine), 9.11 (GPIO), 12.1 (UART), 12.3 (SPI), 12.6 (DMA), 12.8 (timer),
 * 12.9 (watchdog), 12.15 (SYSINFO).
 */
#ifndef RP2350_REGISTERS_H
#define RP2350_REGISTERS_H

#include <stdint.h>

#define RESETS_BASE     0x40020000
#define CLOCKS_BASE     0x40010000
#define XOSC_BASE       0x40048000
#define PLL_SYS_BASE    0x40050000
#define PLL_USB_BASE    0x40058000
#define PSM_BASE        0x40018000
#define WATCHDOG_BASE   0x400d8000
#define TIMER_BASE      0x400b0000
#define IO_BANK0_BASE   0x40028000
#define IO_BANK0_INTR0  0x40028230
#define PADS_BANK0_BASE 0x40038000
#define UART0_BASE      0x40070000
#define FC0_BASE        (CLOCKS_BASE + 0x8c)
#define CHIP_RESET      0x4010002c /* of POWMAN */
#define SPI_BASE(unit)  (0x40080000 + 0x8000 * (uint32_t)(unit))

#include "chips/rp2/peripherals.h"

enum {
    RESET_DMA = 1 << 2,
    RESET_IO_BANK0 = 1 << 6,
    RESET_PADS_BANK0 = 1 << 9,
    RESET_PLL_SYS = 1 << 14,
    RESET_PLL_USB = 1 << 15,
    RESET_SPI0 = 1 << 18,
    RESET_SPI1 = 1 << 19,
    RESET_SYSINFO = 1 << 21,
    RESET_TIMER = 1 << 23,
    RESET_UART0 = 1 << 26,
};
enum { PSM_OSCILLATORS = 3 << 2, PSM_PROC1 = 1 << 24, PSM_ALL = 0x1ffffff };

#define TICKS_TIMER0_CTRL     0x40108018
#define TICKS_TIMER0_CYCLES   0x4010801c
#define TICKS_WATCHDOG_CTRL   0x40108030
#define TICKS_WATCHDOG_CYCLES 0x40108034
#define TIMER_INTR            0x400b003c
#define TIMER_INTE            0x400b0040

#define SIO_GPIO_OUT_SET 0xd0000018
#define SIO_GPIO_OUT_CLR 0xd0000020
#define SIO_GPIO_OE_SET  0xd0000038
#define SIO_GPIO_OE_CLR  0xd0000040

#define DMA_BSWAP             (1U << 24)
#define DMA_TREQ_SPI_TX(unit) ((24U + 2U * (uint32_t)(unit)) << 17)

enum { IRQ_TIMER_0 = 0, IRQ_DMA_0 = 10 };

/* Bits of CHIP_RESET. Each of them is written as an element of an array. */
#define CHIP_RESETS                                                                                                    \
    {1 << 16, "power on"}, {1 << 17, "brown-out"}, {1 << 18, "the RUN pin"},                                           \
        {1 << 19 | 1 << 21 | 1 << 27, "the debug port"}, {1 << 26, "a glitch of the supply"},                          \
        {1 << 25, "the core's power was off"},                                                                         \
    {                                                                                                                  \
        0x11c00000, "the watchdog"                                                                                     \
    }
#define CHIP_NAME "RP2350"

#define CLK_HZ            150000000 /* clk_sys, see clocks.c */
#define CLK_PERI_HZ       125000000 /* of SPI and UART: SPI makes 62.5 MHz of it, and would make 37.5 of 150 */
#define PLL_SYS_POST_DIV  (5 << 16 | 2 << 12) /* 1500 MHz / 5 / 2 */
#define WATCHDOG_TICKS_US 1

#define CHIP_INFO      BUILD_ATTRIBUTE /* of binary_info.c; picotool itself reads the image definition */
#define CHIP_INFO_TEXT "ISA=" IMAGE_ISA

/* clk_peri comes from the PLL that nobody needs for USB: 1500 MHz / 6 / 2. */
static inline void start_clk_peri(void)
{
    REG(CLK_PERI_CTRL) = 0;
    start_pll(PLL_USB_BASE, RESET_PLL_USB, 6 << 16 | 2 << 12);
    REG(CLK_PERI_CTRL) = 2 << 5;
    REG(CLK_PERI_CTRL) = 1 << 11 | 2 << 5;
}

/* Timer and watchdog count microseconds. */
static inline void start_ticks(uint32_t crystal_mhz)
{
    REG(TICKS_TIMER0_CYCLES) = crystal_mhz;
    REG(TICKS_TIMER0_CTRL) = 1;
    REG(TICKS_WATCHDOG_CYCLES) = crystal_mhz;
    REG(TICKS_WATCHDOG_CTRL) = 1;
}

#endif
