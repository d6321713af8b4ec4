/* depth_options: the command line of pinhole-depth. Every number is read strictly. */
#ifndef DEPTH_OPTIONS_H
#define DEPTH_OPTIONS_H

#include "depth_lab.h"

struct depth_command {
    const char *name, *summary;
    const char *options;  /* those it takes, with a space before and behind each: " near far " */
    const char *headings; /* see depth_table_print */
    int (*run)(const struct depth_lab *lab);
};

/* Reads `COMMAND [KIND] [options]` into *lab and *command, one of table[count], or NULL where help was asked for. 0 or
 * PH_ERR_INVAL. */
int depth_options_read(struct depth_lab *lab, const struct depth_command **command, const struct depth_command *table,
                       uint32_t count, int argc, char *const argv[]);

void depth_options_help(const struct depth_command *table, uint32_t count);

#endif
