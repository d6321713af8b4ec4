/* depth_pairs: `pinhole-depth pairs` and `resolve`, which measure the renderer's formats with lab.h. */
#include "complain.h"
#include "depth_ieee.h"
#include "depth_separation.h"
#include "lab_num.h"
#include "progress.h"

#include <stdlib.h>

/* Near and far as they are printed, so that 0.1 means 0.1 and not the nearest number of Q16.16. */
static int ieee_row(const struct depth_lab *lab, uint32_t format)
{
    struct depth_ieee_count found;
    char near_text[LAB_TEXT_SIZE], far_text[LAB_TEXT_SIZE];
    lab_fx_text(lab->near_z, near_text);
    lab_fx_text(lab->far_z, far_text);
    const double near_z = strtod(near_text, NULL), far_z = strtod(far_text, NULL);
    if (depth_ieee_pairs(format, near_z, far_z, lab->spacing, lab->count, &found) != 0) {
        return complain("out of memory; make --count smaller");
    }
    fprintf(lab->rows, "%s,%d,%s,%s,%s,%u,%u,%u,%.10g\n", depth_ieee_name(format), format < 6 ? 32 : 24, near_text,
            far_text, lab->spacing == LAB_LINEAR_SPACED ? "linear" : "log", (unsigned)lab->count, (unsigned)found.equal,
            (unsigned)found.swap, found.max_wrong);
    return 0;
}

/* The lab's text goes here; its first piece, the header, is left out after the first time. */
struct sink {
    FILE *file;
    bool skip;
};

static void put_text(void *context, const char *text)
{
    struct sink *sink = context;
    if (!sink->skip) {
        fputs(text, sink->file);
    }
    sink->skip = false;
}

static int measure_format(struct lab *mine, int (*run)(const struct lab *), uint32_t format)
{
    mine->formats = (uint32_t)1 << format;
    const int status = run(mine);
    return status == 0 ? 0
                       : complain("%s: the renderer refuses this camera (error %d)", lab_formats[format].name, status);
}

/* Runs a measurement of lab.h into lab->rows, format by format. */
static int measure(const struct depth_lab *lab, int (*run)(const struct lab *))
{
    const char *const what = run == lab_pairs ? "pairs" : "resolve";
    struct sink sink = {lab->rows, false};
    struct lab mine = {.near_z = lab->near_z,
                       .far_z = lab->far_z,
                       .count = lab->count,
                       .spacing = lab->spacing,
                       .at = lab->at_count > 0 ? lab->at : NULL,
                       .at_count = lab->at_count,
                       .put = put_text,
                       .context = &sink};
    mine.memory_bytes = lab_bytes(&mine);
    mine.memory = malloc(mine.memory_bytes);
    if (mine.memory == NULL) {
        return complain("out of memory; make --count smaller");
    }
    int status = run(&mine); /* of no format: the header */
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        depth_lab_progress(what, lab->formats, i);
        sink.skip = true;
        status = (lab->formats >> i & 1) != 0 ? measure_format(&mine, run, i) : 0;
    }
    progress_show(what, 1, 1);
    free(mine.memory);
    return status;
}

int depth_pairs(const struct depth_lab *lab)
{
    int status = measure(lab, lab_pairs);
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS && status == 0; i++) {
        if ((lab->host_formats >> i & 1) != 0) {
            status = ieee_row(lab, i);
        }
    }
    return status;
}

int depth_resolve(const struct depth_lab *lab)
{
    const int status = measure(lab, lab_resolve);
    const double z = depth_metres(lab->far_z);
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        if ((depth_drawn_formats(lab) >> i & 1) != 0) {
            const struct depth_lab own = depth_lab_of(lab, i);
            const struct ph_depth_format *const format = lab_formats[i].format;
            char facing[LAB_TEXT_SIZE], any[LAB_TEXT_SIZE];
            depth_separation_text(depth_separation_m(format, &own, z, 0, depth_way_px(&own)), facing);
            depth_separation_text(depth_separation_m(format, &own, z, 90, depth_way_px(&own)), any);
            fprintf(lab->rows,
                    "# %s (%u bits): enough at every distance are %s m for surfaces that face the camera, %s m at any "
                    "tilt (bounds; --fov %g, --size %ux%u).\n",
                    lab_formats[i].name, lab_formats[i].bits, facing, any, depth_metres(lab->fov_deg), lab->width,
                    lab->height);
        }
    }
    return status;
}
