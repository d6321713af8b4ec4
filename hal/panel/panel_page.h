/* panel_page: the part of the driver that makes one-bit pages. For panel_pack.c only; it follows panel_pack.h. */
#ifndef PANEL_PAGE_H
#define PANEL_PAGE_H

#include "panel.h"

/* Divides the scratch memory. HAL_EINVAL: it is too small, or the panel does not consist of whole pages. */
int panel_page_init(struct panel_driver *d);

/* Converts line d->row of the window, whose first pixel is *pixels. What is complete is sent. */
int panel_page_line(struct panel_driver *d, const uint8_t *pixels);

#endif
