/* See rp2.h: clocks and resets. */
#include "port.h"
#include <registers.h>
#include "rp2.h"

#define CRYSTAL_MHZ 12

static void unreset(uint32_t blocks)
{
    REG_CLEAR(RESETS_RESET) = blocks;
    while ((REG(RESETS_RESET_DONE) & blocks) != blocks) {
    }
}

/* Datasheet 2.16: the start-up is counted in units of 256 cycles, up to 16383; 255 ms are 11985. It comes first: on an
 * RP2040 every write to CTRL that does not disable the crystal starts it. */
static void start_crystal(void)
{
    const uint32_t ms = board_here->crystal_start_ms > 0 ? board_here->crystal_start_ms : 1;
    REG(XOSC_STARTUP) = (CRYSTAL_MHZ * 1000 / 256 + 1) * ms;
    REG(XOSC_CTRL) = 0xfab << 12 | 0xaa0; /* enable; 1 .. 15 MHz */
    while ((REG(XOSC_STATUS) & 1U << 31) == 0) {
    }
}

/* clk_sys leaves the PLL while the PLL is set up: it may run already, when another image started this one. */
void rp2_clocks_init(void)
{
    start_crystal();
    REG_CLEAR(CLK_SYS_CTRL) = 1; /* clk_ref */
    while (REG(CLK_SYS_SELECTED) != 1) {
    }
    REG(CLK_REF_CTRL) = 2; /* the crystal */
    while (REG(CLK_REF_SELECTED) != 1 << 2) {
    }
    start_pll(PLL_SYS_BASE, RESET_PLL_SYS, PLL_SYS_POST_DIV);
    REG(CLK_SYS_CTRL) = 0; /* the auxiliary source is the PLL */
    REG(CLK_SYS_CTRL) = 1; /* takes the auxiliary source */
    while (REG(CLK_SYS_SELECTED) != 1 << 1) {
    }
    start_clk_peri();
    start_ticks(CRYSTAL_MHZ);
    REG_SET(RESETS_RESET) = RESET_DMA | RESET_SPI0 | RESET_SPI1;
    unreset(RESET_DMA | RESET_IO_BANK0 | RESET_PADS_BANK0 | RESET_SPI0 | RESET_SPI1 | RESET_SYSINFO | RESET_TIMER |
            RESET_UART0);
}
