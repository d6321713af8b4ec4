/*
 * advise: which near plane, format and bits separate two planes, and what a near plane separates. Solved from the
 * steps of the formats (see lab.h), then drawn: what is promised has been measured.
 */
#include "complain.h"
#include "depth_lab.h"
#include "lab_num.h"
#include "lab_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LSB (1 / 65536.0)

struct question {
    const struct depth_lab *lab;
    FILE *text; /* sentences, as remarks */
    fx_t z, separate;
    struct lab_probe probe;
    struct lab_search search;
};

/* What is known for one format; 0: no such near plane, or not asked. */
struct answer {
    fx_t least, safe;
    uint32_t separates; /* LSBs */
};

/*
 * The smallest separation that is ordered right from z on over its next plateaus, in LSBs: measured on the plateau of z
 * and its two neighbours, since a scene does not lie just on one. 0: the renderer refuses this camera.
 */
static uint32_t measured(struct question *q, const struct lab_format *format, fx_t near_z)
{
    if (lab_probe_open(&q->probe, format, near_z, q->lab->far_z) != 0) {
        return 0;
    }
    lab_search_open(&q->search, &q->probe);
    const uint32_t here = lab_search_at(&q->search, &q->probe, q->z);
    uint32_t most = here;
    for (int side = -1; side <= 1; side += 2) {
        const int64_t z = (int64_t)q->z + side * (int64_t)here;
        if (z >= near_z && z <= q->lab->far_z) {
            const uint32_t beside = lab_search_at(&q->search, &q->probe, (fx_t)z);
            most = beside > most ? beside : most;
        }
    }
    return most;
}

/* The smallest near plane whose step is at most s up to z by formula, in metres; INFINITY: none. */
static double solve(const struct lab_format *format, double z, double s, double far_z)
{
    const double head = 511 / 512.0, far_step = z * z / head,
                 middle = fmin(z, far_z / 2); /* d is N/z - N/f, N = n (1 - 2^-9) */
    const int mantissa = format->bits - 4;
    switch (format->format) {
    case PH_DEPTH_LINEAR_W:
        return fmax(far_z - s * 65536 * head, LSB);
    case PH_DEPTH_FLOAT16:
    case PH_DEPTH_FLOAT24:
        /* At most z (1 - z / f) 2^-mantissa whatever n is, which is most at f / 2, but for the lowest octave. */
        return middle * (1 - middle / far_z) * exp2(-mantissa) > s ? INFINITY : far_step / (s * exp2(mantissa + 15));
    default:
        return far_step / (s * exp2(format->bits));
    }
}

/* The smallest near plane that separates s at z, drawn; 0: none below z does. */
static fx_t least_near(struct question *q, const struct lab_format *format, fx_t s)
{
    const double n = solve(format, (q->z + (double)s) * LSB, fmax(s - 1, 0.5) * LSB, q->lab->far_z * LSB);
    if (n * 65536 >= q->z) {
        return 0;
    }
    double near_lsb = ceil(n * 65536);
    for (int tries = 0; tries < 200 && near_lsb < q->z; tries++) { /* the planes' own rounding: a little more */
        const uint32_t separates = measured(q, format, (fx_t)near_lsb);
        if (separates != 0 && separates <= (uint32_t)s) {
            return (fx_t)near_lsb;
        }
        near_lsb = floor(near_lsb * 1.01) + 1;
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
                                                    separates[LAB_TEXT_SIZE] = "";
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
    if (a->separates != 0) {
        lab_fx_text(lab->near_z, near_text);
        metres_of(a->separates, separates);
    }
    fprintf(lab->rows, "%s,%d,%s,%s,%s,%s,%s,%s,%s\n", format->name, format->bits, metres(lab->far_z, far_text),
            metres(q->z, z), s, least, safe, near_text, separates);
}

static void say_forward(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE];
    fprintf(q->text, "# To separate %s m at %s m with %s (%d bits): ", metres(q->separate, s), metres(q->z, z),
            format->name, format->bits);
    if (a->least == 0) {
        fprintf(q->text, "no near plane does it at every distance up to there.\n");
        return;
    }
    fprintf(q->text, "the near plane at %s m or more", metres(a->least, n));
    if (a->safe != 0) {
        fprintf(q->text, "; %s m is safe: it separates half of that", metres(a->safe, n));
    } else {
        fprintf(q->text, "; none separates half of that, for safety");
    }
    fprintf(q->text, ".\n");
}

static void say_backward(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE];
    fprintf(q->text, "# With the near plane at %s m, %s (%d bits) separates %s m at %s m.\n", metres(q->lab->near_z, n),
            format->name, format->bits, metres_of(a->separates, s), metres(q->z, z));
}

/* What a format costs: memory for 24 bits, a divide for each pixel of linear-w. */
static int cost_of(const struct lab_format *format)
{
    return format->format == PH_DEPTH_LINEAR_W ? 2 : format->bits == 24;
}

/* Whether a is the better advice: a near plane that shows something, a cheap format, then the smaller near plane. */
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

static void conclude(const struct question *q, const struct lab_format *format, const struct answer *a)
{
    char s[LAB_TEXT_SIZE], z[LAB_TEXT_SIZE], n[LAB_TEXT_SIZE], largest[LAB_TEXT_SIZE];
    metres(q->separate, s);
    metres(q->z, z);
    if (format == NULL) {
        fprintf(q->text, "# No format separates %s m up to %s m: make the separation larger, or bring far nearer.\n", s,
                z);
        return;
    }
    fprintf(
        q->text, "# Take %s (%d bits), and the largest near plane that the scene allows: safe from %s m on; %s m is ",
        format->name, format->bits, metres(a->safe != 0 ? a->safe : a->least, n), metres(q->z - q->separate, largest));
    fprintf(q->text, "the largest that cuts neither plane off.\n");
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
    struct answer best_answer = {0, 0, 0};
    uint32_t asked = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        struct answer a = {0, 0, 0};
        const struct lab_format *format = &lab_formats[i];
        if (!is_asked(lab, i)) {
            continue;
        }
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
            a.separates = measured(q, format, lab->near_z);
            say_backward(q, format, &a);
        }
        put_row(q, format, &a);
    }
    if (q->separate != 0 && asked > 0) {
        conclude(q, best, &best_answer);
    }
    return asked > 0 ? 0 : complain(EXIT_USAGE, "advise: none of these formats is drawn by the renderer; see --help");
}

int depth_advise(const struct depth_lab *lab)
{
    if (lab->at_count != 1) {
        return complain(EXIT_USAGE, "advise needs --at Z, one distance, and --separate S or --near N");
    }
    struct question *q = malloc(sizeof *q);
    if (q == NULL) {
        return complain(EXIT_FAILED, "out of memory");
    }
    if (lab->separate >= lab->at[0]) {
        free(q);
        return complain(EXIT_USAGE, "--separate must be less than --at");
    }
    q->lab = lab;
    q->text = lab->rows;
    q->z = lab->at[0];
    q->separate = lab->separate;
    fputs("format,bits,far,z_m,separate_m,near_least_m,near_safe_m,near,separates_m\n", lab->rows);
    const int status = answer_all(q);
    free(q);
    return status;
}
