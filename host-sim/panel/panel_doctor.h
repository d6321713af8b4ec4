/*
 * panel_doctor: `pinhole-panel doctor`. Each check is a line on stdout, "ok    what" or "FAIL  what: why; what to do".
 */
#ifndef PANEL_DOCTOR_H
#define PANEL_DOCTOR_H

#include "panel_kit.h"

/* Checks the displays that were given, or what any display needs here. kit is room for one of them. 0, COMPLAINED if a
 * check failed, or PH_ERR_INVAL. */
int panel_doctor(struct panel_kit *kit, const struct panel_options *o);

#endif
