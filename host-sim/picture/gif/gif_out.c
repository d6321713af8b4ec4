/* See gif_out.h. Frames are packed as they come, into a file without a name, which is copied at the end. */
#define _XOPEN_SOURCE 700 /* mkstemp, pread */

#include "gif_out.h"

#include "file_save.h"
#include "status.h"

#include <gif_lib.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DELAY_CS 3     /* hundredths of a second a frame: the nearest to 30 frames a second that a GIF has */
#define PALETTE  256   /* entries at most; the last one is "as before" */
#define CELLS    32768 /* colours of 5 bits a channel */

#define DITHER 16   /* of 255: how far the dither moves a colour in all */
#define SLOTS  1024 /* of the hash that finds a colour of an exact palette */

#define EVERY_MOST 16384 /* frames: a delay has 16 bits */

struct gif_out {
    uint32_t width, height, scale, count;
    uint32_t every;          /* of so many frames one is kept */
    FILE *waiting;           /* the file so far, without its end */
    off_t size;              /* of what waits, in whole frames */
    GifFileType *file;       /* what writes there */
    uint8_t *shown;          /* the frame that was kept last */
    uint8_t *entries, *line; /* of the frame that is packed; a line of it as it is enlarged */
    GifColorType palette[PALETTE];
    int colours, as_before; /* as_before: the last entry, of as many as a power of 2 */
    bool exact;             /* the palette has every colour that the frame sends */
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

int gif_out_new(struct gif_out **gif, const char *path, uint32_t scale)
{
    *gif = calloc(1, sizeof **gif);
    if (*gif == NULL) {
        return PH_ERR_NOMEM;
    }
    (*gif)->scale = scale;
    (*gif)->every = 1;
    (*gif)->waiting = open_waiting(path);
    return (*gif)->waiting != NULL ? 0 : file_save_status();
}

void gif_out_free(struct gif_out *gif)
{
    if (gif == NULL) {
        return;
    }
    if (gif->file != NULL) {
        EGifCloseFile(gif->file, NULL);
    }
    if (gif->waiting != NULL) {
        fclose(gif->waiting);
    }
    free(gif->shown);
    free(gif->entries);
    free(gif->line);
    free(gif);
}

uint32_t gif_out_count(const struct gif_out *gif)
{
    return gif->count;
}

uint32_t gif_out_every(const struct gif_out *gif)
{
    return gif->every;
}

/* ---- the palette of a frame -------------------------------------------------------------------------- */

/* Does the frame send pixel i? Those that stay as they were are not sent again. */
static bool is_sent(const struct gif_out *gif, const uint8_t *rgb, size_t i)
{
    return gif->count == 0 || memcmp(gif->shown + 3 * i, rgb + 3 * i, 3) != 0;
}

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

/* Takes every colour that the frame sends into the palette. False if there are too many. */
static bool take_all_colours(struct gif_out *gif, const uint8_t *rgb)
{
    const size_t pixels = (size_t)gif->width * gif->height;
    memset(gif->slots, 0, sizeof gif->slots);
    gif->colours = 0;
    for (size_t i = 0; i < pixels; i++) {
        int16_t *const slot = is_sent(gif, rgb, i) ? slot_of(gif, rgb + 3 * i) : NULL;
        if (slot != NULL && *slot == 0) {
            if (gif->colours == PALETTE - 1) {
                return false;
            }
            gif->palette[gif->colours++] = (GifColorType){rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
            *slot = (int16_t)gif->colours;
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

/* What the frame sends of a cell of colours: its middle, and the root of its pixels, so that a large background leaves
 * colours for what stands before it. */
struct sample {
    int red, green, blue;
    uint32_t weight;
};

/* Returns how many samples there are; all[] has room for CELLS. */
static uint32_t take_samples(const struct gif_out *gif, const uint8_t *rgb, uint32_t *counts, struct sample *all)
{
    const size_t pixels = (size_t)gif->width * gif->height;
    uint32_t n = 0;
    for (size_t i = 0; i < pixels; i++) {
        counts[cell_of(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2])] += is_sent(gif, rgb, i);
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
static int choose_colours(struct gif_out *gif, const uint8_t *rgb)
{
    uint32_t *const counts = calloc(CELLS, sizeof *counts);
    struct sample *const all = malloc(CELLS * sizeof *all);
    if (counts != NULL && all != NULL) {
        const uint32_t n = take_samples(gif, rgb, counts, all);
        gif->colours = PALETTE - 1;
        memset(gif->nearest, 0, sizeof gif->nearest);
        for (uint32_t i = 0; i < PALETTE - 1; i++) {
            const struct sample *const s = &all[(uint64_t)i * n / (PALETTE - 1)];
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

static void fill_entries(struct gif_out *gif, const uint8_t *rgb)
{
    for (uint32_t y = 0; y < gif->height; y++) {
        for (uint32_t x = 0; x < gif->width; x++) {
            const size_t i = (size_t)y * gif->width + x;
            gif->entries[i] = is_sent(gif, rgb, i) ? entry_of(gif, rgb + 3 * i, x, y) : (uint8_t)gif->as_before;
        }
    }
}

/* Writes the entries, each pixel scale x scale times. */
static bool put_entries(const struct gif_out *gif)
{
    const uint32_t scale = gif->scale;
    for (uint32_t y = 0; y < gif->height * scale; y++) {
        for (uint32_t x = 0; x < gif->width * scale; x++) {
            gif->line[x] = gif->entries[(size_t)(y / scale) * gif->width + x / scale];
        }
        if (EGifPutLine(gif->file, gif->line, (int)(gif->width * scale)) != GIF_OK) {
            return false;
        }
    }
    return true;
}

static bool put_frame(const struct gif_out *gif)
{
    const GraphicsControlBlock control = {DISPOSE_DO_NOT, false, (int)(DELAY_CS * gif->every),
                                          gif->count > 0 ? gif->as_before : NO_TRANSPARENT_COLOR};
    GifByteType bytes[4];
    const size_t n = EGifGCBToExtension(&control, bytes);
    ColorMapObject *const map = GifMakeMapObject(gif->as_before + 1, gif->palette);
    const bool good = map != NULL && EGifPutExtension(gif->file, GRAPHICS_EXT_FUNC_CODE, (int)n, bytes) == GIF_OK &&
                      EGifPutImageDesc(gif->file, 0, 0, (int)(gif->width * gif->scale), (int)(gif->height * gif->scale),
                                       false, map) == GIF_OK &&
                      put_entries(gif);
    GifFreeMapObject(map);
    return good;
}

static int write_bytes(GifFileType *file, const GifByteType *bytes, int n)
{
    return (int)fwrite(bytes, 1, (size_t)n, file->UserData);
}

/* Writes size and "repeat for ever". */
static bool put_head(struct gif_out *gif)
{
    static const GifByteType loop[3] = {1, 0, 0};
    gif->file = EGifOpen(gif->waiting, write_bytes, NULL);
    if (gif->file == NULL) {
        return false;
    }
    EGifSetGifVersion(gif->file, true);
    return EGifPutScreenDesc(gif->file, (int)(gif->width * gif->scale), (int)(gif->height * gif->scale), 8, 0, NULL) ==
               GIF_OK &&
           EGifPutExtensionLeader(gif->file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(gif->file, 11, "NETSCAPE2.0") == GIF_OK &&
           EGifPutExtensionBlock(gif->file, 3, loop) == GIF_OK && EGifPutExtensionTrailer(gif->file) == GIF_OK;
}

static int begin(struct gif_out *gif, const struct ppm *picture)
{
    const size_t pixels = (size_t)picture->width * picture->height;
    gif->width = picture->width;
    gif->height = picture->height;
    gif->shown = malloc(3 * pixels);
    gif->entries = malloc(pixels);
    gif->line = malloc((size_t)picture->width * gif->scale);
    if (gif->shown == NULL || gif->entries == NULL || gif->line == NULL) {
        return PH_ERR_NOMEM;
    }
    return put_head(gif) ? 0 : file_save_status();
}

/* The fewer bytes are left of the most that a file has, the fewer frames are kept: half of them from half of it on, a
 * quarter from three quarters on, and so forth. */
static void thin_out(struct gif_out *gif)
{
    const uint32_t next = 2 * gif->every;
    if (gif->size > GIF_OUT_BYTES_MOST - GIF_OUT_BYTES_MOST / next && gif->count % next == 0 && next <= EVERY_MOST) {
        gif->every = next;
    }
}

static int keep(struct gif_out *gif, const uint8_t *rgb)
{
    gif->exact = take_all_colours(gif, rgb);
    const int status = gif->exact ? 0 : choose_colours(gif, rgb);
    if (status != 0) {
        return status;
    }
    for (gif->as_before = 1; gif->as_before < gif->colours;) {
        gif->as_before += gif->as_before + 1;
    }
    fill_entries(gif, rgb);
    if (!put_frame(gif) || fflush(gif->waiting) != 0) {
        return file_save_status();
    }
    gif->size = ftello(gif->waiting);
    memcpy(gif->shown, rgb, (size_t)3 * gif->width * gif->height);
    return 0;
}

int gif_out_add(struct gif_out *gif, const struct ppm *picture)
{
    int status = gif->count == 0 ? begin(gif, picture) : 0;
    thin_out(gif);
    if (status == 0 && gif->count % gif->every == 0) {
        status = keep(gif, picture->rgb);
    }
    gif->count += status == 0;
    return status;
}

/* Copies the whole frames, whatever of another follows them, and ends the file. */
static int write_gif(FILE *to, const void *context)
{
    const struct gif_out *const gif = context;
    uint8_t bytes[16384];
    for (off_t at = 0; at < gif->size;) {
        const off_t left = gif->size - at;
        const ssize_t n =
            pread(fileno(gif->waiting), bytes, left < (off_t)sizeof bytes ? (size_t)left : sizeof bytes, at);
        if (n <= 0 || fwrite(bytes, 1, (size_t)n, to) != (size_t)n) {
            return file_save_status();
        }
        at += n;
    }
    return fputc(';', to) != EOF && fflush(to) == 0 ? 0 : file_save_status();
}

int gif_out_save(const struct gif_out *gif, const char *path)
{
    return file_save(path, write_gif, gif);
}
