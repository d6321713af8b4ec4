/* panel_pack: the part of the driver that converts pixels. For panel.c only. */
#ifndef PANEL_PACK_H
#define PANEL_PACK_H

#include "panel.h"

/* Divides the scratch memory. HAL_EINVAL: too small for this panel. */
int panel_pack_init(struct panel_driver *d);

/* Converts line d->row of the window, whose first pixel is the one given, and sends what fills a half of the scratch
 * memory. */
int panel_pack_line(struct panel_driver *d, const uint8_t *pixels);

/* Sends the rest of a window. */
int panel_pack_end(struct panel_driver *d);

#endif
