/*
 * panel_identify: finds out which options make a display right whose module is not what its name says. It asks one
 * question after the other: which colours, which way up, where the glass lies in the controller's memory. For each the
 * test card is shown in all variants, in turn and with a number on it, until the user types the number of the right
 * one.
 */
#ifndef PANEL_IDENTIFY_H
#define PANEL_IDENTIFY_H

#include "board.h"
#include "demo.h"
#include "panel_options.h"

#include <stdio.h>

enum panel_question { PANEL_COLOURS, PANEL_TURN, PANEL_PLACE, PANEL_QUESTIONS };

#define PANEL_VARIANTS_MAX 5

/*
 * The variants of a question: wirings that differ from `w` in what the question is about. The first one is what the
 * board shows with `w`, which is board->panel and board->rotation. Returns how many: 1 where there is no choice.
 */
uint32_t panel_identify_variants(enum panel_question question, const struct panel_wiring *w, const struct board *board,
                                 struct panel_wiring variants[PANEL_VARIANTS_MAX]);

/* The test card, with the name of the scene's view written over it: below the colour bars, in white. */
struct demo panel_identify_card(void);

/* What panel_identify needs to see and hear; tests play it. */
struct panel_identify_user {
    /* Chooses the board of a wiring. 0, or an error that was told. */
    int (*board)(void *context, const struct panel_wiring *w, struct board *board);
    /* Shows a variant for a while, or until something is typed. 0, or an error that was told. */
    int (*show)(void *context, const struct panel_wiring *w, const char *number);
    /* What was typed: a number; 0: nothing, or no number; -1: nothing more will come. */
    int (*typed)(void *context);
    void *context;
};

/* Asks all questions that have a choice, and changes `w` to the answers. 0, COMPLAINED, or an error of the user's. */
int panel_identify(struct panel_wiring *w, const struct panel_identify_user *user);

/* Prints what was found: the options, the line for board.c, and the members of a panel's own table. */
void panel_identify_print(FILE *out, const struct panel_wiring *w, const struct board *board);

#endif
