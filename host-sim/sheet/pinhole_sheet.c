/*
 * pinhole-sheet: puts pictures of any sizes on one sheet, in rows of at most a given width, with the same gap
 * everywhere. A row is as high as its highest picture; the pictures stand in its middle. A caption stands in the middle
 * of a strip below them, in the letters of the core.
 */
#include "complain.h"
#include "frame_out.h"
#include "option_table.h"
#include "option_text.h"
#include "overlay.h"

#include <stdlib.h>
#include <string.h>

struct sheet {
    const char *out, *caption;
    bool help;
    struct frame_out frames;
    uint32_t width, gap; /* pixels */
    uint32_t count;
    uint32_t pixels; /* of all pictures */
    struct ppm *pictures;
    struct ppm paper;
};

struct row {
    uint32_t first, end; /* pictures */
    uint32_t width, height;
};

static const uint8_t paper_colour[3] = {40, 44, 52};

#define CAPTION_SCALE 2
#define CAPTION_LINES (10 * CAPTION_SCALE) /* px */

/* Returns the row of as many pictures from `first` on as fit, at least one. */
static struct row next_row(const struct sheet *s, uint32_t first)
{
    struct row row = {.first = first, .end = first, .width = s->gap, .height = 0};
    while (row.end < s->count) {
        const struct ppm *p = &s->pictures[row.end];
        const uint32_t width = row.width + p->width + s->gap;
        if (row.end > first && width > s->width) {
            break;
        }
        row.width = width;
        row.height = p->height > row.height ? p->height : row.height;
        row.end++;
    }
    return row;
}

static void put_picture(struct ppm *paper, const struct ppm *p, uint32_t x, uint32_t y)
{
    for (uint32_t line = 0; line < p->height; line++) {
        memcpy(paper->rgb + ((size_t)(y + line) * paper->width + x) * 3, p->rgb + (size_t)line * p->width * 3,
               (size_t)p->width * 3);
    }
}

static int make_paper(struct sheet *s)
{
    const uint64_t scale = s->frames.scale > 0 ? s->frames.scale : 1;
    uint64_t width = s->width, height = s->gap;
    for (struct row row = {0}; row.end < s->count;) {
        row = next_row(s, row.end);
        width = row.width > width ? row.width : width;
        height += row.height + s->gap;
    }
    height += s->caption != NULL ? CAPTION_LINES : 0;
    if (width * height * scale * scale > FRAME_OUT_PIXELS_MAX) {
        return complain("the sheet would be %llux%llu, more than %u pixels: take fewer pictures, or smaller ones",
                        (unsigned long long)width * scale, (unsigned long long)height * scale, FRAME_OUT_PIXELS_MAX);
    }
    const size_t pixels = (size_t)(width * height);
    s->paper = (struct ppm){(uint32_t)width, (uint32_t)height, malloc(pixels * 3)};
    if (s->paper.rgb == NULL) {
        return complain("not enough memory for a sheet of %u x %u pixels", (unsigned)s->paper.width,
                        (unsigned)s->paper.height);
    }
    for (size_t i = 0; i < pixels; i++) {
        memcpy(s->paper.rgb + i * 3, paper_colour, 3);
    }
    return 0;
}

static void put_pictures(struct sheet *s)
{
    uint32_t y = s->gap;
    for (struct row row = {0}; row.end < s->count; y += row.height + s->gap) {
        row = next_row(s, row.end);
        uint32_t x = (s->paper.width - row.width) / 2 + s->gap;
        for (uint32_t i = row.first; i < row.end; i++) {
            put_picture(&s->paper, &s->pictures[i], x, y + (row.height - s->pictures[i].height) / 2);
            x += s->pictures[i].width + s->gap;
        }
    }
}

/* Writes the caption at the lower border; what is too wide for the sheet is cut off. */
static int put_caption(struct sheet *s)
{
    const struct ph_overlay_style style = {1, 1, CAPTION_SCALE}; /* not the colour of what is empty, 0 */
    const uint32_t width = s->paper.width, first = (s->paper.height - CAPTION_LINES) * width;
    uint16_t *const letters = calloc(width, CAPTION_LINES * sizeof *letters);
    if (letters == NULL) {
        return complain("not enough memory for a caption");
    }
    const struct ph_overlay_band band = {letters, (uint16_t)width, 0, CAPTION_LINES};
    ph_text(&band, ((int32_t)width - ph_text_width(s->caption, CAPTION_SCALE)) / 2, 0, s->caption, &style);
    for (uint32_t i = 0; i < width * CAPTION_LINES; i++) {
        if (letters[i] != 0) {
            memset(s->paper.rgb + 3 * ((size_t)first + i), 255, 3);
        }
    }
    free(letters);
    return 0;
}

static bool set_out(void *to, const char *value)
{
    struct sheet *s = to;
    s->out = value;
    return strcmp(value, "-") == 0 || option_text_ends(value, ".ppm") || option_text_ends(value, ".png") ||
           option_text_ends(value, ".gif");
}

static bool set_caption(void *to, const char *value)
{
    ((struct sheet *)to)->caption = value;
    return true;
}

static const struct option_row rows[] = {
    {"out", "SHEET.png", "where the sheet goes; - is stdout (PPM)", "a file that ends in .png, .ppm or .gif, or -",
     .set = set_out},
    {"caption", "TEXT", "writes it below the pictures", "a text", .set = set_caption},
    {"scale", "N", "makes every pixel of the sheet N x N pixels", "a whole number, 1 .. 16",
     .at = offsetof(struct sheet, frames.scale), .least = 1, .most = FRAME_OUT_SCALE_MAX},
    {"width", "PX", "width of the sheet; 1024 by default (wider where a picture is)", "a whole number, 1 .. 16384",
     .at = offsetof(struct sheet, width), .least = 1, .most = PPM_SIDE_MAX},
    {"gap", "PX", "gap around each picture; 12 by default", "a whole number, 0 .. 1024",
     .at = offsetof(struct sheet, gap), .least = 0, .most = 1024},
    {"help", NULL, "prints this, as does -h", NULL, .at = offsetof(struct sheet, help)},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

static void print_help(void)
{
    puts("pinhole-sheet --out SHEET.png [options] FILE...: puts pictures (PPM, PNG) of any sizes on one sheet.\n");
    option_table_help(&table);
    printf("\nThe sheet has %u pixels at most.\nExit status: 0 done; 1 failed; 2 wrong usage.\n", FRAME_OUT_PIXELS_MAX);
}

static int load(struct sheet *s, const char *path)
{
    struct ppm *const picture = &s->pictures[s->count];
    const int status = frame_out_load(path, FRAME_OUT_PIXELS_MAX, picture);
    if (status != 0) {
        return status;
    }
    s->count++; /* it is freed with the others, whatever comes */
    s->pixels += picture->width * picture->height;
    return s->pixels <= FRAME_OUT_PIXELS_MAX
               ? 0
               : complain("%s: with it the pictures have more than %u pixels: take fewer, or smaller ones", path,
                          FRAME_OUT_PIXELS_MAX);
}

/* Reads the command line; pictures are loaded on the way. */
static int read_arguments(struct sheet *s, int argc, char *argv[])
{
    for (int i = 1; i < argc && !s->help;) {
        if (argv[i][0] == '-') {
            i = option_table_read(&table, s, argc, argv, i);
            if (i < 0) {
                return i;
            }
        } else {
            const int status = load(s, argv[i]);
            if (status != 0) {
                return status;
            }
            i++;
        }
    }
    return s->help || (s->out != NULL && s->count > 0)
               ? 0
               : complain_usage("--out and at least one FILE are needed; see --help");
}

static int make_sheet(struct sheet *s)
{
    int status = make_paper(s);
    if (status != 0) {
        return status;
    }
    put_pictures(s);
    status = s->caption != NULL ? put_caption(s) : 0;
    status = status ? status : frame_out_open(&s->frames, s->out, false, 0);
    if (status == 0) {
        status = frame_out_put(&s->frames, 0, &s->paper);
    }
    return frame_out_close(&s->frames, status);
}

int main(int argc, char *argv[])
{
    struct sheet sheet = {.width = 1024, .gap = 12};
    complain_begin("pinhole-sheet", argc, argv);
    sheet.pictures = calloc((size_t)argc, sizeof *sheet.pictures);
    int status = sheet.pictures != NULL ? read_arguments(&sheet, argc, argv) : complain("not enough memory");
    if (status == 0 && sheet.help) {
        print_help();
    } else if (status == 0) {
        status = make_sheet(&sheet);
    }
    for (uint32_t i = 0; i < sheet.count; i++) {
        free(sheet.pictures[i].rgb);
    }
    free(sheet.paper.rgb);
    free(sheet.pictures);
    return complain_exit(status);
}
