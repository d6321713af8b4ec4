/* See progress.h. It stands in place of common/progress.c: a page has no terminal, and no signals. */
#include "progress.h"

void progress_begin(const char *program)
{
    (void)program;
}

void progress_show(const char *what, uint64_t done, uint64_t total)
{
    (void)what, (void)done, (void)total;
}

void progress_clear(void)
{
}
