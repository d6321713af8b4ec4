/*
 * Panels with a memory LCD of Sharp: LS013B7DH03 (1.28"), LS027B7DH01 (2.7"). Each pixel has
 * one bit of memory; see panel_line.h for what they take. They reflect: a bit of 1 is white.
 *
 * Their order is that of the data sheets: line 1 is the upper one, and a line begins at the left, with the connector
 * below the picture.
 */
#include "panels.h"

#include "panel_line.h"

/* 1 / (2 * 6 us): the longest tsSCS, see panel_line.h */
#define LINE_COMMANDS .init_hz = 83000, .lines = &panel_line_ops

static const struct panel_controller ls013b7dh03 = {
    .name = "LS013B7DH03",
    .write_hz = 1100000, /* timing characteristics: fSCLK; tsSCS 6 us, thSCS 2 us */
    LINE_COMMANDS,
};

static const struct panel_controller ls027b7dh01 = {
    .name = "LS027B7DH01",
    .write_hz = 2000000, /* timing characteristics: fSCLK; tsSCS 3 us, thSCS 1 us */
    LINE_COMMANDS,
};

#define LINE_PANEL(n, of, w, h)                                                                                        \
    {                                                                                                                  \
        .name = (n), .controller = (of), .width = (w), .height = (h), .ram_width = (w), .ram_height = (h),             \
        .formats = PANEL_FORMAT_BIT(PANEL_MONO_DITHER) | PANEL_FORMAT_BIT(PANEL_MONO_THRESHOLD)                        \
    }

const struct panel panel_ls013b7dh03_128x128 = LINE_PANEL("ls013b7dh03-128x128", &ls013b7dh03, 128, 128);
const struct panel panel_ls027b7dh01_400x240 = LINE_PANEL("ls027b7dh01-400x240", &ls027b7dh01, 400, 240);
