/* See panel.h. */
#include "panels.h"

#define LISTED(name) &panel_##name,
const struct panel *const panel_list[] = {PANELS_EACH(LISTED)};

const uint32_t panel_count = sizeof panel_list / sizeof panel_list[0];
