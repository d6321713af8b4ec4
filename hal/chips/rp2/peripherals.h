/*
 * peripherals: what the RP2040 and the RP2350 have in common. The chip's registers.h gives the base addresses and the
 * rest; offsets, bits and names are those of both datasheets, whose sections registers.h names.
 */
#ifndef RP2_PERIPHERALS_H
#define RP2_PERIPHERALS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))
/* Sets or clears only the bits that are written as 1. */
#define REG_SET(address)   REG((address) + 0x2000)
#define REG_CLEAR(address) REG((address) + 0x3000)

#define RESETS_RESET      RESETS_BASE
#define RESETS_RESET_DONE (RESETS_BASE + 0x08)

#define CLK_REF_CTRL     (CLOCKS_BASE + 0x30)
#define CLK_REF_SELECTED (CLOCKS_BASE + 0x38)
#define CLK_SYS_CTRL     (CLOCKS_BASE + 0x3c)
#define CLK_SYS_SELECTED (CLOCKS_BASE + 0x44)
#define CLK_PERI_CTRL    (CLOCKS_BASE + 0x48)

#define XOSC_CTRL    XOSC_BASE
#define XOSC_STATUS  (XOSC_BASE + 0x04)
#define XOSC_STARTUP (XOSC_BASE + 0x0c)

/* Registers of a PLL; pll: PLL_SYS_BASE or PLL_USB_BASE. */
#define PLL_CS(pll)        (pll)
#define PLL_PWR(pll)       ((pll) + 0x04)
#define PLL_FBDIV_INT(pll) ((pll) + 0x08)
#define PLL_PRIM(pll)      ((pll) + 0x0c)

#define PSM_FRCE_OFF (PSM_BASE + 0x04)
#define PSM_WDSEL    (PSM_BASE + 0x08)

#define WATCHDOG_CTRL     WATCHDOG_BASE
#define WATCHDOG_LOAD     (WATCHDOG_BASE + 0x04)
#define WATCHDOG_REASON   (WATCHDOG_BASE + 0x08)
#define WATCHDOG_SCRATCH0 (WATCHDOG_BASE + 0x0c)
enum { WATCHDOG_ENABLE = 1 << 30, REASON_TIMER = 1, REASON_FORCE = 2 };

#define SYSINFO_CHIP_ID 0x40000000

/* The frequency counter: counts cycles of a clock for some of clk_ref, whose frequency it is told. A write to SRC
 * starts it. */
#define FC0_REF_KHZ  FC0_BASE
#define FC0_INTERVAL (FC0_BASE + 0x10)
#define FC0_SRC      (FC0_BASE + 0x14)
#define FC0_STATUS   (FC0_BASE + 0x18)
#define FC0_RESULT   (FC0_BASE + 0x1c) /* kHz with 5 bits of fraction */
enum { FC0_DONE = 1 << 4, FC0_RUNNING = 1 << 8 };
enum { FC0_SRC_ROSC = 3, FC0_SRC_CLK_SYS = 9, FC0_SRC_CLK_PERI = 10 };

#define TIMER_ALARM0   (TIMER_BASE + 0x10)
#define TIMER_TIMERAWL (TIMER_BASE + 0x28)

#define IO_BANK0_CTRL(pin)  (IO_BANK0_BASE + 4 + 8 * (uint32_t)(pin))
#define IO_BANK0_INTR(pin)  (IO_BANK0_INTR0 + 4 * ((uint32_t)(pin) / 8))
#define INTR_EDGE_HIGH(pin) (8U << 4 * ((uint32_t)(pin) % 8))
enum { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_I2C = 3, FUNCTION_SIO = 5 };

/* On an RP2350 a write without bit 8 also ends the isolation in which a reset leaves a pad. */
#define PADS_BANK0(pin) (PADS_BANK0_BASE + 4 + 4 * (uint32_t)(pin))
enum { PAD_FAST = 1, PAD_SCHMITT = 2, PAD_PULL_UP = 8, PAD_8_MA = 2 << 4, PAD_INPUT = 64 };

#define SIO_CPUID   0xd0000000
#define SIO_GPIO_IN 0xd0000004
#define SIO_FIFO_ST 0xd0000050
#define SIO_FIFO_WR 0xd0000054
#define SIO_FIFO_RD 0xd0000058
enum { FIFO_READABLE = 1, FIFO_WRITABLE = 2 };

#define UART0_DR    UART0_BASE
#define UART0_FR    (UART0_BASE + 0x18)
#define UART0_IBRD  (UART0_BASE + 0x24)
#define UART0_FBRD  (UART0_BASE + 0x28)
#define UART0_LCR_H (UART0_BASE + 0x2c)
#define UART0_CR    (UART0_BASE + 0x30)

/* Registers of an SPI unit; unit: 0 or 1. */
#define SPI_SSPCR0(unit)   SPI_BASE(unit)
#define SPI_SSPCR1(unit)   (SPI_BASE(unit) + 0x04)
#define SPI_SSPDR(unit)    (SPI_BASE(unit) + 0x08)
#define SPI_SSPSR(unit)    (SPI_BASE(unit) + 0x0c)
#define SPI_SSPCPSR(unit)  (SPI_BASE(unit) + 0x10)
#define SPI_SSPDMACR(unit) (SPI_BASE(unit) + 0x24)
enum { SSPSR_TNF = 2, SSPSR_BSY = 16, SSPCR1_SSE = 2, SSPDMACR_TXDMAE = 2 };

/* Registers of an I2C unit; unit: 0 or 1. */
#define IC_CON(unit)         I2C_BASE(unit)
#define IC_TAR(unit)         (I2C_BASE(unit) + 0x04)
#define IC_DATA_CMD(unit)    (I2C_BASE(unit) + 0x10)
#define IC_FS_SCL_HCNT(unit) (I2C_BASE(unit) + 0x1c)
#define IC_FS_SCL_LCNT(unit) (I2C_BASE(unit) + 0x20)
#define IC_INTR_STAT(unit)   (I2C_BASE(unit) + 0x2c)
#define IC_INTR_MASK(unit)   (I2C_BASE(unit) + 0x30)
#define IC_TX_TL(unit)       (I2C_BASE(unit) + 0x3c)
#define IC_CLR_TX_ABRT(unit) (I2C_BASE(unit) + 0x54)
#define IC_ENABLE(unit)      (I2C_BASE(unit) + 0x6c)
#define IC_STATUS(unit)      (I2C_BASE(unit) + 0x70)
#define IC_SDA_HOLD(unit)    (I2C_BASE(unit) + 0x7c)
#define IC_FS_SPKLEN(unit)   (I2C_BASE(unit) + 0xa0)
enum { CON_MASTER = 1, CON_FAST = 2 << 1, CON_RESTART = 1 << 5, CON_NO_SLAVE = 1 << 6 };
enum { DATA_CMD_STOP = 1 << 9 };
enum { INTR_TX_EMPTY = 1 << 4, INTR_TX_ABRT = 1 << 6 };
enum { STATUS_TFNF = 1 << 1, STATUS_TFE = 1 << 2, STATUS_MASTER = 1 << 5 };

#define DMA_CH0_READ_ADDR          0x50000000
#define DMA_CH0_WRITE_ADDR         0x50000004
#define DMA_CH0_TRANS_COUNT        0x50000008
#define DMA_CH0_CTRL_TRIG          0x5000000c
#define DMA_CH0_AL3_READ_ADDR_TRIG 0x5000003c
#define DMA_INTE0                  0x50000404
#define DMA_INTS0                  0x5000040c
enum { DMA_EN = 1, DMA_HALFWORDS = 1 << 2, DMA_INCR_READ = 1 << 4 };

#define TICK_CYCLES (CLK_HZ / 10) /* from tick to tick of each core, see rp2.h: 100 ms */

/* The crystal has 12 MHz. A PLL makes 12 MHz x 125 = 1500 MHz of it, which two post dividers make slower. */
static inline void start_pll(uint32_t pll, uint32_t reset, uint32_t post_dividers)
{
    REG_SET(RESETS_RESET) = reset;
    REG_CLEAR(RESETS_RESET) = reset;
    while ((REG(RESETS_RESET_DONE) & reset) == 0) {
    }
    REG(PLL_CS(pll)) = 1; /* reference: the crystal / 1 */
    REG(PLL_FBDIV_INT(pll)) = 125;
    REG_CLEAR(PLL_PWR(pll)) = 1 << 5 | 1; /* VCO and PLL on */
    while ((REG(PLL_CS(pll)) & 1U << 31) == 0) {
    }
    REG(PLL_PRIM(pll)) = post_dividers;
    REG_CLEAR(PLL_PWR(pll)) = 1 << 3; /* post dividers on */
}

#endif
