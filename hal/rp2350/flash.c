/* See hal/rp2040/flash.h. The boot ROM has set up the read (RP2350 datasheet 5.2); it is left so. */
#include "rp2040/flash.h"

void rp2040_flash_open(void)
{
}

void rp2040_flash_measure(struct rp2040_flash_facts *facts)
{
    *facts = (struct rp2040_flash_facts){0};
}
