/* A stand-in of the pico-sdk. */
#pragma once
#include <hardware/gpio.h>

static inline void sleep_ms(uint32_t ms)
{
    (void)ms;
}
