#include "emulate_qemu.h"
int emulate_trace(const struct emulation *e)
{
    (void)e;
    return 1;
}
