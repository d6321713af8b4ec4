/* pinhole-depth slopes: S_worst of planes by format, shading and tilt, over all azimuths. See depth_planes_count.h. */
#include "complain.h"
#include "depth_separation.h"
#include "depth_planes_count.h"
#include "progress.h"

#include <math.h>

static void put_row(const struct depth_lab *lab, const struct lab_format *format, struct planes_canvas *canvas,
                    struct planes_lean lean)
{
    const struct planes_sweep sweep = depth_planes_sweep(canvas, format->format, lean);
    char enough[LAB_TEXT_SIZE];
    depth_separation_text(sweep.bound_m, enough);
    fprintf(lab->rows, "%s,%u,%.10g,%.10g,%.10g,%s,%g,%s,", format->name, format->bits, depth_metres(lab->near_z),
            depth_metres(lab->far_z), lean.at_m, depth_shading_names[canvas->shading], lean.tilt_deg, enough);
    if (isfinite(sweep.found_m)) {
        fprintf(lab->rows, "%.10g,%.3f\n", sweep.found_m, sweep.bound_m / sweep.found_m);
    } else {
        fputs("none,none\n", lab->rows);
    }
}

static const double tilts[] = {0, 30, 60, 75, 85, 89};
#define TILTS (sizeof tilts / sizeof tilts[0])

/* Measures the rows of a format. *done: rows so far, of `total`. */
static int put_format(const struct depth_lab *lab, const struct lab_format *format, double at_m, uint32_t *done,
                      uint32_t total)
{
    struct planes_canvas canvas;
    const int status = depth_planes_open(&canvas, lab, format->format);
    for (unsigned shading = 0; shading < DEPTH_SHADINGS && status == 0; shading++) {
        canvas.shading = (uint8_t)shading;
        for (size_t i = 0; i < TILTS; i++) {
            progress_show("slopes", (*done)++, total);
            put_row(lab, format, &canvas, (struct planes_lean){at_m, tilts[i], NAN});
        }
    }
    depth_planes_close(&canvas);
    return status;
}

int depth_slopes(const struct depth_lab *lab)
{
    const uint32_t rows = depth_drawn_formats(lab);
    const double middle = (depth_metres(lab->near_z) + depth_metres(lab->far_z)) / 2;
    const uint32_t distances = lab->at_count > 0 ? lab->at_count : 1;
    uint32_t done = 0, total = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        total += (rows >> i & 1) * distances * DEPTH_SHADINGS * (uint32_t)TILTS;
    }
    int status =
        rows != 0 ? 0 : complain_usage("--depth: slopes draws with the renderer's own formats; --help lists them");
    fputs("format,bits,near,far,z_m,shading,tilt_deg,bound_m,measured_m,ratio\n", lab->rows);
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        for (uint32_t k = 0; (rows >> i & 1) != 0 && status == 0 && k < distances; k++) {
            status =
                put_format(&own, &lab_formats[i], lab->at_count > 0 ? depth_metres(lab->at[k]) : middle, &done, total);
        }
    }
    progress_show("slopes", 1, 1);
    return status;
}
