/* See model_folder.h. It stands in place of host-sim/model/model_folder.c: the files are those that the user gave to
 * the page, and no other can be reached. page_wasi.mjs resolves "..". */
#define _DEFAULT_SOURCE /* S_ISREG */

#include "model_folder.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static bool is_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

bool model_folder_find(struct model_folder *folder, const char *name, char path[MODEL_PATH_BYTES])
{
    const char *const slash = strrchr(folder->model, '/');
    const char *const local = strncasecmp(name, "file:", 5) == 0 ? name + 5 : name;
    const int length = slash != NULL ? (int)(slash + 1 - folder->model) : 0;
    if (snprintf(path, MODEL_PATH_BYTES, "%.*s%s", length, folder->model, local) >= MODEL_PATH_BYTES) {
        return false;
    }
    for (char *at = path + length; *at != '\0'; at++) {
        *at = *at == '\\' ? '/' : *at;
    }
    return is_file(path);
}

bool model_folder_find_path(struct model_folder *folder, const char *from, char path[MODEL_PATH_BYTES])
{
    (void)folder;
    return snprintf(path, MODEL_PATH_BYTES, "%s", from) < MODEL_PATH_BYTES && is_file(path);
}
