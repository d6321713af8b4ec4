/* panels: the panels that boards name. */
#ifndef PANELS_H
#define PANELS_H

#include "panel.h"

extern const struct panel_controller panel_st7789; /* for panels that a caller makes up */

extern const struct panel panel_st7789_240x240, panel_st7789_135x240, panel_st7789_240x320, panel_st7789_170x320,
    panel_st7789_240x280, panel_gc9a01_240x240, panel_ili9341_240x320, panel_ili9488_320x480, panel_st7735s_128x128,
    panel_st7735s_128x160, panel_st7735s_80x160, panel_ssd1351_128x128, panel_ssd0323_128x64;

#endif
