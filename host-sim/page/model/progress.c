/* See progress.h. It stands in place of common/progress.c: the worker tells the page how far the work is. */
#include "progress.h"

__attribute__((import_module("page"), import_name("progress"))) void page_progress(const char *what, double share);

void progress_begin(const char *program)
{
    (void)program;
}

void progress_show(const char *what, uint64_t done, uint64_t total)
{
    page_progress(what, total > 0 && done < total ? (double)done / (double)total : 1);
}

void progress_clear(void)
{
}
