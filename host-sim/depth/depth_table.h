/* depth_table: CSV for people. */
#ifndef DEPTH_TABLE_H
#define DEPTH_TABLE_H

#include <stdio.h>

/*
 * Prints CSV as a table with aligned columns, and the remarks below it. headings: names of the columns for people, with
 * commas between them, as many as the CSV has, or NULL. A heading says `predicted` or `measured` where that is a
 * question.
 */
void depth_table_print(FILE *file, const char *csv, const char *headings);

/* Prints an array of JSON: an object a row, with the first line's names as keys. A number stays a number (RFC 8259), an
 * empty cell is null, and anything else is text. Remarks are left out. */
void depth_table_json(FILE *file, const char *csv);

/* Removes the remarks; CSV remains. */
void depth_table_drop_remarks(char *csv);

#endif
