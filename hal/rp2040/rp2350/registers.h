/*
 * registers: of the RP2350, in the place of ../registers.h, whose guard this file has: port.mk lets the compiler read
 * it first. Names, addresses and bits are those of the RP2350 datasheet (Raspberry Pi Ltd), sections 3.1 (SIO), 5.4
 * (ROM), 7.5 (resets), 8.1 .. 8.6 (clocks), 7.4 (power-on state machine), 9.11 (GPIO), 12.1 (UART), 12.3 (SPI), 12.6
 * (DMA), 12.8 (timer), 12.9 (watchdog).
 */
#ifndef RP2040_REGISTERS_H
#define RP2040_REGISTERS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))
/* Sets or clears only the bits that are written as 1. */
#define REG_SET(address)   REG((address) + 0x2000)
#define REG_CLEAR(address) REG((address) + 0x3000)

#define RESETS_RESET      0x40020000
#define RESETS_RESET_DONE 0x40020008
enum {
    RESET_DMA = 1 << 2,
    RESET_IO_BANK0 = 1 << 6,
    RESET_PADS_BANK0 = 1 << 9,
    RESET_PLL_SYS = 1 << 14,
    RESET_PLL_USB = 1 << 15,
    RESET_SPI0 = 1 << 18,
    RESET_SPI1 = 1 << 19,
    RESET_TIMER = 1 << 23,
    RESET_UART0 = 1 << 26,
};

#define CLK_REF_CTRL     0x40010030
#define CLK_REF_SELECTED 0x40010038
#define CLK_SYS_CTRL     0x4001003c
#define CLK_SYS_SELECTED 0x40010044
#define CLK_PERI_CTRL    0x40010048

#define XOSC_CTRL    0x40048000
#define XOSC_STATUS  0x40048004
#define XOSC_STARTUP 0x4004800c

#define PLL_SYS_CS        0x40050000
#define PLL_SYS_PWR       0x40050004
#define PLL_SYS_FBDIV_INT 0x40050008
#define PLL_SYS_PRIM      0x4005000c
#define PLL_USB_CS        0x40058000
#define PLL_USB_PWR       0x40058004
#define PLL_USB_FBDIV_INT 0x40058008
#define PLL_USB_PRIM      0x4005800c

#define PSM_FRCE_OFF 0x40018004
#define PSM_WDSEL    0x40018008
enum { PSM_OSCILLATORS = 3 << 2, PSM_PROC1 = 1 << 24, PSM_ALL = 0x1ffffff };

#define WATCHDOG_CTRL         0x400d8000
#define WATCHDOG_LOAD         0x400d8004
#define WATCHDOG_REASON       0x400d8008
#define WATCHDOG_SCRATCH0     0x400d800c
#define TICKS_TIMER0_CTRL     0x40108018
#define TICKS_TIMER0_CYCLES   0x4010801c
#define TICKS_WATCHDOG_CTRL   0x40108030
#define TICKS_WATCHDOG_CYCLES 0x40108034
enum { WATCHDOG_ENABLE = 1 << 30, REASON_TIMER = 1 };

#define TIMER_ALARM0   0x400b0010
#define TIMER_TIMERAWL 0x400b0028
#define TIMER_INTR     0x400b003c
#define TIMER_INTE     0x400b0040

#define IO_BANK0_CTRL(pin)  (0x40028004 + 8 * (uint32_t)(pin))
#define IO_BANK0_INTR(pin)  (0x40028230 + 4 * ((uint32_t)(pin) / 8))
#define INTR_EDGE_HIGH(pin) (8U << 4 * ((uint32_t)(pin) % 8))
enum { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_SIO = 5 };

/* A write without bit 8 also ends the isolation in which a reset leaves a pad. */
#define PADS_BANK0(pin) (0x40038004 + 4 * (uint32_t)(pin))
enum { PAD_FAST = 1, PAD_SCHMITT = 2, PAD_PULL_UP = 8, PAD_8_MA = 2 << 4, PAD_INPUT = 64 };

#define SIO_CPUID        0xd0000000
#define SIO_GPIO_IN      0xd0000004
#define SIO_GPIO_OUT_SET 0xd0000018
#define SIO_GPIO_OUT_CLR 0xd0000020
#define SIO_GPIO_OE_SET  0xd0000038
#define SIO_GPIO_OE_CLR  0xd0000040
#define SIO_FIFO_ST      0xd0000050
#define SIO_FIFO_WR      0xd0000054
#define SIO_FIFO_RD      0xd0000058
enum { FIFO_READABLE = 1, FIFO_WRITABLE = 2 };

#define UART0_DR    0x40070000
#define UART0_FR    0x40070018
#define UART0_IBRD  0x40070024
#define UART0_FBRD  0x40070028
#define UART0_LCR_H 0x4007002c
#define UART0_CR    0x40070030

/* Of SPI unit 0 or 1. */
#define SPI_BASE(unit)     (0x40080000 + 0x8000 * (uint32_t)(unit))
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
    DMA_BSWAP = 1 << 24,
    DMA_BUSY = 1 << 26,
};
#define DMA_TREQ_SPI_TX(unit) ((24U + 2U * (uint32_t)(unit)) << 17)

/* Each core's own; ARMv8-M Architecture Reference Manual B11 (SysTick), D1.2 (registers). */
#define SYST_CSR  0xe000e010
#define SYST_RVR  0xe000e014
#define SYST_CVR  0xe000e018
#define NVIC_ISER 0xe000e100
#define VTOR      0xe000ed08
enum { IRQ_TIMER_0 = 0, IRQ_DMA_0 = 10 };

#define CLK_HZ            150000000 /* clk_sys, see clocks.c */
#define CLK_PERI_HZ       125000000 /* of SPI and UART: SPI makes 62.5 MHz of it, and would make 37.5 of 150 */
#define PLL_SYS_POST_DIV  (5 << 16 | 2 << 12) /* 1500 MHz / 5 / 2 */
#define WATCHDOG_TICKS_US 1

/* clk_peri comes from the PLL that nobody needs for USB: 1500 MHz / 6 / 2. */
static inline void start_clk_peri(void)
{
    REG(CLK_PERI_CTRL) = 0;
    REG_SET(RESETS_RESET) = RESET_PLL_USB;
    REG_CLEAR(RESETS_RESET) = RESET_PLL_USB;
    while ((REG(RESETS_RESET_DONE) & RESET_PLL_USB) == 0) {
    }
    REG(PLL_USB_CS) = 1;
    REG(PLL_USB_FBDIV_INT) = 125;
    REG_CLEAR(PLL_USB_PWR) = 1 << 5 | 1;
    while ((REG(PLL_USB_CS) & 1U << 31) == 0) {
    }
    REG(PLL_USB_PRIM) = 6 << 16 | 2 << 12;
    REG_CLEAR(PLL_USB_PWR) = 1 << 3;
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

/* The stack pointer of the core that calls it never goes below the end of the region: a push that would is a fault. */
static inline void guard_stack(uint32_t from, uint32_t bytes_log2)
{
    __asm volatile("msr msplim, %0" : : "r"(from + (1U << bytes_log2)));
}

typedef void *lookup_fn(uint32_t code, uint32_t mask);
typedef int reboot_fn(uint32_t flags, uint32_t delay_ms, uint32_t p0, uint32_t p1);

/* Calls the ROM's reboot(), which the ROM finds by two letters and the caller's state (RP2350 datasheet 5.4.8.24). The
 * asm hides the address: compilers expect no object so near to 0. */
static inline void start_boot_loader(void)
{
    uintptr_t at = 0x16;
    __asm("" : "+r"(at));
    lookup_fn *const lookup = (lookup_fn *)(uintptr_t) * (const uint16_t *)at;
    ((reboot_fn *)lookup('R' | 'B' << 8, 4))(0x102, 10, 0, 0); /* secure Arm; boot loader, does not return */
}

#endif
