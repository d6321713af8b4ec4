/* See depth_plot_kinds.h. One function a plot writes its data and the gnuplot commands that draw it. */
#define _XOPEN_SOURCE 700 /* strtok_r */

#include "depth_plot_kinds.h"

#include "complain.h"
#include "depth_budget_terms.h"
#include "depth_plot_curves.h"
#include "lab_probe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define POINTS    400 /* at most DEPTH_AT_MAX: enough for the saw-tooth of float16 */
#define FEW       240 /* where a point takes longer */
#define BINS      24
#define CELLS_MAX 12

/* ---- styles ------------------------------------------------------------------------------------------- */

struct style {
    const char *colour;
    int mark;
};

static struct style style_of(const struct lab_format *format)
{
    /* The renderer's, in their order. */
    static const struct style drawn[] = {{"#e69f00", 5}, {"#0072b2", 7},  {"#d55e00", 4}, {"#009e73", 6},
                                         {"#cc79a7", 9}, {"#56b4e9", 11}, {"#000000", 13}};
    static const char *const widths[] = {"#332288", "#117733", "#999933", "#882255"}; /* 3 .. 6 bits of exponent */
    if (format->kind == LAB_DRAWN) {
        int number = 0;
        while (ph_depth_formats[number + 1] != format->format) {
            number++;
        }
        const struct style own = drawn[number % (int)(sizeof drawn / sizeof drawn[0])];
        return format->exponent != 0 ? (struct style){widths[format->exponent - 3], own.mark} : own;
    }
    static const struct style others[] = {
        [LAB_NDC_Q16] = {"#777777", 0}, [LAB_RECIP_Q16] = {"#b2182b", 0}, [LAB_CLIP_Q16] = {"#762a83", 0},
        [LAB_LINEAR] = {"#cc79a7", 0},  [LAB_OVER_W] = {"#8a6d3b", 0},    [LAB_LOG] = {"#000000", 0},
    };
    return others[format->kind];
}

/* Has another row of lab_formats the same name? Then the name alone is ambiguous. */
static bool has_twin(uint32_t row)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if (i != row && strcmp(lab_formats[i].name, lab_formats[row].name) == 0) {
            return true;
        }
    }
    return false;
}

/* Writes the style of a format's curve. Formats that the renderer does not have get dashes for 16 bits, dashes and dots
 * for 24. */
static void put_style(FILE *script, const struct lab_format *format, bool marks)
{
    const struct style style = style_of(format);
    if (format->kind == LAB_DRAWN && marks) {
        fprintf(script, "linespoints pt %d ps 0.6 pi 24 lw 2.2", style.mark);
    } else if (format->kind == LAB_DRAWN) {
        fputs("lines lw 2.4", script);
    } else {
        fputs(format->bits == 16 ? "lines lw 1.6 dt 2" : "lines lw 1.3 dt 4", script);
    }
    fprintf(script, " lc '%s' ", style.colour);
}

/* The names in the order of the tables, with a percentage each or NULL; the order of drawing does not matter. */
static void put_legend(const struct depth_lab *lab, FILE *script, bool marks, const double *percent)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if ((lab->formats >> i & 1) != 0) {
            fputs(", keyentry with ", script);
            put_style(script, &lab_formats[i], marks);
            fprintf(script, "title '%s", lab_formats[i].name);
            if (has_twin(i)) {
                fprintf(script, " %u bits", lab_formats[i].bits);
            }
            if (percent != NULL) {
                fprintf(script, ": %.3g %% of all", percent[i]);
            }
            fputc('\'', script);
        }
    }
    fputc('\n', script);
}

static void put_camera(const struct depth_lab *lab, FILE *script)
{
    fprintf(script, "near %.4g m, far %.4g m", depth_metres(lab->near_z), depth_metres(lab->far_z));
}

/* ---- resolve -------------------------------------------------------------------------------------------- */

/* Distances evenly spread over the logarithm, near and far plane among them. */
static void spread_distances(struct depth_lab *lab, int points)
{
    const double range = log((double)lab->far_z / lab->near_z);
    lab->at_count = 0;
    for (int i = 0; i < points; i++) {
        const double z = lab->near_z * exp(range * i / (points - 1));
        lab->at[lab->at_count++] = i == points - 1 ? lab->far_z : (fx_t)floor(z + 0.5);
    }
}

/* The cells of a line of CSV, cut in place. */
static int cut(char *line, char *cells[CELLS_MAX])
{
    char *rest = NULL;
    int count = 0;
    for (char *cell = strtok_r(line, ",", &rest); cell != NULL && count < CELLS_MAX;
         cell = strtok_r(NULL, ",", &rest)) {
        cells[count++] = cell;
    }
    return count;
}

static uint32_t find_row(const char *name, const char *bits)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if (strcmp(lab_formats[i].name, name) == 0 && lab_formats[i].bits == strtoul(bits, NULL, 10)) {
            return i;
        }
    }
    return lab_format_count;
}

/* The columns z, ideal, measured, ratio of resolve's rows as data blocks $r<row of lab_formats>. */
static void put_resolve(FILE *script, char *csv)
{
    char *rest = NULL;
    uint32_t open = lab_format_count;
    for (char *line = strtok_r(csv, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        char *cells[CELLS_MAX];
        if (cut(line, cells) < 8 || strtod(cells[4], NULL) <= 0) { /* the header, S_worst, remarks */
            continue;
        }
        const uint32_t row = find_row(cells[0], cells[1]);
        if (row != open) {
            fprintf(script, "%s$r%u << EOD\n", open != lab_format_count ? "EOD\n" : "", (unsigned)row);
        }
        open = row;
        fprintf(script, "%s %s %s %s\n", cells[4], cells[5], cells[6], cells[7]);
    }
    fputs(open != lab_format_count ? "EOD\n" : "", script);
}

/* Curves of column y over z; the renderer's formats are on top. */
static void put_resolve_curves(const struct depth_lab *lab, FILE *script, int y)
{
    for (uint32_t i = 0; i < 2 * lab_format_count; i++) {
        const uint32_t row = i % lab_format_count;
        const bool drawn = lab_formats[row].kind == LAB_DRAWN;
        if ((lab->formats >> row & 1) != 0 && drawn == (i >= lab_format_count)) {
            fprintf(script, ", $r%u using 1:%d with ", (unsigned)row, y);
            put_style(script, &lab_formats[row], true);
            fputs("notitle", script);
        }
    }
}

/* T. Ulrich's bands: a step above 1/1000 of the distance leads to z-fighting; below 1/1000000 is very good. */
static void put_bands(const struct depth_lab *lab, FILE *script)
{
    const double n = depth_metres(lab->near_z);
    fprintf(script,
            "set label 'ripe for z-fighting: more than 10^{-3} z' at %g,graph 0.94 left front tc '#8a5a00'\n"
            "set label 'very good: less than 10^{-6} z' at %g,graph 0.05 right front tc '#2f6b2f'\n"
            "set label 'one step of Q16.16' at %g,8e-6 left front tc '#666666'\n"
            "plot 1e-3 * x with filledcurves y1=1e6 fs solid lc '#fbeed5' notitle, "
            "1e-6 * x with filledcurves y1=1e-9 fs solid lc '#dff0df' notitle",
            n * 1.1, depth_metres(lab->far_z) * 0.9, n * 1.1);
}

static void put_resolve_upper(const struct depth_lab *lab, FILE *script)
{
    fprintf(script,
            "set multiplot\nset logscale xy\nset lmargin at screen 0.11\nset rmargin at screen 0.97\n"
            "set xrange [%g:%g]\nset tmargin at screen 0.95\nset bmargin at screen 0.45\nset yrange [1e-6:%g]\n"
            "set format y '10^{%%T}'\nset format x ''\nset ylabel 'separation [m]'\nset key off\nset grid front\n"
            "set title 'Smallest separation ordered right: measured, and ideal (thin dots); ",
            depth_metres(lab->near_z), depth_metres(lab->far_z), 3 * depth_metres(lab->far_z));
    put_camera(lab, script);
    fputs("'\n", script);
    put_bands(lab, script);
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if ((lab->formats >> i & 1) != 0 && lab_formats[i].kind == LAB_DRAWN) {
            fprintf(script, ", $r%u using 1:2 with lines lw 1 dt 3 lc '%s' notitle", (unsigned)i,
                    style_of(&lab_formats[i]).colour);
        }
    }
    put_resolve_curves(lab, script, 3);
    fputc('\n', script);
}

static void put_resolve_lower(const struct depth_lab *lab, FILE *script)
{
    fputs("unset label\nunset title\nset tmargin at screen 0.41\nset bmargin at screen 0.22\nset format x '%g'\n"
          "set xlabel 'distance z [m]'\nset ylabel 'measured / ideal'\nset yrange [0.5:1000]\n"
          "set key at screen 0.54,0.115 center top horizontal maxcols 4 width -1 samplen 3\nplot 1 lc '#444444' "
          "notitle",
          script);
    put_resolve_curves(lab, script, 4);
    put_legend(lab, script, true, NULL);
    fputs("unset multiplot\n", script);
}

/* Few curves can be read: without --depth those that the renderer draws, and some to compare with. */
static uint32_t formats_of(const struct depth_lab *lab, uint32_t others)
{
    return lab->format_set ? lab->formats : depth_drawn_formats(lab) | others;
}

static uint32_t row_of(const char *name, const char *bits)
{
    return (uint32_t)1 << find_row(name, bits);
}

static int draw_resolve(struct depth_lab *lab, FILE *script, int points)
{
    struct depth_lab spread = *lab;
    char *csv;
    if (lab->at_count == 0) {
        spread_distances(&spread, points);
    }
    const int status = depth_lab_capture(&spread, depth_resolve, &csv);
    if (status == 0) {
        put_resolve(script, csv);
        put_resolve_upper(lab, script);
        put_resolve_lower(lab, script);
    }
    free(csv);
    return status;
}

static int write_resolve(const struct depth_lab *lab, FILE *script)
{
    struct depth_lab own = *lab;
    own.formats = formats_of(lab, row_of("log", "16"));
    return draw_resolve(&own, script, POINTS);
}

/* What is done elsewhere in Q16.16, with 24 bits, beside two of the renderer's formats. */
static int write_others(const struct depth_lab *lab, FILE *script)
{
    struct depth_lab own = *lab;
    if (!lab->format_set) {
        own.formats = row_of("float16", "16") | row_of("fixed24", "24") | row_of("ndc-q16", "24") |
                      row_of("recip-q16", "24") | row_of("clip-q16", "24");
    }
    return draw_resolve(&own, script, FEW);
}

/* ---- adjacent pairs ---------------------------------------------------------------------------------------- */

struct bin {
    uint32_t pairs, equal, swapped;
};

/* Counts the pairs as `pairs` does, by distance: bins evenly spread over the logarithm. */
static void fill_bins(const struct depth_lab *lab, struct lab_probe *probe, struct bin bins[BINS])
{
    const double range = log((double)lab->far_z / lab->near_z);
    const uint64_t span = (uint64_t)(lab->far_z - lab->near_z);
    fx_t w = lab->near_z;
    uint32_t code = lab_code(probe, w);
    for (uint32_t i = 1; i <= lab->count; i++) {
        const int at = (int)(log((double)w / lab->near_z) / range * BINS);
        struct bin *const bin = &bins[at < BINS ? at : BINS - 1];
        w = lab->spacing == LAB_LINEAR_SPACED ? lab->near_z + (fx_t)(span * i / lab->count)
                                              : (fx_t)floor(lab->near_z * exp(range * i / lab->count) + 0.5);
        const uint32_t next = lab_code(probe, w);
        bin->pairs++;
        bin->equal += next == code;
        bin->swapped += next > code;
        code = next;
    }
}

static int put_pairs(const struct depth_lab *lab, FILE *script, uint32_t row, double *percent)
{
    struct lab_probe probe;
    struct bin bins[BINS] = {{0, 0, 0}};
    if (lab_probe_open(&probe, &lab_formats[row], lab->near_z, lab->far_z) != PH_OK) {
        return complain("plot: %s cannot be measured here", lab_formats[row].name);
    }
    fill_bins(lab, &probe, bins);
    const double ratio = (double)lab->far_z / lab->near_z;
    *percent = 0;
    fprintf(script, "$p%u << EOD\n", (unsigned)row);
    for (int i = 0; i < BINS; i++) {
        const double from = depth_metres(lab->near_z) * pow(ratio, (double)i / BINS);
        const double to = depth_metres(lab->near_z) * pow(ratio, (i + 1.0) / BINS);
        const double share = bins[i].pairs > 0 ? 100.0 * (bins[i].equal + bins[i].swapped) / bins[i].pairs : 0;
        fprintf(script, "%.6g %.6g\n%.6g %.6g\n", from, share, to, share);
        *percent += 100.0 * (bins[i].equal + bins[i].swapped) / lab->count;
    }
    fputs("EOD\n", script);
    return 0;
}

static int write_pairs(const struct depth_lab *all, FILE *script)
{
    struct depth_lab own = *all, *const lab = &own;
    double percent[32] = {0}; /* of each row of lab_formats */
    int status = 0;
    own.formats = formats_of(all, row_of("recip-q16", "24"));
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        status = (lab->formats >> i & 1) != 0 ? put_pairs(lab, script, i, &percent[i]) : 0;
    }
    fprintf(script, "set title '%u pairs of neighbours, %s spacing, that the codes do not order; ",
            (unsigned)lab->count, lab->spacing == LAB_LINEAR_SPACED ? "linear" : "log");
    put_camera(lab, script);
    fprintf(script,
            "'\nset logscale x\nset xrange [%g:%g]\nset yrange [-2:102]\nset xlabel 'distance z [m]'\n"
            "set ylabel 'equal or swapped [%% of the pairs there]'\n"
            "set bmargin at screen 0.32\nset lmargin at screen 0.09\nset rmargin at screen 0.97\n"
            "set key at screen 0.53,0.20 center top horizontal maxcols 4 width -1 samplen 3\nplot -5 notitle",
            depth_metres(lab->near_z), depth_metres(lab->far_z));
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if ((lab->formats >> i & 1) != 0) {
            fprintf(script, ", $p%u with ", (unsigned)i);
            put_style(script, &lab_formats[i], false);
            fputs("notitle", script);
        }
    }
    put_legend(lab, script, false, percent);
    return status;
}

/* ---- budget ---------------------------------------------------------------------------------------------- */

/* Writes z, predicted and measured of each part of each format as data blocks $b<row>_<part>. */
static void put_budget(FILE *script, const char *csv, uint32_t row, int part)
{
    const char *const name = part < DEPTH_SHARES ? depth_share_names[part] : "all";
    fprintf(script, "$b%u_%d << EOD\n", (unsigned)row, part);
    for (const char *line = csv; (line = strchr(line, '\n')) != NULL && line[1] != '\0';) {
        char text[200], *cells[CELLS_MAX];
        line++;
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        if (cut(text, cells) >= 8 && find_row(cells[0], cells[1]) == row && strcmp(cells[5], name) == 0) {
            fprintf(script, "%s %s %s\n", cells[4], cells[6], cells[7]);
        }
    }
    fputs("EOD\n", script);
}

static void put_budget_panel(FILE *script, uint32_t row, int panel, int panels)
{
    static const char *const colours[] = {"#999999", "#e69f00", "#56b4e9", "#d55e00", "#cc79a7", "#009e73", "#000000"};
    const int columns = panels > 1 ? 2 : 1, lines = (panels + columns - 1) / columns;
    const double left = 0.09 + 0.48 * (panel % columns), top = 0.93 - 0.86 * (panel / columns) / lines;
    const double width = columns == 1 ? 0.88 : 0.41, height = 0.86 / lines - 0.065;
    fprintf(script,
            "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n"
            "set title '%s' offset 0,-0.6\nset ylabel '%s'\nset xlabel '%s' offset 0,0.5\n%s\nplot 1e-30 notitle",
            left, left + width, top, top - height, lab_formats[row].name, panel % columns == 0 ? "separation [m]" : "",
            panel / columns == lines - 1 || panel + columns >= panels ? "distance z [m]" : "",
            panel > 0 ? "set key off"
            : panels % 2 == 1 && panels > 1
                ? "set key at screen 0.64,0.25 left top vertical"
                : "set key at screen 0.53,0.002 center bottom horizontal maxcols 4 samplen 3");
    for (int part = 0; part <= DEPTH_SHARES; part++) {
        const char *const name = part < DEPTH_SHARES ? depth_share_names[part] : "all together";
        fprintf(script,
                ", $b%u_%d using 1:3 with linespoints pt %d ps 0.6 lw %s lc '%s' title '%s'"
                ", $b%u_%d using 1:2 with lines dt 3 lw 1.2 lc '%s' notitle",
                (unsigned)row, part, part + 4, part == DEPTH_SHARES ? "2.6" : "1.6", colours[part], name, (unsigned)row,
                part, colours[part]);
    }
    fputc('\n', script);
}

static int count_bits(uint32_t bits)
{
    int count = 0;
    for (; bits != 0; bits &= bits - 1) {
        count++;
    }
    return count;
}

static void budget_distances(struct depth_lab *lab)
{
    enum { POINTS_OF_BUDGET = 8 };
    const double range = log((double)lab->far_z / lab->near_z);
    for (lab->at_count = 0; lab->at_count < POINTS_OF_BUDGET; lab->at_count++) {
        const double z = lab->near_z * exp(range * (lab->at_count + 1) / POINTS_OF_BUDGET);
        lab->at[lab->at_count] = lab->at_count == POINTS_OF_BUDGET - 1 ? lab->far_z : (fx_t)floor(z + 0.5);
    }
}

static int write_budget(const struct depth_lab *lab, FILE *script)
{
    struct depth_lab few = *lab;
    const uint32_t rows = depth_drawn_formats(lab);
    char *csv;
    int panel = 0;
    if (lab->at_count == 0) {
        budget_distances(&few);
    }
    const int status = depth_lab_capture(&few, depth_budget, &csv);
    if (status != 0) {
        free(csv);
        return status;
    }
    fprintf(script,
            "set multiplot\nset logscale xy\nset format y '10^{%%T}'\nset xrange [%g:%g]\nset yrange [1e-9:%g]\n",
            depth_metres(few.at[0]), depth_metres(few.at[few.at_count - 1]), depth_metres(lab->far_z) / 10);
    fputs("set label 'Each part alone, and all together: measured (marks), bound (dots)' at screen 0.53,0.98 "
          "center\n",
          script);
    for (uint32_t i = 0; i < lab_format_count; i++) {
        for (int part = 0; (rows >> i & 1) != 0 && part <= DEPTH_SHARES; part++) {
            put_budget(script, csv, i, part);
        }
        if ((rows >> i & 1) != 0) {
            put_budget_panel(script, i, panel++, count_bits(rows));
            fputs("unset label\n", script);
        }
    }
    fputs("unset multiplot\n", script);
    free(csv);
    return 0;
}

const struct depth_plot_kind depth_plot_kinds[] = {
    {"ndc", "z_ndc over z_c, as the source document draws it", 800, 480, depth_plot_ndc, depth_plot_ndc_rows},
    {"g", "g(z), as the source document draws it", 800, 480, depth_plot_g, depth_plot_g_rows},
    {"resolve", "Smallest separation over distance", 860, 800, write_resolve, NULL},
    {"others", "Smallest separation of what others do in Q16.16", 860, 800, write_others, NULL},
    {"pairs", "Adjacent pairs that are not ordered, over distance", 860, 560, write_pairs, NULL},
    {"budget", "What each part of the pipeline costs, over distance", 860, 980, write_budget, NULL},
};

const uint32_t depth_plot_kind_count = sizeof depth_plot_kinds / sizeof depth_plot_kinds[0];
