/* See panel_kit.h. A board of the list is copied and changed by the options: another panel, other lines, another
 * clock. */
#include "panel_kit.h"

#include "complain.h"
#include "nearest.h"
#include "panels.h"

#include <stdio.h>
#include <string.h>

/* The boards that lend their wiring when only a panel is named. */
#define PLAIN_SPI "sbc-generic"
#define PLAIN_USB "ft232h-st7789"

/* Whether a line is a pin of an FT232H, "AD0" .. "AC7". */
static bool is_usb_line(const char *line)
{
    return line != NULL && line[0] == 'A' && (line[1] == 'C' || line[1] == 'D') && line[2] >= '0' && line[2] <= '7' &&
           line[3] == '\0';
}

bool panel_kit_has(const struct board *board)
{
    const struct board_pin *pin = board->i2c_address != 0 ? &board->pins.data : &board->pins.dc;
    return pin->wired && pin->line != NULL;
}

static int choose_board(const struct panel_wiring *w, const struct board **board)
{
    const char *plain = w->usb ? PLAIN_USB : PLAIN_SPI;
    const char *name = w->board != NULL ? w->board : plain;
    *board = board_find(name);
    if (*board == NULL) {
        return complain_usage("--board '%s': no such board; %s`pinhole-panel list` shows them", name,
                              nearest_text(name, nearest_board, NULL));
    }
    if (!panel_kit_has(*board)) {
        return complain_usage("--board '%s': no kit for this machine's SPI bus or USB; `pinhole-panel list` "
                              "shows those",
                              name);
    }
    if (w->usb && !is_usb_line((*board)->pins.dc.line)) {
        return complain_usage("--usb: '%s' is no kit for an FT232H", name);
    }
    return 0;
}

/* Puts another glass on this board, in its first format and no faster than its datasheet allows. */
static int change_panel(struct board *board, const char *name)
{
    const struct panel *panel = panel_find(name);
    if (panel == NULL) {
        return complain_usage("--panel '%s': no such panel; `pinhole-panel list` shows them", name);
    }
    uint8_t format = PANEL_RGB565;
    while ((panel->formats & PANEL_FORMAT_BIT(format)) == 0) {
        format++;
    }
    board->panel = panel;
    board->format = format;
    board->rotation = PANEL_R0;
    board->over_limit = false;
    const uint32_t limit = panel->controller->write_hz;
    board->spi_hz = board->spi_hz < limit ? board->spi_hz : limit;
    return 0;
}

static int change_line(struct panel_kit *kit, enum panel_line which, const char *line)
{
    static const char *const names[] = {"dc", "reset", "backlight", "te"};
    struct board_pins *pins = &kit->board.pins;
    struct board_pin *const pin[] = {&pins->dc, &pins->reset, &pins->backlight, &pins->tearing};
    if (line == NULL) {
        return 0;
    }
    if (strcmp(line, "-") == 0) {
        *pin[which] = (struct board_pin){.wired = false};
        return 0;
    }
    if (kit->usb && !is_usb_line(line)) {
        return complain_usage("--%s '%s': a pin of the FT232H is AD0 .. AD7 or AC0 .. AC7", names[which], line);
    }
    if (kit->usb && which == PANEL_TE) {
        return complain_usage("--te: an FT232H has no line that waits for an edge");
    }
    *pin[which] = (struct board_pin){.wired = true, .line = line};
    return 0;
}

/* Replaces the command that inverts, or does not, in a copy of the initialisation. */
static void change_inversion(struct panel_kit *kit, bool invert)
{
    const uint8_t *codes = kit->glass.controller->invert;
    memcpy(kit->init, kit->glass.init, kit->glass.init_bytes);
    for (size_t i = 0; i + 2 <= kit->glass.init_bytes; i += 2U + kit->init[i + 1]) {
        if (kit->init[i + 1] == 0 && (kit->init[i] == codes[0] || kit->init[i] == codes[1])) {
            kit->init[i] = codes[invert];
        }
    }
    kit->glass.init = kit->init;
}

/* Changes the glass itself, for modules that are not what their name says. */
static int change_glass(struct panel_kit *kit, const struct panel_wiring *w)
{
    struct panel *glass = &kit->glass;
    *glass = *kit->board.panel;
    kit->board.panel = glass;
    if (w->offset_set) {
        if (w->offset[0] + glass->width > glass->ram_width || w->offset[1] + glass->height > glass->ram_height) {
            return complain_usage("--offset %u,%u: the %s has %ux%u pixels, the glass %ux%u", w->offset[0],
                                  w->offset[1], glass->controller->name, glass->ram_width, glass->ram_height,
                                  glass->width, glass->height);
        }
        glass->x0 = (uint16_t)w->offset[0];
        glass->y0 = (uint16_t)w->offset[1];
    }
    if (w->bgr && glass->controller->rotation_bit_bgr == 0) {
        return complain_usage("--bgr: the %s has one colour", glass->controller->name);
    }
    glass->rotation_base ^= w->bgr ? glass->controller->rotation_bit_bgr : 0;
    if (w->invert_set) {
        change_inversion(kit, w->invert);
    }
    return 0;
}

/* A board of the display's size. Its memory is this computer's. */
static int choose_drm(struct panel_kit *kit, const struct panel_wiring *w)
{
    memset(kit, 0, sizeof *kit);
    kit->drm = true;
    kit->kms.where = w->card;
    if (kms_find(&kit->kms) < 0) {
        return complain("%s", kms_error(&kit->kms));
    }
    kit->glass = panel_st7789_240x320;
    kit->glass.name = "kms";
    kit->glass.width = kit->glass.ram_width = kit->kms.width;
    kit->glass.height = kit->glass.ram_height = kit->kms.height;
    snprintf(kit->title, sizeof kit->title, "a display of %ux%u", kit->kms.width, kit->kms.height);
    kit->board = (struct board){.name = w->card != NULL ? w->card : "the kernel's display",
                                .title = kit->title,
                                .pinout = "none",
                                .panel = &kit->glass,
                                .rotation = w->rotate,
                                .format = PANEL_RGB565,
                                .spi_hz = INT32_MAX,
                                .band_height = 16,
                                .scene_bytes = UINT32_MAX};
    kit->hal = (struct hal){&kms_ops, &kit->kms};
    kit->sender = kms_sender(&kit->kms);
    return 0;
}

int panel_kit_choose(struct panel_kit *kit, const struct panel_wiring *w)
{
    const struct board *board = NULL;
    if (w->drm) {
        return choose_drm(kit, w);
    }
    int status = choose_board(w, &board);
    if (status != 0) {
        return status;
    }
    memset(kit, 0, sizeof *kit);
    kit->board = *board;
    kit->usb = is_usb_line(board->pins.dc.line);
    if (w->panel != NULL) {
        status = change_panel(&kit->board, w->panel);
        if (status == 0 && w->board == NULL) { /* messages name the panel, not the board that lent its wiring */
            kit->board.name = kit->board.panel->name;
        }
    }
    for (int i = 0; i < PANEL_LINES && status == 0; i++) {
        status = change_line(kit, (enum panel_line)i, w->lines[i]);
    }
    if (status == 0 && (w->invert_set || w->bgr || w->offset_set)) {
        status = change_glass(kit, w);
    }
    if (status == 0 && w->spi != NULL && kit->usb) {
        status = complain_usage("--spi %s: '%s' is on USB", w->spi, board->name);
    }
    kit->board.rotation = w->rotate_set ? w->rotate : kit->board.rotation;
    kit->board.spi_hz = w->speed_hz != 0 ? w->speed_hz : kit->board.spi_hz;
    kit->board.spi_mode = w->mode_set ? w->mode : kit->board.spi_mode;
    kit->linux.spi_path = w->spi;
    kit->ft232h.serial = w->serial;
    kit->hal = kit->usb ? (struct hal){&ft232h_ops, &kit->ft232h} : (struct hal){&linux_ops, &kit->linux};
    return status;
}

void panel_kit_release(struct panel_kit *kit)
{
    if (kit->kms.keys.denied) {
        complain_note("/dev/input: no permission to read it, so that there were no buttons; join the group input");
    }
    kms_card_close(kit->kms.card);
    kit->kms.card = NULL;
}

const char *panel_kit_error(const struct panel_kit *kit)
{
    return kit->drm ? kms_error(&kit->kms) : kit->usb ? ft232h_error(&kit->ft232h) : linux_hal_error(&kit->linux);
}
