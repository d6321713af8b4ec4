/* panel_facts: what a computer says of itself and of a kit, as lines for a report (self_test.h). */
#ifndef PANEL_FACTS_H
#define PANEL_FACTS_H

#include "panel_kit.h"
#include "self_test.h"

/* Tells about an open kit; context is its struct panel_kit. */
void panel_facts(const void *context, self_test_put *put);

#endif
