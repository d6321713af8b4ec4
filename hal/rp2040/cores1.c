/* See port.h: the second core sleeps in its ROM. */
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
