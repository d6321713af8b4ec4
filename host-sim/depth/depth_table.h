/* depth_table: CSV for people. */
#ifndef DEPTH_TABLE_H
#define DEPTH_TABLE_H

#include <stdio.h>

/*
 * Prints CSV as a table with aligned columns, remarks below it. headings: the columns' names for people, with commas
 * between them, as many as the CSV has (all of them say predicted or measured where that is a question), or NULL.
 */
void depth_table_print(FILE *file, const char *csv, const char *headings);

/* Takes the remarks out: what is left is CSV. */
void depth_table_drop_remarks(char *csv);

#endif
