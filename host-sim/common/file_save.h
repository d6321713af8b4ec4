/*
 * file_save: files that are written whole or not at all: under a name of their own first, then renamed, so that what
 * was there before stays until then, also when a signal ends the program. A pipe or a device is written as it is.
 */
#ifndef FILE_SAVE_H
#define FILE_SAVE_H

#include <stddef.h>
#include <stdio.h>

/* What errno says as a status; HAL_EIO where it says nothing. */
int file_save_status(void);

/* write: puts all of the file there. Both return 0 or a negative errno value. */
int file_save(const char *path, int (*write)(FILE *file, const void *context), const void *context);

/* 0, or COMPLAINED when one line has said why. */
int file_save_bytes(const char *path, const void *bytes, size_t n);

#endif
