/*
 * advise: which near plane, format and bits separate two parallel planes, and what a near plane separates. What it
 * calls enough is the bound of depth_separation.h, and the near planes are solved for that. Beside it stands what was
 * found: the largest separation that the renderer needs on planes that face the camera and on planes that lean
 * (depth_planes_count.h). For a scene see depth_advise_scene.c.
 */
#include "complain.h"
#include "progress.h"
#include "depth_advise_scene.h"
#include "depth_budget_terms.h"
#include "depth_planes_count.h"
#include "depth_separation.h"
#include "lab_num.h"
#include "lab_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LSB        (1 / 65536.0)
#define TILT_DEG   60.0 /* without --tilt */
#define NEAR_LEAST 256  /* LSBs: before it a step of Q16.16 is more than 1/256 of the distance */

struct question {
    const struct depth_lab *lab;
    FILE *text; /* sentences, as remarks */
    fx_t z, separate;
    double tilt_deg;
    struct lab_probe probe;
    struct lab_search search;
};

/* The separation that a near plane gives at every distance up to z, in LSBs; 0: the renderer refuses this camera. */
struct reach {
    uint32_t bound, found;
};

#define NEVER UINT32_MAX /* no separation does */

/* The answer for one format; 0: there is no such near plane, or it was not asked for. */
struct answer {
    fx_t least, safe;
    struct reach separates;
};

/* Returns the smallest separation that is ordered right at z and one separation before and behind it: no scene has only
 * one distance. */
static uint32_t around(struct question *q, fx_t z)
{
    const uint32_t here = lab_search_at(&q->search, &q->probe, z);
    uint32_t most = here;
    for (int side = -1; side <= 1; side += 2) {
        const int64_t w = (int64_t)z + side * (int64_t)here;
        if (w >= q->probe.near_z && w <= q->probe.far_z) {
            const uint32_t beside = lab_search_at(&q->search, &q->probe, (fx_t)w);
            most = beside > most ? beside : most;
        }
    }
    return most;
}

/* N of depth.h over the near plane. */
static double head_of(int exponent)
{
    return 1 - ldexp(1, exponent > 4 ? exponent - 13 : -9);
}

static struct depth_lab lab_with(const struct question *q, const struct lab_format *format, fx_t near_z)
{
    struct depth_lab lab = *q->lab;
    lab.near_z = near_z;
    lab.exponent = format->exponent;
    return lab;
}

/* What is enough at every tilt up to that of the question, and for all of the rest. */
static uint32_t bound(const struct question *q, const struct lab_format *format, fx_t near_z)
{
    const struct depth_lab lab = lab_with(q, format, near_z);
    const double enough = depth_separation_m(format->format, &lab, q->z * LSB, fabs(q->tilt_deg), depth_way_px(&lab));
    return depth_separation_lsbs(enough);
}

/* What planes need that lean in all directions, the farthest row of which is at z; 0: they have no room. */
static uint32_t leaning(const struct question *q, const struct lab_format *format, fx_t near_z, fx_t z)
{
    const struct depth_lab lab = lab_with(q, format, near_z);
    struct planes_canvas canvas;
    double apart = HUGE_VAL;
    if (depth_planes_open(&canvas, &lab, format->format) == 0) {
        const struct planes_lean lean = {z * LSB, q->tilt_deg, NAN};
        apart = depth_planes_sweep(&canvas, format->format, lean).found_m;
    }
    depth_planes_close(&canvas);
    return isfinite(apart) ? depth_separation_lsbs(apart) : 0;
}

/* Measures. The step of a fixed format grows up to z, and that of linear-w is the same everywhere. The step of a float
 * grows inside each octave of its d = N/z - N/f, so the far end of each octave is measured, too. */
static struct reach reach_of(struct question *q, const struct lab_format *format, fx_t near_z)
{
    struct reach reach = {0, 0};
    const int exponent = lab_exponent(format, near_z, q->lab->far_z);
    fx_t worst = q->z;
    if (lab_probe_open(&q->probe, format, near_z, q->lab->far_z) != 0) {
        return reach;
    }
    lab_search_open(&q->search, &q->probe);
    reach.bound = bound(q, format, near_z);
    reach.found = around(q, q->z);
    const double head = near_z * head_of(exponent);
    for (int octave = 1; exponent != 0 && octave < 1 << exponent; octave++) {
        const double end = floor(head / (exp2(-octave) + head / q->lab->far_z));
        if (end > near_z && end < q->z) {
            const uint32_t there = around(q, (fx_t)end);
            worst = there > reach.found ? (fx_t)end : worst;
            reach.found = there > reach.found ? there : reach.found;
        }
    }
    for (int i = 0; q->tilt_deg != 0 && i < (worst != q->z ? 2 : 1); i++) {
        const uint32_t there = leaning(q, format, near_z, i == 0 ? q->z : worst);
        reach.found = there > reach.found ? there : reach.found;
    }
    return reach;
}

/* The smallest near plane, in metres, with which a float of so many bits of exponent has steps of at most s up to z.
 * The step is at most z (1 - z / f) 2^-mantissa for any n but in the lowest octave; it is largest at f / 2. */
static double solve_float(const struct lab_format *format, int exponent, double z, double s, double far_z)
{
    const double middle = fmin(z, far_z / 2);
    const int mantissa = format->bits - exponent;
    const double lowest = z * z / (head_of(exponent) * s * exp2(mantissa + (1 << exponent) - 1));
    return middle * (1 - middle / far_z) * exp2(-mantissa) > s ? INFINITY : lowest;
}

/* Returns the smallest near plane, in metres, whose step is at most s up to z by formula; INFINITY: there is none. */
static double solve(const struct lab_format *format, double z, double s, double far_z)
{
    double least = INFINITY;
    switch (format->format->coding) {
    case PH_DEPTH_IS_LINEAR:
        return fmax(far_z - s * 65536 * head_of(0), LSB);
    case PH_DEPTH_IS_FLOAT: /* the renderer takes the best, but for the sawtooth of a float */
        for (int exponent = 3; exponent <= 5; exponent++) {
            least = fmin(least, solve_float(format, format->exponent != 0 ? format->exponent : exponent, z, s, far_z));
        }
        return least;
    default: /* n f / (f - n), at most 8 n */
        least = z * z / (head_of(0) * s * exp2(format->bits));
        return fmax(least * far_z / (far_z + least), least / 8);
    }
}

/* What leaning planes leave for the depth step of a separation s, in LSBs: along the ray, less the sub-pixel grid. */
static double left_for_step(const struct question *q, fx_t s)
{
    const double angle = depth_radians(fabs(q->tilt_deg));
    const double moved = depth_subpixel_m(q->lab, DEPTH_SUBPIXEL_BITS, q->z * LSB) / (2 * sqrt(2)) * sin(angle) / LSB;
    return s <= moved ? 0 : fmin((s - moved) / cos(angle), s);
}

static bool separates(struct question *q, const struct lab_format *format, fx_t near_z, fx_t s)
{
    return lab_probe_open(&q->probe, format, near_z, q->lab->far_z) == 0 && bound(q, format, near_z) <= (uint32_t)s;
}

/* Returns the smallest near plane with which s is enough at every distance up to z; 0: none below z does. */
static fx_t least_near(struct question *q, const struct lab_format *format, fx_t s)
{
    const double step = left_for_step(q, s),
                 most = q->tilt_deg != 0 ? q->z / 2.0 : q->z; /* planes that lean need room */
    const double n = solve(format, (q->z + (double)s) * LSB, fmax(step - 1, 0.5) * LSB, q->lab->far_z * LSB);
    if (step == 0 || n * 65536 >= most || (q->tilt_deg != 0 && !separates(q, format, (fx_t)(most / 2), s))) {
        return 0;
    }
    double near_lsb = fmax(ceil(n * 65536), NEAR_LEAST);
    for (; near_lsb < most; near_lsb = floor(near_lsb * 1.01) + 1) { /* more, for what triangles are off */
        if (separates(q, format, (fx_t)near_lsb, s)) {
            return (fx_t)near_lsb;
        }
    }
    return 0;
}

static const char *metres(fx_t v, char text[LAB_TEXT_SIZE])
{
    lab_fx_text(v, text);
    return text;
}

static const char *metres_of(uint32_t lsbs, char text[LAB_TEXT_SIZE])
{
    lab_num_text(lab_num_scaled(lsbs, -16), text);
    return text;
}

static void put_row(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    const struct depth_lab *lab = q->lab;
    char far_text[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], s[LAB_TEXT_SIZE] = "", least[LAB_TEXT_SIZE] = "",
                                                    safe[LAB_TEXT_SIZE] = "", near_text[LAB_TEXT_SIZE] = "",
                                                    pair[2 * LAB_TEXT_SIZE] = ",";
    if (q->separate != 0) {
        lab_fx_text(q->separate, s);
        strcpy(least, "none");
        strcpy(safe, "none");
    }
    if (a->least != 0) {
        lab_fx_text(a->least, least);
    }
    if (a->safe != 0) {
        lab_fx_text(a->safe, safe);
    }
    if (a->separates.bound != 0 && a->separates.bound != NEVER) {
        char enough[LAB_TEXT_SIZE], found[LAB_TEXT_SIZE];
        lab_fx_text(lab->near_z, near_text);
        lab_length_text(a->separates.bound, enough);
        lab_length_text(a->separates.found, found);
        snprintf(pair, sizeof pair, "%s,%s", enough, found);
    }
    fprintf(lab->rows, "%s,%d,%s,%s,%s,%s,%s,%s,%s,%g\n", format->name, format->bits, metres(lab->far_z, far_text),
            metres(q->z, z), s, least, safe, near_text, pair, q->tilt_deg);
}

static void say_forward(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE];
    fprintf(q->text, "# To separate %s m at every distance up to %s m with %s (%d bits): ", metres(q->separate, s),
            metres(q->z, z), format->name, format->bits);
    if (a->least == 0) {
        fprintf(q->text, "no near plane does it.\n");
        return;
    }
    fprintf(q->text, "the near plane at %s m or more; ", metres(a->least, n));
    if (a->safe != 0) {
        fprintf(q->text, "at %s m or more half of that separation is enough, which leaves a margin.\n",
                metres(a->safe, n));
    } else {
        fprintf(q->text, "none leaves a margin: none separates half of that.\n");
    }
}

static void say_backward(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE];
    fprintf(q->text, "# With the near plane at %s m, %s (%d bits) ", metres(q->lab->near_z, n), format->name,
            format->bits);
    if (a->separates.bound == 0 || a->separates.bound == NEVER) {
        fprintf(q->text, a->separates.bound == 0 ? "cannot be drawn.\n" : "separates nothing up to there.\n");
        return;
    }
    fprintf(q->text, "separates %s m at every distance up to %s m", metres_of(a->separates.bound, s), metres(q->z, z));
    fprintf(q->text, "; what was found to be needed is %s m.\n", metres_of(a->separates.found, s));
}

/* Ranks a format by its cost: 24 bits take memory, linear-w takes a division a pixel. */
static int cost_of(const struct lab_format *format)
{
    return format->format->coding == PH_DEPTH_IS_LINEAR ? 2 : format->bits == 24;
}

/* Is a the better advice? A near plane that shows something wins, then a cheap format, then the smaller near plane. */
static bool better(const struct question *q, const struct lab_format *f, const struct answer *a,
                   const struct lab_format *g, const struct answer *b)
{
    const fx_t usable = q->z / 16;
    if (a->least == 0 || g == NULL) {
        return a->least != 0;
    }
    if ((a->least <= usable) != (b->least <= usable)) {
        return a->least <= usable;
    }
    return cost_of(f) != cost_of(g) ? cost_of(f) < cost_of(g) : a->least < b->least;
}

/* The answer, which stands before the table. */
static void conclude(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE], largest[LAB_TEXT_SIZE];
    metres(q->separate, s);
    metres(q->z, z);
    const double moved =
        depth_subpixel_m(q->lab, DEPTH_SUBPIXEL_BITS, q->z * LSB) / sqrt(2) * sin(depth_radians(fabs(q->tilt_deg)));
    if (format == NULL && moved > q->separate * LSB) {
        fprintf(q->text,
                "#! No format separates %s m up to %s m at a tilt of %g degrees: the sub-pixel grid of a picture %u "
                "lines high alone moves planes there by up to %.3g m. More lines or a narrower --fov help.\n",
                s, z, q->tilt_deg, (unsigned)q->lab->height, moved);
        return;
    }
    if (format == NULL) {
        fprintf(q->text,
                "#! No format separates %s m up to %s m at a tilt of %g degrees: make the separation larger, or bring "
                "far nearer.\n",
                s, z, q->tilt_deg);
        return;
    }
    fprintf(q->text,
            "#! Take %s (%d bits), and the largest near plane that the scene allows: from %s m on it is enough, ",
            format->name, format->bits, metres(a->least, n));
    if (a->safe == a->least) {
        fprintf(q->text, "with a margin, ");
    } else if (a->safe != 0) {
        fprintf(q->text, "from %s m on it leaves a margin, ", metres(a->safe, n));
    }
    fprintf(q->text, "beyond %s m it cuts the nearer of the two planes off.\n", metres(q->z - q->separate, largest));
}

/* The answer where no separation was asked for: what the renderer takes by itself. */
static void say_auto(struct question *q)
{
    const struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = q->lab->near_z, .far_z = q->lab->far_z};
    const struct ph_depth_format *const chosen = ph_depth_choose(&p);
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE];
    const struct lab_format *format = lab_formats;
    while (format->format != chosen) {
        format++;
    }
    const struct reach reach = reach_of(q, format, q->lab->near_z);
    if (reach.bound != 0 && reach.bound != NEVER) {
        fprintf(q->text,
                "#! With the near plane at %s m auto takes %s, which separates %s m up to %s m at any tilt up "
                "to %g degrees.\n",
                metres(q->lab->near_z, n), format->name, metres_of(reach.bound, s), metres(q->z, z), fabs(q->tilt_deg));
    }
}

static bool is_asked(const struct depth_lab *lab, uint32_t i)
{
    const struct lab_format *format = &lab_formats[i];
    return format->kind == LAB_DRAWN && (lab->formats >> i & 1) != 0 && (lab->bits == 0 || lab->bits == format->bits);
}

static int answer_all(struct question *q)
{
    const struct depth_lab *lab = q->lab;
    const struct lab_format *best = NULL;
    struct answer best_answer = {0, 0, {0, 0}};
    uint32_t asked = 0, formats = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        formats |= (uint32_t)is_asked(lab, i) << i;
    }
    for (uint32_t i = 0; i < lab_format_count; i++) {
        struct answer a = {0, 0, {0, 0}};
        const struct lab_format *format = &lab_formats[i];
        if ((formats >> i & 1) == 0) {
            continue;
        }
        depth_lab_progress("advise", formats, i);
        asked++;
        if (q->separate != 0) {
            a.least = least_near(q, format, q->separate);
            a.safe = a.least != 0 ? least_near(q, format, q->separate / 2) : 0;
            say_forward(q, format, &a);
            if (better(q, format, &a, best, &best_answer)) {
                best = format;
                best_answer = a;
            }
        }
        if (lab->near_set || q->separate == 0) {
            a.separates = reach_of(q, format, lab->near_z);
            say_backward(q, format, &a);
        }
        put_row(q, format, &a);
    }
    progress_show("advise", 1, 1);
    if (asked > 0) {
        fprintf(q->text,
                "# A decal in the plane of its surface shows with depth_bias_slope %d and depth_bias 2, in the float "
                "formats %d.\n",
                PH_DECAL_SLOPE, PH_DECAL_BIAS);
    }
    if (q->separate != 0 && asked > 0) {
        conclude(q, best, &best_answer);
    } else if (asked > 0) {
        say_auto(q);
    }
    return asked > 0 ? 0 : complain_usage("advise: none of these formats is drawn by the renderer; see --help");
}

int depth_advise(const struct depth_lab *lab)
{
    if (lab->demo != NULL || lab->model != NULL) {
        return depth_advise_scene(lab);
    }
    if (lab->at_count != 1) {
        return complain_usage("advise needs --at Z, one distance, and --separate S or --near N; or --model or --demo");
    }
    struct question *q = malloc(sizeof *q);
    if (q == NULL) {
        return complain("out of memory");
    }
    if (lab->separate >= lab->at[0]) {
        free(q);
        return complain_usage("--separate must be less than --at");
    }
    q->lab = lab;
    q->text = lab->rows;
    q->z = lab->at[0];
    q->separate = lab->separate;
    q->tilt_deg = lab->tilt_set ? depth_metres(lab->tilt_deg) : TILT_DEG;
    fputs("format,bits,far,z_m,separate_m,near_least_m,near_safe_m,near,separates_m,found_m,tilt_deg\n", lab->rows);
    const int status = answer_all(q);
    free(q);
    return status;
}
