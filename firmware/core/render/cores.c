/* See cores.h. */
#include "cores.h"

static void nothing(void *argument)
{
    (void)argument;
}

bool ph_other_core_is_free(const struct ph_renderer *r)
{
    if (r->config.other_core == NULL || !r->config.other_core(nothing, NULL)) {
        return false;
    }
    r->config.other_core_join();
    return true;
}
