/* boards: all kits. Boards of a family share their wiring in families/. */
#ifndef BOARDS_H
#define BOARDS_H

#include "board.h"
#include "budgets.h"
#include "panels.h"

/* Raspberry Pi 5; 4; all before. GPIOn of the header is line n of the chip with this label. */
#define RPI_GPIO_LABELS "pinctrl-rp1 pinctrl-bcm2711 pinctrl-bcm2835"

extern const struct board board_pico_display, board_pico_display_2, board_waveshare_pico_lcd_1in3,
    board_waveshare_pico_lcd_0in96, board_waveshare_rp2040_lcd_1in28, board_pico2_display, board_pico2_display_2,
    board_pico2_display_2in8, board_waveshare_pico2_lcd_1in3, board_waveshare_pico2_lcd_0in96,
    board_waveshare_rp2350_lcd_1in28, board_waveshare_rp2350_lcd_0in96, board_lm3s6965evb, board_feather_stm32f405,
    board_rpi_waveshare_1in3, board_rpi_waveshare_1in44, board_rpi_pirate_audio, board_rpi_display_hat_mini,
    board_rpi_pitft_2in8, board_rpi_mini_pitft_1in14, board_rpi_mini_pitft_1in3, board_sbc_generic, board_ft232h_st7789,
    board_ft232h_ili9341, board_sim_ili9488, board_sim_ssd1351, board_sim_st7789_170x320, board_sim_st7789_240x280,
    board_sim_st7735s_128x160;

#endif
