/*
 * debounce: finds presses in the edges of a button's contact. A press counts at its first edge. The edges in the
 * settling time after it do not count; the level at which the contact then rests does. A press that began and ended
 * between two looks is seen by the next look. Pure; private to hal/linux.
 */
#ifndef HAL_LINUX_DEBOUNCE_H
#define HAL_LINUX_DEBOUNCE_H

#include "linux_types.h"

/* Starts with the contact as it is. */
void linux_debounce_start(struct linux_button *button, bool pressed, uint64_t now_ns);

/* Takes an edge to this state, in the order of time. settle_ns 0: edges come debounced. */
void linux_debounce_edge(struct linux_button *button, bool pressed, uint64_t time_ns, uint64_t settle_ns);

/* Whether a button is held now, or was pressed since the last look. */
bool linux_debounce_look(struct linux_button *button, uint64_t now_ns, uint64_t settle_ns);

#endif
