/*
 * debounce: from the edges of a button's contact to what its user meant. A press counts at its first edge; what the
 * contact does in the settling time after that does not count, and where it rests then does. A press that began and
 * ended between two looks is seen by the next look. Pure; private to hal/linux.
 */
#ifndef HAL_LINUX_DEBOUNCE_H
#define HAL_LINUX_DEBOUNCE_H

#include "linux.h"

/* The contact as it stands at the start. */
void linux_debounce_start(struct linux_button *button, bool pressed, uint64_t now_ns);

/* An edge to this state; in the order of time. settle_ns 0: edges come debounced. */
void linux_debounce_edge(struct linux_button *button, bool pressed, uint64_t time_ns, uint64_t settle_ns);

/* Held now, or pressed since the last look. */
bool linux_debounce_look(struct linux_button *button, uint64_t now_ns, uint64_t settle_ns);

#endif
