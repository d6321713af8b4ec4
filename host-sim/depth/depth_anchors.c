/*
 * anchors: the numbers that the depth lab is held against, computed again. Each says where it comes from:
 *   published   it stands in the publication that is named
 *   reproduced  it is what the published program or method gives; the publication itself has other digits, or none
 *   ours        a formula or a measurement of ours
 */
#include "complain.h"
#include "depth_ieee.h"
#include "depth_planes_count.h"
#include "lab_search.h"
#include "progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A run over all anchors: where the lines go, how many failed, and the memory of the searches. */
struct run {
    FILE *rows;
    uint32_t failed, done;
    struct lab_probe probe;
    struct lab_search search;
};

enum how {
    PREDICTED, /* from a formula */
    MEASURED,  /* on code that runs */
};

#define ANCHOR_COUNT 109 /* for the progress bar */

static const char faq[] = "published: OpenGL FAQ 12.050", blog[] = "published: outerra.blogspot.com 2009-08",
                  reversed_z[] = "published: Golubev 2020", jiao[] = "published: Lapidous and Jiao 1999",
                  article[] = "published: Reed 2015 at reedbeta.com",
                  program[] = "reproduced: Reed 2015 at gist Reedbeta/ae437a9acb5dc137eabf",
                  after_akeley[] = "ours: formula after Akeley and Su 2006 (doi 10.2312/EGGH/EGGH06/027-030)",
                  own[] = "ours";

enum verdict { FAILS, PASSES, SUM_ALONE };

static void put_verdict(struct run *run, const char *name, const char *source, const char *stated, double here,
                        enum how how, enum verdict verdict)
{
    static const char *const words[] = {"FAIL", "pass", "the sum alone"};
    fprintf(run->rows, "%s,%s,%s,%.9g,%s,%s\n", name, source, stated, here, how == PREDICTED ? "predicted" : "measured",
            words[verdict]);
    run->failed += verdict == FAILS;
    progress_show("anchors", ++run->done < ANCHOR_COUNT ? run->done : ANCHOR_COUNT - 1, ANCHOR_COUNT);
}

static void put(struct run *run, const char *name, const char *source, const char *stated, double here, enum how how,
                bool pass)
{
    put_verdict(run, name, source, stated, here, how, pass ? PASSES : FAILS);
}

/* One unit in the last digit that was published: "1.9e-6", "42", ".301". */
static double last_digit(const char *published)
{
    const char *point = strchr(published, '.'), *exponent = strchr(published, 'e');
    const size_t end = strcspn(published, "e");
    const double decimals = point == NULL ? 0 : (double)(published + end - point - 1);
    return pow(10, (exponent != NULL ? strtod(exponent + 1, NULL) : 0) - decimals);
}

/* Whether two numbers are equal when they are rounded or cut off to the digits that were published. */
static bool same_digits(const char *published, double here)
{
    const double value = strtod(published, NULL), unit = last_digit(published);
    return here > value - unit * 0.5000001 && here < value + unit;
}

static void to_the_digit(struct run *run, const char *name, const char *source, const char *stated, double here)
{
    put(run, name, source, stated, here, PREDICTED, same_digits(stated, here));
}

/* ---- OpenGL FAQ 12, Outerra, Golubev ---------------------------------------------------------------------- */

/* Distance that a code of s stands for: OpenGL FAQ, 12.050. */
static double faq_distance(double n, double f, double s, double code)
{
    return f * n / (f - code / s * (f - n));
}

static void opengl_faq(struct run *run)
{
    to_the_digit(run, "OpenGL FAQ 12: distance of code 1 (n .01 f 1000 s 65535)", faq, "0.01000015",
                 faq_distance(.01, 1000, 65535, 1));
    to_the_digit(run, "OpenGL FAQ 12: distance of code s - 1", faq, "395.90054", faq_distance(.01, 1000, 65535, 65534));
}

/* Step of log(C w + 1) / log(C far + 1) in 24 bits. */
static double outerra_step(double c, double w)
{
    return (1 + c * w) * log1p(c * 1e7) / c / 16777216;
}

static void outerra(struct run *run)
{
    static const char *const one[] = {"1.9e-6", "1.1e-5", "9.7e-5", "0.001", "0.01", "0.096", "0.96", "9.6"};
    static const char *const thousandth[] = {".0005", ".0005", ".0006", ".001", ".006", ".055", ".549", "5.49"};
    double w = 1;
    for (int i = 0; i < 8; i++) {
        char name[96];
        snprintf(name, sizeof name, "Outerra 2009: log depth step at %.0f m (C 1)", w);
        to_the_digit(run, name, blog, one[i], outerra_step(1, w));
        snprintf(name, sizeof name, "Outerra 2009: log depth step at %.0f m (C .001)", w);
        to_the_digit(run, name, blog, thousandth[i], outerra_step(.001, w));
        w *= 10;
    }
}

static const struct lab_format *find_format(const char *name, int bits)
{
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if (strcmp(lab_formats[i].name, name) == 0 && lab_formats[i].bits == bits) {
            return &lab_formats[i];
        }
    }
    return NULL;
}

/* Opens a probe of a format. False: there is no such format, or the renderer refuses it. */
static bool open_probe(struct run *run, const char *name, int bits, double n, double f)
{
    const struct lab_format *format = find_format(name, bits);
    return format != NULL && lab_probe_open(&run->probe, format, (fx_t)lround(n * 65536), (fx_t)lround(f * 65536)) == 0;
}

static void golubev(struct run *run)
{
    const double n = .1, f = 1e4, share = (1 / n - 1) / (1 / n - 1 / f);
    put(run, "Golubev 2020: share of the codes below 1 m (n .1 f 1e4 24 bits)", reversed_z, "over 0.9", share,
        PREDICTED, share > .9);
    double drawn = 0;
    if (open_probe(run, "fixed24", 24, n, f)) {
        const double near_code = lab_code(&run->probe, run->probe.near_z);
        const double far_code = lab_code(&run->probe, run->probe.far_z);
        drawn = (near_code - lab_code(&run->probe, FX_ONE)) / (near_code - far_code);
    }
    put(run, "Golubev 2020: the same of fixed24 as it is drawn", own, "over 0.9", drawn, MEASURED, drawn > .9);
}

/* ---- Lapidous & Jiao, Akeley & Su ------------------------------------------------------------------------- */

/* Mean step over all distances, of complementary z in an unsigned float of 16 bits whose exponent has just the bits
 * that far / near needs, over the step of linear w. */
static double complementary_over_linear(double ratio)
{
    const int octaves = (int)ceil(log2(ratio)) + 1, exponent = (int)ceil(log2(octaves)), mantissa = 16 - exponent;
    const int samples = 100000, lowest = (1 << exponent) - 2;
    double sum = 0;
    for (int i = 0; i < samples; i++) {
        const double z = 1 + (ratio - 1) * (i + .5) / samples, d = (1 / z - 1 / ratio) / (1 - 1 / ratio);
        const double octave = fmin(floor(-log2(d)), lowest);
        sum += exp2(-(mantissa + 1 + octave)) * z * z * (1 - 1 / ratio);
    }
    return sum / samples / ((ratio - 1) / 65536);
}

static void lapidous(struct run *run)
{
    static const int ratios[] = {100, 500, 1000, 5000};
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += complementary_over_linear(ratios[i]);
    }
    put(run, "Lapidous & Jiao 1999: mean error of complementary z over w-buffer (far/near 100 500 1000 5000)", jiao,
        "about 2", sum / 4, PREDICTED, sum / 4 > 1.5 && sum / 4 < 2.5);
}

/* fixed24 as it is drawn with 8 sub-pixel bits: the planes of `planes`, whose farthest row is at z. */
static void akeley_drawn(struct run *run, double tilt_deg, double s_z)
{
    const struct depth_lab lab = {
        .near_z = FX_HALF, .far_z = FX_INT(100), .fov_deg = FX_INT(60), .width = 240, .height = 240};
    struct planes_canvas canvas;
    char name[96], text[16];
    if (depth_planes_open(&canvas, &lab, PH_DEPTH_FIXED24) != 0) {
        run->failed++;
        return;
    }
    const struct planes_lean lean = {100, tilt_deg, 0};
    const struct planes_sweep sweep = depth_planes_sweep(&canvas, PH_DEPTH_FIXED24, lean);
    depth_planes_close(&canvas);
    snprintf(name, sizeof name, "Akeley & Su 2006: the same of fixed24 as it is drawn (planes at %g degrees)",
             tilt_deg);
    snprintf(text, sizeof text, "%.2g", sweep.bound_m * 1000);
    put(run, name, own, text, sweep.measured_m * 1000, MEASURED,
        sweep.measured_m <= sweep.bound_m && sweep.measured_m > s_z / 2);
}

/* The setting of their paper: window coordinates of a few sub-pixel bits, a field of view, a depth step. Their numbers
 * stand in no source that we can cite; these are their relation with our camera, and what our renderer measures. */
static void akeley(struct run *run)
{
    static const struct {
        int bits;
        const char *stated;
    } columns[] = {{0, "680"}, {2, "170"}, {4, "42"}, {8, "2.9"}, {12, "1.2"}};
    const double n = .5, f = 100, z = 100, pixel = 2 * tan(acos(-1.0) / 6) / 240;
    const double s_z = z * z * (f - n) / (f * n * 16777215);
    to_the_digit(run, "Akeley & Su 2006: S_min of 24-bit z alone in mm (n .5 f 100 z 100)", after_akeley, "1.2",
                 s_z * 1000);
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++) {
        const double s_xy = ldexp(sqrt(2) * pixel * z, -columns[i].bits);
        char name[96];
        snprintf(name, sizeof name, "Akeley & Su 2006: with %d sub-pixel bits in mm (240 px fov 60)", columns[i].bits);
        to_the_digit(run, name, after_akeley, columns[i].stated, sqrt(s_xy * s_xy + s_z * s_z) * 1000);
    }
    akeley_drawn(run, 0, s_z);
    akeley_drawn(run, 45, s_z);
}

/* ---- Reed --------------------------------------------------------------------------------------------------- */

static uint32_t ieee_format(const char *name)
{
    uint32_t format = 0;
    while (strcmp(depth_ieee_name(format), name) != 0) {
        format++;
    }
    return format;
}

static void reed(struct run *run)
{
    static const struct {
        const char *name;
        uint32_t equal, swap;
    } published[] = {
        {"ieee32-standard", 7720, 1}, {"ieee32-infinite", 7575, 1},       {"ieee32-reversed", 0, 0},
        {"int24-standard", 7720, 1},  {"int24-infinite", 7575, 1},        {"int24-reversed", 7577, 0},
        {"ieee32-gl", 7734, 0},       {"ieee32-infinite-reversed", 0, 0}, {"int24-infinite-reversed", 7578, 0},
        {"int24-gl", 7734, 0},        {"ieee32-gl-infinite", 7663, 0},    {"int24-gl-infinite", 7663, 0}};
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        const uint32_t format = ieee_format(published[i].name);
        struct depth_ieee_count found = {0, 0, 0};
        depth_ieee_pairs(format, .1, 10000, LAB_LINEAR_SPACED, 10000, &found);
        char name[96], text[16];
        snprintf(name, sizeof name, "Reed: %s: equal (n .1 f 1e4 10000 pairs)", published[i].name);
        snprintf(text, sizeof text, "%u", (unsigned)published[i].equal);
        put(run, name, program, text, found.equal, MEASURED, found.equal == published[i].equal);
        snprintf(name, sizeof name, "Reed: %s: swapped", published[i].name);
        snprintf(text, sizeof text, "%u", (unsigned)published[i].swap);
        put(run, name, program, text, found.swap, MEASURED, found.swap == published[i].swap);
    }
}

/*
 * The percentages of the article, equal and swapped, with view and projection in one matrix and one after the other.
 * With one matrix, how many of the wrong pairs are equal and how many are swapped depends on the order of the float32
 * sums, which the article does not tell. Where only the sum of both agrees, to 5 of 100, the verdict says so.
 */
static void reed_article(struct run *run)
{
    static const struct {
        const char *name;
        int composed[2], separate[2];
    } article_rows[] = {
        {"standard", {45, 18}, {77, 0}},       {"infinite", {45, 18}, {76, 0}}, {"reversed", {0, 0}, {0, 0}},
        {"infinite-reversed", {0, 0}, {0, 0}}, {"gl", {56, 12}, {77, 0}},       {"gl-infinite", {59, 10}, {77, 0}},
    };
    for (size_t i = 0; i < 4 * (sizeof article_rows / sizeof article_rows[0]); i++) {
        const bool composed = i & 1, whole = i & 2, reversed = strstr(article_rows[i / 4].name, "reversed") != NULL;
        static const int reversed_int24[2] = {76, 0};
        const int *stated = composed ? article_rows[i / 4].composed : article_rows[i / 4].separate;
        char format[40], name[160], text[32];
        struct depth_ieee_count found;
        stated = reversed && whole ? reversed_int24 : stated;
        snprintf(format, sizeof format, "%s-%s", whole ? "int24" : "ieee32", article_rows[i / 4].name);
        depth_ieee_view_pairs(ieee_format(format), .1, 10000, 10000, composed, &found);
        const double here = (found.equal + found.swap) / 100.0;
        snprintf(name, sizeof name, "Reed: %s %s: %.0f + %.0f %% equal + swapped (n .1 f 1e4)", format,
                 composed ? "view and projection in one" : "view then projection", found.equal / 100.0,
                 found.swap / 100.0);
        snprintf(text, sizeof text, "%d + %d", stated[0], stated[1]);
        const bool both = fabs(found.equal / 100.0 - stated[0]) <= 1.5 && fabs(found.swap / 100.0 - stated[1]) <= 1.5;
        const bool sum = fabs(here - stated[0] - stated[1]) <= 5;
        put_verdict(run, name, article, text, here, MEASURED, both ? PASSES : sum ? SUM_ALONE : FAILS);
    }
}

/* ---- what Q16.16 reaches -------------------------------------------------------------------------------------- */

/* Rows of the table in metres, each for n .1 f 1000 and n .5 f 100 with 16 bits, n .1 f 1000 and n 1 f 1000 with 24. */
static const struct reach {
    const char *name[2]; /* with 16, with 24 bits */
    const char *stated[4];
    bool ours; /* what the renderer stores */
} table[] = {
    {{"ndc-q16", "ndc-q16"}, {"181", ".301", "117", "14.8"}, false},
    {{"recip-q16", "recip-q16"}, {"988", "23.3", "988", "931"}, false},
    {{"clip-q16", "clip-q16"}, {"126", ".304", "64", "6.1"}, false},
    {{"fixed16", "fixed24"}, {"126", ".303", ".596", ".060"}, true},
    {{"linear-w", "linear-w"}, {".0153", ".0015", "6e-5", "6e-5"}, true},
    {{"over-w", "over-w"}, {".19", ".019", "7e-4", "9e-4"}, false},
    {{"float16", "float24"}, {".074", ".0058", "3e-4", "2.4e-4"}, true},
    {{"log", "log"}, {".14", ".0081", "5e-4", "4e-4"}, false},
};

/* Ours: at most 5 % worse. Others: within 5 %, or the same digits. */
static bool reaches(const struct reach *row, int column, double here)
{
    const char *stated = row->stated[column];
    const double value = strtod(stated, NULL);
    if (row->ours) {
        return here > 0 && here <= value * 1.05;
    }
    return (here >= value * .95 && here <= value * 1.05) || same_digits(stated, here);
}

/* The worst step over the whole range, in metres. */
static double worst(struct run *run)
{
    lab_search_open(&run->search, &run->probe);
    return lab_search_worst(&run->search, &run->probe) / 65536.0;
}

static void reached(struct run *run)
{
    static const double planes[4][2] = {{.1, 1000}, {.5, 100}, {.1, 1000}, {1, 1000}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        for (int column = 0; column < 4; column++) {
            const double n = planes[column][0], f = planes[column][1];
            double here = 0;
            char name[96];
            if (open_probe(run, table[i].name[column / 2], column / 2 == 0 ? 16 : 24, n, f)) {
                here = worst(run);
            }
            snprintf(name, sizeof name, "Q16.16 reaches: S_worst in m of %s (%d bits n %g f %g)",
                     table[i].name[column / 2], column / 2 == 0 ? 16 : 24, n, f);
            put(run, name, own, table[i].stated[column], here, MEASURED, reaches(&table[i], column, here));
        }
    }
}

int depth_anchors(const struct depth_lab *lab)
{
    struct run *run = malloc(sizeof *run);
    if (run == NULL) {
        return complain("out of memory");
    }
    run->rows = lab->rows;
    run->failed = run->done = 0;
    fputs("anchor,source,stated,here,how,verdict\n", lab->rows);
    opengl_faq(run);
    outerra(run);
    golubev(run);
    lapidous(run);
    akeley(run);
    reed(run);
    reed_article(run);
    reached(run);
    progress_show("anchors", 1, 1);
    const uint32_t failed = run->failed;
    free(run);
    return failed == 0 ? 0 : complain("%u anchors are not met: see FAIL", (unsigned)failed);
}
