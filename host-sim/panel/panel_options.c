/* See panel_options.h. One table has every option, its reader and its help; --board begins a further display. */
#include "panel_options.h"

#include "complain.h"
#include "option_table.h"
#include "option_text.h"
#include "render.h"

#include <stdio.h>
#include <string.h>

#define FRAME_LIMIT 1000000000u
#define LINES_LIMIT 1024
#define HZ_LIMIT    200000000u

/* Returns the display that the options now describe: that of the last --board. */
static struct panel_wiring *wiring(struct panel_options *o)
{
    o->kit_count = o->kit_count == 0 ? 1 : o->kit_count;
    return &o->kits[o->kit_count - 1];
}

static bool set_text(const char **out, const char *value)
{
    *out = value;
    return *value != '\0';
}

/* A second --board starts another display. */
static bool set_board(void *to, const char *value)
{
    struct panel_options *o = to;
    if (wiring(o)->board != NULL && o->kit_count++ == PANEL_KITS_MAX) {
        return false;
    }
    return set_text(&wiring(o)->board, value);
}

static bool set_panel(void *to, const char *value)
{
    return set_text(&wiring(to)->panel, value);
}

static bool set_spi(void *to, const char *value)
{
    return set_text(&wiring(to)->spi, value);
}

static bool set_dc(void *to, const char *value)
{
    return set_text(&wiring(to)->lines[PANEL_DC], value) && strcmp(value, "-") != 0;
}

static bool set_reset(void *to, const char *value)
{
    return set_text(&wiring(to)->lines[PANEL_RESET], value);
}

static bool set_backlight(void *to, const char *value)
{
    return set_text(&wiring(to)->lines[PANEL_BACKLIGHT], value);
}

static bool set_te(void *to, const char *value)
{
    return set_text(&wiring(to)->lines[PANEL_TE], value);
}

static bool set_usb(void *to, const char *serial)
{
    wiring(to)->usb = true;
    wiring(to)->serial = serial;
    return serial == NULL || *serial != '\0';
}

static bool set_drm(void *to, const char *where)
{
    wiring(to)->drm = true;
    wiring(to)->card = where;
    return where == NULL || *where != '\0';
}

static bool set_mode(void *to, const char *value)
{
    static const char *const names[] = {"0", "3"};
    const int found = option_text_choice(value, names, 2);
    wiring(to)->mode = found > 0 ? 3 : 0;
    wiring(to)->mode_set = true;
    return found >= 0;
}

static bool set_rotate(void *to, const char *value)
{
    wiring(to)->rotate_set = true;
    return option_text_turns(value, &wiring(to)->rotate);
}

static bool set_invert(void *to, const char *value)
{
    static const char *const names[] = {"off", "on"};
    const int found = option_text_choice(value, names, 2);
    wiring(to)->invert_set = true;
    wiring(to)->invert = found == 1;
    return found >= 0;
}

static bool set_bgr(void *to, const char *value)
{
    (void)value; /* it takes none */
    wiring(to)->bgr = true;
    return true;
}

static bool set_offset(void *to, const char *value)
{
    const char *comma = strchr(value, ',');
    char first[8];
    if (comma == NULL || (size_t)(comma - value) >= sizeof first) {
        return false;
    }
    memcpy(first, value, (size_t)(comma - value));
    first[comma - value] = '\0';
    wiring(to)->offset_set = true;
    return option_text_u32(first, 0, 1023, &wiring(to)->offset[0]) &&
           option_text_u32(comma + 1, 0, 1023, &wiring(to)->offset[1]);
}

static bool set_speed(void *to, const char *value)
{
    return option_text_u32(value, 1, HZ_LIMIT, &wiring(to)->speed_hz);
}

static bool set_depth(void *to, const char *value)
{
    return option_text_depth(value, &((struct panel_options *)to)->depth);
}

static bool set_diff(void *to, const char *value)
{
    static const char *const names[] = {"off", "on"};
    struct panel_options *o = to;
    const int found = option_text_choice(value, names, 2);
    o->diff = found == 1;
    return found >= 0;
}

static bool set_list(void *to, const char *value)
{
    struct panel_options *o = to;
    (void)value;
    o->command = PANEL_LIST;
    return true;
}

static bool set_help(void *to, const char *value)
{
    struct panel_options *o = to;
    (void)value;
    o->command = PANEL_HELP;
    return true;
}

#define LINE_ALLOWED "a line: GPIO25, gpiochip0:25, a chip's label and :25, or AC0 on an FT232H; - for not wired"

static const struct option_row rows[] = {
    {"board", "NAME", "a kit; given twice: two displays, in step. The options after it are for this display",
     "a name that `pinhole-panel list` shows, at most 4 times", .set = set_board},
    {"panel", "NAME", "the glass of a home-wired display, with or without --board",
     "a name that `pinhole-panel list` shows", .set = set_panel},
    {"spi", "PATH", "the SPI device", "a path like /dev/spidev0.0", .set = set_spi},
    {"usb", "[SERIAL]", "the display is on an FT232H; of several the one with this serial number",
     "nothing or a serial number", .set = set_usb},
    {"drm", "[CARD[:CONNECTOR]]",
     "a display that the kernel drives (HDMI, DSI, panel-mipi-dbi); the first that is connected by default.\n"
     "        The arrow keys and Enter of every input device are its buttons",
     "nothing, or a name that `pinhole-panel list` shows", .set = set_drm},
    {"dc", "LINE", "the display's D/C line",
     "a line: GPIO25, gpiochip0:25, a chip's label and :25, or AC0 on an FT232H", .set = set_dc},
    {"reset", "LINE", "its reset line", LINE_ALLOWED, .set = set_reset},
    {"backlight", "LINE", "its backlight", LINE_ALLOWED, .set = set_backlight},
    {"te", "LINE", "its tearing-effect line: each frame begins at its edge", LINE_ALLOWED, .set = set_te},
    {"mode", "0|3", "SPI mode; 3 for displays without chip select", "0 or 3", .set = set_mode},
    {"speed", "HZ", "the bus clock asked for; the board's own by default", "a whole number, 1 .. 200000000",
     .set = set_speed},
    {"invert", "on|off", "for a glass that shows the negative: the controller inverts, or does not", "on or off",
     .set = set_invert},
    {"bgr", NULL, "for a glass that shows red as blue", NULL, .set = set_bgr},
    {"offset", "X,Y", "columns and rows of the controller's memory before the glass, unless it mirrors them",
     "two whole numbers, 0 .. 1023", .set = set_offset},
    {"rotate", "0|90|180|270",
     "how far the picture is turned clockwise in the controller's memory; 0 is the controller's own top; the\n"
     "        board's own by default",
     "0, 90, 180 or 270 degrees", .set = set_rotate},
    {"demo", "NAME", "a built-in scene; turntable by default", "a name that `pinhole-sim --list` shows",
     .at = offsetof(struct panel_options, demo)},
    {"view", "NAME", "one of the demo's views; the first by default", "a name that `pinhole-sim --list` shows",
     .at = offsetof(struct panel_options, view)},
    {"model", "FILE", "a model file on the turntable", "an OBJ, STL, PLY, glTF or GLB file",
     .at = offsetof(struct panel_options, model)},
    MODEL_OPTION_ROWS(struct panel_options, model_options),
    {"frames", "N", "ends after N frames; else when it is stopped (Ctrl-C)", "a whole number, 1 .. 1000000000",
     .at = offsetof(struct panel_options, frames), .least = 1, .most = FRAME_LIMIT},
    {"start", "N", "number of the first frame; 0 by default", "a whole number, 0 .. 1000000000",
     .at = offsetof(struct panel_options, start), .least = 0, .most = FRAME_LIMIT},
    {"fps", "N", "at most N frames a second", "a whole number, 1 .. 1000", .at = offsetof(struct panel_options, fps),
     .least = 1, .most = 1000},
    {"diff", "on|off", "sends only what changed; off by default", "on or off", .set = set_diff},
    {"refresh", "N", "with --diff on: all of the picture every N frames", "a whole number, 1 .. 1000000000",
     .at = offsetof(struct panel_options, refresh), .least = 1, .most = FRAME_LIMIT},
    {"band", "LINES", "height of a band; the board's own by default", "a whole number of lines, 1 .. 1024",
     .at = offsetof(struct panel_options, band), .least = 1, .most = LINES_LIMIT},
    {"depth", "FORMAT", "what the depth buffer holds; auto by default, as in pinhole-sim", OPTION_DEPTH_VALUES,
     .set = set_depth, .alias = OPTION_DEPTH_ALIAS},
    {"overlay", NULL, "writes the frame time of the bus and the triangles drawn over the picture", NULL,
     .at = offsetof(struct panel_options, overlay)},
    {"stats", NULL, "frames a second, bytes and bus share, once a second on stderr", NULL,
     .at = offsetof(struct panel_options, stats)},
    {"list", NULL, "prints the boards and the panels, as the command list does", NULL, .set = set_list},
    {"help", NULL, "prints this, as does -h", NULL, .set = set_help},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

void panel_options_help(void)
{
    puts("pinhole-panel [COMMAND] [options]: shows a scene on a display at this machine's SPI bus or USB, or one that\n"
         "the kernel drives.\n"
         "\n"
         "Commands (none: shows the scene until it is stopped):\n"
         "  list       the boards and the panels\n"
         "  doctor     checks what a display needs here: a line for each check, and what to do about a failure\n"
         "  probe      asks the display which controller it has, if its data line back is wired\n"
         "  testcard   corner dots, ring, arrow up, colour bars: what is wrong with a panel\n"
         "  speedtest  shows the test card at one bus clock after the other\n"
         "  identify   shows the test card in one variant after another, each with a number: you say which is right\n"
         "  report     shows the test card, compares drawn frames with known ones, and writes text to paste\n"
         "\n"
         "Options:");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed; 2 wrong usage; 130, 143, 129 stopped by Ctrl-C, SIGTERM, SIGHUP.");
}

static bool read_command(struct panel_options *o, const char *word)
{
    static const char *const names[] = {"run",      "list",      "doctor", "probe",
                                        "testcard", "speedtest", "report", "identify"};
    const int found = option_text_choice(word, names, sizeof names / sizeof names[0]);
    o->command = found >= 0 ? (enum panel_command)found : PANEL_RUN;
    return found >= 0;
}

/* The kernel has the wires of a display that it drives. */
static int check_drm(const struct panel_options *o)
{
    const struct panel_wiring *w = &o->kits[0];
    bool wired = w->board != NULL || w->panel != NULL || w->spi != NULL || w->usb || w->mode_set || w->speed_hz != 0;
    for (int i = 0; i < PANEL_LINES; i++) {
        wired = wired || w->lines[i] != NULL;
    }
    if (wired || o->kit_count > 1) {
        return complain_usage("--drm: the kernel has this display's wires, and it is the only one: give no --board, "
                              "--panel, wire or clock with it");
    }
    if (o->diff) {
        return complain_usage("--drm and --diff exclude each other: only what changed is given to the kernel anyway");
    }
    return o->command == PANEL_RUN || o->command == PANEL_TESTCARD || o->command == PANEL_REPORT
               ? 0
               : complain_usage("--drm is for showing a scene, for testcard and report, not for this command");
}

static int check_together(const struct panel_options *o)
{
    if (o->kit_count > 0 && o->kits[0].drm) {
        const int status = check_drm(o);
        if (status != 0) {
            return status;
        }
    }
    if (o->demo != NULL && o->model != NULL) {
        return complain_usage("--demo and --model exclude each other");
    }
    const bool scene = o->demo != NULL || o->model != NULL || o->view != NULL;
    if (scene && o->command != PANEL_RUN) {
        return complain_usage("--demo, --view and --model are for showing a scene, not for this command");
    }
    if (o->refresh != 0 && !o->diff) {
        return complain_usage("--refresh is for --diff on: without it every frame is sent whole");
    }
    if (o->command == PANEL_RUN || o->command == PANEL_TESTCARD) {
        return o->kit_count > 0 ? 0
                                : complain_usage("no display: give --board NAME (`pinhole-panel list` shows "
                                                 "them), --panel NAME and its wiring, or --drm (see --help)");
    }
    if (o->command != PANEL_LIST && o->command != PANEL_DOCTOR && o->kit_count != 1) {
        return complain_usage("one display at a time: give one --board NAME, or --panel NAME and its wiring");
    }
    return 0;
}

int panel_options_read(struct panel_options *o, int argc, char *const argv[])
{
    *o = (struct panel_options){.depth = {PH_DEPTH_AUTO, 0}};
    int i = 1;
    if (argc > 1 && argv[1][0] != '-') {
        if (!read_command(o, argv[1])) {
            return complain_usage(
                "'%s': no such command; run, list, doctor, probe, testcard, speedtest, report or identify", argv[1]);
        }
        i = 2;
    }
    while (i < argc) {
        i = option_table_read(&table, o, argc, argv, i);
        if (i < 0) {
            return i;
        }
    }
    return o->command == PANEL_HELP ? 0 : check_together(o);
}
