/*
 * spi_clock: which bus clocks the chips' SPI units make of their input clock, and where they pause. The ports set their
 * registers by this; the simulator, and so the tables of boards, tell by it what a kit really sends.
 *
 * Every function takes the fastest clock of at most hz that its search finds, fractions of 1 Hz left aside: asked for
 * a clock that a unit is said to make, it makes that one again.
 */
#ifndef SPI_CLOCK_H
#define SPI_CLOCK_H

#include "board.h"

#define SPI_CLOCK_RP2_HZ      125000000U /* clk_peri */
#define SPI_CLOCK_LM3S6965_HZ 50000000U  /* the CPU's */
#define SPI_CLOCK_STM32F4_HZ  42000000U  /* APB1 */

/* PL022 (RP2040 datasheet 4.4.2.3, LM3S6965 SSICPSR): input / (prescaler (1 + scr)). */
struct spi_clock_pl022 {
    uint32_t prescaler; /* even, 2 .. 254 */
    uint32_t scr;       /* 0 .. 255 */
    uint32_t hz;        /* 0: none is that slow */
};

static inline struct spi_clock_pl022 spi_clock_pl022(uint32_t input_hz, uint32_t hz)
{
    const uint32_t divide = hz < input_hz ? input_hz / (hz + 1) + 1 : 1;
    uint32_t prescaler = 2;
    while (prescaler < 254 && prescaler * 256 < divide) {
        prescaler += 2;
    }
    const uint32_t scr = (divide - 1) / prescaler;
    return (struct spi_clock_pl022){prescaler, scr, scr > 255 ? 0 : input_hz / (prescaler * (scr + 1))};
}

/* STM32F4 (RM0090, SPI_CR1.BR): input / 2^(br + 1), br = 0 .. 7. The clock is 0 if none is that slow. */
static inline uint32_t spi_clock_stm32f4(uint32_t input_hz, uint32_t hz, uint32_t *br)
{
    for (*br = 0; *br < 8; ++*br) {
        if (input_hz >> (*br + 1) <= hz) {
            return input_hz >> (*br + 1);
        }
    }
    return 0;
}

/* The clock that the board's SPI unit makes of hz; 0: nothing that slow. */
static inline uint32_t spi_clock_of(const struct board *board, uint32_t hz)
{
    uint32_t br = 0;
    switch (board->spi_unit) {
    case BOARD_SPI_RP2:
        return spi_clock_pl022(SPI_CLOCK_RP2_HZ, hz).hz;
    case BOARD_SPI_LM3S6965:
        return spi_clock_pl022(SPI_CLOCK_LM3S6965_HZ, hz).hz;
    case BOARD_SPI_STM32F4:
        return spi_clock_stm32f4(SPI_CLOCK_STM32F4_HZ, hz, &br);
    default:
        return hz;
    }
}

/*
 * The pauses of a write of n bytes, in half periods of the clock: in mode 0 a PL022 raises its own select line for 1.5
 * periods after each word (PrimeCell SSP DDI 0194, Motorola SPI format with SPH = 0). hal/chips/rp2 sends writes that
 * it does not copy as words of 16 bits.
 */
static inline uint32_t spi_clock_pause(const struct board *board, uint32_t n)
{
    const bool pl022 = board->spi_unit == BOARD_SPI_RP2 || board->spi_unit == BOARD_SPI_LM3S6965;
    const bool wide = board->spi_unit == BOARD_SPI_RP2 && n > HAL_COPIED && n % 2 == 0;
    return pl022 && board->spi_mode == 0 ? 3 * (wide ? n / 2 : n) : 0;
}

#endif
