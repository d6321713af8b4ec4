/* sim_list: the demos and boards that --list shows. */
#ifndef SIM_LIST_H
#define SIM_LIST_H

#include "demo.h"

/* Writes the names of the demo's views into text, with a space before each. What has no room is cut off. */
void sim_list_views(const struct demo *demo, char *text, size_t size);

/* Prints a line for each demo and each board on stdout. */
void sim_list_print(void);

/* Prints `{"demos": [..], "boards": [..]}` on stdout; host-sim/README.md has its keys, which stay. */
void sim_list_print_json(void);

#endif
