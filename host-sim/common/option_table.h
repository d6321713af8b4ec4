/*
 * option_table: command lines as tables. An option is `--name value`, `--name=value` or `--name`. A wrong one gives one
 * line on stderr and PH_ERR_INVAL.
 */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include "nearest.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct option_row {
    const char *name;     /* without "--" */
    const char *argument; /* as --help shows it; "[X]" is optional; NULL: it takes none */
    const char *help;
    const char *allowed;                           /* its values in words; NULL: it takes none */
    bool (*set)(void *options, const char *value); /* value is NULL if there is none; false: it is wrong */
    size_t at; /* where `set` is NULL: offset in options of a bool (it takes no value), of a uint32_t (most is
                  not 0), or of a const char *, which may not be left out and not be empty */
    uint32_t least, most;             /* of a whole number */
    bool (*check)(const char *value); /* whether a const char * is right; NULL: any is */
    const char *words;                /* the only ones that a const char * may be, with | between them; NULL: any */
    nearest_list *names;              /* what a wrong value may have meant; NULL: no list */
    const char *alias;                /* another name of the option, without "--"; NULL: none */
};

struct option_table {
    const struct option_row *rows;
    size_t count;
};

/* Returns the row of "--name" or "--name=value", or NULL. */
const struct option_row *option_table_find(const struct option_table *table, const char *text);

/* Reads the option argv[i] and its value; returns the index of the next word. */
int option_table_read(const struct option_table *table, void *options, int argc, char *const argv[], int i);

/* Reads options, and at most `most` other words into words[]; returns how many words. */
int option_table_words(const struct option_table *table, void *options, int argc, char *const argv[],
                       const char *words[], int most);

/* Prints the rows, and --version, as --help shows them. */
void option_table_help(const struct option_table *table);

#endif
