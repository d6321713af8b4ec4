/* An image that prints the lines of firmware/app/arenas.inc: what each level of each demo takes in its arena. */
#include "demo.h"
#include "port.h"
#include "self_test.h"

static void put_bytes(const char *before, size_t bytes)
{
    port_log(before);
    self_test_number(port_log, (uint32_t)bytes, false, 1);
}

int main(void)
{
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct demo *const demo = demo_list[i];
        port_log("{\"");
        port_log(demo->name);
        put_bytes("\", {", demo->arena_bytes);
        for (uint32_t level = 0; level < demo->coarser_count; level++) {
            put_bytes(", ", demo->coarser[level].arena_bytes);
        }
        port_log("}},\n");
    }
    port_exit(0);
    return 0;
}
