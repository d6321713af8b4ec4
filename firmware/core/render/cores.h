/* cores: work that two cores share. Private to firmware/core. */
#ifndef PH_CORES_H
#define PH_CORES_H

#include "render.h"

#define PH_SHARED_LEAST 32 /* of fewer vertices or triangles one core does all */

/* Runs the same on both cores: with `mine` here, and with `others` on the other core; without one, or if it is busy,
 * here. Returns when both are done. Neither may change what the other reads. */
static inline void ph_run_both(const struct ph_renderer *r, void (*run)(void *argument), void *mine, void *others)
{
    const bool both = r->config.other_core != NULL && r->config.other_core(run, others);
    run(mine);
    if (both) {
        r->config.other_core_join();
    } else {
        run(others);
    }
}

/* Whether there is another core, and it is free. */
bool ph_other_core_is_free(const struct ph_renderer *r);

#endif
