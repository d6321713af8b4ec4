/*
 * panel_doctor: `pinhole-panel doctor`. Each check is a line on stdout, "ok    what" or "FAIL  what: why; what to do".
 */
#ifndef PANEL_DOCTOR_H
#define PANEL_DOCTOR_H

#include "panel_kit.h"

/*
 * The displays that were given, else what any display needs here. kit: room for one of them, any content. 0,
 * COMPLAINED if a check failed, or PH_ERR_INVAL.
 */
int panel_doctor(struct panel_kit *kit, const struct panel_options *o);

#endif
