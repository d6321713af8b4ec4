/* progress: how far long work has come, for who waits at a terminal. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdint.h>

/* A bar on stderr where that is a terminal; done >= total takes it away. */
void progress_show(const char *what, uint64_t done, uint64_t total);

#endif
