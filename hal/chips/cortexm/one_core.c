/* See port.h: for chips with one core, and images that use only one. */
#include "port.h"

bool port_core_run(void (*run)(void *argument), void *argument)
{
    (void)run;
    (void)argument;
    return false;
}

void port_core_join(void)
{
}
