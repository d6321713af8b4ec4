/* text_line: text files line by line, where the file may be anything: getline() takes all memory for a file without
 * lines.
 */
#ifndef TEXT_LINE_H
#define TEXT_LINE_H

#include <stdio.h>
#include <sys/types.h>

/*
 * The next line with its end, as getline(), to be freed by the caller; of a longer one than `most` bytes that many, and
 * then the rest as another line. Its length; 0: the end; or a negative errno value.
 */
ssize_t text_line_read(char **line, size_t *size, size_t most, FILE *file);

#endif
