/*
 * The image of the depth lab: prints on the log UART what `pinhole-depth pairs --near 1 --far 8 --count 500 --csv -`
 * and `pinhole-depth resolve --near 1 --far 8 --csv -`, with --format all but the float32 rows, print on a host, byte
 * for byte; then `done`. No panel is needed.
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
    static uint64_t memory[3072]; /* 24 KiB: what a microcontroller of 64 KB can spare */
    const struct lab lab = {.near_z = FX_ONE,
                            .far_z = FX_INT(8),
                            .formats = UINT32_MAX,
                            .count = 500,
                            .memory = memory,
                            .memory_bytes = sizeof memory,
                            .put = put};
    int status = lab_pairs(&lab);
    if (status == 0) {
        status = lab_resolve(&lab);
    }
    port_log(status == 0 ? "done\n" : "failed\n");
    port_exit(status == 0 ? 0 : 1);
    return 0;
}
