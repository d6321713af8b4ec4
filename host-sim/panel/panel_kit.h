/* panel_kit: the display that the command line names: on this machine's SPI bus, on an FT232H, or the kernel's own. */
#ifndef PANEL_KIT_H
#define PANEL_KIT_H

#include "ft232h/ft232h.h"
#include "kms/kms.h"
#include "linux/linux.h"
#include "panel_options.h"

/* A kit that was chosen. It must not move after that: the board points into it, and the backend to it. */
struct panel_kit {
    struct board board;         /* with what the command line changes */
    struct hal hal;             /* not open */
    struct panel_sender sender; /* zeros: the panel driver */
    bool usb, drm;
    struct linux_hal linux;
    struct ft232h ft232h;
    struct kms kms;
    struct panel glass; /* of kms, or the board's with another offset, colours or inversion */
    uint8_t init[512];  /* its initialisation, if inverted otherwise */
    char title[40];
};

/* Can pinhole-panel drive it? Its pins must be lines of an operating system or of an FT232H. */
bool panel_kit_has(const struct board *board);

/* Chooses the kit that the options name. 0, PH_ERR_INVAL or COMPLAINED. */
int panel_kit_choose(struct panel_kit *kit, const struct panel_wiring *wiring);

/* Gives back what panel_kit_choose took, and says what went unseen while the kit was open. */
void panel_kit_release(struct panel_kit *kit);

/* Returns the last error in the words of the backend, or "". */
const char *panel_kit_error(const struct panel_kit *kit);

#endif
