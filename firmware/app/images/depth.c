/*
 * The image of the depth lab measures on the microcontroller itself. It prints on the log UART, byte for byte, what
 * these commands print on a host, and then `done`. It needs no panel.
 *
 *   pinhole-depth pairs --near .1 --far 1000 --count 500 --csv - --format FORMATS
 *   pinhole-depth resolve --near 1 --far 4 --csv - --format FORMATS
 *
 * FORMATS: all but those with ieee32 or int24 in their names, which need floating point.
 */
#include "lab.h"
#include "port.h"

static void put(void *context, const char *text)
{
    (void)context;
    port_log(text);
}

int main(void)
{
    static uint64_t memory[2048];     /* 16 KiB: a microcontroller can spare so much */
    struct lab lab = {.near_z = 6554, /* 0.1 */
                      .far_z = FX_INT(1000),
                      .formats = UINT32_MAX,
                      .count = 500,
                      .memory = memory,
                      .memory_bytes = sizeof memory,
                      .put = put};
    int status = lab_pairs(&lab);
    lab.near_z = FX_ONE;
    lab.far_z = FX_INT(4);
    status = status == 0 ? lab_resolve(&lab) : status;
    port_log(status == 0 ? "done\n" : "failed\n");
    port_exit(status == 0 ? 0 : 1);
    return 0;
}
