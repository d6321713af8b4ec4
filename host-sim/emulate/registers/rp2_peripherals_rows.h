/*
 * rp2_peripherals_rows: the registers that the RP2040 and the RP2350 have in common, as rows of their tables
 * (registers_table.c). A row's source is a section of the chip's own datasheet; DDI 0183 is Arm's manual of the PL011,
 * DDI 0194 that of the PL022.
 *
 * What differs the chip's table says before it includes this: S(rp2040, rp2350) takes the chip's one of two texts; the
 * others are its bits, offsets, fields and needs.
 */
#ifndef RP2_PERIPHERALS_ROWS_H
#define RP2_PERIPHERALS_ROWS_H

#include "registers/rp2_rows.h"

/* ---- resets ------------------------------------------------------------------------------------------------------ */

#define USES_CLK_PERI (RESET_UART0 | RESET_SPI0 | RESET_SPI1)

static const struct register_when resets_when[] = {
    {.changes = RESET_PLL_SYS,
     .sets = RESET_PLL_SYS,
     SEEN(CLK_SYS_SELECTED, 3, 1),
     SINCE(CLK_SYS_CTRL, SYS_SRC),
     .why = "clk_sys may still come from the PLL: SELECTED did not say that it is clk_ref"},
    {.changes = USES_CLK_PERI,
     .clears = USES_CLK_PERI,
     IS(CLK_PERI_CTRL, PERI_ENABLE, PERI_ENABLE),
     .why = "UART and SPI leave reset only with clk_peri, which is off"},
    RESETS_NEEDS};

static const struct register_row resets_rows[] = {
    {"RESET", 0x00, .start = RESETS_AT_START, REGISTER_LIST(resets_fields), REGISTER_LIST(resets_when),
     S("2.14.3", "7.5")},
    {"RESET_DONE", 0x08, .kind = REGISTER_STATUS, .source = S("2.14.3", "7.5")},
};

/* ---- clocks, oscillator, PLLs ------------------------------------------------------------------------------------ */

static const struct register_field clk_ref_fields[] = {
    {"SRC", 0, 2, 0, 0, "the ring oscillator"},
    {"SRC", 0, 2, 2, 2, "the crystal"},
};

static const struct register_when clk_ref_when[] = {
    {.changes = 3, .sets = 2, CRYSTAL_RUNS},
};

static const struct register_when clk_sys_when[] = {
    {.changes = AUXSRC, IS(CLK_SYS_CTRL, SYS_SRC, 0), .why = "AUXSRC glitches, and clk_sys runs from it"},
    {.changes = AUXSRC,
     .sets = SYS_SRC,
     IS(CLK_SYS_CTRL, SYS_SRC, SYS_SRC),
     .why = "AUXSRC glitches, and clk_sys turns to it at the same time"},
    {.changes = AUXSRC,
     SEEN(CLK_SYS_SELECTED, 3, 1),
     SINCE(CLK_SYS_CTRL, SYS_SRC),
     .why = "SELECTED did not say that clk_sys has left the auxiliary source"},
    {.changes = SYS_SRC, .sets = SYS_SRC, PLL_RUNS(PLL_SYS_BASE)},
};

static const struct register_when clk_peri_when[] = {
    {.changes = AUXSRC, IS(CLK_PERI_CTRL, PERI_ENABLE, 0), .why = "AUXSRC glitches, and clk_peri is on"},
    {.changes = AUXSRC,
     .sets = PERI_ENABLE,
     IS(CLK_PERI_CTRL, PERI_ENABLE, PERI_ENABLE),
     .why = "AUXSRC glitches, and clk_peri turns on at the same time"},
    {.changes = AUXSRC,
     WAITED(CLK_PERI_CTRL, PERI_ENABLE, 1000),
     .why = "clk_peri stops after two cycles of its source, which may be slow: 1 us has not passed"},
    CLK_PERI_NEEDS,
};

/* The frequency counter: a write to SRC starts it. */
#define FC0_SRC    (CLOCKS_BASE + FC0 + 0x14)
#define FC0_STATUS (CLOCKS_BASE + FC0 + 0x18)
static const struct register_field fc0_ref_fields[] = {{"REF_KHZ", 0, 20, 12000, 12000, "clk_ref is the crystal"}};
static const struct register_field fc0_interval_fields[] = {{"INTERVAL", 0, 4, 0, 15, "counts for 2^INTERVAL us"}};
static const struct register_field fc0_src_fields[] = {
    {"SRC", 0, 8, 0, 0, "stops"},
    {"SRC", 0, 8, 3, 3, "the ring oscillator"},
    {"SRC", 0, 8, 5, 5, "the crystal"},
    {"SRC", 0, 8, 9, 10, "clk_sys, clk_peri"},
};
static const struct register_when fc0_idle_when[] = {
    {SEEN(FC0_STATUS, 1 << 8, 0), SINCE(FC0_SRC, 0), .why = "it may count: RUNNING was not seen to be 0"},
};
static const struct register_when fc0_src_when[] = {
    {.sets = 0xff, SEEN(FC0_STATUS, 1 << 8, 0), SINCE(FC0_SRC, 0), .why = "it may count: RUNNING was not seen to be 0"},
    {.sets = 0xff, AT_LEAST(CLOCKS_BASE + FC0, 0xfffff, 1), .why = "REF_KHZ has not been set"},
    {.sets = 0xff, REF_IS_CRYSTAL},
};

#define FC0_ROWS                                                                                                        \
    {                                                                                                                   \
        "FC0_REF_KHZ",       FC0, .start = 0, REGISTER_LIST(fc0_ref_fields), REGISTER_LIST(fc0_idle_when),              \
        S("2.15.6.2", "8.1")},                                                                                          \
        {"FC0_INTERVAL",      FC0 + 0x10, .start = 8, REGISTER_LIST(fc0_interval_fields), REGISTER_LIST(fc0_idle_when), \
         S("2.15.6.2", "8.1")},                                                                                         \
        {"FC0_SRC",           FC0 + 0x14, .start = 0, REGISTER_LIST(fc0_src_fields), REGISTER_LIST(fc0_src_when),       \
         S("2.15.6.2", "8.1")},                                                                                         \
        {"FC0_STATUS", FC0 + 0x18, .kind = REGISTER_STATUS, .source = S("2.15.6.2", "8.1")},                            \
    {                                                                                                                   \
        "FC0_RESULT", FC0 + 0x1c, .kind = REGISTER_STATUS, .source = S("2.15.6.2", "8.1")                               \
    }

static const struct register_row clocks_rows[] = {
    FC0_ROWS,
    {"CLK_REF_CTRL", 0x30, .start = 0, REGISTER_LIST(clk_ref_fields), REGISTER_LIST(clk_ref_when), S("2.15.3", "8.1")},
    {"CLK_REF_SELECTED", 0x38, .kind = REGISTER_STATUS, .source = S("2.15.3", "8.1")},
    {"CLK_SYS_CTRL", 0x3c, .start = CLK_SYS_AT_START, REGISTER_LIST(clk_sys_fields), REGISTER_LIST(clk_sys_when),
     S("2.15.3", "8.1")},
    {"CLK_SYS_SELECTED", 0x44, .kind = REGISTER_STATUS, .source = S("2.15.3", "8.1")},
    {"CLK_PERI_CTRL", 0x48, .start = 0, REGISTER_LIST(clk_peri_fields), REGISTER_LIST(clk_peri_when),
     S("2.15.3", "8.1")},
};

/* Both boards' crystal has 12 MHz: 47 x 256 of its cycles are 1 ms. Its field takes 64 times as long, too. */
static const struct register_field startup_fields[] = {{"DELAY", 0, 14, 47, 0x3fff, "STABLE after 256 cycles each"}};

static const struct register_when startup_when[] = {
    {IS(XOSC_CTRL, XOSC_ENABLE, 0), .why = "the crystal has been started, and counts already"},
};

static const struct register_field xosc_fields[] = {
    {"FREQ_RANGE", 0, 12, 0xaa0, 0xaa0, "1 to 15 MHz"},
    {"ENABLE", 12, 12, 0xfab, 0xfab, "on; every other code starts it, too (RP2040), or is ignored (RP2350)"},
};

static const struct register_when xosc_when[] = {
    {.changes = XOSC_ENABLE, WRITTEN(XOSC_STARTUP), .why = "STARTUP has not been written"},
};

static const struct register_row xosc_rows[] = {
    {"CTRL", 0x00, .start = 0, REGISTER_LIST(xosc_fields), REGISTER_LIST(xosc_when), S("2.16.7", "8.2")},
    {"STATUS", 0x04, .kind = REGISTER_STATUS, .source = S("2.16.7", "8.2")},
    {"STARTUP", 0x0c, .start = 0, REGISTER_LIST(startup_fields), REGISTER_LIST(startup_when), S("2.16.3", "8.2")},
};

/* The VCO runs at 750 to 1600 MHz: 12 MHz x 63 to 133. */
#define PLL_FBDIV_LEAST 63
static const struct register_field pll_cs_fields[] = {{"REFDIV", 0, 6, 1, 1, "the crystal / 1"}};
static const struct register_field pll_fbdiv_fields[] = {
    {"FBDIV_INT", 0, 12, PLL_FBDIV_LEAST, 133, "the VCO at so many times 12 MHz"},
};
static const struct register_field pll_pwr_fields[] = {
    {"PD", 0, 1, 0, 1, "the PLL is off"},
    {"POSTDIVPD", 3, 1, 0, 1, "the post dividers are off"},
    {"VCOPD", 5, 1, 0, 1, "the VCO is off"},
};

/* The order of the RP2040 datasheet's 2.18.3: dividers, power, LOCK, post dividers and their power. */
#define PLL_OFF_WHEN(pll)                                                                                              \
    {                                                                                                                  \
        {                                                                                                              \
            IS(PLL_PWR(pll), PLL_VCO_OFF, PLL_VCO_OFF), .why = "the PLL is on"                                         \
        }                                                                                                              \
    }
#define PLL_PWR_WHEN(pll)                                                                                              \
    {                                                                                                                  \
        {.changes = PLL_VCO_OFF, .clears = PLL_VCO_OFF, CRYSTAL_RUNS},                                                 \
            {.changes = PLL_VCO_OFF,                                                                                   \
             .clears = PLL_VCO_OFF,                                                                                    \
             AT_LEAST(PLL_FBDIV_INT(pll), 0xfff, PLL_FBDIV_LEAST),                                                     \
             .why = "FBDIV_INT has not been set"},                                                                     \
            {.changes = PLL_POST_OFF,                                                                                  \
             .clears = PLL_POST_OFF,                                                                                   \
             IS(PLL_PWR(pll), PLL_VCO_OFF, 0),                                                                         \
             .why = "the post dividers come after the VCO"},                                                           \
            {.changes = PLL_POST_OFF,                                                                                  \
             .clears = PLL_POST_OFF,                                                                                   \
             SEEN(PLL_CS(pll), 1U << 31, 1U << 31),                                                                    \
             SINCE(PLL_PWR(pll), PLL_VCO_OFF),                                                                         \
             .why = "LOCK was not seen since the VCO went on"},                                                        \
            {.changes = PLL_POST_OFF,                                                                                  \
             .clears = PLL_POST_OFF,                                                                                   \
             WRITTEN(PLL_PRIM(pll)),                                                                                   \
             .why = "PRIM has not been written"},                                                                      \
    }
static const struct register_when pll_sys_off_when[] = PLL_OFF_WHEN(PLL_SYS_BASE);
static const struct register_when pll_sys_pwr_when[] = PLL_PWR_WHEN(PLL_SYS_BASE);
static const struct register_when pll_sys_when[] = {OUT_OF_RESET(RESET_PLL_SYS)};

#define PLL_ROWS(off_when, pwr_when)                                                                                   \
    {                                                                                                                  \
        {"CS", 0x00, .start = 1, REGISTER_LIST(pll_cs_fields), REGISTER_LIST(off_when), S("2.18.3", "8.6")},           \
            {"PWR", 0x04, .start = 0x2d, REGISTER_LIST(pll_pwr_fields), REGISTER_LIST(pwr_when), S("2.18.3", "8.6")},  \
            {"FBDIV_INT",       0x08, .start = 0, REGISTER_LIST(pll_fbdiv_fields), REGISTER_LIST(off_when),            \
             S("2.18.3", "8.6")},                                                                                      \
            {"PRIM", 0x0c, .start = 0x77000, REGISTER_LIST(pll_prim_fields), .source = S("2.18.3", "8.6")},            \
    }
static const struct register_row pll_sys_rows[] = PLL_ROWS(pll_sys_off_when, pll_sys_pwr_when);

/* ---- power-on state machine, watchdog, timer --------------------------------------------------------------------- */

static const struct register_field psm_off_fields[] = {
    {"PROC1", PSM_PROC1_AT, 1, 0, 1, "core 1 is held in reset; after it, it waits in the ROM"},
};
static const struct register_field psm_wdsel_fields[] = {
    {"all bits", 0, 32, PSM_ALL_BUT_OSCILLATORS, PSM_ALL_BUT_OSCILLATORS,
     "the watchdog resets all but the oscillators; no emulator follows a reset of less"},
};
#define PSM_PROC1 (1U << PSM_PROC1_AT)
static const struct register_when psm_off_when[] = {
    {.changes = PSM_PROC1,
     .clears = PSM_PROC1,
     SEEN(PSM_FRCE_OFF, PSM_PROC1, PSM_PROC1),
     SINCE(PSM_FRCE_OFF, PSM_PROC1),
     .why = "core 1 was not seen to be in reset"},
};

static const struct register_row psm_rows[] = {
    {"FRCE_OFF", 0x04, .start = 0, REGISTER_LIST(psm_off_fields), REGISTER_LIST(psm_off_when), S("2.13.5", "7.4")},
    {"WDSEL", 0x08, .start = 0, REGISTER_LIST(psm_wdsel_fields), .source = S("2.13.5", "7.4")},
};

static const struct register_field watchdog_fields[] = {{"ENABLE", 30, 1, 0, 1, "the watchdog counts down"}};
static const struct register_when watchdog_when[] = {
    {.changes = WATCHDOG_ENABLE, .sets = WATCHDOG_ENABLE, TICKS_NEEDS, .why = "the watchdog has no tick of 1 us"},
    {.changes = WATCHDOG_ENABLE, .sets = WATCHDOG_ENABLE, WRITTEN(WATCHDOG_LOAD), .why = "LOAD has not been written"},
    {.changes = WATCHDOG_ENABLE,
     .sets = WATCHDOG_ENABLE,
     WRITTEN(PSM_WDSEL),
     .why = "WDSEL has not been written: the watchdog would reset nothing"},
};

#define WATCHDOG_ROWS                                                                                                  \
    {"CTRL",                                                                                                           \
     0x00,                                                                                                             \
     .start = 0x07000000,                                                                                              \
     REGISTER_LIST(watchdog_fields),                                                                                   \
     REGISTER_LIST(watchdog_when),                                                                                     \
     S("4.7.6", "12.9")},                                                                                              \
        {"LOAD", 0x04, .start = 0, REGISTER_LIST(load_fields), .source = S("4.7.6", "12.9")},                          \
        {"REASON", 0x08, .kind = REGISTER_STATUS, .source = S("4.7.6", "12.9")},                                       \
    {                                                                                                                  \
        "SCRATCH0", 0x0c, .start = 0, REGISTER_LIST(any_fields), .source = S("4.7.6", "12.9")                          \
    }

static const struct register_when timer_when[] = {
    OUT_OF_RESET(RESET_TIMER),
    {TIMER_NEEDS, .why = "the timer has no tick of 1 us"},
};
static const struct register_row timer_rows[] = {
    {"ALARM0", 0x10, .start = 0, REGISTER_LIST(any_fields), .source = S("4.6.5", "12.8")},
    {"TIMERAWL", 0x28, .kind = REGISTER_STATUS, .source = S("4.6.5", "12.8")},
    {"INTR", TIMER_INTR, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(bit_fields), .source = S("4.6.5", "12.8")},
    {"INTE", TIMER_INTE, .start = 0, REGISTER_LIST(bit_fields), .source = S("4.6.5", "12.8")},
};

/* ---- what the chip says of itself -------------------------------------------------------------------------------- */

static const struct register_when sysinfo_when[] = {OUT_OF_RESET(RESET_SYSINFO)};
static const struct register_row sysinfo_rows[] = {
    {"CHIP_ID", 0x00, .kind = REGISTER_STATUS, .source = S("2.20", "12.15")},
};
static const struct register_row chip_reset_rows[] = {
    {"CHIP_RESET", CHIP_RESET, .kind = REGISTER_STATUS, .source = S("2.10", "6.4")},
};

/* ---- pins -------------------------------------------------------------------------------------------------------- */

/* Which function a pin has depends on its number: of SPI, clock and data out are of use; the UART is on GP0 and GP1. */
static const struct register_field uart_pin_fields[] = {
    {"FUNCSEL", 0, 5, FUNCTION_UART, FUNCTION_UART, "UART0: TX of GP0, RX of GP1"},
    {"FUNCSEL", 0, 5, FUNCTION_SIO, FUNCTION_SIO, "a pin of SIO"},
};
static const struct register_field i2c_pin_fields[] = {
    {"FUNCSEL", 0, 5, FUNCTION_I2C, FUNCTION_I2C, "I2C0's data where number % 4 is 0, its clock where it is 1"},
    {"FUNCSEL", 0, 5, FUNCTION_SIO, FUNCTION_SIO, "a pin of SIO"},
};
static const struct register_field spi_pin_fields[] = {
    {"FUNCSEL", 0, 5, FUNCTION_SPI, FUNCTION_SPI, "SPI's clock where number % 4 is 2, its data out where it is 3"},
    {"FUNCSEL", 0, 5, FUNCTION_SIO, FUNCTION_SIO, "a pin of SIO"},
};
static const struct register_field edge_fields[] = {
    {"GPIO0_EDGE_HIGH", 3, 1, 0, 1, "forgets a rising edge"},
    {"GPIO1_EDGE_HIGH", 7, 1, 0, 1, "forgets a rising edge"},
    {"GPIO2_EDGE_HIGH", 11, 1, 0, 1, "forgets a rising edge"},
    {"GPIO3_EDGE_HIGH", 15, 1, 0, 1, "forgets a rising edge"},
    {"GPIO4_EDGE_HIGH", 19, 1, 0, 1, "forgets a rising edge"},
    {"GPIO5_EDGE_HIGH", 23, 1, 0, 1, "forgets a rising edge"},
    {"GPIO6_EDGE_HIGH", 27, 1, 0, 1, "forgets a rising edge"},
    {"GPIO7_EDGE_HIGH", 31, 1, 0, 1, "forgets a rising edge"},
};

static const struct register_when io_bank0_when[] = {OUT_OF_RESET(RESET_IO_BANK0)};
static const struct register_row io_bank0_rows[] = {
    {"GPIO0_1_CTRL", 0x04, 2, 8, .start = 31, REGISTER_LIST(uart_pin_fields), .source = S("2.19.2", "9.4")},
    {"GPIO2_6_.._CTRL", 0x14, 7, 32, .start = 31, REGISTER_LIST(spi_pin_fields), .source = S("2.19.2", "9.4")},
    {"GPIO3_7_.._CTRL", 0x1c, 7, 32, .start = 31, REGISTER_LIST(spi_pin_fields), .source = S("2.19.2", "9.4")},
    {"GPIO4_8_.._CTRL", 0x24, 7, 32, .start = 31, REGISTER_LIST(i2c_pin_fields), .source = S("2.19.2", "9.4")},
    {"GPIO5_9_.._CTRL", 0x2c, 7, 32, .start = 31, REGISTER_LIST(i2c_pin_fields), .source = S("2.19.2", "9.4")},
    {"INTR", IO_BANK0_INTR, 4, 4, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(edge_fields),
     .source = S("2.19.6", "9.11")},
};

static const struct register_field pad_fields[] = {
    {"SLEWFAST", 0, 1, 0, 1, "no pixel: how steep edges are; 62.5 MHz want them fast"},
    {"SCHMITT", 1, 1, 0, 1, "no pixel: hysteresis of the input"},
    {"PDE", 2, 1, 0, 0, "no pull-down"},
    {"PUE", 3, 1, 0, 1, "pull-up"},
    {"DRIVE", 4, 2, 0, 2, "no pixel: 2 to 8 mA, more than the inputs of a panel take"},
    {"IE", 6, 1, 0, 1, "the input can be read"},
    PAD_FIELDS};
static const struct register_when pads_when[] = {OUT_OF_RESET(RESET_PADS_BANK0)};
static const struct register_row pads_rows[] = {
    {"GPIO", 0x04, 30, 4, .start = PAD_AT_START, REGISTER_LIST(pad_fields), .source = S("2.19.6", "9.11")},
};

static const struct register_field qspi_pad_fields[] = {
    {"SLEWFAST", 0, 1, 0, 1, "no pixel: how steep edges are; the margin of reads depends on it"},
    {"SCHMITT", 1, 1, 0, 1, "no pixel: hysteresis of the input, which delays it"},
    {"PDE", 2, 1, 0, 1, "no pixel: pulls down while nobody drives the line"},
    {"DRIVE", 4, 2, 1, 2, "no pixel: 4 or 8 mA"},
    {"IE", 6, 1, 0, 1, "the input can be read"},
};

/* ---- UART -------------------------------------------------------------------------------------------------------- */

/* 125 MHz / (16 x 115200) = 67.8; with any fraction 67 makes 114.9 to 116.6 kbaud, which receivers take. */
static const struct register_field ibrd_fields[] = {{"BAUD_DIVINT", 0, 16, 67, 67, "115200 baud of 125 MHz"}};
static const struct register_field fbrd_fields[] = {{"BAUD_DIVFRAC", 0, 6, 0, 63, "64ths of BAUD_DIVINT"}};
static const struct register_field lcr_h_fields[] = {
    {"FEN", 4, 1, 1, 1, "FIFOs"},
    {"WLEN", 5, 2, 3, 3, "8 bits"},
};
static const struct register_field uart_cr_fields[] = {
    {"UARTEN", 0, 1, 0, 1, "on"},
    {"TXE", 8, 1, 0, 1, "sends"},
    {"RXE", 9, 1, 0, 1, "receives"},
};
static const struct register_field byte_fields[] = {{"DATA", 0, 8, 0, 255, "a byte to send"}};
static const struct register_when uart_off_when[] = {
    {IS(UART0_CR, 1, 0), .why = "the UART is on"},
};
static const struct register_when uart_cr_when[] = {
    {.changes = 1, .sets = 1, AT_LEAST(UART0_IBRD, 0xffff, 1), .why = "IBRD has not been set"},
    {.changes = 1,
     .sets = 1,
     WRITTEN(UART0_LCR_H),
     SINCE(UART0_IBRD, 0),
     .why = "LCR_H, which takes IBRD over, has not been written since"},
    {.changes = 1,
     .sets = 1,
     WRITTEN(UART0_LCR_H),
     SINCE(UART0_FBRD, 0),
     .why = "LCR_H, which takes FBRD over, has not been written since"},
};
static const struct register_when uart_dr_when[] = {
    {IS(UART0_CR, 0x101, 0x101), .why = "the UART is off, or does not send"},
    {SEEN(UART0_FR, 1 << 5, 0), SINCE(UART0_DR, 0), .why = "the FIFO may be full: TXFF was not seen to be 0"},
};

static const struct register_when uart_when[] = {OUT_OF_RESET(RESET_UART0)};
static const struct register_row uart_rows[] = {
    {"DR", 0x00, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(byte_fields), REGISTER_LIST(uart_dr_when),
     "DDI 0183 3.3.1"},
    {"FR", 0x18, .kind = REGISTER_STATUS, .source = "DDI 0183 3.3.3"},
    {"IBRD", 0x24, .start = 0, REGISTER_LIST(ibrd_fields), REGISTER_LIST(uart_off_when), "DDI 0183 3.3.5"},
    {"FBRD", 0x28, .start = 0, REGISTER_LIST(fbrd_fields), REGISTER_LIST(uart_off_when), "DDI 0183 3.3.6"},
    {"LCR_H", 0x2c, .start = 0, REGISTER_LIST(lcr_h_fields), REGISTER_LIST(uart_off_when), "DDI 0183 3.3.7"},
    {"CR", 0x30, .start = 0x300, REGISTER_LIST(uart_cr_fields), REGISTER_LIST(uart_cr_when), "DDI 0183 3.3.8"},
};

/* ---- SPI --------------------------------------------------------------------------------------------------------- */

static const struct register_field sspcr0_fields[] = {
    {"DSS", 0, 4, 7, 7, "words of 8 bits"},
    {"DSS", 0, 4, 15, 15, "words of 16 bits"},
    {"FRF", 4, 2, 0, 0, "Motorola's frames"},
    {"SPO", 6, 1, 0, 1, "the clock rests high"},
    {"SPH", 7, 1, 0, 1, "bits are taken at the clock's second edge; no pauses between words"},
    {"SCR", 8, 8, 0, 255, "clk_peri / (CPSDVSR (1 + SCR))"},
};
static const struct register_field sspcr1_fields[] = {{"SSE", 1, 1, 0, 1, "on"}};
static const struct register_field sspcpsr_fields[] = {{"CPSDVSR / 2", 1, 7, 1, 127, "clk_peri / (CPSDVSR (1 + SCR))"}};
static const struct register_field sspdmacr_fields[] = {{"TXDMAE", 1, 1, 0, 1, "asks the DMA for words"}};
static const struct register_field sspdr_fields[] = {{"DATA", 0, 16, 0, 0xffff, "a word to send"}};

#define SPI_OFF_WHEN(unit)                                                                                             \
    {                                                                                                                  \
        {                                                                                                              \
            IS(SPI_SSPCR1(unit), SSPCR1_SSE, 0), .why = "the unit is on (SSE)"                                         \
        }                                                                                                              \
    }
#define SPI_NOT_BUSY(unit, since_written)                                                                              \
    {                                                                                                                  \
        .changes = SSPCR1_SSE, .clears = SSPCR1_SSE, SEEN(SPI_SSPSR(unit), SSPSR_BSY, 0), SINCE(since_written, 0),     \
        .why = "words may be on their way: BSY was not seen to be 0"                                                   \
    }
#define SPI_CR1_WHEN(unit)                                                                                             \
    {                                                                                                                  \
        {.changes = SSPCR1_SSE,                                                                                        \
         .sets = SSPCR1_SSE,                                                                                           \
         AT_LEAST(SPI_SSPCPSR(unit), 0xff, 2),                                                                         \
         .why = "CPSR has no divisor"},                                                                                \
            {.changes = SSPCR1_SSE, .sets = SSPCR1_SSE, AT_LEAST(SPI_SSPCR0(unit), 15, 3), .why = "CR0 has no width"}, \
            SPI_NOT_BUSY(unit, SPI_SSPDR(unit)), SPI_NOT_BUSY(unit, DMA_CH0_CTRL_TRIG),                                \
            SPI_NOT_BUSY(unit, DMA_CH0_AL3_READ_ADDR_TRIG),                                                            \
    }
#define SPI_DR_WHEN(unit)                                                                                              \
    {                                                                                                                  \
        {IS(SPI_SSPCR1(unit), SSPCR1_SSE, SSPCR1_SSE), .why = "the unit is off (SSE)"},                                \
            {SEEN(SPI_SSPSR(unit), SSPSR_TNF, SSPSR_TNF), SINCE(SPI_SSPDR(unit), 0),                                   \
             .why = "the FIFO may be full: TNF was not seen"},                                                         \
    }
static const struct register_when spi0_off_when[] = SPI_OFF_WHEN(0), spi1_off_when[] = SPI_OFF_WHEN(1);
static const struct register_when spi0_cr1_when[] = SPI_CR1_WHEN(0), spi1_cr1_when[] = SPI_CR1_WHEN(1);
static const struct register_when spi0_dr_when[] = SPI_DR_WHEN(0), spi1_dr_when[] = SPI_DR_WHEN(1);
static const struct register_when spi0_when[] = {OUT_OF_RESET(RESET_SPI0)}, spi1_when[] = {OUT_OF_RESET(RESET_SPI1)};

#define SPI_ROWS(off_when, cr1_when, dr_when)                                                                          \
    {                                                                                                                  \
        {"SSPCR0", 0x00, .start = 0, REGISTER_LIST(sspcr0_fields), REGISTER_LIST(off_when), "DDI 0194 3.3.1"},         \
            {"SSPCR1", 0x04, .start = 0, REGISTER_LIST(sspcr1_fields), REGISTER_LIST(cr1_when), "DDI 0194 3.3.2"},     \
            {"SSPDR",                                                                                                  \
             0x08,                                                                                                     \
             .kind = REGISTER_COMMAND,                                                                                 \
             .start = 0,                                                                                               \
             REGISTER_LIST(sspdr_fields),                                                                              \
             REGISTER_LIST(dr_when),                                                                                   \
             "DDI 0194 3.3.3"},                                                                                        \
            {"SSPSR", 0x0c, .kind = REGISTER_STATUS, .source = "DDI 0194 3.3.4"},                                      \
            {"SSPCPSR", 0x10, .start = 0, REGISTER_LIST(sspcpsr_fields), REGISTER_LIST(off_when), "DDI 0194 3.3.5"},   \
            {"SSPDMACR", 0x24, .start = 0, REGISTER_LIST(sspdmacr_fields), .source = "DDI 0194 3.3.10"},               \
    }
static const struct register_row spi0_rows[] = SPI_ROWS(spi0_off_when, spi0_cr1_when, spi0_dr_when);
static const struct register_row spi1_rows[] = SPI_ROWS(spi1_off_when, spi1_cr1_when, spi1_dr_when);

/* ---- DMA: channel 0, from memory to an SPI unit ------------------------------------------------------------------ */

static const struct register_field dma_write_fields[] = {
    {"WRITE_ADDR", 0, 32, SPI_SSPDR(0), SPI_SSPDR(0), "SPI0"},
    {"WRITE_ADDR", 0, 32, SPI_SSPDR(1), SPI_SSPDR(1), "SPI1"},
};
static const struct register_field dma_count_fields[] = {{"COUNT", 0, 28, 1, 0xfffffff, "transfers"}};

#define UNIT_TAKES_WORDS(unit, condition)                                                                              \
    {condition, IS(DMA_CH0_WRITE_ADDR, UINT32_MAX, SPI_SSPDR(unit)), .why = "TREQ_SEL is that of the other SPI unit"}, \
        {condition, IS(SPI_SSPCR1(unit), SSPCR1_SSE, SSPCR1_SSE), .why = "the SPI unit is off (SSE)"},                 \
    {                                                                                                                  \
        condition, IS(SPI_SSPDMACR(unit), SSPDMACR_TXDMAE, SSPDMACR_TXDMAE),                                           \
            .why = "the SPI unit does not ask for words"                                                               \
    }
static const struct register_when dma_control_when[] = {
    {AT_LEAST(DMA_CH0_TRANS_COUNT, 0xfffffff, 1), .why = "TRANS_COUNT is 0"},
    {.sets = DMA_HALFWORDS, IS(DMA_CH0_READ_ADDR, 1, 0), .why = "READ_ADDR is odd, and the channel reads halfwords"},
    UNIT_TAKES_WORDS(0, .clears = DMA_SPI1_BIT),
    UNIT_TAKES_WORDS(1, .sets = DMA_SPI1_BIT),
};
static const struct register_when dma_again_when[] = {
    {IS(DMA_CH0_CTRL_TRIG, DMA_EN, DMA_EN), .why = "the channel is off: this starts nothing"},
    {.sets = 1, IS(DMA_CH0_CTRL_TRIG, DMA_HALFWORDS, 0), .why = "the address is odd, and the channel reads halfwords"},
};

static const struct register_when dma_when[] = {OUT_OF_RESET(RESET_DMA)};
static const struct register_row dma_rows[] = {
    {"CH0_READ_ADDR", 0x00, .start = 0, REGISTER_LIST(any_fields), .source = S("2.5.7", "12.6")},
    {"CH0_WRITE_ADDR", 0x04, .start = 0, REGISTER_LIST(dma_write_fields), .source = S("2.5.7", "12.6")},
    {"CH0_TRANS_COUNT", 0x08, .start = 0, REGISTER_LIST(dma_count_fields), .source = S("2.5.7", "12.6")},
    {"CH0_CTRL_TRIG", 0x0c, .start = 0, REGISTER_LIST(dma_control_fields), REGISTER_LIST(dma_control_when),
     S("2.5.7", "12.6")},
    {"CH0_AL3_READ_ADDR_TRIG", 0x3c, .start = 0, REGISTER_LIST(any_fields), REGISTER_LIST(dma_again_when),
     S("2.5.2", "12.6")},
    {"INTE0", 0x404, .start = 0, REGISTER_LIST(bit_fields), .source = S("2.5.7", "12.6")},
    {"INTS0", 0x40c, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(bit_fields), .source = S("2.5.7", "12.6")},
};

/* ---- SIO: the FIFOs between the cores ---------------------------------------------------------------------------- */

static const struct register_when fifo_wr_when[] = {
    {SEEN(SIO_FIFO_ST, FIFO_RDY, FIFO_RDY), SINCE(SIO_FIFO_WR, 0), .why = "the FIFO may be full: RDY was not seen"},
};
static const struct register_when fifo_rd_when[] = {
    {SEEN(SIO_FIFO_ST, FIFO_VLD, FIFO_VLD), .why = "the FIFO may be empty: VLD was not seen"},
};

#define SIO_ROWS                                                                                                       \
    {"CPUID", 0x00, .kind = REGISTER_STATUS, .source = S("2.3.1", "3.1")},                                             \
        {"GPIO_IN", 0x04, .kind = REGISTER_STATUS, .source = S("2.3.1", "3.1")},                                       \
        {"GPIO_OUT_SET", SIO_GPIO_OUT_SET, PINS_COMMAND}, {"GPIO_OUT_CLR", SIO_GPIO_OUT_CLR, PINS_COMMAND},            \
        {"GPIO_OE_SET", SIO_GPIO_OE_SET, PINS_COMMAND}, {"GPIO_OE_CLR", SIO_GPIO_OE_CLR, PINS_COMMAND},                \
        {"FIFO_ST", 0x50, .kind = REGISTER_STATUS, .source = S("2.3.1", "3.1")}, {"FIFO_WR",                           \
                                                                                  0x54,                                \
                                                                                  .kind = REGISTER_COMMAND,            \
                                                                                  .start = 0,                          \
                                                                                  REGISTER_LIST(any_fields),           \
                                                                                  REGISTER_LIST(fifo_wr_when),         \
                                                                                  S("2.3.1", "3.1")},                  \
    {                                                                                                                  \
        "FIFO_RD", 0x58, .kind = REGISTER_STATUS, .when = fifo_rd_when, .when_count = 1, .source = S("2.3.1", "3.1")   \
    }
#define PINS_COMMAND .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(pins_fields), .source = S("2.3.1", "3.1")

/* ---- what Arm's cores have of their own: DDI 0419 (ARMv6-M), B3.3 (SysTick); DDI 0553 (ARMv8-M), B11 ------------- */

static const struct register_field systick_fields[] = {
    {"CLKSOURCE, TICKINT, ENABLE", 0, 3, 0, 0, "off"},
    {"CLKSOURCE, TICKINT, ENABLE", 0, 3, 7, 7, "an exception each time the core's clock has counted down"},
};
static const struct register_field reload_fields[] = {{"RELOAD", 0, 24, 1, 0xffffff, "cycles between ticks - 1"}};
static const struct register_field clear_fields[] = {{"CURRENT", 0, 32, 0, 0, "starts again at RELOAD"}};
static const struct register_when systick_when[] = {
    {.changes = 1, .sets = 1, WRITTEN(SYST_RVR), .why = "RVR has not been written"},
    {.changes = 1,
     .sets = 1,
     WRITTEN(SYST_CVR),
     SINCE(SYST_RVR, 0),
     .why = "CVR, which has an unknown value, has not been written since RVR"},
};

#define SYSTICK_ROWS                                                                                                   \
    {"SYST_CSR", 0x010, .start = 0, REGISTER_LIST(systick_fields), REGISTER_LIST(systick_when), S("B3.3", "B11")},     \
        {"SYST_RVR", 0x014, .start = 0, REGISTER_LIST(reload_fields), .source = S("B3.3", "B11")},                     \
    {                                                                                                                  \
        "SYST_CVR", 0x018, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(clear_fields),                          \
                           .source = S("B3.3", "B11")                                                                  \
    }

#endif
