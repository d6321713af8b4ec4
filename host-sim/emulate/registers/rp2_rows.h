/*
 * rp2_rows: what the tables of the RP2040 and the RP2350 are written with (registers_table.c, rp2_peripherals_rows.h).
 * Addresses and bits stand here and in the tables a second time: the tables would not see a wrong one in the ports'
 * headers if they took them from there. The chip's table has defined its base addresses before.
 */
#ifndef RP2_ROWS_H
#define RP2_ROWS_H

#include "registers/registers.h"

#define RESETS_RESET               RESETS_BASE
#define RESETS_RESET_DONE          (RESETS_BASE + 0x08)
#define CLK_REF_CTRL               (CLOCKS_BASE + 0x30)
#define CLK_REF_SELECTED           (CLOCKS_BASE + 0x38)
#define CLK_SYS_CTRL               (CLOCKS_BASE + 0x3c)
#define CLK_SYS_SELECTED           (CLOCKS_BASE + 0x44)
#define CLK_PERI_CTRL              (CLOCKS_BASE + 0x48)
#define XOSC_CTRL                  XOSC_BASE
#define XOSC_STATUS                (XOSC_BASE + 0x04)
#define XOSC_STARTUP               (XOSC_BASE + 0x0c)
#define PLL_CS(pll)                (pll)
#define PLL_PWR(pll)               ((pll) + 0x04)
#define PLL_FBDIV_INT(pll)         ((pll) + 0x08)
#define PLL_PRIM(pll)              ((pll) + 0x0c)
#define PSM_FRCE_OFF               (PSM_BASE + 0x04)
#define PSM_WDSEL                  (PSM_BASE + 0x08)
#define WATCHDOG_LOAD              (WATCHDOG_BASE + 0x04)
#define UART0_DR                   UART0_BASE
#define UART0_FR                   (UART0_BASE + 0x18)
#define UART0_IBRD                 (UART0_BASE + 0x24)
#define UART0_FBRD                 (UART0_BASE + 0x28)
#define UART0_LCR_H                (UART0_BASE + 0x2c)
#define UART0_CR                   (UART0_BASE + 0x30)
#define SPI_SSPCR0(unit)           SPI_BASE(unit)
#define SPI_SSPCR1(unit)           (SPI_BASE(unit) + 0x04)
#define SPI_SSPDR(unit)            (SPI_BASE(unit) + 0x08)
#define SPI_SSPSR(unit)            (SPI_BASE(unit) + 0x0c)
#define SPI_SSPCPSR(unit)          (SPI_BASE(unit) + 0x10)
#define SPI_SSPDMACR(unit)         (SPI_BASE(unit) + 0x24)
#define DMA_BASE                   0x50000000
#define DMA_CH0_READ_ADDR          DMA_BASE
#define DMA_CH0_WRITE_ADDR         (DMA_BASE + 0x04)
#define DMA_CH0_TRANS_COUNT        (DMA_BASE + 0x08)
#define DMA_CH0_CTRL_TRIG          (DMA_BASE + 0x0c)
#define DMA_CH0_AL3_READ_ADDR_TRIG (DMA_BASE + 0x3c)
#define SIO_BASE                   0xd0000000
#define SIO_FIFO_ST                (SIO_BASE + 0x50)
#define SIO_FIFO_WR                (SIO_BASE + 0x54)
#define PPB_BASE                   0xe000e000
#define SYST_RVR                   (PPB_BASE + 0x014)
#define SYST_CVR                   (PPB_BASE + 0x018)

#define WATCHDOG_ENABLE (1U << 30)
#define SSPCR1_SSE      (1U << 1)
#define SSPSR_TNF       (1U << 1)
#define SSPSR_BSY       (1U << 4)
#define SSPDMACR_TXDMAE (1U << 1)
#define DMA_EN          1U
#define DMA_HALFWORDS   (1U << 2)
#define FIFO_VLD        1U
#define FIFO_RDY        2U
enum { FUNCTION_SPI = 1, FUNCTION_UART = 2, FUNCTION_I2C = 3, FUNCTION_SIO = 5 };

/* Parts of a struct register_when. */
#define IS(at, bits, is)       .need = REGISTER_IS, .address = (at), .mask = (bits), .value = (is)
#define AT_LEAST(at, bits, is) .need = REGISTER_AT_LEAST, .address = (at), .mask = (bits), .value = (is)
#define SEEN(at, bits, is)     .need = REGISTER_SEEN, .address = (at), .mask = (bits), .value = (is)
#define WAITED(at, bits, ns)   .need = REGISTER_WAITED, .address = (at), .mask = (bits), .value = (ns)
#define WRITTEN(at)            .need = REGISTER_WRITTEN, .address = (at)
#define SINCE(at, bits)        .since = (at), .since_mask = (bits)

#define XOSC_ENABLE    0xfff000
#define SYS_SRC        1U
#define AUXSRC         (7U << 5) /* of clk_sys and of clk_peri */
#define PERI_ENABLE    (1U << 11)
#define PLL_VCO_OFF    (1U << 5 | 1) /* VCOPD, PD */
#define PLL_POST_OFF   (1U << 3)     /* POSTDIVPD */
#define CRYSTAL_STABLE SEEN(XOSC_STATUS, 1U << 31, 1U << 31), SINCE(XOSC_CTRL, XOSC_ENABLE)

#define CRYSTAL_RUNS  CRYSTAL_STABLE, .why = "the crystal was not seen to be STABLE"
#define PLL_RUNS(pll) IS(PLL_PWR(pll), PLL_VCO_OFF | PLL_POST_OFF, 0), .why = "the PLL or its post dividers are off"
#define REF_IS_CRYSTAL                                                                                                 \
    SEEN(CLK_REF_SELECTED, 15, 4), SINCE(CLK_REF_CTRL, 3), .why = "SELECTED did not say that clk_ref is the crystal"

/* Two needs before any access to a block. */
#define OUT_OF_RESET(bit)                                                                                              \
    {IS(RESETS_RESET, (bit), 0), .why = "the block is in reset"},                                                      \
    {                                                                                                                  \
        SEEN(RESETS_RESET_DONE, (bit), (bit)), SINCE(RESETS_RESET, (bit)),                                             \
            .why = "RESET_DONE was not seen since the block left reset"                                                \
    }

static const struct register_field any_fields[] = {{"all bits", 0, 32, 0, UINT32_MAX, "a number or an address"}};

/* Where a chip has a register for each pin: a bit each, of the 30. */
static const struct register_field pins_fields[] = {{"pins", 0, 30, 0, 0x3fffffff, "a level or a direction each"}};

static const struct register_field bit_fields[] = {{"bit 0", 0, 1, 0, 1, "on or off"}};

#endif
