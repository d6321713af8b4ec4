/* pinhole-depth planes: two parallel planes through the renderer. See depth_planes_scene.h and depth_planes_count.h. */
#include "depth_planes_count.h"

#include "complain.h"
#include "depth_separation.h"
#include "file_save.h"
#include "option_text.h"
#include "png_out.h"
#include "progress.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GAP_PX       4
#define TILT_DEFAULT 75.0
#define OCTAVES      17 /* of a distance in Q16.16: below 1/2 m, and 1/2 m .. 2^15 m */

static double at_default(const struct depth_lab *lab, uint32_t i)
{
    return lab->at_count > 0 ? depth_metres(lab->at[i]) : (depth_metres(lab->near_z) + depth_metres(lab->far_z)) / 2;
}

/* ---- the picture, and what it counts -------------------------------------------------------------------- */

struct band {
    uint32_t samples, wrong, codes;
    uint32_t predicted; /* codes */
    double nearest_m, farthest_m;
};

struct picture {
    struct ppm ppm;
    uint32_t column; /* where the next format's picture begins */
};

/* Paints the picture. Black: not counted, blue: right, orange: wrong. The colour-blind see them as three greys. */
static void paint(struct picture *picture, const struct depth_lab *lab, const uint8_t *verdicts)
{
    static const uint8_t colours[][3] = {
        [PLANES_UNCOUNTED] = {16, 16, 20}, [PLANES_RIGHT] = {0, 92, 146}, [PLANES_WRONG] = {245, 190, 60}};
    for (uint32_t y = 0; y < lab->height && picture->ppm.rgb != NULL; y++) {
        uint8_t *to = picture->ppm.rgb + ((size_t)y * picture->ppm.width + picture->column) * 3;
        for (uint32_t x = 0; x < lab->width; x++, to += 3) {
            memcpy(to, colours[verdicts[y * lab->width + x]], 3);
        }
    }
    picture->column += lab->width + GAP_PX;
}

static int compare_codes(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static uint32_t distinct(uint32_t *codes, uint32_t n)
{
    uint32_t count = n > 0;
    qsort(codes, n, sizeof *codes, compare_codes);
    for (uint32_t i = 1; i < n; i++) {
        count += codes[i] != codes[i - 1];
    }
    return count;
}

static int octave_of(double distance_m)
{
    const int octave = ilogb(distance_m) + 2;
    return octave < 0 ? 0 : octave >= OCTAVES ? OCTAVES - 1 : octave;
}

/* Counts one octave of distance, or all (-1), of the plane behind, which was drawn last and alone. codes: room for two
 * a pixel. */
static struct band count_band(const struct planes_canvas *canvas, const struct planes_quad *behind, int octave,
                              uint32_t *codes)
{
    const struct depth_lab *lab = canvas->lab;
    const struct ph_depth_format *const format = canvas->renderer.config.depth_format;
    const uint32_t area = (uint32_t)lab->width * lab->height;
    uint32_t *const predicted = codes + area;
    struct band band = {.nearest_m = HUGE_VAL};
    for (uint32_t i = 0; i < area; i++) {
        const double distance = depth_planes_distance_m(canvas, behind, i);
        if (canvas->verdicts[i] != PLANES_UNCOUNTED && (octave < 0 || octave_of(distance) == octave)) {
            predicted[band.samples] = (uint32_t)fmax(depth_code_at(format, lab, distance), 0);
            codes[band.samples++] = depth_planes_code(canvas, i);
            band.wrong += canvas->verdicts[i] == PLANES_WRONG;
            band.nearest_m = fmin(band.nearest_m, distance);
            band.farthest_m = fmax(band.farthest_m, distance);
        }
    }
    band.codes = distinct(codes, band.samples);
    band.predicted = distinct(predicted, band.samples);
    return band;
}

static int show_bands(struct planes_canvas *canvas, const struct lab_format *format, const struct planes_pair *pair)
{
    const struct depth_lab *lab = canvas->lab;
    uint32_t *const codes = malloc((size_t)lab->width * lab->height * 2 * sizeof *codes);
    if (codes == NULL) {
        return complain("planes: no memory for a picture of %ux%u", lab->width, lab->height);
    }
    depth_planes_draw(canvas, &pair->behind, NULL);
    for (int i = 0; i <= OCTAVES; i++) {
        const int octave = i < OCTAVES ? i : -1;
        const struct band band = count_band(canvas, &pair->behind, octave, codes);
        if (band.samples > 0) {
            fprintf(lab->rows, "# %-9s %-6s %10.4f %10.4f %9u %17u %17u %18u\n", format->name,
                    octave < 0 ? "all" : "one", band.nearest_m, band.farthest_m, (unsigned)band.samples,
                    (unsigned)band.wrong, (unsigned)band.codes, (unsigned)band.predicted);
        }
    }
    free(codes);
    return 0;
}

static int show_format(const struct depth_lab *lab, const struct lab_format *format, const struct planes_pair *pair,
                       struct picture *picture)
{
    struct planes_canvas canvas;
    int status = depth_planes_open(&canvas, lab, format->format);
    if (status == 0) {
        canvas.shading = lab->shading;
        depth_planes_turn(&canvas, depth_metres(lab->azimuth_deg));
        depth_planes_count(&canvas, pair, canvas.verdicts);
        paint(picture, lab, canvas.verdicts);
        status = show_bands(&canvas, format, pair);
    }
    depth_planes_close(&canvas);
    return status;
}

/* Half of the separation that the coarsest format needs: a coarse format then shows errors, and a fine one does not. */
static double half_too_small(const struct depth_lab *lab, double at, double tilt)
{
    const uint32_t rows = depth_drawn_formats(lab);
    double most = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        if ((rows >> i & 1) != 0) {
            most = fmax(most, depth_planes_predicted_m(&own, lab_formats[i].format, at, 0, tilt));
        }
    }
    return fmax(most / 2, 2.0 / 65536);
}

static int make_pair(const struct depth_lab *lab, struct planes_pair *pair)
{
    const double at = at_default(lab, 0), tilt = lab->tilt_set ? depth_metres(lab->tilt_deg) : TILT_DEFAULT;
    const double separation = lab->separation != 0 ? depth_metres(lab->separation) : half_too_small(lab, at, tilt);
    const struct planes_lean lean = {at, tilt, depth_metres(lab->azimuth_deg)};
    const struct planes_place place = depth_planes_whole(lab, lean, separation);
    if (!depth_planes_make(lab, &place, pair)) {
        return complain_usage("--at %g, --tilt %g, --separation %g: no such planes between --near and --far", at, tilt,
                              separation);
    }
    if (!depth_planes_front_is_nearer(pair)) {
        return complain_usage("--separation %g: rounds to nothing in Q16.16; take 0.00002 or more", separation);
    }
    fprintf(lab->rows, "# Two planes %.6g m apart, tilted by %g degrees, the one behind %g m away in the middle:\n",
            depth_planes_separation_m(pair), tilt, at);
    fputs("# format    octave   from [m]     to [m]   samples  wrong (measured)  codes (measured)  codes (predicted)\n",
          lab->rows);
    return 0;
}

static int save_png(const char *path, const struct ppm *picture)
{
    size_t length;
    uint8_t *const bytes = png_out_bytes(picture, &length);
    if (bytes == NULL) {
        return complain("planes: no memory for the error picture");
    }
    const int status = file_save_bytes(path, bytes, length);
    free(bytes);
    return status;
}

static int save_picture(const struct depth_lab *lab, struct picture *picture)
{
    if (lab->out == NULL) {
        return 0;
    }
    if (option_text_ends(lab->out, ".png")) {
        return save_png(lab->out, &picture->ppm);
    }
    const int status = ppm_save(lab->out, &picture->ppm);
    return status == 0 ? 0 : complain("--out %s: cannot be written: %s", lab->out, strerror(-status));
}

static int show_pictures(const struct depth_lab *lab)
{
    const uint32_t rows = depth_drawn_formats(lab);
    uint32_t pictures = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        pictures += rows >> i & 1;
    }
    struct planes_pair pair;
    struct picture picture = {.ppm = {pictures * (lab->width + GAP_PX) - GAP_PX, lab->height, NULL}};
    int status = make_pair(lab, &pair);
    if (status == 0 && lab->out != NULL) {
        picture.ppm.rgb = calloc((size_t)picture.ppm.width * picture.ppm.height, 3);
        if (picture.ppm.rgb == NULL) {
            return complain("planes: no memory for the error picture");
        }
    }
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        status = (rows >> i & 1) != 0 ? show_format(&own, &lab_formats[i], &pair, &picture) : 0;
    }
    if (status == 0) {
        status = save_picture(lab, &picture);
    }
    free(picture.ppm.rgb);
    return status;
}

/* ---- the sweep ------------------------------------------------------------------------------------------ */

static void sweep_row(const struct depth_lab *lab, const struct lab_format *format, struct planes_canvas *canvas,
                      struct planes_lean lean)
{
    const struct planes_sweep sweep = depth_planes_sweep(canvas, format->format, lean);
    char enough[LAB_TEXT_SIZE];
    depth_separation_text(sweep.bound_m, enough);
    fprintf(lab->rows, "%s,%u,%.10g,%.10g,%.10g,%g,%.4g,%.4g,%s,", format->name, format->bits,
            depth_metres(lab->near_z), depth_metres(lab->far_z), lean.at_m, lean.tilt_deg, sweep.s_min_m,
            sweep.at_tilt_m, enough);
    if (isfinite(sweep.found_m)) {
        fprintf(lab->rows, "%.10g,%.3f,", sweep.found_m, sweep.found_m / sweep.at_tilt_m);
    } else {
        fputs("none,none,", lab->rows);
    }
    fprintf(lab->rows, "%g,%s\n", lean.azimuth_deg, depth_shading_names[lab->shading]);
    if (!isfinite(sweep.found_m)) {
        fprintf(lab->rows,
                "# none: %s at %g m, tilted by %g degrees: no separation is right in every place, or the planes have "
                "no room (their corners lie within 16384 m)\n",
                format->name, lean.at_m, lean.tilt_deg);
    }
}

static int sweep_format(const struct depth_lab *lab, const struct lab_format *format)
{
    static const double tilts[] = {0, 15, 30, 45, 60, 75};
    const uint32_t tilt_count = lab->tilt_set ? 1 : sizeof tilts / sizeof tilts[0];
    struct planes_canvas canvas;
    const int status = depth_planes_open(&canvas, lab, format->format);
    for (uint32_t i = 0; status == 0 && (i < lab->at_count || i == 0); i++) {
        canvas.shading = lab->shading;
        for (uint32_t k = 0; k < tilt_count; k++) {
            const double tilt = lab->tilt_set ? depth_metres(lab->tilt_deg) : tilts[k];
            sweep_row(lab, format, &canvas,
                      (struct planes_lean){at_default(lab, i), tilt, depth_metres(lab->azimuth_deg)});
        }
    }
    depth_planes_close(&canvas);
    return status;
}

int depth_planes(const struct depth_lab *lab)
{
    if (lab->out != NULL && !option_text_ends(lab->out, ".ppm") && !option_text_ends(lab->out, ".png")) {
        return complain_usage("--out %s: the error picture is written as .ppm or .png", lab->out);
    }
    const uint32_t rows = depth_drawn_formats(lab);
    if (rows == 0) {
        return complain_usage("--depth: planes draws with the renderer's own formats; --help lists them");
    }
    fputs(
        "format,bits,near,far,z_m,tilt_deg,s_min_predicted_m,at_tilt_predicted_m,bound_m,measured_m,ratio,azimuth_deg,"
        "shading\n",
        lab->rows);
    int status = 0;
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        depth_lab_progress("planes", rows, i);
        status = (rows >> i & 1) != 0 ? sweep_format(&own, &lab_formats[i]) : 0;
    }
    progress_show("planes", 1, 1);
    return status != 0 ? status : show_pictures(lab);
}
