/* See cores.h. */
#include "cores.h"

PH_TIER(mesh) static void nothing(void *argument) /* called as run */
{
    (void)argument;
}

PH_TIER(mesh) bool ph_other_core_is_idle(const struct ph_renderer *r)
{
    if (r->config.other_core == NULL || !r->config.other_core(nothing, NULL)) {
        return false;
    }
    r->config.other_core_join();
    return true;
}

PH_TIER(seldom)
void ph_draw_in_parts(struct ph_renderer *r, const struct ph_band *band, int32_t rows, void (*run)(void *share))
{
    const bool both = rows > 0 && ph_other_core_is_idle(r);
    struct ph_share mine = {r, *band, 0, both ? 2 : 1, 0}, others = mine;
    if (both) {
        others.part = 1;
        others.band = ph_cut_lower(&mine.band, rows);
        ph_run_both(r, run, &mine, &others);
    } else {
        run(&mine);
    }
    r->stats.fragments += mine.fragments + others.fragments;
}
