/* See frame_check.h. */
#define _POSIX_C_SOURCE 200809L /* stat */

#include "frame_check.h"

#include "complain.h"
#include "crc32.h"
#include "frame_out.h"
#include "option_text.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- CRCs -------------------------------------------------------------------------------------------- */

/* Is this a line of --crc, as text or as JSON? */
static bool is_crc_line(const char *line, unsigned *frame, unsigned *crc)
{
    char number[11], digits[9];
    if (sscanf(line, "frame %10[0-9] crc32 %8[0-9A-Fa-f]", number, digits) != 2 &&
        sscanf(line, "{\"frame\": %10[0-9], \"crc32\": \"%8[0-9A-Fa-f]\"}", number, digits) != 2) {
        return false;
    }
    *frame = (unsigned)strtoul(number, NULL, 10);
    *crc = (unsigned)strtoul(digits, NULL, 16);
    return true;
}

/* Reads `frame N crc32 XXXXXXXX` lines; others are passed over, but one must be there. A line that begins with a zero
 * byte ends the file: it is no text, and /dev/zero has no end. */
static int read_crcs(struct frame_check *check)
{
    char line[256];
    FILE *const file = fopen(check->reference, "r");
    if (file == NULL) {
        return complain("%s: cannot be read: %s", check->reference, strerror(errno));
    }
    int status = 0;
    while (status == 0 && fgets(line, sizeof line, file) != NULL && line[0] != '\0') {
        unsigned frame, crc;
        if (!is_crc_line(line, &frame, &crc)) {
            continue;
        }
        struct frame_check_crc *const more = realloc(check->crcs, (check->crc_count + 1) * sizeof *more);
        if (more == NULL) {
            status = complain("not enough memory for %s", check->reference);
        } else {
            check->crcs = more;
            check->crcs[check->crc_count++] = (struct frame_check_crc){frame, crc};
        }
    }
    fclose(file);
    return status == 0 && check->crc_count == 0
               ? complain("%s: is no picture, and has no line `frame N crc32 XXXXXXXX`", check->reference)
               : status;
}

static int check_crc(struct frame_check *check, uint32_t frame, const struct ppm *picture)
{
    const uint32_t crc = crc32_update(0, picture->rgb, (size_t)picture->width * picture->height * 3);
    for (uint32_t i = 0; i < check->crc_count; i++) {
        if (check->crcs[i].frame == frame) {
            if (check->crcs[i].crc != crc) {
                check->wrong++;
                printf("frame %u: crc32 %08X, but %08X in %s\n", (unsigned)frame, (unsigned)crc,
                       (unsigned)check->crcs[i].crc, check->reference);
            }
            return 0;
        }
    }
    return complain("%s: has no frame %u", check->reference, (unsigned)frame);
}

/* ---- pictures ---------------------------------------------------------------------------------------- */

struct difference {
    uint32_t pixels, most;
    uint32_t x0, y0, x1, y1; /* the smallest rectangle that holds them */
};

static uint32_t channel_distance(const uint8_t a[3], const uint8_t b[3])
{
    int most = 0;
    for (int i = 0; i < 3; i++) {
        const int far = abs(a[i] - b[i]);
        most = far > most ? far : most;
    }
    return (uint32_t)most;
}

/* Finds what differs, and draws it into the reference: red on a dark picture. */
static struct difference compare(const struct ppm *picture, struct ppm *reference, uint32_t tolerance)
{
    struct difference d = {.x0 = UINT32_MAX, .y0 = UINT32_MAX};
    for (uint32_t y = 0; y < picture->height; y++) {
        for (uint32_t x = 0; x < picture->width; x++) {
            const size_t at = ((size_t)y * picture->width + x) * 3;
            uint8_t *const rgb = reference->rgb + at;
            const uint32_t far = channel_distance(picture->rgb + at, rgb);
            const uint8_t grey = (uint8_t)((rgb[0] + 2 * rgb[1] + rgb[2]) / 16);
            memset(rgb, grey, 3);
            if (far > tolerance) {
                d.pixels++;
                d.most = far > d.most ? far : d.most;
                d.x0 = x < d.x0 ? x : d.x0;
                d.y0 = y < d.y0 ? y : d.y0;
                d.x1 = x > d.x1 ? x : d.x1;
                d.y1 = y;
                rgb[0] = (uint8_t)(128 + far / 2);
            }
        }
    }
    return d;
}

/* Writes the name of a frame's reference: "FILE.png", or with several frames "FILE-0003.png"; in a folder
 * "frame-0003.png" or, if that is not there, ".ppm". */
static int name_reference(const struct frame_check *check, uint32_t frame, char name[PATH_MAX])
{
    struct stat status;
    int n;
    if (stat(check->reference, &status) == 0 && S_ISDIR(status.st_mode)) {
        n = snprintf(name, PATH_MAX, "%s/frame-%0*u.png", check->reference, check->digits, (unsigned)frame);
        if (n < PATH_MAX && stat(name, &status) != 0) {
            memcpy(name + n - 4, ".ppm", 4);
        }
    } else if (check->several) {
        n = snprintf(name, PATH_MAX, "%.*s-%0*u%s", (int)strlen(check->reference) - 4, check->reference, check->digits,
                     (unsigned)frame, check->reference + strlen(check->reference) - 4);
    } else {
        n = snprintf(name, PATH_MAX, "%s", check->reference);
    }
    return n < PATH_MAX ? 0 : complain("%s: the name is too long", check->reference);
}

static int draw_difference(const struct frame_check *check, uint32_t frame, const struct ppm *drawn)
{
    struct frame_out out = {.scale = 1};
    int status = frame_out_open(&out, check->difference, check->several, frame);
    out.digits = check->digits;
    if (status == 0) {
        status = frame_out_put(&out, frame, drawn);
    }
    return frame_out_close(&out, status);
}

/* Compares pictures of one size. */
static int check_pixels(struct frame_check *check, uint32_t frame, const struct ppm *picture, struct ppm *reference,
                        const char *name)
{
    const struct difference d = compare(picture, reference, check->tolerance);
    if (d.pixels == 0) {
        return 0;
    }
    check->wrong++;
    printf("frame %u: %u of %u pixels differ from %s, by at most %u of 255, in columns %u .. %u, rows %u .. %u\n",
           (unsigned)frame, (unsigned)d.pixels, (unsigned)(picture->width * picture->height), name, (unsigned)d.most,
           (unsigned)d.x0, (unsigned)d.x1, (unsigned)d.y0, (unsigned)d.y1);
    return draw_difference(check, frame, reference);
}

/* Compares at the size of the glass, or scaled if the reference is. */
static int check_sizes(struct frame_check *check, uint32_t frame, const struct ppm *picture, struct ppm *reference,
                       const char *name)
{
    const uint32_t scale = check->scale > 0 ? check->scale : 1;
    struct ppm large;
    if (reference->width == picture->width && reference->height == picture->height) {
        return check_pixels(check, frame, picture, reference, name);
    }
    if (reference->width != picture->width * scale || reference->height != picture->height * scale) {
        check->wrong++;
        printf("frame %u: is %ux%u, but %s is %ux%u\n", (unsigned)frame, (unsigned)(picture->width * scale),
               (unsigned)(picture->height * scale), name, (unsigned)reference->width, (unsigned)reference->height);
        return 0;
    }
    int status = frame_out_enlarge(picture, scale, &large);
    if (status == 0) {
        status = check_pixels(check, frame, &large, reference, name);
    }
    free(large.rgb);
    return status;
}

static int check_picture(struct frame_check *check, uint32_t frame, const struct ppm *picture)
{
    char name[PATH_MAX];
    struct ppm reference;
    const uint32_t scaled = picture->width * picture->height * check->scale * check->scale;
    int status = name_reference(check, frame, name);
    if (status == 0) {
        status = frame_out_load(name, scaled > FRAME_OUT_PIXELS_MAX ? scaled : FRAME_OUT_PIXELS_MAX, &reference);
    }
    if (status == 0) {
        status = check_sizes(check, frame, picture, &reference, name);
        free(reference.rgb);
    }
    return status;
}

/* ---- all of it --------------------------------------------------------------------------------------- */

int frame_check_open(struct frame_check *check, uint32_t last)
{
    struct stat status;
    check->crcs = NULL;
    check->crc_count = check->wrong = 0;
    check->digits = snprintf(NULL, 0, "%u", (unsigned)last);
    check->digits = check->digits > 4 ? check->digits : 4;
    if (check->reference == NULL || option_text_ends(check->reference, ".png") ||
        option_text_ends(check->reference, ".ppm") ||
        (stat(check->reference, &status) == 0 && S_ISDIR(status.st_mode))) {
        return 0;
    }
    if (check->tolerance > 0) {
        return complain_usage("--tolerance: CRCs have none; --check %s must be a PNG, a PPM or a folder of them",
                              check->reference);
    }
    return read_crcs(check);
}

int frame_check_put(struct frame_check *check, uint32_t frame, const struct ppm *picture)
{
    return check->reference == NULL ? 0
           : check->crcs != NULL    ? check_crc(check, frame, picture)
                                    : check_picture(check, frame, picture);
}

int frame_check_close(struct frame_check *check, int status)
{
    free(check->crcs);
    check->crcs = NULL;
    if (check->reference == NULL || status != 0 || check->wrong == 0) {
        return status;
    }
    return complain("%u frame%s not as in %s", (unsigned)check->wrong, check->wrong == 1 ? " is" : "s are",
                    check->reference);
}
