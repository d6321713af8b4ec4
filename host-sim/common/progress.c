#define _XOPEN_SOURCE 700 /* isatty */

#include "progress.h"

#include <stdio.h>
#include <unistd.h>

void progress_show(const char *what, uint64_t done, uint64_t total)
{
    static const char bar[] = "########################################";
    const int filled = (int)(done * 40 / (total > 0 ? total : 1));
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    if (done >= total) {
        fprintf(stderr, "\r%79s\r", "");
    } else {
        fprintf(stderr, "\r%-20s [%-40.*s] %3d %%", what, filled, bar, filled * 5 / 2);
    }
    fflush(stderr);
}
