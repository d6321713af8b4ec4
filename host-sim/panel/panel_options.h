/* panel_options: the command line of pinhole-panel. Its values point into argv. */
#ifndef PANEL_OPTIONS_H
#define PANEL_OPTIONS_H

#include "board.h"
#include "model.h"
#include "option_text.h"

#define PANEL_KITS_MAX 4

enum panel_command {
    PANEL_RUN,
    PANEL_LIST,
    PANEL_DOCTOR,
    PANEL_PROBE,
    PANEL_TESTCARD,
    PANEL_SPEEDTEST,
    PANEL_REPORT,
    PANEL_IDENTIFY,
    PANEL_HELP,
};

enum panel_line { PANEL_DC, PANEL_RESET, PANEL_BACKLIGHT, PANEL_TE, PANEL_LINES };

/* One display: a board, or a panel with its wiring. NULL or 0: as the board has it. */
struct panel_wiring {
    const char *board;
    const char *panel;
    const char *spi;                /* path of a spidev */
    const char *lines[PANEL_LINES]; /* "-": not wired */
    bool usb;
    const char *serial; /* of the FT232H, or NULL: the only one */
    bool drm;
    const char *card; /* CARD[:CONNECTOR], or NULL: the first display that the kernel drives */
    bool mode_set;
    uint8_t mode; /* SPI mode, 0 or 3 */
    bool rotate_set;
    uint8_t rotate; /* enum panel_rotation */
    uint32_t speed_hz;
    bool invert_set, invert;
    bool bgr; /* red and blue change places */
    bool offset_set;
    uint32_t offset[2]; /* of the glass in the controller's memory, columns and rows */
};

struct panel_options {
    enum panel_command command;
    struct panel_wiring kits[PANEL_KITS_MAX];
    int kit_count;
    const char *demo, *view, *model; /* NULL: not given */
    struct model_options model_options;
    uint32_t start, frames; /* frames 0: until it is stopped */
    uint32_t fps;           /* 0: as fast as it goes */
    uint32_t band;          /* lines, 0: the board's own */
    struct option_depth depth;
    bool diff;        /* send only what changed */
    uint32_t refresh; /* and all of it every so many frames; 0: never */
    bool stats, overlay;
};

/* Reads the command line. 0 or PH_ERR_INVAL. */
int panel_options_read(struct panel_options *o, int argc, char *const argv[]);

void panel_options_help(void);

#endif
