/* See depth_advise_scene.h. For each format and near plane the pixels are counted that show another surface than
 * the nearest one. */
#include "depth_advise_scene.h"

#include "complain.h"
#include "depth_budget_terms.h"
#include "depth_layers.h"
#include "lab_num.h"
#include "progress.h"

#include <math.h>
#include <stdlib.h>

#define NEARS       2
#define FORMATS_MAX 32
#define PAIRS_MAX   256
#define PAIRS_SHOWN 8
#define STEPS       1.25 /* depth steps that two surfaces must be apart: a step, and what set-up rounds of it */

/* A format with a near plane, and what was counted. */
struct candidate {
    const struct lab_format *format;
    struct depth_lab lab;              /* with its near plane, the far plane of the scene, and its bits of exponent */
    uint64_t fights, wrong, surprises; /* surprises: wrong, though they should not fight */
};

/* Two surfaces, one before the other. */
struct pair {
    uint16_t front, behind;
    uint64_t pixels, fights[FORMATS_MAX]; /* fights: with the camera's own near plane, by row of lab_formats */
    double gap_m, z_m;                    /* the smallest gap, and where */
};

struct scene_report {
    const struct depth_lab *lab;
    struct depth_layers scene;
    struct candidate candidates[NEARS * FORMATS_MAX];
    uint32_t candidate_count;
    struct pair pairs[PAIRS_MAX];
    uint32_t pair_count;
    uint64_t pixels, overlaps, lost; /* pixels with a surface, with several, and that fight in every format */
};

static double step_m(const struct candidate *c, const struct scene_layer *at)
{
    const struct ph_depth_format *const format = c->format->format;
    return at->parallel ? depth_step_parallel_m(format, &c->lab, at->z_m) : depth_step_m(format, &c->lab, at->z_m);
}

/* What moves two surfaces in every format. */
static double moved_m(const struct scene_layer *a, const struct scene_layer *b)
{
    return (a->slope_m + b->slope_m) * (sqrt(2) / 512) + a->off_m + b->off_m;
}

static double need_m(const struct candidate *c, const struct scene_layer *a, const struct scene_layer *b)
{
    return STEPS * step_m(c, b) + moved_m(a, b);
}

/* What the depth biases of the materials set them apart: codes of 16 bits, or eighths of them. */
static double lift_m(const struct candidate *c, const struct scene_layer *a, const struct scene_layer *b)
{
    return step_m(c, b) * ldexp(a->bias - b->bias, c->format->bits - 16 - (c->lab.exponent != 0 ? 3 : 0));
}

static struct pair *pair_of(struct scene_report *r, uint16_t front, uint16_t behind)
{
    uint32_t i = 0;
    while (i < r->pair_count && (r->pairs[i].front != front || r->pairs[i].behind != behind)) {
        i++;
    }
    if (i == PAIRS_MAX) {
        return NULL;
    }
    if (i == r->pair_count) {
        r->pairs[r->pair_count++] = (struct pair){.front = front, .behind = behind, .gap_m = HUGE_VAL};
    }
    return &r->pairs[i];
}

/* Whether a format shows which of two surfaces is in front. Of one triangle that is drawn twice always the first one
 * shows. */
static bool differ(const struct scene_report *r, const struct scene_layer *a, const struct scene_layer *b)
{
    const bool same_place = a->z_m == b->z_m && a->slope_m == b->slope_m;
    return !same_place && (a->surface != b->surface || r->scene.surfaces[a->surface].look.shading != PH_SHADE_UNLIT);
}

/* Does the nearest surface fight with that layer? */
static bool fights_with(const struct scene_report *r, const struct candidate *c, const struct scene_pixel *pixel,
                        uint32_t i)
{
    const struct scene_layer *const front = &pixel->layers[0], *const behind = &pixel->layers[i];
    const double apart = behind->z_m - front->z_m + lift_m(c, front, behind);
    return differ(r, front, behind) && apart < need_m(c, front, behind);
}

static bool fights(const struct scene_report *r, const struct candidate *c, const struct scene_pixel *pixel)
{
    uint32_t i = 1;
    while (i < pixel->count && !fights_with(r, c, pixel, i)) {
        i++;
    }
    return i < pixel->count;
}

/* Counts a pixel for a candidate. */
static void count_fights(struct scene_report *r, struct candidate *c, const struct scene_pixel *pixel)
{
    c->fights += fights(r, c, pixel);
    for (uint32_t i = 1; i < pixel->count && c->lab.near_z == r->scene.lens.near_z; i++) {
        struct pair *const pair =
            fights_with(r, c, pixel, i) ? pair_of(r, pixel->layers[0].surface, pixel->layers[i].surface) : NULL;
        if (pair != NULL) {
            pair->fights[c->format - lab_formats]++;
        }
    }
}

static void count_pixel(struct scene_report *r, const struct scene_pixel *pixel)
{
    const struct scene_layer *const front = &pixel->layers[0];
    bool overlaps = false, lost = false;
    for (uint32_t i = 1; i < pixel->count; i++) {
        const struct scene_layer *const behind = &pixel->layers[i];
        const bool counts = differ(r, front, behind);
        struct pair *const pair = counts ? pair_of(r, front->surface, behind->surface) : NULL;
        const double gap = behind->z_m - front->z_m;
        if (pair != NULL) {
            pair->pixels++;
            pair->z_m = gap < pair->gap_m ? front->z_m : pair->z_m;
            pair->gap_m = fmin(gap, pair->gap_m);
        }
        overlaps |= counts;
        lost |= counts && gap < moved_m(front, behind);
    }
    r->pixels++;
    r->overlaps += overlaps;
    r->lost += lost;
}

/* Counts pixels that show another surface than the nearest, while the finest format tells them apart. */
static int count_wrong(struct scene_report *r, struct candidate *c)
{
    const int status = depth_layers_show(&r->scene, c->format, c->lab.near_z);
    if (status != 0) {
        return status;
    }
    for (uint32_t i = 0; i < (uint32_t)r->lab->width * r->lab->height; i++) {
        const struct scene_pixel *const pixel = &r->scene.layers[i];
        const uint32_t shown = r->scene.pixels[i];
        const bool wrong = pixel->count > 0 && shown != 0 && shown != pixel->layers[0].surface + 1u;
        c->wrong += wrong;
        c->surprises += wrong && !fights(r, c, pixel);
    }
    return 0;
}

/* The nearest surface of a frame; what lies at its pixels stays in the scene. */
static int look(struct scene_report *r, uint32_t frame, double *nearest)
{
    const uint32_t area = (uint32_t)r->lab->width * r->lab->height;
    const int status = depth_layers_find(&r->scene, frame);
    if (status != 0) {
        return status;
    }
    for (uint32_t i = 0; i < area; i++) {
        if (r->scene.layers[i].count > 0) {
            *nearest = fmin(*nearest, r->scene.layers[i].layers[0].z_m);
        }
    }
    return 0;
}

static int count_frame(struct scene_report *r, uint32_t frame)
{
    const uint32_t area = (uint32_t)r->lab->width * r->lab->height;
    double nearest = HUGE_VAL;
    int status = look(r, frame, &nearest);
    for (uint32_t i = 0; i < area && status == 0; i++) {
        const struct scene_pixel *const pixel = &r->scene.layers[i];
        if (pixel->count > 0) {
            count_pixel(r, pixel);
        }
        for (uint32_t k = 0; k < r->candidate_count && pixel->count > 1; k++) {
            count_fights(r, &r->candidates[k], pixel);
        }
    }
    for (uint32_t k = 0; k < r->candidate_count && status == 0; k++) {
        progress_show("formats", k, r->candidate_count);
        status = count_wrong(r, &r->candidates[k]);
    }
    progress_show("formats", 1, 1);
    return status;
}

/* The largest near plane that cuts nothing of what the frames show, to two digits; its own if there is no larger one.
 */
static fx_t largest_near(fx_t own, double nearest)
{
    if (!isfinite(nearest) || nearest < 0) {
        return own;
    }
    const double digit = pow(10, floor(log10(nearest * 0.99)) - 1);
    const fx_t near_z = (fx_t)floor(floor(nearest * 0.99 / digit) * digit * 65536 + 0.5);
    return near_z > own ? near_z : own;
}

/* A float's bits of exponent, which the renderer takes for the first lens of a frame; 0: the format is no float. */
static uint8_t exponent_of(const struct scene_report *r, const struct candidate *c)
{
    const int exponent = lab_exponent(c->format, c->lab.near_z, c->lab.far_z);
    const bool parallel = r->scene.draw_count > 0 && r->scene.draws[0].lens.kind == PH_ORTHOGRAPHIC;
    return (uint8_t)(exponent != 0 && c->format->exponent == 0 && parallel ? 3 : exponent);
}

static int choose_candidates(struct scene_report *r)
{
    double nearest = HUGE_VAL;
    for (uint32_t i = 0; i < r->lab->frames; i++) {
        const int status = look(r, r->lab->start + i, &nearest);
        if (status != 0) {
            return status;
        }
    }
    const fx_t own = r->scene.lens.near_z, nears[NEARS] = {own, largest_near(own, nearest)};
    for (int n = 0; n < NEARS && (n == 0 || nears[n] != nears[0]); n++) {
        for (uint32_t i = 0; i < lab_format_count; i++) {
            const struct lab_format *const format = &lab_formats[i];
            const bool asked = format->kind == LAB_DRAWN && (r->lab->formats >> i & 1) != 0 &&
                               (r->lab->bits == 0 || r->lab->bits == format->bits);
            if (asked) {
                struct candidate *const c = &r->candidates[r->candidate_count++];
                *c = (struct candidate){format, depth_lab_of(r->lab, i), 0, 0, 0};
                c->lab.near_z = nears[n];
                c->lab.far_z = r->scene.lens.far_z;
                c->lab.exponent = exponent_of(r, c);
            }
        }
    }
    return r->candidate_count > 0
               ? 0
               : complain_usage("advise: none of these formats is drawn by the renderer; see --help");
}

/* ---- the answer --------------------------------------------------------------------------------------------- */

static double percent(uint64_t part, uint64_t whole)
{
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0;
}

/* The cost of a format: memory first, then time. */
static int cost_of(const struct lab_format *format)
{
    const unsigned coding = format->format->coding;
    return coding == PH_DEPTH_IS_LINEAR ? 3 : format->bits == 24 ? 2 : coding == PH_DEPTH_IS_FLOAT;
}

/* The cheapest of those that are as good as the best but for a pixel in 10,000; of its near planes the camera's own. */
static const struct candidate *best_of(const struct scene_report *r)
{
    const struct candidate *best = NULL;
    uint64_t least = UINT64_MAX;
    for (uint32_t i = 0; i < r->candidate_count; i++) {
        least = r->candidates[i].fights < least ? r->candidates[i].fights : least;
    }
    for (uint32_t i = 0; i < r->candidate_count; i++) {
        const struct candidate *const c = &r->candidates[i];
        if (c->fights <= least + r->pixels / 10000 && (best == NULL || cost_of(c->format) < cost_of(best->format))) {
            best = c;
        }
    }
    return best;
}

static void put_answer(const struct scene_report *r)
{
    const struct candidate *const best = best_of(r);
    char near_text[LAB_TEXT_SIZE];
    lab_fx_text(best->lab.near_z, near_text);
    fprintf(r->lab->rows, "#! Take %s (%d bits) with the near plane at %s m: %llu of %llu pixels (%.3g %%) would fight",
            best->format->name, best->format->bits, near_text, (unsigned long long)best->fights,
            (unsigned long long)r->pixels, percent(best->fights, r->pixels));
    if (r->lost > 0) {
        fprintf(r->lab->rows, ", %llu of them in every format: %s more than they are apart",
                (unsigned long long)r->lost,
                r->scene.fisheye ? "the fisheye's flat pieces and the sub-pixel grid move them"
                                 : "the sub-pixel grid moves them");
    }
    fputs(".\n", r->lab->rows);
    if (depth_layers_file_scale(&r->scene) > 0) {
        fprintf(r->lab->rows, "# The model is drawn with a radius of 1 m: 1 m here is %.4g units of its file.\n",
                1 / depth_layers_file_scale(&r->scene));
    }
}

/* A gap, in the units of the model's file as well. */
static void put_gap(const struct scene_report *r, double gap_m)
{
    fprintf(r->lab->rows, "%.3g m", gap_m);
    if (depth_layers_file_scale(&r->scene) > 0) {
        fprintf(r->lab->rows, " (%.3g units of the file)", gap_m / depth_layers_file_scale(&r->scene));
    }
}

static void put_rows(const struct scene_report *r)
{
    char near_text[LAB_TEXT_SIZE], far_text[LAB_TEXT_SIZE];
    fputs("format,bits,exponent,near [m],far [m],pixels,overlapping,fight (predicted),fight % (predicted),wrong "
          "(measured),unforeseen (measured)\n",
          r->lab->rows);
    lab_fx_text(r->scene.lens.far_z, far_text);
    for (uint32_t i = 0; i < r->candidate_count; i++) {
        const struct candidate *const c = &r->candidates[i];
        lab_fx_text(c->lab.near_z, near_text);
        fprintf(r->lab->rows, "%s,%d,%d,%s,%s,%llu,%llu,%llu,%.4g,%llu,%llu\n", c->format->name, c->format->bits,
                c->lab.exponent, near_text, far_text, (unsigned long long)r->pixels, (unsigned long long)r->overlaps,
                (unsigned long long)c->fights, percent(c->fights, r->pixels), (unsigned long long)c->wrong,
                (unsigned long long)c->surprises);
    }
}

static int compare_pairs(const void *a, const void *b)
{
    const struct pair *const p = a, *const q = b;
    uint64_t left = 0, right = 0;
    for (int i = 0; i < FORMATS_MAX; i++) {
        left += p->fights[i];
        right += q->fights[i];
    }
    return left != right ? (left < right) - (left > right) : (p->pixels < q->pixels) - (p->pixels > q->pixels);
}

/* The pairs of surfaces that fight most, and who separates them. */
static void put_pairs(struct scene_report *r)
{
    char near_text[LAB_TEXT_SIZE];
    lab_fx_text(r->scene.lens.near_z, near_text);
    qsort(r->pairs, r->pair_count, sizeof r->pairs[0], compare_pairs);
    for (uint32_t i = 0; i < r->pair_count && i < PAIRS_SHOWN; i++) {
        const struct pair *const p = &r->pairs[i];
        const char *const front = r->scene.surfaces[p->front].colour, *const behind =
                                                                          r->scene.surfaces[p->behind].colour;
        fprintf(r->lab->rows, "# Surface %u (%s) before surface %u (%s): %llu pixels, ", p->front + 1u, front,
                p->behind + 1u, behind, (unsigned long long)p->pixels);
        put_gap(r, p->gap_m);
        fprintf(r->lab->rows, " apart or more, the least at %.4g m. With the near plane at %s m fight:", p->z_m,
                near_text);
        for (uint32_t k = 0; k < r->candidate_count && r->candidates[k].lab.near_z == r->scene.lens.near_z; k++) {
            const struct lab_format *const format = r->candidates[k].format;
            fprintf(r->lab->rows, "%s %s %.3g %%", k > 0 ? "," : "", format->name,
                    percent(p->fights[format - lab_formats], p->pixels));
        }
        fputs(".\n", r->lab->rows);
    }
}

int depth_advise_scene(const struct depth_lab *lab)
{
    struct scene_report *const r = calloc(1, sizeof *r);
    if (r == NULL) {
        return complain("out of memory");
    }
    r->lab = lab;
    int status = depth_layers_open(&r->scene, lab);
    if (status == 0) {
        status = choose_candidates(r);
    }
    for (uint32_t i = 0; i < lab->frames && status == 0; i++) {
        status = count_frame(r, lab->start + i);
    }
    if (status == 0) {
        put_rows(r);
        put_answer(r);
        put_pairs(r);
    }
    depth_layers_close(&r->scene);
    free(r);
    return status;
}
