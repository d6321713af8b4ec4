/*
 * The usual module with four pins (GND, VCC, SCL, SDA); VCC takes the Pico's 3V3. GP4 and GP5 are the pins of
 * pico-sdk's PICO_DEFAULT_I2C. A1h and C8h are those of Adafruit's adafruit_ssd1306.py.
 */
#include "boards.h"

const struct board board_pico_oled_0in96_i2c = {
    .name = "pico-oled-0in96-i2c",
    .title = "Raspberry Pi Pico with a 0.96\" OLED on I2C wires, 128x64, one bit a pixel",
    .pinout = "https://mutexfirmware.com/5-rasberry-pi-pico-ssd1306-oled-display-micropython",
    .panel = &panel_ssd1306_128x64,
    .rotation = PANEL_R0,
    .format = PANEL_MONO_DITHER,
    .spi_unit = BOARD_SPI_RP2,
    .spi_bus = 0,
    .i2c_address = 0x3C,
    .spi_hz = 400000,
    .pins = {.clock = BOARD_PIN(5), .data = BOARD_PIN(4)},
    .band_height = 16,
    BUDGET_RP2040,
};
