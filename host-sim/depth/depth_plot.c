/* See depth_plot.h. Writes a gnuplot script, and runs gnuplot on it where a picture is wanted. */
#define _XOPEN_SOURCE 700 /* open_memstream */

#include "depth_plot.h"

#include "complain.h"
#include "depth_gnuplot.h"
#include "file_save.h"
#include "option_text.h"

#include <stdlib.h>
#include <string.h>

const struct depth_plot_kind *depth_plot_find(const char *name)
{
    for (uint32_t i = 0; i < depth_plot_kind_count; i++) {
        if (strcmp(depth_plot_kinds[i].name, name) == 0) {
            return &depth_plot_kinds[i];
        }
    }
    return NULL;
}

static void begin(FILE *script, const struct depth_plot_kind *kind, bool png)
{
    if (png) {
        fprintf(script, "set terminal pngcairo size %d,%d font 'Sans,11' background '#ffffff'\n", kind->width,
                kind->height);
    } else {
        fprintf(script, "set terminal svg size %d,%d font 'Helvetica,Arial,sans-serif,14' background '#ffffff'\n",
                kind->width, kind->height);
    }
    fputs("set encoding utf8\nset border 3 lc '#444444'\nset tics nomirror textcolor '#222222'\n"
          "set grid lc '#dddddd' lt 1 lw 1\nset key noenhanced\nset decimalsign '.'\n",
          script);
}

int depth_plot_picture(const struct depth_lab *lab, const struct depth_plot_kind *kind, bool png, char **picture,
                       size_t *length)
{
    char *text = NULL;
    size_t size;
    FILE *const script = open_memstream(&text, &size);
    *picture = NULL;
    if (script == NULL) {
        return complain("out of memory");
    }
    begin(script, kind, png);
    int status = kind->write(lab, script);
    if (fclose(script) != 0 && status == 0) {
        status = complain("out of memory");
    }
    if (status == 0) {
        status = depth_gnuplot_run(text, picture, length);
    }
    free(text);
    return status;
}

static int no_such_kind(const char *name)
{
    char names[200];
    size_t n = 0;
    for (uint32_t i = 0; i < depth_plot_kind_count && n < sizeof names; i++) {
        n += (size_t)snprintf(names + n, sizeof names - n, " %s", depth_plot_kinds[i].name);
    }
    return complain_usage("plot '%s': no such kind; there are%s", name, names);
}

int depth_plot(const struct depth_lab *lab)
{
    const struct depth_plot_kind *kind = depth_plot_find(lab->kind);
    if (kind == NULL) {
        return no_such_kind(lab->kind);
    }
    const bool rows = lab->csv != NULL || lab->json != NULL;
    if (rows && kind->rows == NULL) {
        return complain_usage(
            "plot %s has no --csv and --json: the commands resolve, pairs and budget have the numbers", kind->name);
    }
    const int written = rows ? kind->rows(lab) : 0;
    if (written != 0 || (rows && lab->out == NULL)) {
        return written;
    }
    if (lab->out == NULL) {
        return complain_usage("plot needs --out FILE.svg or FILE.png, or --csv");
    }
    const bool png = option_text_ends(lab->out, ".png");
    if (!png && !option_text_ends(lab->out, ".svg")) {
        return complain_usage("--out %s: plots are written as .svg or .png", lab->out);
    }
    char *picture;
    size_t length = 0;
    int status = depth_plot_picture(lab, kind, png, &picture, &length);
    if (status == 0) {
        status = file_save_bytes(lab->out, picture, length);
    }
    free(picture);
    return status;
}
