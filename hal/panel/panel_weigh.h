/* panel_weigh: whether a frame is better sent whole than as what changed, by the time that both took. Private to
 * panel_diff. */
#ifndef PANEL_WEIGH_H
#define PANEL_WEIGH_H

#include "panel_diff.h"

/* Takes the time of the frame before, then decides on this one. Only for backends whose writes take time: false for
 * others. */
bool panel_weigh(struct panel_diff *diff, const struct panel_driver *d);

#endif
