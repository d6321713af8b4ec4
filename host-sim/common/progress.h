/* progress: a bar on the terminal for long work. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdint.h>

/* Shows a bar on stderr if that is a terminal; done >= total removes it. */
void progress_show(const char *what, uint64_t done, uint64_t total);

#endif
