/* pinhole-depth budget: which part of the pipeline limits what depth resolves. See depth_budget_terms.h. */
#include "complain.h"
#include "depth_budget_measure.h"
#include "depth_planes_count.h"
#include "depth_separation.h"
#include "lab_search.h"
#include "progress.h"

#include <math.h>
#include <stdlib.h>

#define ALL DEPTH_SHARES

/* Predicted and measured: each part, then all parts together. */
struct budget {
    double predicted_m[DEPTH_SHARES + 1], measured_m[DEPTH_SHARES + 1];
};

static void predict(const struct depth_lab *lab, const struct ph_depth_format *format, double z, struct budget *budget)
{
    for (int i = 0; i < DEPTH_SHARES; i++) {
        budget->predicted_m[i] = depth_share_m((enum depth_share)i, format, lab, z);
    }
}

/* All parts together: the bound, and planes whose farthest row is at z, at the tilt that needs most. */
static void sweep_tilts(struct planes_canvas *canvas, const struct ph_depth_format *format, double z,
                        struct budget *budget)
{
    static const double tilts[] = {0, 40, 75, 85};
    const struct depth_lab *const lab = canvas->lab;
    budget->predicted_m[ALL] = depth_separation_m(format, lab, z, 90, depth_way_px(lab));
    budget->measured_m[ALL] = 0;
    for (size_t i = 0; i < sizeof tilts / sizeof tilts[0]; i++) {
        const struct planes_sweep sweep = depth_planes_sweep(canvas, format, (struct planes_lean){z, tilts[i], NAN});
        budget->measured_m[ALL] = fmax(budget->measured_m[ALL], sweep.found_m);
    }
}

/* Measures S_eff at z of planes that face the camera, as `resolve` does. 0 or COMPLAINED. */
static int measure_store(const struct depth_lab *lab, const struct lab_format *format, fx_t z, double *out)
{
    struct work {
        struct lab_probe probe;
        struct lab_search search;
    } *const work = malloc(sizeof *work);
    if (work == NULL || lab_probe_open(&work->probe, format, lab->near_z, lab->far_z) != PH_OK) {
        free(work);
        return complain("budget: %s cannot be measured here", format->name);
    }
    lab_search_open(&work->search, &work->probe);
    *out = lab_search_at(&work->search, &work->probe, z) / 65536.0;
    free(work);
    return 0;
}

static void measure(struct planes_canvas *canvas, const struct ph_depth_format *format, double z, struct budget *budget)
{
    double *const measured = budget->measured_m;
    measured[DEPTH_SHARE_INPUT] = depth_budget_input_m(canvas, z);
    measured[DEPTH_SHARE_MATRIX] = depth_budget_matrix_m(canvas, z);
    measured[DEPTH_SHARE_DIVIDE] = depth_budget_divide_m(canvas, z);
    measured[DEPTH_SHARE_INTERPOLATION] = depth_budget_interpolation_m(canvas, z);
    measured[DEPTH_SHARE_SUBPIXEL] = depth_budget_subpixel_m(canvas, z);
    sweep_tilts(canvas, format, z, budget);
}

static int largest(const double parts[DEPTH_SHARES])
{
    int index = 0;
    for (int i = 1; i < DEPTH_SHARES; i++) {
        index = parts[i] > parts[index] ? i : index;
    }
    return index;
}

static void print_budget(const struct depth_lab *lab, const struct lab_format *format, double z,
                         const struct budget *budget)
{
    const int dominant = largest(budget->measured_m);
    for (int i = 0; i <= DEPTH_SHARES; i++) {
        char enough[LAB_TEXT_SIZE];
        snprintf(enough, sizeof enough, "%.10g", budget->predicted_m[i]);
        if (i == ALL) {
            depth_separation_text(budget->predicted_m[i], enough);
        }
        fprintf(lab->rows, "%s,%u,%.10g,%.10g,%.10g,%s,%s,", format->name, format->bits, depth_metres(lab->near_z),
                depth_metres(lab->far_z), z, i < ALL ? depth_share_names[i] : "all", enough);
        if (isfinite(budget->measured_m[i])) {
            fprintf(lab->rows, "%.10g,%s\n", budget->measured_m[i], i == dominant ? "dominates" : "");
        } else {
            fputs("none,\n", lab->rows);
        }
    }
}

static int budget_format(const struct depth_lab *lab, uint32_t row, const fx_t *at, uint32_t count)
{
    const struct lab_format *format = &lab_formats[row];
    struct planes_canvas canvas;
    struct budget budget;
    int status = depth_planes_open(&canvas, lab, format->format);
    for (uint32_t i = 0; i < count && status == 0; i++) {
        const double z = depth_metres(at[i]);
        status = measure_store(lab, format, at[i], &budget.measured_m[DEPTH_SHARE_STORE]);
        if (status == 0) {
            predict(lab, format->format, z, &budget);
            measure(&canvas, format->format, z, &budget);
            print_budget(lab, format, z, &budget);
        }
    }
    depth_planes_close(&canvas);
    return status;
}

/* The distances that are measured without --at: twice the near plane, every decade of it, and the far plane. */
static uint32_t default_distances(const struct depth_lab *lab, fx_t at[DEPTH_AT_MAX])
{
    uint32_t count = 0;
    for (int64_t z = 2 * (int64_t)lab->near_z; z < lab->far_z && count < DEPTH_AT_MAX - 1; z *= 10) {
        at[count++] = (fx_t)z;
    }
    at[count++] = lab->far_z;
    return count;
}

int depth_budget(const struct depth_lab *lab)
{
    fx_t distances[DEPTH_AT_MAX];
    const uint32_t count = lab->at_count > 0 ? lab->at_count : default_distances(lab, distances);
    const uint32_t rows = depth_drawn_formats(lab);
    if (rows == 0) {
        return complain_usage("--depth: budget draws with the renderer's own formats; --help lists them");
    }
    fputs("format,bits,near,far,z_m,part,predicted_m,measured_m,dominant\n", lab->rows);
    int status = 0;
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        depth_lab_progress("budget", rows, i);
        status = (rows >> i & 1) != 0 ? budget_format(&own, i, lab->at_count > 0 ? lab->at : distances, count) : 0;
    }
    progress_show("budget", 1, 1);
    return status;
}
