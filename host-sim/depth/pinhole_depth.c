/* pinhole-depth: what depth resolves; see depth_lab.h. */

#include "complain.h"
#include "depth_options.h"
#include "depth_table.h"
#include "file_save.h"

#include <stdlib.h>
#include <string.h>

static const struct depth_command commands[] = {
    {"pairs", "adjacent-pair test: depths in order from near to far, how many neighbours are equal or swapped",
     " near far format fov size count spacing csv ",
     "format,bits,near [m],far [m],spacing,pairs,equal (measured),swapped (measured),largest wrong [m] (measured)",
     depth_pairs},
    {"resolve", "the smallest separation that is ordered right at each distance, and the largest of them",
     " near far format fov size at csv ",
     "format,bits,near [m],far [m],z [m],ideal step [m] (predicted),S_eff [m] (measured),ratio", depth_resolve},
    {"monotone", "the code at every Q16.16 distance from near to far: does it ever rise?",
     " near far format fov size csv ",
     "format,bits,near [m],far [m],distances (measured),codes (measured),rises (measured),longest plateau [m] "
     "(measured),verdict",
     depth_monotone},
    {"advise", "which near plane, format and bits separate S at Z; and the separation at Z with this near plane",
     " near far format fov size at separate bits csv ",
     "format,bits,far [m],z [m],to separate [m],near from [m] (measured),with a margin [m] (measured),with near "
     "[m],separates at z [m] (measured),up to z [m] (measured)",
     depth_advise},
    {"anchors", "every published number that the depth lab is based on, computed again", " csv ",
     "anchor,published,here,how,verdict", depth_anchors},
    {"planes", "two parallel planes through the renderer: from which separation on none shows through the other",
     " near far format fov size at tilt separation out csv ",
     "format,bits,near [m],far [m],z [m],tilt [deg],S_min [m] (predicted),at this tilt [m] (predicted),no pixel wrong "
     "from [m] (measured),measured / predicted",
     depth_planes},
    {"budget", "what each part of the pipeline costs at each distance, and which part dominates",
     " near far format fov size at csv ",
     "format,bits,near [m],far [m],z [m],part,separation [m] (predicted),separation [m] (measured),largest (measured)",
     depth_budget},
    {"plot", "draws one of the KINDs ndc, g, resolve, pairs, budget through gnuplot",
     " kind near far format fov size at count spacing out ", NULL, depth_plot},
    {"all", "a report in Markdown: all of these for one camera, with tables, plots and the command that made each",
     " near far fov size out ", NULL, depth_report},
};

#define COMMAND_COUNT (sizeof commands / sizeof commands[0])

static int show(const struct depth_command *command, const struct depth_lab *lab, char *csv)
{
    if (lab->csv == NULL) {
        depth_table_print(stdout, csv, command->headings);
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
