/* panels: the panels that boards name. */
#ifndef PANELS_H
#define PANELS_H

#include "panel.h"

extern const struct panel_controller panel_st7789; /* for panels that a caller makes up */

/* Panels of make's PANEL_DIR. */
#ifndef PANELS_MORE
#define PANELS_MORE(P)
#endif

/* The panels that boards name: each is a struct panel in panel/panels_*.c. */
/* clang-format off */
#define PANELS_EACH(P) \
    P(st7789_240x240) P(st7789_135x240) P(st7789_240x320) P(st7789_170x320) P(st7789_172x320) P(st7789_240x280) P(gc9a01_240x240) \
    P(ili9341_240x320) P(ili9488_320x480) P(st7796s_320x480) P(hx8357d_320x480) P(ili9486_320x480) \
    P(st7735s_128x128) P(st7735s_128x160) P(st7735s_80x160) \
    P(ssd1351_128x128) P(ssd0323_128x64) P(ssd1306_128x64) P(ssd1306_128x32) P(ssd1306_72x40) P(ssd1309_128x64) \
    P(sh1106_128x64) P(sh1107_64x128) P(sh1107_128x128) P(ls013b7dh03_128x128) P(ls027b7dh01_400x240) PANELS_MORE(P)
/* clang-format on */

/* Declares each of them. */
#define PANELS_DECLARE(name) extern const struct panel panel_##name;
PANELS_EACH(PANELS_DECLARE)

#endif
