/* See file_save.h. Signals wait while the temporary file is renamed or removed, so that none is left behind. */
#define _XOPEN_SOURCE 700 /* getpid, sigprocmask, SIGXCPU */

#include "file_save.h"

#include "complain.h"
#include "hal.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGXCPU};

int file_save_status(void)
{
    return errno > 0 ? -errno : HAL_EIO;
}

/* Writes the whole file under this name and closes it. */
static int write_file(const char *name, int (*write)(FILE *file, const void *context), const void *context)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL) {
        return file_save_status();
    }
    const int status = write(file, context);
    return fclose(file) != 0 && status == 0 ? file_save_status() : status;
}

int file_save(const char *path, int (*write)(FILE *file, const void *context), const void *context)
{
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) { /* a pipe or device must stay what it is */
        return write_file(path, write, context);
    }
    char part[PATH_MAX];
    if (snprintf(part, sizeof part, "%s.%ld.part", path, (long)getpid()) >= (int)sizeof part) {
        return -ENAMETOOLONG;
    }
    sigset_t ending, before; /* a signal that ends the program waits until the temporary file is gone */
    sigemptyset(&ending);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        sigaddset(&ending, ending_signals[i]);
    }
    sigprocmask(SIG_BLOCK, &ending, &before);
    int result = write_file(part, write, context);
    if (result == 0 && rename(part, path) != 0) {
        result = file_save_status();
    }
    if (result != 0) {
        remove(part);
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    return result;
}

struct text {
    const void *bytes;
    size_t n;
};

static int write_bytes(FILE *file, const void *context)
{
    const struct text *text = context;
    return fwrite(text->bytes, 1, text->n, file) == text->n ? 0 : file_save_status();
}

int file_save_bytes(const char *path, const void *bytes, size_t n)
{
    const struct text text = {bytes, n};
    const int status = file_save(path, write_bytes, &text);
    return status == 0 ? 0 : complain("%s: cannot be written: %s", path, strerror(-status));
}
