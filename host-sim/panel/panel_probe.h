/*
 * panel_probe: which controller is this? By its identification bytes, read slowly after a reset: RDDID (04h) and, on
 * Ilitek's, RDID4 (D3h).
 */
#ifndef PANEL_PROBE_H
#define PANEL_PROBE_H

#include "hal.h"

#include "board.h"

#define PROBE_BYTES 5

/* What was read: after each command PROBE_BYTES bytes, as they come off the wire. */
struct panel_answers {
    uint8_t id[PROBE_BYTES];  /* 04h */
    uint8_t id4[PROBE_BYTES]; /* D3h */
};

/*
 * Resets the panel of an open kit and asks it. 0, or HAL_E..; HAL_ENOSYS: the kit has no data line back. The panel is
 * asleep then.
 */
int panel_probe_read(const struct hal *hal, const struct board *board, struct panel_answers *answers);

/* The controller's name; NULL: it is none that we know, or nothing answered. */
const char *panel_probe_name(const struct panel_answers *answers);

/* Whether anything answered: not all bits are the same. */
bool panel_probe_answered(const struct panel_answers *answers);

#endif
