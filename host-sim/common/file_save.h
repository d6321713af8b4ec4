/*
 * file_save: files that are written whole or not at all. A file is written under a temporary name and then renamed, so
 * that the old one stays until then, also when a signal ends the program. A pipe or a device is written as it is.
 */
#ifndef FILE_SAVE_H
#define FILE_SAVE_H

#include <stddef.h>
#include <stdio.h>

/* Returns -errno, or HAL_EIO when errno is 0. */
int file_save_status(void);

/* Saves a file: write puts the whole content there. file_save and write return 0 or a negative errno value. */
int file_save(const char *path, int (*write)(FILE *file, const void *context), const void *context);

/* Saves n bytes. 0 or COMPLAINED. */
int file_save_bytes(const char *path, const void *bytes, size_t n);

#endif
