/*
 * What the RP2040 takes as accesses to its registers; see registers/registers.h. Sections are those of the RP2040
 * datasheet (Raspberry Pi Ltd), and B3 those of the ARMv6-M Architecture Reference Manual (DDI 0419).
 */
#define S(rp2040, rp2350) rp2040

#define SYSINFO_BASE    0x40000000
#define CLOCKS_BASE     0x40008000
#define RESETS_BASE     0x4000c000
#define PSM_BASE        0x40010000
#define IO_BANK0_BASE   0x40014000
#define PADS_BANK0_BASE 0x4001c000
#define PADS_QSPI_BASE  0x40020000
#define XOSC_BASE       0x40024000
#define PLL_SYS_BASE    0x40028000
#define UART0_BASE      0x40034000
#define SPI_BASE(unit)  ((unit) == 0 ? 0x4003c000U : 0x40040000U)
#define I2C0_BASE       0x40044000
#define TIMER_BASE      0x40054000
#define WATCHDOG_BASE   0x40058000
#define VREG_BASE       0x40064000
#define SSI_BASE        0x18000000

#include "registers/rp2_rows.h"

#define SSI(offset)   (SSI_BASE + (offset))
#define WATCHDOG_TICK (WATCHDOG_BASE + 0x2c)
#define SIO_DIV_CSR   (SIO_BASE + 0x78)
#define MPU_RNR       (PPB_BASE + 0xd98)
#define MPU_RBAR      (PPB_BASE + 0xd9c)
#define MPU_RASR      (PPB_BASE + 0xda0)

/* ---- what differs between the chips ------------------------------------------------------------------------------ */

/* Offsets. */
enum { SIO_GPIO_OUT_SET = 0x14, SIO_GPIO_OUT_CLR = 0x18, SIO_GPIO_OE_SET = 0x24, SIO_GPIO_OE_CLR = 0x28 };
enum { IO_BANK0_INTR = 0xf0, TIMER_INTR = 0x34, TIMER_INTE = 0x38, FC0 = 0x80, CHIP_RESET = 0x08 };

#define RESET_DMA        (1U << 2)
#define RESET_I2C0       (1U << 3)
#define RESET_IO_BANK0   (1U << 5)
#define RESET_PADS_BANK0 (1U << 8)
#define RESET_PLL_SYS    (1U << 12)
#define RESET_SPI0       (1U << 16)
#define RESET_SPI1       (1U << 17)
#define RESET_SYSINFO    (1U << 19)
#define RESET_TIMER      (1U << 21)
#define RESET_UART0      (1U << 22)

#define PSM_ALL_BUT_OSCILLATORS 0x1fffc /* ROSC is bit 0, XOSC bit 1 */

/* The ROM has taken the timer, the pads and the flash's pins out of reset (pico-bootrom-rp2040, bootrom_main.c). */
#define RESETS_AT_START  (0x1ffffff & ~(RESET_TIMER | RESET_PADS_BANK0 | 1 << 6 | 1 << 9))
#define CLK_SYS_AT_START 0
#define PAD_AT_START     0x56
#define PSM_PROC1_AT     16
#define DMA_SPI1_BIT     (1 << 16) /* TREQ_SEL is 16 for SPI0, 18 for SPI1 */
#define PAD_FIELDS
#define RESETS_NEEDS

static const struct register_field resets_fields[] = {
    {"DMA", 2, 1, 0, 1, "in reset"},        {"I2C0", 3, 1, 0, 1, "in reset"},     {"IO_BANK0", 5, 1, 0, 1, "in reset"},
    {"PADS_BANK0", 8, 1, 0, 1, "in reset"}, {"PLL_SYS", 12, 1, 0, 1, "in reset"}, {"SPI0", 16, 1, 0, 1, "in reset"},
    {"SPI1", 17, 1, 0, 1, "in reset"},      {"SYSINFO", 19, 1, 0, 1, "in reset"}, {"TIMER", 21, 1, 0, 1, "in reset"},
    {"UART0", 22, 1, 0, 1, "in reset"},
};
static const struct register_field clk_sys_fields[] = {
    {"SRC", 0, 1, 0, 1, "clk_ref, the auxiliary source"},
    {"AUXSRC", 5, 3, 0, 0, "the system PLL"},
};
static const struct register_field clk_peri_fields[] = {
    {"AUXSRC", 5, 3, 0, 0, "clk_sys"},
    {"ENABLE", 11, 1, 0, 1, "on"},
};
/* 1500 MHz / 6 / 2 = 125 MHz: UART, flash and divisors are set up for that, and the chip ends at 133 (5.5). */
static const struct register_field pll_prim_fields[] = {
    {"POSTDIV2", 12, 3, 2, 2, "divides by 2"},
    {"POSTDIV1", 16, 3, 6, 6, "divides by 6"},
};
static const struct register_field load_fields[] = {
    {"LOAD", 0, 24, 1, 0xffffff, "half microseconds: it counts down twice a tick (erratum RP2040-E1)"},
};
static const struct register_field dma_control_fields[] = {
    {"EN", 0, 1, 0, 1, "on"},
    {"DATA_SIZE", 2, 2, 0, 0, "bytes"},
    {"DATA_SIZE", 2, 2, 1, 1, "halfwords"},
    {"INCR_READ", 4, 1, 0, 1, "reads one after the other"},
    {"CHAIN_TO", 11, 4, 0, 0, "itself: no other channel follows"},
    {"TREQ_SEL", 15, 6, 16, 16, "SPI0 asks for words"},
    {"TREQ_SEL", 15, 6, 18, 18, "SPI1 asks for words"},
    {"BSWAP", 22, 1, 0, 1, "the bytes of a halfword change places"},
};
#define TICK_ON     (1U << 9 | 12) /* ENABLE, CYCLES */
#define TICKS_NEEDS IS(WATCHDOG_TICK, 0x3ff, TICK_ON)
#define TIMER_NEEDS TICKS_NEEDS
#define CLK_PERI_NEEDS                                                                                                 \
    {                                                                                                                  \
        .changes = PERI_ENABLE, .sets = PERI_ENABLE, SEEN(CLK_SYS_SELECTED, 3, 2), SINCE(CLK_SYS_CTRL, SYS_SRC),       \
        .why = "SELECTED did not say that clk_sys, of which clk_peri is made, comes from the PLL"                      \
    }

#include "registers/rp2_peripherals_rows.h"

#include "registers/rp2_i2c_rows.h"

static const struct register_field tick_fields[] = {
    {"CYCLES", 0, 9, 12, 12, "a tick is 1 us"},
    {"ENABLE", 9, 1, 0, 1, "ticks"},
};
static const struct register_when tick_when[] = {{REF_IS_CRYSTAL}};
static const struct register_row watchdog_rows[] = {
    WATCHDOG_ROWS,
    {"TICK", 0x2c, .start = 0x200, REGISTER_LIST(tick_fields), REGISTER_LIST(tick_when), "4.7.2"},
};

/* ---- flash: hal/rp2040/boot2.S ----------------------------------------------------------------------------------- */

/* The ROM leaves the SSI on, as it has read boot2 by it. */
static const struct register_field ctrlr0_fields[] = {
    {"TMOD", 8, 2, 0, 0, "bytes out and in"},    {"TMOD", 8, 2, 3, 3, "command and address out, then data in"},
    {"DFS_32", 16, 5, 7, 7, "frames of 8 bits"}, {"DFS_32", 16, 5, 31, 31, "frames of 32 bits"},
    {"SPI_FRF", 21, 2, 0, 0, "one line"},        {"SPI_FRF", 21, 2, 2, 2, "four lines"},
};
static const struct register_field ctrlr1_fields[] = {{"NDF", 0, 16, 0, 0, "one frame a read"}};
static const struct register_field baudr_fields[] = {{"SCKDV / 2", 1, 15, 1, 0x7fff, "clk_sys / SCKDV"}};
static const struct register_field rsd_fields[] = {{"RSD", 0, 8, 0, 7, "cycles of clk_sys that data is sampled later"}};
static const struct register_field spi_ctrlr0_fields[] = {
    {"TRANS_TYPE", 0, 2, 0, 2, "command and address on one line; the address on four; both"},
    {"ADDR_L", 2, 4, 0, 0, "bytes have no address"},
    {"ADDR_L", 2, 4, 6, 6, "24 address bits"},
    {"ADDR_L", 2, 4, 8, 8, "24 address bits, 8 mode bits"},
    {"INST_L", 8, 2, 0, 0, "no command"},
    {"INST_L", 8, 2, 2, 2, "a command of 8 bits"},
    {"WAIT_CYCLES", 11, 5, 0, 31, "dummy clocks"},
    {"XIP_CMD", 24, 8, 0, 255, "the command, or the mode bits"},
};
static const struct register_when ssi_off_when[] = {
    {IS(SSI(0x08), 1, 0), .why = "the SSI is on (SSIENR) and ignores it"},
};
static const struct register_when ssi_on_when[] = {
    {IS(SSI(0x08), 1, 1), .why = "the SSI is off (SSIENR)"},
};
static const struct register_when ssienr_when[] = {
    {.changes = 1, .sets = 1, AT_LEAST(SSI(0x14), 0xffff, 2), .why = "BAUDR has no divisor"},
    {.changes = 1,
     .clears = 1,
     SEEN(SSI(0x28), 5, 4),
     SINCE(SSI(0x60), 0),
     .why = "a transfer may be on its way: SR did not say that all is sent (TFE, not BUSY)"},
};
static const struct register_row ssi_rows[] = {
    {"CTRLR0", 0x00, .start = 0, REGISTER_LIST(ctrlr0_fields), REGISTER_LIST(ssi_off_when), "4.10.13"},
    {"CTRLR1", 0x04, .start = 0, REGISTER_LIST(ctrlr1_fields), REGISTER_LIST(ssi_off_when), "4.10.13"},
    {"SSIENR", 0x08, .start = 1, REGISTER_LIST(bit_fields), REGISTER_LIST(ssienr_when), "4.10.13"},
    {"BAUDR", 0x14, .start = 0, REGISTER_LIST(baudr_fields), REGISTER_LIST(ssi_off_when), "4.10.13"},
    {"SR", 0x28, .kind = REGISTER_STATUS, .source = "4.10.13"},
    {"DR0", 0x60, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(any_fields), REGISTER_LIST(ssi_on_when),
     "4.10.13"},
    {"RX_SAMPLE_DLY", 0xf0, .start = 0, REGISTER_LIST(rsd_fields), REGISTER_LIST(ssi_off_when), "4.10.13"},
    {"SPI_CTRLR0", 0xf4, .start = 0x03000000, REGISTER_LIST(spi_ctrlr0_fields), REGISTER_LIST(ssi_off_when), "4.10.13"},
};
static const struct register_row pads_qspi_rows[] = {
    {"SCLK", 0x04, .start = 0x56, REGISTER_LIST(qspi_pad_fields), .source = "2.19.6"},
    {"SD", 0x08, 4, 4, .start = 0x52, REGISTER_LIST(qspi_pad_fields), .source = "2.19.6"},
};

/* ---- core -------------------------------------------------------------------------------------------------------- */

static const struct register_when quotient_when[] = {
    {SEEN(SIO_DIV_CSR, 1, 1), SINCE(SIO_BASE + 0x64, 0), .why = "READY was not seen since UDIVISOR was written"},
    {SEEN(SIO_DIV_CSR, 1, 1), SINCE(SIO_BASE + 0x6c, 0), .why = "READY was not seen since SDIVISOR was written"},
};
static const struct register_row sio_rows[] = {
    SIO_ROWS,
    {"DIV_UDIVIDEND", 0x60, .start = 0, REGISTER_LIST(any_fields), .source = "2.3.1.5"},
    {"DIV_UDIVISOR", 0x64, .start = 0, REGISTER_LIST(any_fields), .source = "2.3.1.5"},
    {"DIV_SDIVIDEND", 0x68, .start = 0, REGISTER_LIST(any_fields), .source = "2.3.1.5"},
    {"DIV_SDIVISOR", 0x6c, .start = 0, REGISTER_LIST(any_fields), .source = "2.3.1.5"},
    {"DIV_QUOTIENT", 0x70, .kind = REGISTER_STATUS, .when = quotient_when, .when_count = 2, .source = "2.3.1.5"},
    {"DIV_REMAINDER", 0x74, .kind = REGISTER_STATUS, .when = quotient_when, .when_count = 2, .source = "2.3.1.5"},
    {"DIV_CSR", 0x78, .kind = REGISTER_STATUS, .source = "2.3.1.5"},
};

static const struct register_field iser_fields[] = {
    {"TIMER_IRQ_0", 0, 1, 0, 1, "enabled"},
    {"DMA_IRQ_0", 11, 1, 0, 1, "enabled"},
    {"I2C0_IRQ", 23, 1, 0, 1, "enabled"},
};
static const struct register_field vtor_fields[] = {{"TBLOFF", 8, 24, 0, 0xffffff, "where the vectors are"}};
static const struct register_field mpu_ctrl_fields[] = {
    {"PRIVDEFENA, HFNMIENA, ENABLE", 0, 3, 5, 5, "on, but not in the hard fault; elsewhere as without an MPU"},
};
static const struct register_field mpu_rnr_fields[] = {{"REGION", 0, 8, 0, 0, "the first of the 8"}};
static const struct register_field mpu_rbar_fields[] = {
    {"REGION, VALID", 0, 8, 0, 0, "RNR says which region"},
    {"ADDR", 8, 24, 0, 0xffffff, "where it begins"},
};
static const struct register_field mpu_rasr_fields[] = {
    {"ENABLE", 0, 1, 0, 1, "on, without access for anybody"},
    {"SIZE", 1, 5, 7, 31, "the logarithm of its bytes - 1; 256 at least"},
};
static const struct register_when mpu_region_when[] = {{WRITTEN(MPU_RNR), .why = "RNR has not been written"}};
static const struct register_when mpu_rasr_when[] = {{WRITTEN(MPU_RBAR), .why = "RBAR has not been written"}};
static const struct register_when mpu_ctrl_when[] = {
    {.sets = 1, IS(MPU_RASR, 1, 1), .why = "no region is on"},
};
static const struct register_row ppb_rows[] = {
    SYSTICK_ROWS,
    {"NVIC_ISER", 0x100, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(iser_fields), .source = "B3.4"},
    {"VTOR", 0xd08, .start = 0, REGISTER_LIST(vtor_fields), .source = "B3.2"},
    {"MPU_CTRL", 0xd94, .start = 0, REGISTER_LIST(mpu_ctrl_fields), REGISTER_LIST(mpu_ctrl_when), "B3.5"},
    {"MPU_RNR", 0xd98, .start = 0, REGISTER_LIST(mpu_rnr_fields), .source = "B3.5"},
    {"MPU_RBAR", 0xd9c, .start = 0, REGISTER_LIST(mpu_rbar_fields), REGISTER_LIST(mpu_region_when), "B3.5"},
    {"MPU_RASR", 0xda0, .start = 0, REGISTER_LIST(mpu_rasr_fields), REGISTER_LIST(mpu_rasr_when), "B3.5"},
};

static const struct register_block blocks[] = {
    {"SIO", SIO_BASE, 0x180, .per_core = true, REGISTER_LIST(sio_rows)},
    {"DMA", DMA_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(dma_rows), REGISTER_LIST(dma_when)},
    {"SPI0", SPI_BASE(0), 0x4000, .aliases = true, false, REGISTER_LIST(spi0_rows), REGISTER_LIST(spi0_when)},
    {"SPI1", SPI_BASE(1), 0x4000, .aliases = true, false, REGISTER_LIST(spi1_rows), REGISTER_LIST(spi1_when)},
    {"I2C0", I2C0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(i2c_rows), REGISTER_LIST(i2c_when)},
    {"TIMER", TIMER_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(timer_rows), REGISTER_LIST(timer_when)},
    {"UART0", UART0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(uart_rows), REGISTER_LIST(uart_when)},
    {"RESETS", RESETS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(resets_rows)},
    {"CLOCKS", CLOCKS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(clocks_rows)},
    {"XOSC", XOSC_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(xosc_rows)},
    {"PLL_SYS", PLL_SYS_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pll_sys_rows), REGISTER_LIST(pll_sys_when)},
    {"PSM", PSM_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(psm_rows)},
    {"WATCHDOG", WATCHDOG_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(watchdog_rows)},
    {"IO_BANK0", IO_BANK0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(io_bank0_rows),
     REGISTER_LIST(io_bank0_when)},
    {"PADS_BANK0", PADS_BANK0_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pads_rows), REGISTER_LIST(pads_when)},
    {"PADS_QSPI", PADS_QSPI_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(pads_qspi_rows)},
    {"SYSINFO", SYSINFO_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(sysinfo_rows), REGISTER_LIST(sysinfo_when)},
    {"VREG_AND_CHIP_RESET", VREG_BASE, 0x4000, .aliases = true, false, REGISTER_LIST(chip_reset_rows)},
    {"SSI", SSI_BASE, 0x100, .per_core = false, REGISTER_LIST(ssi_rows)},
    {"PPB", PPB_BASE, 0x1000, .per_core = true, REGISTER_LIST(ppb_rows)},
};

const struct register_chip rp2040_registers = {"RP2040", "RP2040 datasheet", REGISTER_LIST(blocks), RESETS_RESET};
