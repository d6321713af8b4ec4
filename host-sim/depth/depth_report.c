/* pinhole-depth all: every measurement of one camera as a report in Markdown, with the command that makes each. */
#define _XOPEN_SOURCE 700 /* open_memstream, mkdir */

#include "complain.h"
#include "depth_gnuplot.h"
#include "depth_plot.h"
#include "depth_separation.h"
#include "depth_table.h"
#include "file_save.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct section {
    const char *command, *title, *plots[2]; /* kinds of plots that show it, or NULL */
    const char *options;                    /* of the camera beside near and far: "fov size"; NULL: no camera */
    const char *headings;
    const char *text;
    int (*run)(const struct depth_lab *lab);
};

static const struct section sections[] = {
    {"advise",
     "In short",
     {NULL, NULL},
     "fov size",
     "format,bits,far [m],z [m],to separate [m],near from [m] (bound),with a margin [m] (bound),with near "
     "[m],separates up to z [m] (bound),needed up to z [m] (found),tilt [deg]",
     "The separation that the renderer's formats keep with this camera up to the far plane, and the near plane from "
     "which on they separate a thousandth of that distance, at every tilt up to that of the last column, every azimuth "
     "and in every shading. What was found to be needed by planes that were drawn is less. Coarser steps lead to "
     "z-fighting. Formats of 16 "
     "bits take two bytes a pixel, formats of 24 bits four; linear-w takes a division a pixel, too.",
     depth_advise},
    {"resolve",
     "Smallest separation",
     {"resolve", "others"},
     "",
     "format,bits,near [m],far [m],z [m],ideal step [m] (predicted),S_eff [m] (measured),ratio",
     "The smallest separation of two surfaces facing the camera that is ordered right at a distance, and its worst "
     "over all distances. fixed16, float16, fixed24, float24 and linear-w with 16 bits are the renderer's. The others "
     "are for comparison: what is done elsewhere in Q16.16 (ndc-q16, recip-q16, clip-q16), linear-w with 24 bits, n/w "
     "as a float (over-w), and the logarithm. A step finer than that of Q16.16 is measured as one step of Q16.16, "
     "0.0000153 m.",
     depth_resolve},
    {"pairs",
     "Adjacent pairs",
     {"pairs", NULL},
     "",
     "format,bits,near [m],far [m],spacing,pairs,equal (measured),swapped (measured),largest wrong [m] (measured)",
     "Distances in order from near to far: how many neighbours get the same code, or codes in the wrong order.",
     depth_pairs},
    {"budget",
     "Who limits it",
     {"budget", NULL},
     "fov size",
     "format,bits,near [m],far [m],z [m],part,bound [m] (predicted),separation [m] (measured),largest (measured)",
     "The separation that each part of the pipeline alone may confuse, and all of them together. The prediction is a "
     "bound: what is measured never exceeds it, and all together are enough at every tilt. A part is measured in its "
     "worst case. All together are measured on drawn planes, tilted by 0, 40, 75 and 85 degrees in all directions, "
     "where "
     "the worst cases seldom meet: so they may measure less than a part alone.",
     depth_budget},
    {"planes",
     "Two planes",
     {NULL, NULL},
     "fov size",
     "format,bits,near [m],far [m],z [m],tilt [deg],S_min [m] (predicted),at this tilt [m] (predicted),enough [m] "
     "(bound),no pixel wrong from [m] (found),found / predicted,azimuth [deg],shading",
     "Two parallel planes drawn by the renderer, compared with exact arithmetic pixel by pixel. S_min is a step "
     "of depth and one of the sub-pixel grid, for every tilt. The bound is what is enough at this tilt in every place, "
     "at "
     "every azimuth and in every shading.",
     depth_planes},
    {"slopes",
     "Every slope and shading",
     {NULL, NULL},
     "fov size",
     "format,bits,near [m],far [m],z [m],shading,tilt [deg],enough [m] (bound),no pixel wrong from [m] (found),bound / "
     "found",
     "The worst over all azimuths, from tiny planes to those that fill the picture. One triangle has one depth in "
     "every "
     "shading, so their rows agree. The bound is enough at every tilt up to that of the row.",
     depth_slopes},
    {"scenes",
     "Surfaces that meet",
     {NULL, NULL},
     "fov size",
     "format,bits,near [m],far [m],scene,shading,pixels (measured),wrong (measured),largest wrong [m] (measured),at "
     "[m],step there [m] (predicted)",
     "Floors before walls, tiles with cards, triangles from near to far that cross, and a sphere drawn in each shading "
     "and then once more over it. A pixel is wrong if what shows there lies behind the other surface on its exact ray.",
     depth_scenes},
    {"monotone",
     "Monotonicity",
     {NULL, NULL},
     "",
     "format,bits,near [m],far [m],distances (measured),codes (measured),rises (measured),longest plateau [m] "
     "(measured),verdict",
     "The code at every distance that Q16.16 has: it must never rise. The renderer's formats pass. They have no Q16.16 "
     "reciprocal because it fails (recip-q16).",
     depth_monotone},
    {"anchors",
     "Numbers to hold it against",
     {NULL, NULL},
     NULL,
     "anchor,source,stated,here,how,verdict",
     "Numbers about depth, computed again; this camera does not matter. Each says whether it stands in a publication, "
     "is reproduced with a published program, or is ours. One passes if it has the stated digits; Reed's percentages "
     "pass if their sum is within 5 of 100, as they depend on the order of float32 sums. Of what Q16.16 reaches, the "
     "renderer's formats pass with at most 5 % more, the others within 5 %.",
     depth_anchors},
};

/* Makes a path in the directory of the report. 0 or COMPLAINED. */
static int name_file(const struct depth_lab *lab, const char *name, const char *suffix, char path[PATH_MAX])
{
    if (snprintf(path, PATH_MAX, "%s/%s.%s", lab->out, name, suffix) >= PATH_MAX) {
        return complain("--out: this name is too long");
    }
    return 0;
}

/* The options that describe the camera; options NULL: none do. */
static void put_camera(const struct depth_lab *lab, FILE *report, const char *options)
{
    char near_text[LAB_TEXT_SIZE], far_text[LAB_TEXT_SIZE];
    lab_fx_text(lab->near_z, near_text);
    lab_fx_text(lab->far_z, far_text);
    if (options != NULL) {
        fprintf(report, " --near %s --far %s", near_text, far_text);
    }
    if (options != NULL && *options != '\0') {
        fprintf(report, " --fov %g --size %ux%u", depth_metres(lab->fov_deg), lab->width, lab->height);
    }
}

/* A line of CSV as one of a Markdown table. */
static void put_cells(FILE *report, const char *line)
{
    const int n = (int)strcspn(line, "\n");
    fputs("| ", report);
    for (int i = 0; i < n; i++) {
        fputs(line[i] == ',' ? " | " : (char[]){line[i], '\0'}, report);
    }
    fputs(" |\n", report);
}

/* The remarks of CSV: sentences as a list, a table as it is. */
static void put_remarks(FILE *report, const char *csv, bool sentences)
{
    const char *const fence = sentences ? "" : "```text\n";
    bool first = true;
    for (const char *line = strchr(csv, '\n'); line != NULL && line[1] != '\0'; line = strchr(line + 1, '\n')) {
        if (line[1] == '#') {
            const char *const text = line + 2 + strspn(line + 2, "!") + 1; /* "# " or "#! " */
            fprintf(report, "%s%s%s%.*s\n", first ? "\n" : "", first ? fence : "", sentences ? "- " : "",
                    (int)strcspn(text, "\n"), text);
            first = false;
        }
    }
    fputs(first ? "" : sentences ? "" : "```\n", report);
}

/* Writes CSV as a Markdown table, without its remarks. */
static void put_table(FILE *report, const char *csv, const char *headings)
{
    put_cells(report, headings);
    fputc('|', report);
    for (const char *comma = headings; comma != NULL; comma = strchr(comma, ',')) {
        fputs("---|", report);
        comma += *comma == ',';
    }
    fputc('\n', report);
    for (const char *line = strchr(csv, '\n'); line != NULL && line[1] != '\0'; line = strchr(line + 1, '\n')) {
        if (line[1] != '#') {
            put_cells(report, line + 1);
        }
    }
}

/* Writes the plot beside the report and its link; without gnuplot a line says so. */
static int put_plot(const struct depth_lab *lab, FILE *report, const char *name, const char *options, bool can_plot)
{
    const struct depth_plot_kind *const kind = depth_plot_find(name);
    char path[PATH_MAX], *picture = NULL;
    size_t length = 0;
    if (!can_plot) {
        fprintf(report, "\nNo plot `%s`: gnuplot is missing (`apt-get install gnuplot-nox`).\n", name);
        return 0;
    }
    int status = name_file(lab, name, "svg", path);
    if (status == 0) {
        status = depth_plot_picture(lab, kind, false, &picture, &length);
    }
    if (status == 0) {
        status = file_save_bytes(path, picture, length);
    }
    free(picture);
    fprintf(report, "\n![%s](%s.svg)\n\n`pinhole-depth plot %s", kind->title, name, name);
    put_camera(lab, report, options);
    fprintf(report, " --out %s.svg`\n", name);
    return status;
}

static int save_rows(const struct depth_lab *lab, const char *name, char *csv)
{
    char path[PATH_MAX];
    depth_table_drop_remarks(csv);
    const int status = name_file(lab, name, "csv", path);
    return status != 0 ? status : file_save_bytes(path, csv, strlen(csv));
}

/* The distance and the separation that advise is asked about. */
static void ask_advice(struct depth_lab *lab)
{
    lab->near_set = true;
    lab->at[0] = lab->far_z;
    lab->at_count = 1;
    lab->separate = (fx_t)(((int64_t)lab->far_z + 999) / 1000);
}

/* The options of the section's command beside the camera. */
static void put_more(const struct depth_lab *lab, FILE *report, const struct section *section)
{
    if (section->run == depth_planes) {
        fputs(" --out planes.png", report);
    }
    if (section->run == depth_advise) {
        struct depth_lab own = *lab;
        char z[LAB_TEXT_SIZE], s[LAB_TEXT_SIZE];
        ask_advice(&own);
        lab_fx_text(own.at[0], z);
        lab_fx_text(own.separate, s);
        fprintf(report, " --at %s --separate %s", z, s);
    }
}

/* Runs the command of a section; `planes` writes its picture, too. */
static int run_section(const struct depth_lab *lab, const struct section *section, char **csv)
{
    struct depth_lab own = *lab;
    char picture[PATH_MAX];
    own.out = NULL;
    if (section->run == depth_advise) {
        ask_advice(&own);
    }
    if (section->run == depth_planes) {
        const int status = name_file(lab, "planes", "png", picture);
        if (status != 0) {
            *csv = NULL;
            return status;
        }
        own.out = picture;
    }
    return depth_lab_capture(&own, section->run, csv);
}

static int put_section(const struct depth_lab *lab, FILE *report, const struct section *section, bool can_plot)
{
    char *csv;
    int status = run_section(lab, section, &csv);
    if (status == 0) {
        fprintf(report, "\n## %s\n\n%s\n\n`pinhole-depth %s", section->title, section->text, section->command);
        put_camera(lab, report, section->options);
        put_more(lab, report, section);
        fprintf(report, "` ([%s.csv](%s.csv))\n\n", section->command, section->command);
        put_table(report, csv, section->headings);
        put_remarks(report, csv, section->run == depth_advise);
        status = save_rows(lab, section->command, csv);
    }
    if (status == 0 && section->run == depth_planes) {
        fputs("\n![Pixels of both planes, right ones blue, wrong ones orange](planes.png)\n\n"
              "Orange: the plane behind shows. One picture a format, in the order of the table.\n",
              report);
    }
    for (int i = 0; i < 2 && status == 0 && section->plots[i] != NULL; i++) {
        status = put_plot(lab, report, section->plots[i], section->options, can_plot);
    }
    free(csv);
    return status;
}

/* Whether the renderer draws it without a reciprocal a pixel, with as many bits of exponent as it takes itself. */
static bool is_quick(const struct lab_format *format)
{
    return format->kind == LAB_DRAWN && format->exponent == 0 && format->format->coding != PH_DEPTH_IS_LINEAR;
}

/* One line: the cheapest format that separates a thousandth of the far plane's distance, or the finest. The formats of
 * 16 bits that step in one multiplication come first. */
static void put_answer(const struct depth_lab *lab, FILE *report)
{
    const double enough = depth_metres(lab->far_z) / 1000;
    const struct lab_format *best = NULL;
    double best_m = HUGE_VAL;
    for (uint32_t i = 0; i < 2 * lab_format_count && !(best_m <= enough); i++) {
        const struct lab_format *const format = &lab_formats[i % lab_format_count];
        if (format->bits == (i < lab_format_count ? 16 : 24) && is_quick(format)) {
            const struct depth_lab own = depth_lab_of(lab, i % lab_format_count);
            const double worst =
                depth_separation_m(format->format, &own, depth_metres(lab->far_z), 0, depth_way_px(&own));
            best = worst < best_m ? format : best;
            best_m = fmin(worst, best_m);
        }
    }
    if (best != NULL) {
        fprintf(
            report,
            "\n**Take `%s` (%u bits): with the near plane at %.4g m it keeps surfaces that face the camera apart from "
            "%.3g m on, at every distance up to %.4g m.**\n",
            best->name, best->bits, depth_metres(lab->near_z), best_m, depth_metres(lab->far_z));
    }
}

static int put_report(const struct depth_lab *lab, FILE *report)
{
    const bool can_plot = depth_gnuplot_is_here();
    struct depth_lab documents = *lab; /* with the near and far planes that the documents have */
    int status = 0;
    documents.near_set = documents.far_set = false;
    fprintf(report, "# What depth resolves: near %.4g m, far %.4g m, %g degrees, %ux%u\n", depth_metres(lab->near_z),
            depth_metres(lab->far_z), depth_metres(lab->fov_deg), lab->width, lab->height);
    put_answer(lab, report);
    fputs("\nMade by `pinhole-depth all", report);
    put_camera(lab, report, "fov size");
    fputs(" --out DIR`.\n", report);
    for (size_t i = 0; i < sizeof sections / sizeof sections[0] && status == 0; i++) {
        status = put_section(lab, report, &sections[i], can_plot);
    }
    if (status == 0) {
        fputs("\n## The source documents' curves\n", report);
        status = put_plot(&documents, report, "ndc", NULL, can_plot);
    }
    return status != 0 ? status : put_plot(&documents, report, "g", NULL, can_plot);
}

int depth_report(const struct depth_lab *lab)
{
    char path[PATH_MAX], *text = NULL;
    size_t length;
    if (lab->out == NULL) {
        return complain_usage("all needs --out DIR, a directory for the report");
    }
    struct stat directory;
    const int error = mkdir(lab->out, 0777) == 0 ? 0 : errno;
    if (error != 0 && (stat(lab->out, &directory) != 0 || !S_ISDIR(directory.st_mode))) {
        return complain("--out %s: cannot be used as a directory: %s", lab->out,
                        strerror(error == EEXIST ? ENOTDIR : error));
    }
    FILE *const report = open_memstream(&text, &length);
    if (report == NULL) {
        return complain("out of memory");
    }
    int status = put_report(lab, report);
    if (fclose(report) != 0 && status == 0) {
        status = complain("out of memory");
    }
    if (status == 0) {
        status = name_file(lab, "report", "md", path);
    }
    if (status == 0) {
        status = file_save_bytes(path, text, length);
    }
    free(text);
    if (status != 0 && error == 0) {
        rmdir(lab->out); /* it was made here; a plot that is in it keeps it */
    }
    return status;
}
