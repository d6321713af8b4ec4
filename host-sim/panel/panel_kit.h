/* panel_kit: the display that the command line names, on this machine's SPI bus or an FT232H. */
#ifndef PANEL_KIT_H
#define PANEL_KIT_H

#include "ft232h/ft232h.h"
#include "linux/linux.h"
#include "panel_options.h"

/* Stays where it is once it is chosen: the board points into it, the backend at it. */
struct panel_kit {
    struct board board; /* with what the command line changes */
    struct hal hal;     /* not open */
    bool usb;
    struct linux_hal linux;
    struct ft232h ft232h;
};

/* Whether pinhole-panel can drive it: its pins are lines of an operating system or of an FT232H. */
bool panel_kit_has(const struct board *board);

/* 0, or PH_ERR_INVAL when one line has said what is wrong. */
int panel_kit_choose(struct panel_kit *kit, const struct panel_wiring *wiring);

/* What the backend says about its last error; "" if nothing. */
const char *panel_kit_error(const struct panel_kit *kit);

#endif
