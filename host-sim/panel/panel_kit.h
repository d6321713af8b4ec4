/* panel_kit: the display that the command line names, on this machine's SPI bus or an FT232H. */
#ifndef PANEL_KIT_H
#define PANEL_KIT_H

#include "ft232h/ft232h.h"
#include "linux/linux.h"
#include "panel_options.h"

/* Must not move once it is chosen: the board points into it, and the backend to it. */
struct panel_kit {
    struct board board; /* with what the command line changes */
    struct hal hal;     /* not open */
    bool usb;
    struct linux_hal linux;
    struct ft232h ft232h;
};

/* Can pinhole-panel drive it? Its pins must be lines of an operating system or of an FT232H. */
bool panel_kit_has(const struct board *board);

/* 0 or PH_ERR_INVAL. */
int panel_kit_choose(struct panel_kit *kit, const struct panel_wiring *wiring);

/* Returns the last error in the words of the backend, or "". */
const char *panel_kit_error(const struct panel_kit *kit);

#endif
