/* See ppm.h. */
#include "ppm.h"

#include "file_save.h"
#include "status.h"

#include <stdlib.h>
#include <string.h>

int ppm_write(FILE *file, const struct ppm *picture)
{
    const size_t n = (size_t)picture->width * picture->height * 3;
    if (fprintf(file, "P6\n%u %u\n255\n", (unsigned)picture->width, (unsigned)picture->height) < 0) {
        return file_save_status();
    }
    return fwrite(picture->rgb, 1, n, file) == n && fflush(file) == 0 ? 0 : file_save_status();
}

static int write_picture(FILE *file, const void *context)
{
    return ppm_write(file, context);
}

int ppm_save(const char *path, const struct ppm *picture)
{
    return file_save(path, write_picture, picture);
}

/* Reads the next number of a header and the white space and comments before it. */
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
    return digits > 0 && value > 0 && value <= max && (c == ' ' || c == '\n' || c == '\r' || c == '\t') ? 0
                                                                                                        : PH_ERR_INVAL;
}

static int read_picture(FILE *file, uint32_t most_pixels, struct ppm *picture)
{
    uint32_t maximum;
    char magic[2];
    if (fread(magic, 1, sizeof magic, file) != sizeof magic || memcmp(magic, "P6", sizeof magic) != 0 ||
        read_number(file, PPM_SIDE_MAX, &picture->width) != 0 ||
        read_number(file, PPM_SIDE_MAX, &picture->height) != 0 || read_number(file, 255, &maximum) != 0 ||
        maximum != 255) {
        return PH_ERR_INVAL;
    }
    const size_t n = (size_t)picture->width * picture->height * 3;
    picture->rgb = n / 3 <= most_pixels ? malloc(n) : NULL;
    if (picture->rgb == NULL) {
        return PH_ERR_NOMEM;
    }
    if (fread(picture->rgb, 1, n, file) != n) {
        free(picture->rgb);
        return PH_ERR_INVAL;
    }
    return 0;
}

int ppm_load(const char *path, uint32_t most_pixels, struct ppm *picture)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return file_save_status();
    }
    const int result = read_picture(file, most_pixels, picture);
    fclose(file);
    return result;
}
