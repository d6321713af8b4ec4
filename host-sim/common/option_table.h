/*
 * option_table: command lines as tables. Options are `--name value`, `--name=value` or `--name`; what is wrong with one
 * is told in one line (complain.h).
 */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct option_row {
    const char *name;     /* without "--" */
    const char *argument; /* as --help shows it; "[X]": may be left out; NULL: takes none */
    const char *help;
    const char *allowed;                           /* its values in words; NULL: takes none */
    bool (*set)(void *options, const char *value); /* value: NULL if it has none; false: the value is wrong */
    size_t at; /* where `set` is NULL: offset in options of a bool (it takes no value), of a uint32_t (most is
                  not 0), or of a const char *, which may not be left out and not be empty */
    uint32_t least, most; /* of a whole number */
};

struct option_table {
    const struct option_row *rows;
    size_t count;
};

/* The row of "--name" or "--name=value"; NULL: there is none. */
const struct option_row *option_table_find(const struct option_table *table, const char *text);

/* Reads argv[i], an option, and its value; returns the index of what follows, or PH_ERR_INVAL. */
int option_table_read(const struct option_table *table, void *options, int argc, char *const argv[], int i);

/* Reads a command line: options, and at most `most` other words, into words[]; returns how many, or PH_ERR_INVAL. */
int option_table_words(const struct option_table *table, void *options, int argc, char *const argv[],
                       const char *words[], int most);

/* Prints the rows as --help shows them. */
void option_table_help(const struct option_table *table);

#endif
