/* See rp2.h: pins of IO_BANK0. */
#include <registers.h>
#include "rp2.h"

void rp2_pin_write(uint32_t pin, bool level)
{
    REG(level ? SIO_GPIO_OUT_SET : SIO_GPIO_OUT_CLR) = 1U << pin;
}

void rp2_pin_function(uint32_t pin, uint32_t function)
{
    REG(IO_BANK0_CTRL(pin)) = function;
}

/* Makes a pin an output. Its level is set before the pin drives it. */
void rp2_pin_output(uint32_t pin, bool level)
{
    rp2_pin_write(pin, level);
    REG(SIO_GPIO_OE_SET) = 1U << pin;
    REG(PADS_BANK0(pin)) = PAD_SCHMITT | PAD_8_MA | PAD_INPUT;
    rp2_pin_function(pin, FUNCTION_SIO);
}

void rp2_pin_input(uint32_t pin)
{
    REG(SIO_GPIO_OE_CLR) = 1U << pin;
    REG(PADS_BANK0(pin)) = PAD_SCHMITT | PAD_PULL_UP | PAD_INPUT;
    rp2_pin_function(pin, FUNCTION_SIO);
}
