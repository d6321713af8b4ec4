/* See text_line.h. */
#define _POSIX_C_SOURCE 200809L /* getc_unlocked, ssize_t */

#include "text_line.h"

#include "status.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>

/* Makes room for one more byte and a zero at (*line)[n]. */
static bool make_room(char **line, size_t *size, size_t n)
{
    if (n + 2 <= *size) {
        return true;
    }
    const size_t more = *size < 128 ? 128 : 2 * *size;
    char *const longer = realloc(*line, more);
    if (longer == NULL) {
        return false;
    }
    *line = longer;
    *size = more;
    return true;
}

ssize_t text_line_read(char **line, size_t *size, size_t most, FILE *file)
{
    size_t n = 0;
    for (int c = 0; n < most && c != '\n'; n++) {
        c = getc_unlocked(file);
        if (c == EOF) {
            break;
        }
        if (!make_room(line, size, n)) {
            return PH_ERR_NOMEM;
        }
        (*line)[n] = (char)c;
        (*line)[n + 1] = '\0';
    }
    return ferror(file) ? -errno : (ssize_t)n;
}
