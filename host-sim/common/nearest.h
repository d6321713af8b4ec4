/* nearest: the name that a mistyped one was meant to be. */
#ifndef NEAREST_H
#define NEAREST_H

#include <stddef.h>

/* Returns name i of a list, or NULL at its end. */
typedef const char *nearest_list(const void *from, size_t i);

/* Returns the name that takes the fewest changed, added or lost letters, at most a third of the longer name's; else
 * NULL.
 */
const char *nearest_name(const char *wrong, nearest_list *list, const void *from);

/* Returns "did you mean NAME? " with the nearest name, or "". The text stays until the next call. */
const char *nearest_text(const char *wrong, nearest_list *list, const void *from);

/* Lists (nearest_kits.c): the demos, the boards. */
const char *nearest_demo(const void *from, size_t i);
const char *nearest_board(const void *from, size_t i);

#endif
