/* A stand-in of the pico-sdk's SPI: a controller that knows CASET, RASET and RAMWR. */
#pragma once
#include "gpio.h"

#define spi0 ((void *)1)

static uint8_t stand_in_command;
static uint32_t stand_in_window[2][2]; /* first and last: columns, rows */

typedef struct {
    volatile uint32_t dr;
} spi_hw_t;

static inline spi_hw_t *spi_get_hw(void *spi)
{
    static spi_hw_t registers;
    (void)spi;
    return &registers;
}

static inline uint spi_init(void *spi, uint hz)
{
    (void)spi;
    return hz;
}

static inline uint spi_get_dreq(void *spi, bool transmit)
{
    return spi == spi0 && transmit ? 16 : 0;
}

static inline bool spi_is_busy(void *spi)
{
    return spi != spi0;
}

static inline int spi_write_blocking(void *spi, const uint8_t *bytes, size_t n)
{
    (void)spi;
    if (!stand_in_pins[16]) { /* DC is low */
        stand_in_command = bytes[0];
    } else if (n == 4 && (stand_in_command == 0x2a || stand_in_command == 0x2b)) {
        stand_in_window[stand_in_command - 0x2a][0] = (uint32_t)bytes[0] << 8 | bytes[1];
        stand_in_window[stand_in_command - 0x2a][1] = (uint32_t)bytes[2] << 8 | bytes[3];
    }
    return (int)n;
}
