/*
 * pinhole-sheet: puts PPM pictures of any sizes on one sheet, in rows of at most a given width, with the same gap
 * everywhere between them. A row is as high as its highest picture; pictures stand in its middle.
 */
#include "complain.h"
#include "option_text.h"
#include "ppm.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct sheet {
    const char *out;
    uint32_t width, gap; /* pixels */
    uint32_t count;
    struct ppm *pictures;
    struct ppm paper;
};

struct row {
    uint32_t first, end; /* pictures */
    uint32_t width, height;
};

static const uint8_t paper_colour[3] = {40, 44, 52};

static void print_help(void)
{
    puts("pinhole-sheet --out SHEET.ppm [--width PX] [--gap PX] FILE.ppm...\n"
         "  --out SHEET.ppm  where the sheet goes\n"
         "  --width PX       width of the sheet, 1 .. 16384; 1024 by default (wider where a picture is)\n"
         "  --gap PX         gap around each picture, 0 .. 1024; 12 by default");
}

/* The pictures from `first` on that fit into one row; at least one. */
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
    s->paper = (struct ppm){.width = s->width, .height = s->gap};
    for (struct row row = {0}; row.end < s->count;) {
        row = next_row(s, row.end);
        s->paper.width = row.width > s->paper.width ? row.width : s->paper.width;
        s->paper.height += row.height + s->gap;
    }
    const size_t pixels = (size_t)s->paper.width * s->paper.height;
    s->paper.rgb = malloc(pixels * 3);
    if (s->paper.rgb == NULL) {
        return complain(EXIT_FAILED, "not enough memory for a sheet of %u x %u pixels", (unsigned)s->paper.width,
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

/* Reads the command line; pictures are loaded on the way. */
static int read_arguments(struct sheet *s, int argc, char *argv[])
{
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--out") == 0 && *value != '\0') {
            s->out = argv[++i];
        } else if ((strcmp(argv[i], "--width") == 0 && option_text_u32(value, 1, PPM_SIDE_MAX, &s->width)) ||
                   (strcmp(argv[i], "--gap") == 0 && option_text_u32(value, 0, 1024, &s->gap))) {
            i++;
        } else if (argv[i][0] == '-') {
            return complain(EXIT_USAGE, "%s %s: wrong option or value; see --help", argv[i], value);
        } else if (ppm_load(argv[i], &s->pictures[s->count]) != 0) {
            return complain(EXIT_FAILED, "%s: cannot be read as a PPM: %s", argv[i], strerror(errno));
        } else {
            s->count++;
        }
    }
    return s->out != NULL && s->count > 0 ? 0 : complain(EXIT_USAGE, "--out and at least one FILE.ppm are needed");
}

int main(int argc, char *argv[])
{
    struct sheet sheet = {.width = 1024, .gap = 12};
    complain_as("pinhole-sheet");
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        print_help();
        return complain_stdout();
    }
    sheet.pictures = calloc((size_t)argc, sizeof *sheet.pictures);
    int status =
        sheet.pictures != NULL ? read_arguments(&sheet, argc, argv) : complain(EXIT_FAILED, "not enough memory");
    if (status == 0) {
        status = make_paper(&sheet);
    }
    if (status == 0) {
        put_pictures(&sheet);
        if (ppm_save(sheet.out, &sheet.paper) != 0) {
            status = complain(EXIT_FAILED, "%s: cannot be written: %s", sheet.out, strerror(errno));
        }
    }
    for (uint32_t i = 0; i < sheet.count; i++) {
        free(sheet.pictures[i].rgb);
    }
    free(sheet.paper.rgb);
    free(sheet.pictures);
    return status;
}
