/* See files.h. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */
#include "files.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/pinhole-test-XXXXXX";

int files_begin(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/pinhole-test-XXXXXX");
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_one(const char *path, const struct stat *status, int type, struct FTW *where)
{
    (void)status;
    (void)type;
    (void)where;
    return remove(path);
}

int files_end(void **state)
{
    (void)state;
    return nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

int files_begin_inside(void)
{
    return files_begin(NULL) == 0 ? chdir(folder) : -1;
}

int files_end_empty(void)
{
    return rmdir(folder);
}

const char *file_path(const char *name)
{
    static char paths[8][256];
    static unsigned next;
    char *path = paths[next++ % 8];
    snprintf(path, 256, "%s/%s", folder, name);
    return path;
}

const char *file_bytes(const char *name, const void *bytes, size_t n)
{
    const char *path = file_path(name);
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, n, file) != n || fclose(file) != 0) {
        abort();
    }
    return path;
}

const char *file_text(const char *name, const char *text)
{
    return file_bytes(name, text, strlen(text));
}

uint8_t *file_read(const char *name, size_t *n)
{
    uint8_t *bytes = malloc(1 << 20);
    FILE *file = fopen(file_path(name), "rb");
    if (file == NULL || bytes == NULL) {
        abort();
    }
    *n = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    return bytes;
}

char *file_base64(const uint8_t *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = calloc(n / 3 * 4 + 5, 1);
    for (size_t i = 0, out = 0; i < n; i += 3) {
        const uint32_t v =
            (uint32_t)bytes[i] << 16 | (i + 1 < n ? (uint32_t)bytes[i + 1] << 8 : 0) | (i + 2 < n ? bytes[i + 2] : 0);
        text[out++] = digits[v >> 18];
        text[out++] = digits[v >> 12 & 63];
        text[out++] = i + 1 < n ? digits[v >> 6 & 63] : '=';
        text[out++] = i + 2 < n ? digits[v & 63] : '=';
    }
    return text;
}
