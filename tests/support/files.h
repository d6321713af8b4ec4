/* files: files that a test makes, in a directory of its own. */
#ifndef FILES_H
#define FILES_H

#include <stddef.h>
#include <stdint.h>

/* For a group of tests: make the directory; remove it with everything in it. */
int files_begin(void **state);
int files_end(void **state);

/* For a main whose tests name their files without a folder: makes the directory and goes there; removes it, which fails
 * unless the tests have removed all that they made (cmocka would print that of a teardown, and exit with 0). 0: done.
 */
int files_begin_inside(void);
int files_end_empty(void);

/* Full name of a file in it; one of 8 buffers that take turns. */
const char *file_path(const char *name);

/* Writes n bytes, or a text; returns file_path(name). */
const char *file_bytes(const char *name, const void *bytes, size_t n);
const char *file_text(const char *name, const char *text);

/* Reads a file of this name; *n is its length. free() it. */
uint8_t *file_read(const char *name, size_t *n);

/* The text of n bytes in base64. free() it. */
char *file_base64(const uint8_t *bytes, size_t n);

#endif
