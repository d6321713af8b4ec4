/*
 * registers: the registers that this port uses, and what else differs between the RP2040 and the RP2350: for the latter
 * rp2350/registers.h takes this file's place. Names, addresses and bits are those of the RP2040 datasheet (Raspberry
 * Pi Ltd), sections 2.3 (SIO), 2.5 (DMA), 2.13 (power-on state machine), 2.14 (resets), 2.15 .. 2.18 (clocks), 2.19
 * (GPIO), 4.2 (UART), 4.4 (SPI), 4.6 (timer), 4.7 (watchdog).
 */
#ifndef RP2040_REGISTERS_H
#define RP2040_REGISTERS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))
/* Sets or clears only the bits that are written as 1. */
#define REG_SET(address)   REG((address) + 0x2000)
#define REG_CLEAR(address) REG((address) + 0x3000)

#define RESETS_RESET      0x4000c000
#define RESETS_RESET_DONE 0x4000c008
enum {
    RESET_DMA = 1 << 2,
    RESET_IO_BANK0 = 1 << 5,
    RESET_PADS_BANK0 = 1 << 8,
    RESET_PLL_SYS = 1 << 12,
    RESET_SPI0 = 1 << 16,
    RESET_SPI1 = 1 << 17,
    RESET_TIMER = 1 << 21,
    RESET_UART0 = 1 << 22,
};

#define CLK_REF_CTRL     0x40008030
#define CLK_REF_SELECTED 0x40008038
#define CLK_SYS_CTRL     0x4000803c
#define CLK_SYS_SELECTED 0x40008044
#define CLK_PERI_CTRL    0x40008048

#define XOSC_CTRL    0x40024000
#define XOSC_STATUS  0x40024004
#define XOSC_STARTUP 0x4002400c

#define PLL_SYS_CS        0x40028000
#define PLL_SYS_PWR       0x40028004
#define PLL_SYS_FBDIV_INT 0x40028008
#define PLL_SYS_PRIM      0x4002800c

#define PSM_FRCE_OFF 0x40010004
#define PSM_WDSEL    0x40010008
enum { PSM_OSCILLATORS = 3, PSM_PROC1 = 1 << 16, PSM_ALL = 0x1ffff };

#define WATCHDOG_CTRL     0x40058000
#define WATCHDOG_LOAD     0x40058004
#define WATCHDOG_REASON   0x40058008
#define WATCHDOG_SCRATCH0 0x4005800c
#define WATCHDOG_TICK     0x4005802c
enum { WATCHDOG_ENABLE = 1 << 30, REASON_TIMER = 1 };

#define TIMER_ALARM0   0x40054010
#define TIMER_TIMERAWL 0x40054028
#define TIMER_INTR     0x40054034
#define TIMER_INTE     0x40054038

#define IO_BANK0_CTRL(pin)  (0x40014004 + 8 * (uint32_t)(pin))
#define IO_BANK0_INTR(pin)  (0x400140f0 + 4 * ((uint32_t)(pin) / 8))
#define INTR_EDGE_HIGH(pin) (8U << 4 * ((uint32_t)(pin) % 8))
enum { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_SIO = 5 };

#define PADS_BANK0(pin) (0x4001c004 + 4 * (uint32_t)(pin))
enum { PAD_FAST = 1, PAD_SCHMITT = 2, PAD_PULL_UP = 8, PAD_8_MA = 2 << 4, PAD_INPUT = 64 };

#define SIO_CPUID         0xd0000000
#define SIO_GPIO_IN       0xd0000004
#define SIO_GPIO_OUT_SET  0xd0000014
#define SIO_GPIO_OUT_CLR  0xd0000018
#define SIO_GPIO_OE_SET   0xd0000024
#define SIO_GPIO_OE_CLR   0xd0000028
#define SIO_FIFO_ST       0xd0000050
#define SIO_FIFO_WR       0xd0000054
#define SIO_FIFO_RD       0xd0000058
#define SIO_DIV_UDIVIDEND 0xd0000060
#define SIO_DIV_UDIVISOR  0xd0000064
#define SIO_DIV_SDIVIDEND 0xd0000068
#define SIO_DIV_SDIVISOR  0xd000006c
#define SIO_DIV_QUOTIENT  0xd0000070
#define SIO_DIV_REMAINDER 0xd0000074
#define SIO_DIV_CSR       0xd0000078
enum { FIFO_READABLE = 1, FIFO_WRITABLE = 2 };

#define UART0_DR    0x40034000
#define UART0_FR    0x40034018
#define UART0_IBRD  0x40034024
#define UART0_FBRD  0x40034028
#define UART0_LCR_H 0x4003402c
#define UART0_CR    0x40034030

/* Of SPI unit 0 or 1. */
#define SPI_BASE(unit)     (0x4003c000 + 0x4000 * (uint32_t)(unit))
#define SPI_SSPCR0(unit)   (SPI_BASE(unit) + 0x00)
#define SPI_SSPCR1(unit)   (SPI_BASE(unit) + 0x04)
#define SPI_SSPDR(unit)    (SPI_BASE(unit) + 0x08)
#define SPI_SSPSR(unit)    (SPI_BASE(unit) + 0x0c)
#define SPI_SSPCPSR(unit)  (SPI_BASE(unit) + 0x10)
#define SPI_SSPDMACR(unit) (SPI_BASE(unit) + 0x24)
enum { SSPSR_TNF = 2, SSPSR_BSY = 16, SSPCR1_SSE = 2, SSPDMACR_TXDMAE = 2 };

#define DMA_CH0_READ_ADDR          0x50000000
#define DMA_CH0_WRITE_ADDR         0x50000004
#define DMA_CH0_TRANS_COUNT        0x50000008
#define DMA_CH0_CTRL_TRIG          0x5000000c
#define DMA_CH0_AL3_READ_ADDR_TRIG 0x5000003c
#define DMA_CH0_AL1_CTRL           0x50000010
#define DMA_INTE0                  0x50000404
#define DMA_INTS0                  0x5000040c
enum {
    DMA_EN = 1,
    DMA_HALFWORDS = 1 << 2,
    DMA_INCR_READ = 1 << 4,
    DMA_BSWAP = 1 << 22,
    DMA_BUSY = 1 << 24,
};
#define DMA_TREQ_SPI_TX(unit) ((16U + 2U * (uint32_t)(unit)) << 15)

/* Each core's own; ARMv6-M Architecture Reference Manual B3.3 (SysTick), B3.5 (MPU). */
#define SYST_CSR  0xe000e010
#define SYST_RVR  0xe000e014
#define SYST_CVR  0xe000e018
#define NVIC_ISER 0xe000e100
#define VTOR      0xe000ed08
#define MPU_CTRL  0xe000ed94
#define MPU_RNR   0xe000ed98
#define MPU_RBAR  0xe000ed9c
#define MPU_RASR  0xe000eda0
enum { IRQ_TIMER_0 = 0, IRQ_DMA_0 = 11 };

#define CLK_HZ            125000000           /* clk_sys, see clocks.c */
#define CLK_PERI_HZ       125000000           /* of SPI and UART */
#define PLL_SYS_POST_DIV  (6 << 16 | 2 << 12) /* 1500 MHz / 6 / 2 */
#define WATCHDOG_TICKS_US 2                   /* the load counts down twice a microsecond (erratum RP2040-E1) */

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

/* No access within the region of the MPU, elsewhere as without one. */
static inline void guard_stack(uint32_t from, uint32_t bytes_log2)
{
    REG(MPU_RNR) = 0;
    REG(MPU_RBAR) = from;
    REG(MPU_RASR) = (bytes_log2 - 1) << 1 | 1;
    REG(MPU_CTRL) = 5;
}

typedef void *lookup_fn(const uint16_t *table, uint32_t code);
typedef void reset_usb_boot_fn(uint32_t activity_pins, uint32_t disabled_interfaces);

/* Reads a halfword from the ROM's first words. The asm hides the address: compilers expect no object so near to 0. */
static inline uintptr_t rom_word(uintptr_t address)
{
    __asm("" : "+r"(address));
    return *(const uint16_t *)address;
}

/* Calls the ROM's reset_usb_boot(), which the ROM finds by two letters (RP2040 datasheet 2.8.3). */
static inline void start_boot_loader(void)
{
    lookup_fn *const lookup = (lookup_fn *)rom_word(0x18);
    ((reset_usb_boot_fn *)lookup((const uint16_t *)rom_word(0x14), 'U' | 'B' << 8))(0, 0);
}

#endif
