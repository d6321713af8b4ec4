/*
 * What the RP2350 takes as accesses to its registers; see registers/registers.h. Sections are those of the RP2350
 * datasheet (Raspberry Pi Ltd), and B11 those of the ARMv8-M Architecture Reference Manual (DDI 0553).
 */
#define S(rp2040, rp2350) rp2350

#define SYSINFO_BASE    0x40000000
#define CLOCKS_BASE     0x40010000
#define PSM_BASE        0x40018000
#define RESETS_BASE     0x40020000
#define IO_BANK0_BASE   0x40028000
#define PADS_BANK0_BASE 0x40038000
#define PADS_QSPI_BASE  0x40040000
#define XOSC_BASE       0x40048000
#define PLL_SYS_BASE    0x40050000
#define PLL_USB_BASE    0x40058000
#define UART0_BASE      0x40070000
#define SPI_BASE(unit)  ((unit) == 0 ? 0x40080000U : 0x40088000U)
#define TIMER_BASE      0x400b0000
#define XIP_BASE        0x400c8000
#define QMI_BASE        0x400d0000
#define WATCHDOG_BASE   0x400d8000
#define POWMAN_BASE     0x40100000
#define TICKS_BASE      0x40108000

#include "registers/rp2_rows.h"

#define TICKS_TIMER0_CTRL     (TICKS_BASE + 0x18)
#define TICKS_TIMER0_CYCLES   (TICKS_BASE + 0x1c)
#define TICKS_WATCHDOG_CTRL   (TICKS_BASE + 0x30)
#define TICKS_WATCHDOG_CYCLES (TICKS_BASE + 0x34)
#define SIO_MTIMECMP          (SIO_BASE + 0x1b8)

/* ---- what differs between the chips ------------------------------------------------------------------------------ */

/* Offsets. */
enum { SIO_GPIO_OUT_SET = 0x18, SIO_GPIO_OUT_CLR = 0x20, SIO_GPIO_OE_SET = 0x38, SIO_GPIO_OE_CLR = 0x40 };
enum { IO_BANK0_INTR = 0x230, TIMER_INTR = 0x3c, TIMER_INTE = 0x40, FC0 = 0x8c, CHIP_RESET = 0x2c };

#define RESET_DMA        (1U << 2)
#define RESET_IO_BANK0   (1U << 6)
#define RESET_PADS_BANK0 (1U << 9)
#define RESET_PLL_SYS    (1U << 14)
#define RESET_PLL_USB    (1U << 15)
#define RESET_SPI0       (1U << 18)
#define RESET_SPI1       (1U << 19)
#define RESET_SYSINFO    (1U << 21)
#define RESET_TIMER      (1U << 23)
#define RESET_UART0      (1U << 26)

#define PSM_ALL_BUT_OSCILLATORS 0x1fffff3 /* ROSC is bit 2, XOSC bit 3 */

/* The ROM has taken the flash's pins out of reset (5.2). clk_sys starts from the ring oscillator by the auxiliary mux.
 */
#define RESETS_AT_START  (0x1fffffff & ~(1 << 7 | 1 << 10))
#define CLK_SYS_AT_START 0x41
#define PAD_AT_START     0x116
#define PSM_PROC1_AT     24
#define DMA_SPI1_BIT     (1 << 18) /* TREQ_SEL is 24 for SPI0, 26 for SPI1 */
#define PAD_FIELDS       {"ISO", 8, 1, 0, 0, "the pad is not isolated"},

static const struct register_field resets_fields[] = {
    {"DMA", 2, 1, 0, 1, "in reset"},      {"IO_BANK0", 6, 1, 0, 1, "in reset"}, {"PADS_BANK0", 9, 1, 0, 1, "in reset"},
    {"PLL_SYS", 14, 1, 0, 1, "in reset"}, {"PLL_USB", 15, 1, 0, 1, "in reset"}, {"SPI0", 18, 1, 0, 1, "in reset"},
    {"SPI1", 19, 1, 0, 1, "in reset"},    {"SYSINFO", 21, 1, 0, 1, "in reset"}, {"TIMER0", 23, 1, 0, 1, "in reset"},
    {"UART0", 26, 1, 0, 1, "in reset"},
};
static const struct register_field clk_sys_fields[] = {
    {"SRC", 0, 1, 0, 1, "clk_ref, the auxiliary source"},
    {"AUXSRC", 5, 3, 0, 0, "the system PLL"},
    {"AUXSRC", 5, 3, 2, 2, "the ring oscillator, as after a reset"},
};
static const struct register_field clk_peri_fields[] = {
    {"AUXSRC", 5, 3, 0, 0, "clk_sys"},
    {"AUXSRC", 5, 3, 2, 2, "the USB PLL"},
    {"ENABLE", 11, 1, 0, 1, "on"},
};
static const struct register_field pll_prim_fields[] = {
    {"POSTDIV2", 12, 3, 1, 7, "divides"},
    {"POSTDIV1", 16, 3, 1, 7, "divides"},
};
static const struct register_field load_fields[] = {{"LOAD", 0, 24, 1, 0xffffff, "microseconds: one a tick"}};
static const struct register_field dma_control_fields[] = {
    {"EN", 0, 1, 0, 1, "on"},
    {"DATA_SIZE", 2, 2, 0, 0, "bytes"},
    {"DATA_SIZE", 2, 2, 1, 1, "halfwords"},
    {"INCR_READ", 4, 1, 0, 1, "reads one after the other"},
    {"CHAIN_TO", 13, 4, 0, 0, "itself: no other channel follows"},
    {"TREQ_SEL", 17, 6, 24, 24, "SPI0 asks for words"},
    {"TREQ_SEL", 17, 6, 26, 26, "SPI1 asks for words"},
    {"BSWAP", 24, 1, 0, 1, "the bytes of a halfword change places"},
};
#define TICKS_NEEDS IS(TICKS_WATCHDOG_CTRL, 1, 1)
#define TIMER_NEEDS IS(TICKS_TIMER0_CTRL, 1, 1)
#define CLK_PERI_NEEDS                                                                                                 \
    {                                                                                                                  \
        .changes = PERI_ENABLE, .sets = 2 << 5, PLL_RUNS(PLL_USB_BASE)                                                 \
    }
#define RESETS_NEEDS                                                                                                   \
    {.changes = RESET_PLL_USB,                                                                                         \
     .sets = RESET_PLL_USB,                                                                                            \
     IS(CLK_PERI_CTRL, PERI_ENABLE, 0),                                                                                \
     .why = "clk_peri is on, and may come from the PLL"},

#include "registers/rp2_peripherals_rows.h"

static const struct register_when pll_usb_off_when[] = PLL_OFF_WHEN(PLL_USB_BASE);
static const struct register_when pll_usb_pwr_when[] = PLL_PWR_WHEN(PLL_USB_BASE);
static const struct register_when pll_usb_when[] = {OUT_OF_RESET(RESET_PLL_USB)};
static const struct register_row pll_usb_rows[] = PLL_ROWS(pll_usb_off_when, pll_usb_pwr_when);

static const struct register_row watchdog_rows[] = {WATCHDOG_ROWS};

/* ---- ticks ------------------------------------------------------------------------------------------------------- */

static const struct register_field cycles_fields[] = {{"CYCLES", 0, 9, 12, 12, "a tick is 1 us"}};
#define TICK_CTRL_WHEN(cycles)                                                                                         \
    {                                                                                                                  \
        {.changes = 1, .sets = 1, AT_LEAST(cycles, 0x1ff, 12), .why = "CYCLES has not been set"},                      \
            {.changes = 1, .sets = 1, REF_IS_CRYSTAL},                                                                 \
    }
#define TICK_CYCLES_WHEN(control)                                                                                      \
    {                                                                                                                  \
        {                                                                                                              \
            IS(control, 1, 0), .why = "the tick runs"                                                                  \
        }                                                                                                              \
    }
static const struct register_when tick0_ctrl_when[] = TICK_CTRL_WHEN(TICKS_TIMER0_CYCLES);
static const struct register_when tick0_cycles_when[] = TICK_CYCLES_WHEN(TICKS_TIMER0_CTRL);
static const struct register_when tickw_ctrl_when[] = TICK_CTRL_WHEN(TICKS_WATCHDOG_CYCLES);
static const struct register_when tickw_cycles_when[] = TICK_CYCLES_WHEN(TICKS_WATCHDOG_CTRL);
static const struct register_row ticks_rows[] = {
    {"TIMER0_CTRL", 0x18, .start = 0, REGISTER_LIST(bit_fields), REGISTER_LIST(tick0_ctrl_when), "8.5"},
    {"TIMER0_CYCLES", 0x1c, .start = 0, REGISTER_LIST(cycles_fields), REGISTER_LIST(tick0_cycles_when), "8.5"},
    {"WATCHDOG_CTRL", 0x30, .start = 0, REGISTER_LIST(bit_fields), REGISTER_LIST(tickw_ctrl_when), "8.5"},
    {"WATCHDOG_CYCLES", 0x34, .start = 0, REGISTER_LIST(cycles_fields), REGISTER_LIST(tickw_cycles_when), "8.5"},
};

/* ---- the cache's counters, which a test reads ---------------------------------------------------------------------
 */

static const struct register_field hits_fields[] = {{"CTR", 0, 32, 0, UINT32_MAX, "any write clears it"}};
static const struct register_row xip_rows[] = {
    {"CTR_HIT", 0x0c, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(hits_fields), .source = "4.4.5"},
    {"CTR_ACC", 0x10, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(hits_fields), .source = "4.4.5"},
};

/* ---- flash: the QMI, and the pads of its window 0 ---------------------------------------------------------------- */

#define QMI_EN   1
#define QMI_BUSY 2

static const struct register_field direct_csr_fields[] = {
    {"EN", 0, 1, 0, 1, "direct mode: no reads from memory"},
    {"ASSERT_CS0N", 2, 1, 0, 1, "selects the flash"},
    {"AUTO_CS0N", 6, 1, 0, 1, "selects the flash while words are sent"},
    {"CLKDIV", 22, 8, 1, 255, "clk_sys / CLKDIV in direct mode"},
};
static const struct register_field direct_tx_fields[] = {{"DATA", 0, 16, 0, 0xff, "a byte on one line"}};
static const struct register_field timing_fields[] = {
    {"CLKDIV", 0, 8, 1, 255, "clk_sys / CLKDIV"},
    {"RXDELAY", 8, 3, 0, 7, "half cycles of clk_sys that data is sampled later"},
    {"MIN_DESELECT", 12, 5, 0, 31, "cycles between two reads, and half a clock"},
    {"SELECT_HOLD", 23, 2, 0, 3, "cycles that the flash stays selected after a read"},
    {"PAGEBREAK", 28, 2, 0, 3, "where a read that goes on begins anew"},
    {"COOLDOWN", 30, 2, 0, 3, "64 cycles each that a read may go on later"},
};
static const struct register_field rfmt_fields[] = {
    {"PREFIX_WIDTH", 0, 2, 0, 2, "one, two or four lines"},
    {"ADDR_WIDTH", 2, 2, 0, 2, "one, two or four lines"},
    {"SUFFIX_WIDTH", 4, 2, 0, 2, "one, two or four lines"},
    {"DUMMY_WIDTH", 6, 2, 0, 2, "one, two or four lines"},
    {"DATA_WIDTH", 8, 2, 0, 2, "one, two or four lines"},
    {"PREFIX_LEN", 12, 1, 0, 1, "a command of 8 bits"},
    {"SUFFIX_LEN", 14, 2, 0, 0, "no mode bits"},
    {"SUFFIX_LEN", 14, 2, 2, 2, "8 mode bits"},
    {"DUMMY_LEN", 16, 3, 0, 7, "4 bits each, of no meaning"},
};
static const struct register_field rcmd_fields[] = {
    {"PREFIX", 0, 8, 0, 255, "the command"},
    {"SUFFIX", 8, 8, 0, 255, "the mode bits"},
};
static const struct register_when direct_when[] = {
    {IS(QMI_BASE, QMI_EN, QMI_EN), .why = "direct mode is off (EN)"},
};
/* Transfers from memory may go on after EN until BUSY says that they have ended. */
static const struct register_when window_when[] = {
    {IS(QMI_BASE, QMI_EN, QMI_EN), .why = "flash may be read meanwhile: direct mode is off (EN)"},
    {SEEN(QMI_BASE, QMI_BUSY, 0), SINCE(QMI_BASE, QMI_EN), .why = "BUSY was not seen to be 0 in direct mode"},
};
static const struct register_row qmi_rows[] = {
    {"DIRECT_CSR", 0x00, .start = 0x01800000, REGISTER_LIST(direct_csr_fields), .source = "12.14.6"},
    {"DIRECT_TX", 0x04, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(direct_tx_fields),
     REGISTER_LIST(direct_when), "12.14.6"},
    {"DIRECT_RX", 0x08, .kind = REGISTER_STATUS, .source = "12.14.6"},
    {"M0_TIMING", 0x0c, .start = 0x40000004, REGISTER_LIST(timing_fields), REGISTER_LIST(window_when), "12.14.6"},
    {"M0_RFMT", 0x10, .start = 0x1000, REGISTER_LIST(rfmt_fields), REGISTER_LIST(window_when), "12.14.6"},
    {"M0_RCMD", 0x14, .start = 0xa003, REGISTER_LIST(rcmd_fields), REGISTER_LIST(window_when), "12.14.6"},
};
static const struct register_row pads_qspi_rows[] = {
    {"SCLK", 0x04, .start = 0x56, REGISTER_LIST(qspi_pad_fields), .source = "9.11.4"},
    {"SD", 0x08, 4, 4, .start = 0x56, REGISTER_LIST(qspi_pad_fields), .source = "9.11.4"},
};

/* ---- cores ------------------------------------------------------------------------------------------------------- */

static const struct register_field mtime_ctrl_fields[] = {
    {"FULLSPEED, EN", 0, 2, 3, 3, "counts the cores' cycles"},
    {"DBGPAUSE", 2, 2, 0, 3, "no pixel: only while a debugger has halted a core"},
};
/* RISC-V Privileged Architecture, 3.2.1: until both halves are new, the time of before or of never must stand there. */
static const struct register_when mtimecmph_when[] = {
    {IS(SIO_MTIMECMP, UINT32_MAX, UINT32_MAX), .why = "with the old MTIMECMP the new time may have passed"},
};
static const struct register_row sio_rows[] = {
    SIO_ROWS,
    {"MTIME_CTRL", 0x1a4, .start = 0xd, REGISTER_LIST(mtime_ctrl_fields), .source = "3.1.8"},
    {"MTIME", 0x1b0, .kind = REGISTER_STATUS, .source = "3.1.8"},
    {"MTIMEH", 0x1b4, .kind = REGISTER_STATUS, .source = "3.1.8"},
    {"MTIMECMP", 0x1b8, .start = UINT32_MAX, REGISTER_LIST(any_fields), .source = "3.1.8"},
    {"MTIMECMPH", 0x1bc, .start = UINT32_MAX, REGISTER_LIST(any_fields), REGISTER_LIST(mtimecmph_when), "3.1.8"},
};

static const struct register_field iser_fields[] = {
    {"TIMER0_IRQ_0", 0, 1, 0, 1, "enabled"},
    {"DMA_IRQ_0", 10, 1, 0, 1, "enabled"},
};
/* The ROM has written VTOR; the port reads it. */
static const struct register_row ppb_rows[] = {
    SYSTICK_ROWS,
    {"NVIC_ISER", 0x100, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(iser_fields), .source = "B11"},
    {"VTOR", 0xd08, .kind = REGISTER_STATUS, .source = "B11"},
};

static const struct register_block blocks[] = {
    {"SIO", SIO_BASE, 0x200, .per_core = true, REGISTER_LIST(sio_rows)},
    {"DMA", DMA_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(dma_rows), REGISTER_LIST(dma_when)},
    {"SPI0", SPI_BASE(0), 0x4000, .aliases = true, false, REGISTER_LIST(spi0_rows), REGISTER_LIST(spi0_when)},
    {"SPI1", SPI_BASE(1), 0x4000, .aliases = true, false, REGISTER_LIST(spi1_rows), REGISTER_LIST(spi1_when)},
    {"TIMER0", TIMER_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(timer_rows), REGISTER_LIST(timer_when)},
    {"UART0", UART0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(uart_rows), REGISTER_LIST(uart_when)},
    {"RESETS", RESETS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(resets_rows)},
    {"CLOCKS", CLOCKS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(clocks_rows)},
    {"XOSC", XOSC_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(xosc_rows)},
    {"PLL_SYS", PLL_SYS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pll_sys_rows), REGISTER_LIST(pll_sys_when)},
    {"PLL_USB", PLL_USB_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pll_usb_rows), REGISTER_LIST(pll_usb_when)},
    {"PSM", PSM_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(psm_rows)},
    {"WATCHDOG", WATCHDOG_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(watchdog_rows)},
    {"TICKS", TICKS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(ticks_rows)},
    {"IO_BANK0", IO_BANK0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(io_bank0_rows),
     REGISTER_LIST(io_bank0_when)},
    {"PADS_BANK0", PADS_BANK0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pads_rows), REGISTER_LIST(pads_when)},
    {"PADS_QSPI", PADS_QSPI_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pads_qspi_rows)},
    {"XIP", XIP_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(xip_rows)},
    {"QMI", QMI_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(qmi_rows)},
    {"SYSINFO", SYSINFO_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(sysinfo_rows), REGISTER_LIST(sysinfo_when)},
    {"POWMAN", POWMAN_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(chip_reset_rows)},
    {"PPB", PPB_BASE, 0x1000, .per_core = true, REGISTER_LIST(ppb_rows)},
};

const struct register_chip rp2350_registers = {"RP2350", "RP2350 datasheet", REGISTER_LIST(blocks), RESETS_RESET};
