/*
 * panel_doctor: `pinhole-panel doctor`. Each check is a line on stdout, "ok    what" or "FAIL  what: why; what to do".
 */
#ifndef PANEL_DOCTOR_H
#define PANEL_DOCTOR_H

#include "panel_options.h"

/* The displays that were given, else what any display needs here. 0, or EXIT_FAILED if a check failed. */
int panel_doctor(const struct panel_options *o);

#endif
