#define _POSIX_C_SOURCE 200809L /* mkdir */

#include "frame_out.h"

#include "complain.h"
#include "option_text.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>

/* Makes every directory of path that is missing. 0 or a negative errno value. */
static int make_directories(const char *path)
{
    char part[PATH_MAX];
    const size_t n = strlen(path);
    if (n >= sizeof part) {
        return -ENAMETOOLONG;
    }
    for (size_t i = 1; i <= n; i++) {
        if (path[i] != '/' && path[i] != '\0') {
            continue;
        }
        memcpy(part, path, i);
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST) {
            return -errno;
        }
    }
    struct stat status;
    if (stat(path, &status) != 0) {
        return -errno;
    }
    return S_ISDIR(status.st_mode) ? 0 : -ENOTDIR;
}

/* Is this the name of a picture in another format? "name.x/" is a directory, and so is an existing one. */
static bool is_other_picture(const char *target)
{
    const char *slash = strrchr(target, '/'), *name = slash == NULL ? target : slash + 1;
    const char *dot = strrchr(name, '.');
    struct stat status;
    return dot != NULL && dot != name && dot[1] != '\0' && (stat(target, &status) != 0 || !S_ISDIR(status.st_mode));
}

int frame_out_open(struct frame_out *out, const char *target, bool several)
{
    out->path = target;
    if (target == NULL) {
        out->kind = FRAME_OUT_NONE;
    } else if (strcmp(target, "-") == 0) {
        out->kind = FRAME_OUT_STREAM;
    } else if (option_text_ends(target, ".ppm")) {
        out->kind = several ? FRAME_OUT_FILES : FRAME_OUT_FILE;
    } else if (is_other_picture(target)) {
        return complain_usage("--out %s: only .ppm pictures are written; a new directory with a dot needs a / behind",
                              target);
    } else {
        out->kind = FRAME_OUT_DIRECTORY;
        const int status = make_directories(target);
        if (status != 0) {
            return complain("%s: cannot be used as a directory for frames: %s", target, strerror(-status));
        }
    }
    return 0;
}

static int name_file(const struct frame_out *out, uint32_t frame, char name[PATH_MAX])
{
    int n = 0;
    switch (out->kind) {
    case FRAME_OUT_DIRECTORY:
        n = snprintf(name, PATH_MAX, "%s/frame-%04u.ppm", out->path, (unsigned)frame);
        break;
    case FRAME_OUT_FILES:
        n = snprintf(name, PATH_MAX, "%.*s-%04u.ppm", (int)strlen(out->path) - 4, out->path, (unsigned)frame);
        break;
    default:
        n = snprintf(name, PATH_MAX, "%s", out->path);
        break;
    }
    return n < PATH_MAX ? 0 : -ENAMETOOLONG;
}

int frame_out_put(const struct frame_out *out, uint32_t frame, const struct ppm *picture)
{
    if (out->kind == FRAME_OUT_NONE) {
        return 0;
    }
    if (out->kind == FRAME_OUT_STREAM) {
        const int written = ppm_write(stdout, picture);
        return written == 0 ? 0 : complain("stdout: %s", strerror(-written));
    }
    char name[PATH_MAX];
    int status = name_file(out, frame, name);
    if (status == 0) {
        status = ppm_save(name, picture);
    }
    return status == 0 ? 0 : complain("%s: cannot be written: %s", out->path, strerror(-status));
}
