/*
 * i2c_clock: the counts that make the clock of a DW_apb_i2c (RP2040, RP2350), in cycles of the chip. They are set by
 * the I2C specification (NXP, UM10204, table 10: fast mode and fast-mode plus).
 *
 * A clock is low for LCNT + 1 cycles, and high for HCNT + SPKLEN + 7 of them, counted from where the unit sees it high
 * (RP2040 datasheet 4.3.14). So wires that rise slowly make the clock slower, never too fast.
 */
#ifndef I2C_CLOCK_H
#define I2C_CLOCK_H

#include <stdint.h>

#define I2C_CLOCK_MOST_HZ 1000000 /* fast-mode plus */
#define I2C_CLOCK_SPIKE   50      /* ns: shorter pulses are none (tSP) */
#define I2C_CLOCK_HOLD    300     /* ns: data stays so long after the clock's falling edge, however slowly that falls */

struct i2c_clock {
    uint32_t hz;                     /* the clock really made; 0: none is that slow */
    uint32_t high, low, spike, hold; /* HCNT, LCNT, SPKLEN, SDA_HOLD */
};

static inline uint32_t i2c_clock_cycles(uint32_t chip_hz, uint32_t ns)
{
    return (chip_hz / 1000000 * ns + 999) / 1000;
}

/* Two thirds of a period are low: 1.67 us of the 2.5 at 400 kHz, of which the specification wants 1.3, and for the high
 * part 0.6 us. At 1 MHz it wants 0.5 and 0.26. */
static inline struct i2c_clock i2c_clock_dw(uint32_t chip_hz, uint32_t hz)
{
    struct i2c_clock c = {.spike = i2c_clock_cycles(chip_hz, I2C_CLOCK_SPIKE),
                          .hold = i2c_clock_cycles(chip_hz, I2C_CLOCK_HOLD)};
    const uint32_t asked = hz < I2C_CLOCK_MOST_HZ ? hz : I2C_CLOCK_MOST_HZ;
    const uint32_t period = asked == 0 ? UINT32_MAX : (chip_hz + asked - 1) / asked;
    if (period > 3 * (UINT16_MAX / 2)) { /* LCNT has 16 bits */
        return c;
    }
    const uint32_t low = (2 * period + 2) / 3;
    c.hz = chip_hz / period;
    c.low = low - 1;
    c.high = period - low - c.spike - 7;
    return c;
}

#endif
