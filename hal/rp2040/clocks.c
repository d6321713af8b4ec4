/* See rp2040.h: clocks and resets. */
#include "registers.h"
#include "rp2040.h"

#define CRYSTAL_MHZ 12

static void unreset(uint32_t blocks)
{
    REG_CLEAR(RESETS_RESET) = blocks;
    while ((REG(RESETS_RESET_DONE) & blocks) != blocks) {
    }
}

/* Datasheet 2.16: the start-up takes 1 ms, counted in units of 256 cycles. */
static void start_crystal(void)
{
    REG(XOSC_CTRL) = 0xaa0; /* 1 .. 15 MHz */
    REG(XOSC_STARTUP) = CRYSTAL_MHZ * 1000 / 256 + 1;
    REG_SET(XOSC_CTRL) = 0xfab << 12; /* enable */
    while ((REG(XOSC_STATUS) & 1U << 31) == 0) {
    }
}

/* Datasheet 2.18: 12 MHz x 125 = 1500 MHz, which two dividers make slower. */
static void start_pll(void)
{
    unreset(RESET_PLL_SYS);
    REG(PLL_SYS_CS) = 1; /* reference: the crystal / 1 */
    REG(PLL_SYS_FBDIV_INT) = 125;
    REG_CLEAR(PLL_SYS_PWR) = 1 << 5 | 1; /* VCO and PLL on */
    while ((REG(PLL_SYS_CS) & 1U << 31) == 0) {
    }
    REG(PLL_SYS_PRIM) = PLL_SYS_POST_DIV;
    REG_CLEAR(PLL_SYS_PWR) = 1 << 3; /* post dividers on */
}

/* clk_sys leaves the PLL while the PLL is set up: it may run already, when another image started this one. */
void rp2040_clocks_init(void)
{
    start_crystal();
    REG_CLEAR(CLK_SYS_CTRL) = 1; /* clk_ref */
    while (REG(CLK_SYS_SELECTED) != 1) {
    }
    REG(CLK_REF_CTRL) = 2; /* the crystal */
    while (REG(CLK_REF_SELECTED) != 1 << 2) {
    }
    REG_SET(RESETS_RESET) = RESET_PLL_SYS;
    start_pll();
    REG(CLK_SYS_CTRL) = 0; /* the auxiliary source is the PLL */
    REG(CLK_SYS_CTRL) = 1; /* takes the auxiliary source */
    while (REG(CLK_SYS_SELECTED) != 1 << 1) {
    }
    start_clk_peri();
    start_ticks(CRYSTAL_MHZ);
    REG_SET(RESETS_RESET) = RESET_DMA | RESET_SPI0 | RESET_SPI1;
    unreset(RESET_DMA | RESET_IO_BANK0 | RESET_PADS_BANK0 | RESET_SPI0 | RESET_SPI1 | RESET_TIMER | RESET_UART0);
}
