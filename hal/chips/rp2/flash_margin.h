/*
 * flash_margin: how far the moment at which a chip samples the bits of its flash is from the moments at which they
 * change, and the clock and the sample delay that the ports set by that. For C and for the assembler; times are in
 * picoseconds.
 *
 *   clock of the flash   ___/^^^^^\_____/^^^^^\_____/^^
 *                                 a     b     c            divider: cycles of clk_sys from a to c
 *   bits of the flash    = n - 1 =xxxx=== n ==xxxx= n + 1
 *
 * The flash puts bits n out after the falling edge a, and bits n + 1 after c. Without a delay the chip samples bits n
 * at the rising edge b, which is half a period after a. `halves` is the delay in half cycles of clk_sys: twice the
 * RP2040's RX_SAMPLE_DLY, or the RP2350's RXDELAY. Seen from the chip all bits come later, because the clock passes a
 * pad on its way out, and the bits pass one on their way in.
 *
 * Setup is the time from the latest moment at which bits n are valid to the sample. Hold is the time from the sample to
 * the earliest moment at which bits n + 1 can come. Each must be at least FLASH_MARGIN_PS, which is left for what no
 * data sheet tells: the wires, the flash's load, the jitter of the clock.
 *
 * What a flash takes, by the AC characteristics in its data sheet:
 *   W25Q      W25Q16JV: tCLQV is at most 6 ns, tCLQX at least 1.5 ns
 *   unknown   tCLQV of 8 ns is the most, tCLQX of 0 the least that serial flashes for 3.3 V and 50 MHz have
 *
 * What the two pads take together at 3.3 V over process, voltage and temperature:
 *   least   RP2040 data sheet, 5.5.3.6.1, Table 632: 1.11 + 0.47 ns, the pads alone. Nothing is published for the
 * RP2350, for which this is a guess. most    RP2350 data sheet, Table 1292: 2.5 ns from clk_sys to a QSPI pad, and 1.5
 * ns back. The RP2040's pads alone take 2.14 + 0.76 ns (Table 632), and the way between them and its SSI is not
 * published. That 4 ns are enough for both is a guess, too, but pico-sdk has the RP2040 read a W25Q at 200 MHz with
 * divider 2 and delay 1, which leaves 10 - 6 ns. (Table 633 has up to 5.59 + 4.95 ns between a PIO and a pin, through
 * the choice of 30 pins and the synchronisers, which are not in the SSI's way.)
 */
#ifndef FLASH_MARGIN_H
#define FLASH_MARGIN_H

#define FLASH_MARGIN_PS 3000

#define FLASH_W25Q_TCLQV_PS    6000
#define FLASH_W25Q_TCLQX_PS    1500
#define FLASH_UNKNOWN_TCLQV_PS 8000
#define FLASH_UNKNOWN_TCLQX_PS 0
#define FLASH_PADS_LEAST_PS    (1110 + 470)
#define FLASH_PADS_MOST_PS     (2500 + 1500)

/* Macros for constants, which #if takes as well. */
#define FLASH_HALVES_PS(clk_sys_hz, halves) ((halves) * (500000000000 / (clk_sys_hz)))
#define FLASH_SETUP_PS(clk_sys_hz, divider, halves, tclqv_ps)                                                          \
    (FLASH_HALVES_PS(clk_sys_hz, (divider) + (halves)) - FLASH_PADS_MOST_PS - (tclqv_ps))
#define FLASH_HOLD_PS(clk_sys_hz, divider, halves, tclqx_ps)                                                           \
    (FLASH_HALVES_PS(clk_sys_hz, (divider) - (halves)) + FLASH_PADS_LEAST_PS + (tclqx_ps))
#define FLASH_IS_SAFE(clk_sys_hz, divider, halves, tclqv_ps, tclqx_ps)                                                 \
    (FLASH_SETUP_PS(clk_sys_hz, divider, halves, tclqv_ps) >= FLASH_MARGIN_PS &&                                       \
     FLASH_HOLD_PS(clk_sys_hz, divider, halves, tclqx_ps) >= FLASH_MARGIN_PS)

/*
 * RP2040. The divider is even. A W25Q is read at 62.5 MHz: setup 6 ns, hold 3.08 ns. Any other flash is read at 31.25
 * MHz: setup 12 ns, hold 9.58 ns; at 62.5 MHz hold would be 1.58 ns.
 */
#define RP2040_FLASH_CLK_SYS_HZ      125000000
#define RP2040_FLASH_W25Q_DIVIDER    2
#define RP2040_FLASH_UNKNOWN_DIVIDER 4
#define RP2040_FLASH_DELAY           1 /* RX_SAMPLE_DLY */

#if !FLASH_IS_SAFE(RP2040_FLASH_CLK_SYS_HZ, RP2040_FLASH_W25Q_DIVIDER, 2 * RP2040_FLASH_DELAY, FLASH_W25Q_TCLQV_PS,    \
                   FLASH_W25Q_TCLQX_PS)
#error "an RP2040 samples a W25Q too early or too late: take the next larger divider"
#endif
#if !FLASH_IS_SAFE(RP2040_FLASH_CLK_SYS_HZ, RP2040_FLASH_UNKNOWN_DIVIDER, 2 * RP2040_FLASH_DELAY,                      \
                   FLASH_UNKNOWN_TCLQV_PS, FLASH_UNKNOWN_TCLQX_PS)
#error "an RP2040 samples an unknown flash too early or too late: take the next larger divider"
#endif

/*
 * RP2350, whose delay is in half cycles. A W25Q is read at 75 MHz: setup 3.33 ns, hold 3.08 ns. Any other flash is read
 * at 50 MHz: setup 4.66 ns, hold 4.91 ns.
 */
#define RP2350_FLASH_CLK_SYS_HZ      150000000
#define RP2350_FLASH_W25Q_DIVIDER    2
#define RP2350_FLASH_UNKNOWN_DIVIDER 3
#define RP2350_FLASH_DELAY           2 /* RXDELAY */

#if !FLASH_IS_SAFE(RP2350_FLASH_CLK_SYS_HZ, RP2350_FLASH_W25Q_DIVIDER, RP2350_FLASH_DELAY, FLASH_W25Q_TCLQV_PS,        \
                   FLASH_W25Q_TCLQX_PS)
#error "an RP2350 samples a W25Q too early or too late: take the next larger divider"
#endif
#if !FLASH_IS_SAFE(RP2350_FLASH_CLK_SYS_HZ, RP2350_FLASH_UNKNOWN_DIVIDER, RP2350_FLASH_DELAY, FLASH_UNKNOWN_TCLQV_PS,  \
                   FLASH_UNKNOWN_TCLQX_PS)
#error "an RP2350 samples an unknown flash too early or too late: take the next larger divider"
#endif

#endif
