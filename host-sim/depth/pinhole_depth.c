/* pinhole-depth: what depth resolves; see depth_lab.h. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */

#include "complain.h"
#include "depth_options.h"
#include "depth_table.h"
#include "file_save.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct depth_command commands[] = {
    {"pairs", "adjacent-pair test: depths in order from near to far, how many neighbours are equal or swapped",
     " near far depth fov size count spacing csv json ",
     "format,bits,near [m],far [m],spacing,pairs,equal (measured),swapped (measured),largest wrong [m] (measured)",
     depth_pairs},
    {"resolve", "the smallest separation that is ordered right at each distance, and the largest of them",
     " near far depth fov size at csv json ",
     "format,bits,near [m],far [m],z [m],ideal step [m] (predicted),S_eff [m] (measured),ratio", depth_resolve},
    {"monotone", "the code at every Q16.16 distance from near to far: does it ever rise?",
     " near far depth fov size csv json ",
     "format,bits,near [m],far [m],distances (measured),codes (measured),rises (measured),longest plateau [m] "
     "(measured),verdict",
     depth_monotone},
    {"advise",
     "which near plane, format and bits separate S at Z; the separation at Z with this near plane; or what fights in\n"
     "            the frames of a model or demo",
     " near far depth fov size at separate tilt bits demo view model allow-outside camera start frames csv json ",
     "format,bits,far [m],z [m],to separate [m],near from [m] (bound),with a margin [m] (bound),with near "
     "[m],separates up to z [m] (bound),needed up to z [m] (found),tilt [deg]",
     depth_advise},
    {"anchors", "the numbers that the depth lab is held against, published, reproduced or ours, computed again",
     " csv json ", "anchor,source,stated,here,how,verdict", depth_anchors},
    {"planes", "two parallel planes through the renderer: from which separation on none shows through the other",
     " near far depth fov size at tilt azimuth shading separation out csv json ",
     "format,bits,near [m],far [m],z [m],tilt [deg],S_min [m] (predicted),at this tilt [m] (predicted),enough [m] "
     "(bound),no pixel wrong from [m] (found),found / predicted,azimuth [deg],shading",
     depth_planes},
    {"slopes", "S_worst of planes by format, shading and tilt, over all azimuths and from tiny to screen-filling",
     " near far depth fov size at csv json ",
     "format,bits,near [m],far [m],z [m],shading,tilt [deg],enough [m] (bound),no pixel wrong from [m] (found),bound / "
     "found",
     depth_slopes},
    {"scenes", "floor and wall, tiles, crossing triangles, a sphere drawn twice: pixels that show the wrong surface",
     " near far depth fov size csv json ",
     "format,bits,near [m],far [m],scene,shading,pixels (measured),wrong (measured),largest wrong [m] (measured),at "
     "[m],step there [m] (predicted)",
     depth_scenes},
    {"budget", "what each part of the pipeline costs at each distance, and which part dominates",
     " near far depth fov size at csv json ",
     "format,bits,near [m],far [m],z [m],part,bound [m] (predicted),separation [m] (measured),largest (measured)",
     depth_budget},
    {"compare",
     "FILE|-: a log of the image of the depth lab (make firmware APP=depth) against this machine, byte for byte",
     " kind csv json ", "near [m],far [m],format,lines (measured),verdict", depth_compare},
    {"plot", "draws one of the KINDs ndc, g, resolve, others, pairs, budget through gnuplot",
     " kind near far depth fov size at count spacing out csv json ", NULL, depth_plot},
    {"all", "a report in Markdown: all of these for one camera, with tables, plots and the command that made each",
     " near far fov size out ", NULL, depth_report},
};

#define COMMAND_COUNT (sizeof commands / sizeof commands[0])

/* The rows as JSON, to a file or stdout. */
static int show_json(const char *path, const char *csv)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = strcmp(path, "-") == 0 ? stdout : open_memstream(&text, &length);
    if (file == NULL) {
        return complain("--json %s: not enough memory", path);
    }
    depth_table_json(file, csv);
    if (file == stdout) {
        return 0;
    }
    const int status =
        fclose(file) == 0 ? file_save_bytes(path, text, length) : complain("%s: not enough memory", path);
    free(text);
    return status;
}

static int show(const struct depth_command *command, const struct depth_lab *lab, char *csv)
{
    if (lab->json != NULL) {
        const int status = show_json(lab->json, csv);
        if (status != 0 || lab->csv == NULL) {
            return status;
        }
    }
    if (lab->csv == NULL) {
        const bool scene = lab->demo != NULL || lab->model != NULL; /* advise then has other columns */
        depth_table_print(stdout, csv, scene ? NULL : command->headings);
        return 0;
    }
    depth_table_drop_remarks(csv);
    if (strcmp(lab->csv, "-") != 0) {
        return file_save_bytes(lab->csv, csv, strlen(csv));
    }
    fputs(csv, stdout);
    return 0;
}

int main(int argc, char *argv[])
{
    struct depth_lab lab;
    const struct depth_command *command;
    complain_begin("pinhole-depth", argc, argv);
    int status = depth_options_read(&lab, &command, commands, COMMAND_COUNT, argc, argv);
    if (status != 0) {
        return complain_exit(status);
    }
    if (command == NULL) {
        depth_options_help(commands, COMMAND_COUNT);
    } else {
        char *csv;
        status = depth_lab_capture(&lab, command->run, &csv);
        if (csv != NULL && (status == 0 || command->run == depth_anchors)) { /* a failed anchor is shown too */
            const int shown = show(command, &lab, csv);
            status = status != 0 ? status : shown;
        }
        free(csv);
    }
    return complain_exit(status);
}
