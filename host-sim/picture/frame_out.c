/* See frame_out.h. The name says which format is meant; what was made for an output that failed is removed. */
#define _POSIX_C_SOURCE 200809L /* mkdir */

#include "frame_out.h"

#include "complain.h"
#include "file_save.h"
#include "gif_out.h"
#include "option_text.h"
#include "picture_in.h"
#include "png_out.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Makes every directory of path that is missing; *made is the length of the first one's name, or 0. 0 or a negative
 * errno value. */
static int make_directories(const char *path, size_t *made)
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
        if (mkdir(part, 0777) == 0) {
            *made = *made > 0 ? *made : i;
        } else if (errno != EEXIST) {
            return -errno;
        }
    }
    struct stat status;
    if (stat(path, &status) != 0) {
        return -errno;
    }
    return S_ISDIR(status.st_mode) ? 0 : -ENOTDIR;
}

/* Removes the directories that were made and are empty. */
static void remove_directories(const char *path, size_t made)
{
    char part[PATH_MAX];
    for (size_t n = strlen(path); n >= made && n > 0; n--) {
        if (path[n] == '/' || path[n] == '\0') {
            memcpy(part, path, n);
            part[n] = '\0';
            rmdir(part);
        }
    }
}

/* Is this the name of a picture in another format? "name.x/" is a directory, and so is an existing one. */
static bool is_other_picture(const char *target)
{
    const char *slash = strrchr(target, '/'), *name = slash == NULL ? target : slash + 1;
    const char *dot = strrchr(name, '.');
    struct stat status;
    return dot != NULL && dot != name && dot[1] != '\0' && (stat(target, &status) != 0 || !S_ISDIR(status.st_mode));
}

static int open_directory(struct frame_out *out)
{
    out->kind = FRAME_OUT_DIRECTORY;
    const int status = make_directories(out->path, &out->made);
    if (status == 0) {
        return 0;
    }
    if (out->made > 0) {
        remove_directories(out->path, out->made);
    }
    return complain("%s: cannot be used as a directory for frames: %s", out->path, strerror(-status));
}

static int open_gif(struct frame_out *out)
{
    out->kind = FRAME_OUT_GIF;
    const int status = gif_out_new(&out->gif, out->path, out->scale > 0 ? out->scale : 1);
    if (gif_out_reason != NULL) {
        return complain("%s: %s", out->path, gif_out_reason);
    }
    if (status != 0) {
        gif_out_free(out->gif);
        return complain("%s: cannot be written: %s", out->path, strerror(-status));
    }
    return 0;
}

int frame_out_open(struct frame_out *out, const char *target, bool several, uint32_t last)
{
    static const char *const endings[] = {".ppm", ".png"};
    out->path = target;
    out->ending = endings[0];
    out->digits = snprintf(NULL, 0, "%u", (unsigned)last);
    out->digits = out->digits > 4 ? out->digits : 4;
    out->gif = NULL;
    out->is_full = false;
    out->made = 0;
    out->kind = FRAME_OUT_NONE;
    if (target == NULL) {
        return 0;
    }
    if (strcmp(target, "-") == 0) {
        out->kind = FRAME_OUT_STREAM;
        return 0;
    }
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        if (option_text_ends(target, endings[i])) {
            out->ending = endings[i];
            out->kind = several ? FRAME_OUT_FILES : FRAME_OUT_FILE;
            return 0;
        }
    }
    if (option_text_ends(target, ".gif")) {
        return open_gif(out);
    }
    if (is_other_picture(target)) {
        return complain_usage(
            "--out %s: .ppm, .png and .gif pictures are written; a new directory with a dot needs a / "
            "behind",
            target);
    }
    return open_directory(out);
}

static int name_file(const struct frame_out *out, uint32_t frame, char name[PATH_MAX])
{
    int n = 0;
    switch (out->kind) {
    case FRAME_OUT_DIRECTORY:
        n = snprintf(name, PATH_MAX, "%s/frame-%0*u%s", out->path, out->digits, (unsigned)frame, out->ending);
        break;
    case FRAME_OUT_FILES:
        n = snprintf(name, PATH_MAX, "%.*s-%0*u%s", (int)strlen(out->path) - 4, out->path, out->digits, (unsigned)frame,
                     out->ending);
        break;
    default:
        n = snprintf(name, PATH_MAX, "%s", out->path);
        break;
    }
    return n < PATH_MAX ? 0 : -ENAMETOOLONG;
}

int frame_out_enlarge(const struct ppm *from, uint32_t scale, struct ppm *to)
{
    *to = (struct ppm){from->width * scale, from->height * scale, NULL};
    to->rgb = malloc((size_t)to->width * to->height * 3);
    if (to->rgb == NULL) {
        return complain("not enough memory for --scale");
    }
    uint8_t *rgb = to->rgb;
    for (uint32_t y = 0; y < to->height; y++) {
        for (uint32_t x = 0; x < to->width; x++, rgb += 3) {
            memcpy(rgb, from->rgb + ((size_t)(y / scale) * from->width + x / scale) * 3, 3);
        }
    }
    return 0;
}

static int save_png(const char *path, const struct ppm *picture)
{
    size_t length;
    uint8_t *const bytes = png_out_bytes(picture, &length);
    const int status = bytes != NULL ? file_save_bytes(path, bytes, length) : complain("not enough memory for a PNG");
    free(bytes);
    return status;
}

static int save(const struct frame_out *out, uint32_t frame, const struct ppm *picture)
{
    char name[PATH_MAX];
    int status = 0;
    if (out->kind == FRAME_OUT_STREAM) {
        status = ppm_write(stdout, picture);
        return status == 0 ? 0 : complain("stdout: %s", strerror(-status));
    }
    status = name_file(out, frame, name);
    if (status == 0 && strcmp(out->ending, ".png") == 0) {
        return save_png(name, picture);
    }
    status = status == 0 ? ppm_save(name, picture) : status;
    return status == 0 ? 0 : complain("%s: cannot be written: %s", out->path, strerror(-status));
}

/* The frames of a GIF wait in a file. A full disk ends the recording, and what was recorded is kept. */
static int put_gif(struct frame_out *out, const struct ppm *picture)
{
    const int status = gif_out_add(out->gif, picture);
    out->is_full = status != 0 && gif_out_count(out->gif) > 0;
    return status == 0 ? 0
                       : complain("%s: ends after %u frames, which are kept; the next has no room in this folder: %s",
                                  out->path, (unsigned)gif_out_count(out->gif), strerror(-status));
}

int frame_out_put(struct frame_out *out, uint32_t frame, const struct ppm *picture)
{
    if (out->kind == FRAME_OUT_NONE) {
        return 0;
    }
    if (out->kind == FRAME_OUT_GIF) {
        return put_gif(out, picture);
    }
    if (out->scale <= 1) {
        return save(out, frame, picture);
    }
    struct ppm large;
    int status = frame_out_enlarge(picture, out->scale, &large);
    if (status == 0) {
        status = save(out, frame, &large);
    }
    free(large.rgb);
    return status;
}

int frame_out_close(struct frame_out *out, int status)
{
    if (out->kind == FRAME_OUT_GIF && gif_out_count(out->gif) > 0 && (status == 0 || out->is_full)) {
        const int saved = gif_out_save(out->gif, out->path);
        if (saved == 0 && gif_out_every(out->gif) > 1) {
            complain_note("%s: towards its end it has one frame of %u, so that it stays below %u MB", out->path,
                          (unsigned)gif_out_every(out->gif), GIF_OUT_BYTES_MOST / 1000000);
        }
        status = saved == 0 ? status : complain("%s: cannot be written: %s", out->path, strerror(-saved));
    }
    if (out->kind == FRAME_OUT_GIF) {
        gif_out_free(out->gif);
    }
    if (out->made > 0) {
        remove_directories(out->path, out->made);
    }
    out->kind = FRAME_OUT_NONE;
    return status;
}

static int too_large(const char *path, uint32_t width, uint32_t height, uint32_t most_pixels)
{
    return complain("%s: is %ux%u, and there is room for %u pixels: shrink it", path, (unsigned)width, (unsigned)height,
                    (unsigned)most_pixels);
}

int frame_out_load(const char *path, uint32_t most_pixels, struct ppm *picture)
{
    struct picture_in in = {.most = PPM_SIDE_MAX, .most_pixels = most_pixels};
    const int status = ppm_load(path, most_pixels, picture);
    if (status == PH_ERR_NOMEM) {
        return too_large(path, picture->width, picture->height, most_pixels);
    }
    if (status == PH_ERR_INVAL && picture_in_file(&in, path) == NULL) {
        *picture = in.picture;
        return 0;
    }
    if ((uint64_t)in.width * in.height > most_pixels) {
        return too_large(path, in.width, in.height, most_pixels);
    }
    if (status == PH_ERR_INVAL) {
        return complain("%s: is neither a binary PPM (P6) nor a PNG, JPEG or WebP picture that can be read", path);
    }
    return status == 0 ? 0 : complain("%s: cannot be read: %s", path, strerror(-status));
}
