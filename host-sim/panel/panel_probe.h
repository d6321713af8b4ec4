/*
 * panel_probe: finds out which controller a panel has, by its identification bytes: RDDID (04h) and, on controllers of
 * Ilitek, RDID4 (D3h). They are read slowly after a reset.
 */
#ifndef PANEL_PROBE_H
#define PANEL_PROBE_H

#include "hal.h"

#include "board.h"

#define PROBE_BYTES 5

/* The PROBE_BYTES bytes after each command, as they come off the wire. */
struct panel_answers {
    uint8_t id[PROBE_BYTES];  /* 04h */
    uint8_t id4[PROBE_BYTES]; /* D3h */
};

/* Resets the panel of an open kit and asks it; the panel is asleep then. 0, or a status of hal.h (HAL_ENOSYS: the kit
 * has no data line back). */
int panel_probe_read(const struct hal *hal, const struct board *board, struct panel_answers *answers);

/* Returns the controller's name; NULL: nothing answered, or an unknown one. */
const char *panel_probe_name(const struct panel_answers *answers);

/* Did anything answer? Then not all bits are the same. */
bool panel_probe_answered(const struct panel_answers *answers);

#endif
