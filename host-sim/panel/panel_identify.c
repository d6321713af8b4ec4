/* See panel_identify.h. */
#include "panel_identify.h"

#include "complain.h"
#include "overlay.h"

#include <stdio.h>
#include <string.h>

/* ---- the variants ------------------------------------------------------------------------------- */

/* Whether a panel's initialisation ends inverted; -1: it says nothing of that. */
static int inverts(const struct panel *panel)
{
    int found = -1;
    for (size_t i = 0; i + 2 <= panel->init_bytes; i += 2U + panel->init[i + 1]) {
        for (int k = 0; k < 2 && panel->init[i + 1] == 0; k++) {
            found = panel->init[i] == panel->controller->invert[k] ? k : found;
        }
    }
    return found;
}

static uint32_t colours(const struct panel_wiring *w, const struct panel *panel, struct panel_wiring *variants)
{
    const int inverted = inverts(panel);
    const uint32_t negatives = inverted < 0 ? 1 : 2, orders = panel->controller->rotation_bit_bgr != 0 ? 2 : 1;
    for (uint32_t i = 0; i < negatives * orders; i++) {
        variants[i] = *w;
        variants[i].invert_set = w->invert_set || i % negatives != 0;
        variants[i].invert = (inverted > 0) != (i % negatives != 0);
        variants[i].bgr = w->bgr != (i / negatives != 0);
    }
    return negatives * orders;
}

static uint32_t turns(const struct panel_wiring *w, const struct board *board, struct panel_wiring *variants)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < 4; i++) {
        const uint8_t rotation = (uint8_t)((board->rotation + i) & 3);
        if (panel_can_turn(board->panel, rotation)) {
            variants[n] = *w;
            variants[n].rotate_set = w->rotate_set || i != 0;
            variants[n++].rotate = rotation;
        }
    }
    return n;
}

/* Where makers bond a glass: as the panel has it, in the middle of the memory, at its start, at its end; and in the
 * middle of the 128 x 160 that an ST7735S has of its 132 x 162 by its pins. */
static uint32_t places(const struct panel_wiring *w, const struct panel *p, struct panel_wiring *variants)
{
    const uint32_t x = (uint32_t)p->ram_width - p->width, y = (uint32_t)p->ram_height - p->height;
    const bool pins = p->ram_width == 132 && p->ram_height == 162;
    const uint32_t at[PANEL_VARIANTS_MAX][2] = {
        {p->x0, p->y0}, {x / 2, y / 2}, {0, 0}, {x, y}, {pins ? x / 2 - 2 : 0, pins ? y / 2 - 1 : 0}};
    uint32_t n = 0;
    for (uint32_t i = 0; i < PANEL_VARIANTS_MAX; i++) {
        bool known = false;
        for (uint32_t k = 0; k < i; k++) {
            known = known || (at[k][0] == at[i][0] && at[k][1] == at[i][1]);
        }
        if (!known) {
            variants[n] = *w;
            variants[n].offset_set = w->offset_set || i != 0;
            memcpy(variants[n++].offset, at[i], sizeof at[i]);
        }
    }
    return n;
}

uint32_t panel_identify_variants(enum panel_question question, const struct panel_wiring *w, const struct board *board,
                                 struct panel_wiring variants[PANEL_VARIANTS_MAX])
{
    switch (question) {
    case PANEL_COLOURS:
        return colours(w, board->panel, variants);
    case PANEL_TURN:
        return turns(w, board, variants);
    default:
        return places(w, board->panel, variants);
    }
}

/* ---- the card ----------------------------------------------------------------------------------- */

static uint32_t card_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t lines = ph_draw_band(r, band, pixels);
    const int32_t height = context->height, scale = height / 80 > 1 ? height / 80 : 1;
    const struct ph_overlay_band over = {pixels, context->width, (int32_t)(band * r->config.band_height),
                                         (int32_t)lines};
    const struct ph_overlay_style style = {0xFFFF, 0, (uint8_t)(scale < 8 ? scale : 8)};
    ph_overlay_text(&over, (context->width - ph_overlay_width(context->view, style.scale)) / 2, height * 84 / 100,
                    context->view, &style);
    return lines;
}

struct demo panel_identify_card(void)
{
    struct demo card = *demo_find("testcard");
    card.band = card_band;
    return card;
}

/* ---- the questions ------------------------------------------------------------------------------ */

static const char *const questions[PANEL_QUESTIONS] = {
    [PANEL_COLOURS] = "Which card is white on black, with bars of red, green, blue, white and grey?",
    [PANEL_TURN] = "Which card has its arrow up, as you hold the display?",
    [PANEL_PLACE] = "Which card has its white line along all four edges?",
};

/* Shows the variants in turn until one of them is named. Returns its number, or an error. */
static int ask(const struct panel_wiring *variants, uint32_t n, const char *question,
               const struct panel_identify_user *user)
{
    fprintf(stderr, "%s\nType its number, 1 .. %u, and Enter; Enter alone shows the next.\n", question, (unsigned)n);
    for (uint32_t i = 0;; i = (i + 1) % n) {
        char number[12];
        snprintf(number, sizeof number, "%u", (unsigned)i + 1);
        const int status = user->show(user->context, &variants[i], number);
        const int typed = status == 0 ? user->typed(user->context) : 0;
        if (status != 0) {
            return status;
        }
        if (typed < 0) {
            return complain("no card was named: the display stays what its name says");
        }
        if (typed > 0 && (uint32_t)typed <= n) {
            return typed;
        }
    }
}

int panel_identify(struct panel_wiring *w, const struct panel_identify_user *user)
{
    for (int question = 0; question < PANEL_QUESTIONS; question++) {
        struct panel_wiring variants[PANEL_VARIANTS_MAX];
        struct board board;
        int status = user->board(user->context, w, &board);
        if (status != 0) {
            return status;
        }
        const uint32_t n = panel_identify_variants((enum panel_question)question, w, &board, variants);
        status = n > 1 ? ask(variants, n, questions[question], user) : 1;
        if (status <= 0) {
            return status;
        }
        *w = variants[status - 1];
    }
    return 0;
}

void panel_identify_print(FILE *out, const struct panel_wiring *w, const struct board *board)
{
    const struct panel *panel = board->panel;
    fprintf(out, "options ");
    if (w->invert_set) {
        fprintf(out, " --invert %s", w->invert ? "on" : "off");
    }
    fprintf(out, "%s", w->bgr ? " --bgr" : "");
    if (w->offset_set) {
        fprintf(out, " --offset %u,%u", (unsigned)w->offset[0], (unsigned)w->offset[1]);
    }
    fprintf(out, " --rotate %u\n", 90U * board->rotation);
    fprintf(out, "board.c  .rotation = PANEL_R%u,\n", 90U * board->rotation);
    fprintf(out, "panel    .x0 = %u, .y0 = %u, .rotation_base = 0x%02X,", panel->x0, panel->y0, panel->rotation_base);
    const int inverted = inverts(panel);
    if (inverted >= 0) {
        fprintf(out, " and in .init 0x%02X, 0,", panel->controller->invert[inverted]);
    }
    fprintf(out, "\n");
}
