/* What arenas take on a 32-bit target, as other machines have to know it: see demo.h and memory_plan.h. */
#include "demo.h"

#include <string.h>

#define LEVELS_MAX 5

static const struct {
    const char *demo;
    uint32_t bytes[LEVELS_MAX];
} arenas[] = {
#include "arenas.inc"
};

/* Whether this machine lays out structs as a 32-bit target does. x86 with 32 bits does not: it aligns 64-bit members
 * less. */
static bool is_target(void)
{
    return sizeof(void *) == 4 && _Alignof(uint64_t) == 8;
}

uint32_t demo_arena_bytes_32(const struct demo *demo, uint32_t level)
{
    const size_t here = level > 0 ? demo->coarser[level - 1].arena_bytes : demo->arena_bytes;
    const uint32_t known = level > 0 ? demo->coarser[level - 1].arena_bytes_32 : demo->arena_bytes_32;
    if (known != 0 || is_target()) {
        return known != 0 ? known : (uint32_t)here;
    }
    for (size_t i = 0; i < sizeof arenas / sizeof arenas[0]; i++) {
        if (strcmp(arenas[i].demo, demo->name) == 0 && level < LEVELS_MAX && arenas[i].bytes[level] != 0) {
            return arenas[i].bytes[level];
        }
    }
    return (uint32_t)here;
}
