/* The clocks of the SPI units against the formulas of their manuals, by trying every divider. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "chips/spi_clock.h"

static void known_clocks(void **state)
{
    (void)state;
    static const struct {
        const struct board *board;
        uint32_t asked, got;
    } known[] = {
        {&board_pico_display, 62500000, 62500000},
        {&board_pico_display, 62499999, 31250000},
        {&board_pico_display, UINT32_MAX, 62500000},
        {&board_pico_display, 10000000, 8928571},
        {&board_pico_display, 4000000, 3906250},
        {&board_pico_display, 1922, 1922},
        {&board_pico_display, 1900, 0},
        {&board_pico_display, 0, 0},
        {&board_lm3s6965evb, 3500000, 3125000},
        {&board_lm3s6965evb, 1000000, 1000000},
        {&board_lm3s6965evb, 768, 768},
        {&board_lm3s6965evb, 767, 0},
        {&board_feather_stm32f405, 21000000, 21000000},
        {&board_feather_stm32f405, 20000000, 10500000},
        {&board_feather_stm32f405, 164062, 164062},
        {&board_feather_stm32f405, 164061, 0},
        {&board_rpi_waveshare_1in3, 12345678, 12345678},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        assert_int_equal(spi_clock_of(known[i].board, known[i].asked), known[i].got);
    }
}

/* Every clock that a PL022 can make, asked for as it is told, comes back; one hertz less gives a slower one. */
static void a_clock_that_was_told_is_made_again(void **state)
{
    (void)state;
    static const uint32_t inputs[] = {SPI_CLOCK_RP2_HZ, SPI_CLOCK_LM3S6965_HZ};
    for (uint32_t prescaler = 2; prescaler <= 254; prescaler += 2) {
        for (uint32_t scr = 0; scr <= 255; scr++) {
            const uint32_t input = inputs[scr & 1], hz = input / (prescaler * (scr + 1));
            const struct spi_clock_pl022 clock = spi_clock_pl022(input, hz);
            assert_true(clock.hz <= hz && clock.prescaler % 2 == 0 && clock.scr <= 255);
            assert_int_equal(clock.hz, input / (clock.prescaler * (clock.scr + 1)));
            assert_int_equal(spi_clock_pl022(input, clock.hz).hz, clock.hz);
            assert_true(spi_clock_pl022(input, clock.hz - 1).hz < clock.hz);
            if (prescaler == 2) {
                assert_int_equal(clock.hz, hz);
            }
        }
    }
}

static void pauses_follow_words_in_mode_0(void **state)
{
    (void)state;
    struct board mode_0 = board_pico_display;
    mode_0.spi_mode = 0;
    assert_int_equal(spi_clock_pause(&mode_0, 480), 3 * 240);
    assert_int_equal(spi_clock_pause(&mode_0, 481), 3 * 481);
    assert_int_equal(spi_clock_pause(&mode_0, HAL_COPIED), 3 * HAL_COPIED);
    assert_int_equal(spi_clock_pause(&board_lm3s6965evb, 64), 3 * 64);
    assert_int_equal(spi_clock_pause(&board_pico_display, 480), 0);
    assert_int_equal(spi_clock_pause(&board_feather_stm32f405, 480), 0);
    assert_int_equal(spi_clock_pause(&board_rpi_waveshare_1in3, 480), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_clocks),
        cmocka_unit_test(a_clock_that_was_told_is_made_again),
        cmocka_unit_test(pauses_follow_words_in_mode_0),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
