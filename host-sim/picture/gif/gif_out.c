/* See gif_out.h. Frames wait in a temporary file, because the palette is known only after the last one. */
#define _XOPEN_SOURCE 700 /* mkstemp, fseeko */

#include "gif_out.h"

#include "file_save.h"
#include "status.h"

#include <gif_lib.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DELAY_CS  3   /* hundredths of a second a frame: the nearest to 30 frames a second that a GIF has */
#define PALETTE   256 /* the last entry is "as before" */
#define AS_BEFORE 255
#define CELLS     32768 /* colours of 5 bits a channel */

#define DITHER 16   /* of 255: how far the dither moves a colour in all */
#define SLOTS  1024 /* of the hash that finds a colour of an exact palette */

struct gif_out {
    uint32_t width, height, count;
    FILE *waiting;  /* the frames, one behind the other */
    uint8_t *frame; /* the one that was read last */
    GifColorType palette[PALETTE];
    int colours;
    bool exact;             /* the palette has every colour of all frames */
    int16_t slots[SLOTS];   /* entry + 1 of an exact palette; 0: free */
    uint8_t nearest[CELLS]; /* entry + 1 for a cell of colours; 0: not looked up yet */
};

const char *const gif_out_reason = NULL;

/* A file in the folder of path that goes away with its last descriptor. */
static FILE *open_waiting(const char *path)
{
    char name[PATH_MAX];
    if (snprintf(name, sizeof name, "%s.XXXXXX", path) >= (int)sizeof name) {
        return NULL;
    }
    const int descriptor = mkstemp(name);
    if (descriptor < 0) {
        return NULL;
    }
    unlink(name);
    return fdopen(descriptor, "w+b");
}

int gif_out_new(struct gif_out **gif, const char *path)
{
    *gif = calloc(1, sizeof **gif);
    if (*gif == NULL) {
        return PH_ERR_NOMEM;
    }
    (*gif)->waiting = open_waiting(path);
    return (*gif)->waiting != NULL ? 0 : file_save_status();
}

void gif_out_free(struct gif_out *gif)
{
    if (gif != NULL && gif->waiting != NULL) {
        fclose(gif->waiting);
    }
    if (gif != NULL) {
        free(gif->frame);
    }
    free(gif);
}

static size_t frame_bytes(const struct gif_out *gif)
{
    return (size_t)gif->width * gif->height * 3;
}

int gif_out_add(struct gif_out *gif, const struct ppm *picture)
{
    gif->width = picture->width;
    gif->height = picture->height;
    if (gif->frame == NULL) {
        gif->frame = malloc(frame_bytes(gif));
    }
    if (gif->frame == NULL) {
        return PH_ERR_NOMEM;
    }
    if (fwrite(picture->rgb, 1, frame_bytes(gif), gif->waiting) != frame_bytes(gif) || fflush(gif->waiting) != 0) {
        return file_save_status();
    }
    gif->count++;
    return 0;
}

uint32_t gif_out_count(const struct gif_out *gif)
{
    return gif->count;
}

/* Reads a frame; NULL: it cannot be read. */
static const uint8_t *read_frame(const struct gif_out *gif, uint32_t number)
{
    const bool is_read = fseeko(gif->waiting, (off_t)frame_bytes(gif) * number, SEEK_SET) == 0 &&
                         fread(gif->frame, 1, frame_bytes(gif), gif->waiting) == frame_bytes(gif);
    return is_read ? gif->frame : NULL;
}

/* ---- the palette ------------------------------------------------------------------------------------- */

/* The slot where this colour is, or would be. There are four times as many slots as colours. */
static int16_t *slot_of(struct gif_out *gif, const uint8_t rgb[3])
{
    uint32_t at = (rgb[0] * 0x9E3779B1u ^ rgb[1] * 0x85EBCA77u ^ rgb[2] * 0xC2B2AE3Du) >> 20;
    for (;; at++) {
        int16_t *const slot = &gif->slots[at % SLOTS];
        const GifColorType *const c = &gif->palette[*slot - (*slot > 0)];
        if (*slot == 0 || (c->Red == rgb[0] && c->Green == rgb[1] && c->Blue == rgb[2])) {
            return slot;
        }
    }
}

/* Takes every colour of all frames into the palette. False if there are too many, or a frame cannot be read. */
static bool take_all_colours(struct gif_out *gif)
{
    const size_t pixels = (size_t)gif->width * gif->height;
    for (uint32_t f = 0; f < gif->count; f++) {
        const uint8_t *rgb = read_frame(gif, f);
        for (size_t i = 0; rgb != NULL && i < pixels; i++, rgb += 3) {
            int16_t *const slot = slot_of(gif, rgb);
            if (*slot == 0 && gif->colours == AS_BEFORE) {
                return false;
            }
            if (*slot == 0) {
                gif->palette[gif->colours++] = (GifColorType){rgb[0], rgb[1], rgb[2]};
                *slot = (int16_t)gif->colours;
            }
        }
        if (rgb == NULL) {
            return false;
        }
    }
    return true;
}

static size_t cell_of(int red, int green, int blue)
{
    return (size_t)(red >> 3 << 10 | green >> 3 << 5 | blue >> 3);
}

/* The distance of two colours, squared and weighted: the eye sees green best and blue worst. */
static int colour_distance(const GifColorType *colour, int red, int green, int blue)
{
    const int r = red - colour->Red, g = green - colour->Green, b = blue - colour->Blue;
    return 3 * r * r + 6 * g * g + b * b;
}

static uint8_t find_nearest(const struct gif_out *gif, int red, int green, int blue)
{
    int best = 0, least = INT32_MAX;
    for (int i = 0; i < gif->colours; i++) {
        const int far = colour_distance(&gif->palette[i], red, green, blue);
        best = far < least ? i : best;
        least = far < least ? far : least;
    }
    return (uint8_t)best;
}

/* What all frames have of a cell of colours: its middle, and the root of its pixels, so that a large background leaves
 * colours for what stands before it. */
struct sample {
    int red, green, blue;
    uint32_t weight;
};

/* Returns how many samples there are; all[] has room for CELLS. */
static uint32_t take_samples(const struct gif_out *gif, uint32_t *counts, struct sample *all)
{
    const size_t pixels = (size_t)gif->width * gif->height;
    uint32_t n = 0;
    for (uint32_t f = 0; f < gif->count; f++) {
        const uint8_t *rgb = read_frame(gif, f);
        for (size_t i = 0; rgb != NULL && i < pixels; i++, rgb += 3) {
            counts[cell_of(rgb[0], rgb[1], rgb[2])]++;
        }
    }
    for (int cell = 0; cell < CELLS; cell++) {
        if (counts[cell] > 0) {
            uint32_t root = 1;
            while (root * root < counts[cell] && root < 65535) {
                root++;
            }
            all[n++] = (struct sample){(cell >> 10) * 8 + 4, (cell >> 5 & 31) * 8 + 4, (cell & 31) * 8 + 4, root};
        }
    }
    return n;
}

/* Moves each entry to the mean of the samples that are nearest to it (Lloyd's algorithm, one step). An entry without
 * any goes to the sample that is worst off. */
static void improve_colours(struct gif_out *gif, const struct sample *all, uint32_t n)
{
    uint64_t sums[PALETTE][4] = {{0}};
    uint64_t worst = 0;
    uint32_t worst_at = 0;
    for (uint32_t i = 0; i < n; i++) {
        const struct sample *const s = &all[i];
        const uint8_t entry = find_nearest(gif, s->red, s->green, s->blue);
        const uint64_t far = (uint64_t)colour_distance(&gif->palette[entry], s->red, s->green, s->blue) * s->weight;
        const uint64_t parts[4] = {s->weight, (uint64_t)s->red * s->weight, (uint64_t)s->green * s->weight,
                                   (uint64_t)s->blue * s->weight};
        for (int k = 0; k < 4; k++) {
            sums[entry][k] += parts[k];
        }
        worst_at = far > worst ? i : worst_at;
        worst = far > worst ? far : worst;
    }
    for (int i = 0; i < gif->colours; i++) {
        const uint64_t *const sum = sums[i], weight = sum[0];
        const struct sample *const s = &all[worst_at];
        gif->palette[i] = weight > 0 ? (GifColorType){(uint8_t)(sum[1] / weight), (uint8_t)(sum[2] / weight),
                                                      (uint8_t)(sum[3] / weight)}
                                     : (GifColorType){(uint8_t)s->red, (uint8_t)s->green, (uint8_t)s->blue};
    }
}

/* Chooses 255 colours: every so many samples one, then improved. 0 or PH_ERR_NOMEM. */
static int choose_colours(struct gif_out *gif)
{
    uint32_t *const counts = calloc(CELLS, sizeof *counts);
    struct sample *const all = malloc(CELLS * sizeof *all);
    if (counts != NULL && all != NULL) {
        const uint32_t n = take_samples(gif, counts, all);
        gif->colours = AS_BEFORE;
        for (uint32_t i = 0; i < AS_BEFORE; i++) {
            const struct sample *const s = &all[(uint64_t)i * n / AS_BEFORE];
            gif->palette[i] = (GifColorType){(uint8_t)s->red, (uint8_t)s->green, (uint8_t)s->blue};
        }
        for (int i = 0; i < 12; i++) {
            improve_colours(gif, all, n);
        }
    }
    const int status = counts != NULL && all != NULL ? 0 : PH_ERR_NOMEM;
    free(counts);
    free(all);
    return status;
}

/* ---- frames ------------------------------------------------------------------------------------------ */

static int clamped(int v)
{
    return v < 0 ? 0 : v > 255 ? 255 : v;
}

/* The entry for a pixel. What the palette lacks is dithered by a threshold of its place: 8x8, Bayer's order. */
static uint8_t entry_of(struct gif_out *gif, const uint8_t rgb[3], uint32_t x, uint32_t y)
{
    if (gif->exact) {
        return (uint8_t)(*slot_of(gif, rgb) - 1);
    }
    uint32_t order = 0;
    for (uint32_t bit = 0; bit < 3; bit++) {
        order = order << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
    }
    const int more = ((int)order - 32) * DITHER / 64; /* order: 0 .. 63 */
    const int red = clamped(rgb[0] + more), green = clamped(rgb[1] + more), blue = clamped(rgb[2] + more);
    uint8_t *const known = &gif->nearest[cell_of(red, green, blue)];
    if (*known == 0) {
        *known = (uint8_t)(1 + find_nearest(gif, (red & ~7) + 4, (green & ~7) + 4, (blue & ~7) + 4));
    }
    return (uint8_t)(*known - 1);
}

/* Turns a frame into entries; `before` has those that are shown, and gets the new ones. False: it cannot be read. */
static bool fill_entries(struct gif_out *gif, uint32_t frame, uint8_t *before, uint8_t *entries)
{
    const uint8_t *rgb = read_frame(gif, frame);
    for (uint32_t y = 0; rgb != NULL && y < gif->height; y++) {
        for (uint32_t x = 0; x < gif->width; x++, rgb += 3) {
            const uint8_t entry = entry_of(gif, rgb, x, y);
            *entries++ = frame > 0 && entry == *before ? AS_BEFORE : entry;
            *before++ = entry;
        }
    }
    return rgb != NULL;
}

/* Writes entries, each pixel scale x scale times. */
static bool put_entries(GifFileType *file, const struct gif_out *gif, const uint8_t *entries, uint32_t scale,
                        uint8_t *line)
{
    for (uint32_t y = 0; y < gif->height * scale; y++) {
        for (uint32_t x = 0; x < gif->width * scale; x++) {
            line[x] = entries[(size_t)(y / scale) * gif->width + x / scale];
        }
        if (EGifPutLine(file, line, (int)(gif->width * scale)) != GIF_OK) {
            return false;
        }
    }
    return true;
}

static bool put_frame(GifFileType *file, const struct gif_out *gif, uint32_t frame, const uint8_t *entries,
                      uint32_t scale, uint8_t *line)
{
    const GraphicsControlBlock control = {DISPOSE_DO_NOT, false, DELAY_CS,
                                          frame > 0 ? AS_BEFORE : NO_TRANSPARENT_COLOR};
    GifByteType bytes[4];
    const size_t n = EGifGCBToExtension(&control, bytes);
    return EGifPutExtension(file, GRAPHICS_EXT_FUNC_CODE, (int)n, bytes) == GIF_OK &&
           EGifPutImageDesc(file, 0, 0, (int)(gif->width * scale), (int)(gif->height * scale), false, NULL) == GIF_OK &&
           put_entries(file, gif, entries, scale, line);
}

/* Writes size, palette and "repeat for ever". */
static bool put_head(GifFileType *file, const struct gif_out *gif, uint32_t scale)
{
    static const GifByteType loop[3] = {1, 0, 0};
    ColorMapObject *const map = GifMakeMapObject(PALETTE, gif->palette);
    EGifSetGifVersion(file, true);
    const bool good =
        map != NULL &&
        EGifPutScreenDesc(file, (int)(gif->width * scale), (int)(gif->height * scale), 8, 0, map) == GIF_OK &&
        EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
        EGifPutExtensionBlock(file, 11, "NETSCAPE2.0") == GIF_OK && EGifPutExtensionBlock(file, 3, loop) == GIF_OK &&
        EGifPutExtensionTrailer(file) == GIF_OK;
    GifFreeMapObject(map);
    return good;
}

static int write_bytes(GifFileType *file, const GifByteType *bytes, int n)
{
    return (int)fwrite(bytes, 1, (size_t)n, file->UserData);
}

struct job {
    struct gif_out *gif;
    uint32_t scale;
    uint8_t *before, *entries, *line;
};

static int write_gif(FILE *to, const void *context)
{
    const struct job *job = context;
    GifFileType *const file = EGifOpen(to, write_bytes, NULL);
    bool good = file != NULL && put_head(file, job->gif, job->scale);
    for (uint32_t f = 0; good && f < job->gif->count; f++) {
        good = fill_entries(job->gif, f, job->before, job->entries) &&
               put_frame(file, job->gif, f, job->entries, job->scale, job->line);
    }
    good = (file == NULL || EGifCloseFile(file, NULL) == GIF_OK) && good;
    return good && fflush(to) == 0 ? 0 : file_save_status();
}

int gif_out_save(struct gif_out *gif, const char *path, uint32_t scale)
{
    const size_t pixels = (size_t)gif->width * gif->height;
    struct job job = {gif, scale, malloc(pixels), malloc(pixels), malloc((size_t)gif->width * scale)};
    int status = job.before != NULL && job.entries != NULL && job.line != NULL ? 0 : PH_ERR_NOMEM;
    gif->exact = take_all_colours(gif);
    if (status == 0 && !gif->exact) {
        status = choose_colours(gif);
    }
    if (status == 0) {
        status = file_save(path, write_gif, &job);
    }
    free(job.before);
    free(job.entries);
    free(job.line);
    return status;
}
