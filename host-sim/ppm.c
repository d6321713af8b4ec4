#define _XOPEN_SOURCE 700 /* getpid, sigprocmask, SIGXCPU */

#include "ppm.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int ppm_write(FILE *file, const struct ppm *picture)
{
    const size_t n = (size_t)picture->width * picture->height * 3;
    if (fprintf(file, "P6\n%u %u\n255\n", (unsigned)picture->width, (unsigned)picture->height) < 0) {
        return -1;
    }
    return fwrite(picture->rgb, 1, n, file) == n && fflush(file) == 0 ? 0 : -1;
}

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGXCPU};

/* The whole picture under this name, closed. 0, or -1 with errno set. */
static int write_file(const char *name, const struct ppm *picture)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL) {
        return -1;
    }
    const int result = ppm_write(file, picture), error = errno;
    if (fclose(file) != 0 && result == 0) {
        return -1;
    }
    errno = error;
    return result;
}

int ppm_save(const char *path, const struct ppm *picture)
{
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) { /* a pipe or device must stay what it is */
        return write_file(path, picture);
    }
    char part[PATH_MAX];
    if (snprintf(part, sizeof part, "%s.%ld.part", path, (long)getpid()) >= (int)sizeof part) {
        errno = ENAMETOOLONG;
        return -1;
    }
    sigset_t ending, before; /* a signal that ends the program waits until nothing half-written is left */
    sigemptyset(&ending);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        sigaddset(&ending, ending_signals[i]);
    }
    sigprocmask(SIG_BLOCK, &ending, &before);
    const int result = write_file(part, picture) == 0 && rename(part, path) == 0 ? 0 : -1;
    const int error = errno;
    if (result != 0) {
        remove(part);
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = error;
    return result;
}

/* The next number of a header: white space and comments before it. */
static int read_number(FILE *file, uint32_t max, uint32_t *out)
{
    int c = getc(file);
    while (c == '#' || c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        while (c == '#' && (c = getc(file)) != '\n' && c != EOF) {
            c = '#';
        }
        c = getc(file);
    }
    uint32_t value = 0;
    int digits = 0;
    for (; c >= '0' && c <= '9' && value <= max; digits++, c = getc(file)) {
        value = value * 10 + (uint32_t)(c - '0');
    }
    *out = value;
    return digits > 0 && value > 0 && value <= max && (c == ' ' || c == '\n' || c == '\r' || c == '\t') ? 0 : -1;
}

static int read_picture(FILE *file, struct ppm *picture)
{
    uint32_t maximum;
    char magic[2];
    if (fread(magic, 1, sizeof magic, file) != sizeof magic || memcmp(magic, "P6", sizeof magic) != 0 ||
        read_number(file, PPM_SIDE_MAX, &picture->width) != 0 ||
        read_number(file, PPM_SIDE_MAX, &picture->height) != 0 || read_number(file, 255, &maximum) != 0 ||
        maximum != 255) {
        errno = EINVAL;
        return -1;
    }
    const size_t n = (size_t)picture->width * picture->height * 3;
    picture->rgb = malloc(n);
    if (picture->rgb == NULL) {
        return -1;
    }
    if (fread(picture->rgb, 1, n, file) != n) {
        free(picture->rgb);
        errno = EINVAL;
        return -1;
    }
    return 0;
}

int ppm_load(const char *path, struct ppm *picture)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return -1;
    }
    const int result = read_picture(file, picture);
    const int error = errno;
    fclose(file);
    errno = error;
    return result;
}
