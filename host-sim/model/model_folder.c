/* See model_folder.h. */
#define _DEFAULT_SOURCE /* realpath, S_ISREG */

#include "model_folder.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

_Static_assert(MODEL_PATH_BYTES >= PATH_MAX, "realpath writes that many bytes");

/* How many bytes of the model's path are its folder, with the slash. */
static int folder_length(const struct model_folder *folder)
{
    const char *slash = strrchr(folder->model, '/');
    return slash != NULL ? (int)(slash + 1 - folder->model) : 0;
}

/* Whether a path without links and ".." is in the folder, or is the model's own. */
static bool is_inside(const struct model_folder *folder, const char *path)
{
    char near[MODEL_PATH_BYTES], real[MODEL_PATH_BYTES];
    const int length = folder_length(folder);
    if (realpath(folder->model, real) != NULL && strcmp(real, path) == 0) {
        return true;
    }
    if (snprintf(near, sizeof near, "%.*s.", length, folder->model) >= (int)sizeof near ||
        realpath(near, real) == NULL) {
        return false;
    }
    const size_t n = strcmp(real, "/") == 0 ? 0 : strlen(real);
    return strncmp(path, real, n) == 0 && path[n] == '/';
}

/* Resolves a path; the name is how the model spells it. */
static bool resolve(struct model_folder *folder, const char *from, const char *name, char path[MODEL_PATH_BYTES])
{
    struct stat status;
    if (realpath(from, path) == NULL || stat(path, &status) != 0 || !S_ISREG(status.st_mode)) {
        return false;
    }
    if (folder->allow_outside || is_inside(folder, path)) {
        return true;
    }
    if (folder->outside[0] == '\0') {
        snprintf(folder->outside, sizeof folder->outside, "%.*s", (int)sizeof folder->outside - 1, name);
    }
    return false;
}

bool model_folder_find(struct model_folder *folder, const char *name, char path[MODEL_PATH_BYTES])
{
    char from[MODEL_PATH_BYTES];
    const bool is_uri = strncasecmp(name, "file:", 5) == 0;
    const char *local = is_uri ? name + 5 : name;
    if (is_uri && strncmp(local, "//", 2) == 0) { /* a host may follow: this one is meant */
        local += 2;
        local += strcspn(local, "/");
    }
    const int length = local[0] == '/' || local[0] == '\\' ? 0 : folder_length(folder);
    if (snprintf(from, sizeof from, "%.*s%s", length, folder->model, local) >= (int)sizeof from) {
        return false;
    }
    for (char *at = from + length; *at != '\0'; at++) {
        *at = *at == '\\' ? '/' : *at;
    }
    return resolve(folder, from, name, path);
}

bool model_folder_find_path(struct model_folder *folder, const char *from, char path[MODEL_PATH_BYTES])
{
    const size_t length = (size_t)folder_length(folder);
    return resolve(folder, from, strncmp(from, folder->model, length) == 0 ? from + length : from, path);
}
