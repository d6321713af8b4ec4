/* A stand-in of the pico-sdk's pins: the state of DC (16) and CS (17) is kept. */
#pragma once
#include "stand_in.h"

typedef unsigned uint;
enum { GPIO_FUNC_SPI = 1 };

static bool stand_in_pins[32];

static inline void gpio_init(uint pin)
{
    stand_in_pins[pin] = false;
}

static inline void gpio_set_dir(uint pin, bool out)
{
    stand_in_pins[pin] = stand_in_pins[pin] && out;
}

static inline void gpio_put(uint pin, bool value)
{
    stand_in_pins[pin] = value;
}

static inline void gpio_set_function(uint pin, uint function)
{
    (void)pin;
    (void)function;
}
