/* panel_pack: the part of the driver that converts pixels. For panel.c only. */
#ifndef PANEL_PACK_H
#define PANEL_PACK_H

#include "panel.h"

/* Divides the scratch memory. HAL_EINVAL: it is too small for this panel. */
int panel_pack_init(struct panel_driver *d);

/* Converts line d->row of the window, whose first pixel is *pixels. Each full half of the scratch memory is sent. */
int panel_pack_line(struct panel_driver *d, const uint8_t *pixels);

/* Sends what the half has, and goes on with the other. */
int panel_pack_flush(struct panel_driver *d);

/* Sends the rest of the window. */
int panel_pack_end(struct panel_driver *d);

#endif
