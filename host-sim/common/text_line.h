/* text_line: reads files of any kind line by line. (getline() takes all memory for a file without line ends.) */
#ifndef TEXT_LINE_H
#define TEXT_LINE_H

#include <stdio.h>
#include <sys/types.h>

/*
 * Reads the next line with its line end into *line, as getline() does; the caller frees it. Of a line longer than
 * `most` bytes it reads that many; the rest comes as the next line. Returns the length, 0 at the end of the file, or a
 * negative errno value.
 */
ssize_t text_line_read(char **line, size_t *size, size_t most, FILE *file);

#endif
