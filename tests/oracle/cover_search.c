/* The cover by straight cuts, then annealing: see cover_search.h. */
#include "cover_search.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define RECTS_MAX (COVER_SIDE_MAX * COVER_SIDE_MAX)

struct rect {
    int x0, x1, y0, y1; /* x1, y1: one past the end */
};

struct search {
    const uint8_t *changed;
    int width, height;
    struct cover_costs costs;
    uint32_t *best; /* of every rectangle */
    uint32_t sums[(COVER_SIDE_MAX + 1) * (COVER_SIDE_MAX + 1)];
    struct rect rects[RECTS_MAX], trial[RECTS_MAX + 2], sorted[RECTS_MAX];
    int count, trial_count;
    uint32_t random;
};

static uint32_t draw(struct search *s, uint32_t below)
{
    s->random = s->random * 1664525U + 1013904223U;
    return (uint32_t)((uint64_t)s->random * below >> 32);
}

/* ---- every cover by straight cuts ----------------------------------------------------------------- */

static uint32_t *best_of(const struct search *s, int x0, int x1, int y0, int y1)
{
    const size_t w = (size_t)s->width + 1, h = (size_t)s->height + 1;
    return &s->best[(((size_t)x0 * w + (size_t)x1) * h + (size_t)y0) * h + (size_t)y1];
}

static uint32_t changed_in(const struct search *s, int x0, int x1, int y0, int y1)
{
    const uint32_t *sums = s->sums;
    const int w = s->width + 1;
    return sums[y1 * w + x1] - sums[y0 * w + x1] - sums[y1 * w + x0] + sums[y0 * w + x0];
}

static void sum_up(struct search *s)
{
    const int w = s->width + 1;
    for (int y = 0; y < s->height; y++) {
        for (int x = 0; x < s->width; x++) {
            s->sums[(y + 1) * w + x + 1] = s->sums[y * w + x + 1] + s->sums[(y + 1) * w + x] - s->sums[y * w + x] +
                                           (s->changed[y * s->width + x] != 0);
        }
    }
}

static uint32_t cheapest(const struct search *s, int x0, int x1, int y0, int y1)
{
    if (changed_in(s, x0, x1, y0, y1) == 0) {
        return 0;
    }
    uint32_t best = 2 * s->costs.border + s->costs.start + s->costs.pixel * (uint32_t)((x1 - x0) * (y1 - y0));
    for (int x = x0 + 1; x < x1; x++) {
        const uint32_t cost = *best_of(s, x0, x, y0, y1) + *best_of(s, x, x1, y0, y1);
        best = cost < best ? cost : best;
    }
    for (int y = y0 + 1; y < y1; y++) {
        const uint32_t cost = *best_of(s, x0, x1, y0, y) + *best_of(s, x0, x1, y, y1);
        best = cost < best ? cost : best;
    }
    return best;
}

static void fill_best(struct search *s)
{
    for (int w = 1; w <= s->width; w++) {
        for (int h = 1; h <= s->height; h++) {
            for (int x = 0; x + w <= s->width; x++) {
                for (int y = 0; y + h <= s->height; y++) {
                    *best_of(s, x, x + w, y, y + h) = cheapest(s, x, x + w, y, y + h);
                }
            }
        }
    }
}

/* Where the best cover cuts this rectangle; false: it does not. */
static bool find_cut(const struct search *s, const struct rect *r, struct rect part[2])
{
    const uint32_t best = *best_of(s, r->x0, r->x1, r->y0, r->y1);
    for (int x = r->x0 + 1; x < r->x1; x++) {
        if (*best_of(s, r->x0, x, r->y0, r->y1) + *best_of(s, x, r->x1, r->y0, r->y1) == best) {
            part[0] = (struct rect){r->x0, x, r->y0, r->y1};
            part[1] = (struct rect){x, r->x1, r->y0, r->y1};
            return true;
        }
    }
    for (int y = r->y0 + 1; y < r->y1; y++) {
        if (*best_of(s, r->x0, r->x1, r->y0, y) + *best_of(s, r->x0, r->x1, y, r->y1) == best) {
            part[0] = (struct rect){r->x0, r->x1, r->y0, y};
            part[1] = (struct rect){r->x0, r->x1, y, r->y1};
            return true;
        }
    }
    return false;
}

/* The rectangles of the best cover; `trial` is a stack of those that are still to be cut. */
static void trace(struct search *s)
{
    const struct cover_costs *c = &s->costs;
    s->trial[0] = (struct rect){0, s->width, 0, s->height};
    for (int open = 1; open > 0;) {
        const struct rect r = s->trial[--open];
        const uint32_t best = *best_of(s, r.x0, r.x1, r.y0, r.y1);
        const uint32_t whole = 2 * c->border + c->start + c->pixel * (uint32_t)((r.x1 - r.x0) * (r.y1 - r.y0));
        if (best != 0 && best < whole && find_cut(s, &r, &s->trial[open])) {
            open += 2;
        } else if (best != 0) {
            s->rects[s->count++] = r;
        }
    }
}

/* ---- annealing ------------------------------------------------------------------------------------ */

static int by_lines(const void *a, const void *b)
{
    const struct rect *p = a, *q = b;
    const int d[4] = {p->y0 - q->y0, p->y1 - q->y1, p->x0 - q->x0, p->x1 - q->x1};
    return d[0] != 0 ? d[0] : d[1] != 0 ? d[1] : d[2] != 0 ? d[2] : d[3];
}

static int by_columns(const void *a, const void *b)
{
    const struct rect *p = a, *q = b;
    const int d[4] = {p->x0 - q->x0, p->x1 - q->x1, p->y0 - q->y0, p->y1 - q->y1};
    return d[0] != 0 ? d[0] : d[1] != 0 ? d[1] : d[2] != 0 ? d[2] : d[3];
}

static uint32_t cost_in_order(const struct search *s, const struct rect *rects, int n)
{
    uint32_t cost = 0;
    for (int i = 0; i < n; i++) {
        const struct rect *r = &rects[i], *p = i > 0 ? r - 1 : NULL;
        const bool columns = p == NULL || p->x0 != r->x0 || p->x1 != r->x1;
        const bool lines = p == NULL || p->y0 != r->y0 || p->y1 != r->y1;
        cost += ((uint32_t)columns + lines) * s->costs.border + s->costs.start +
                s->costs.pixel * (uint32_t)((r->x1 - r->x0) * (r->y1 - r->y0));
    }
    return cost;
}

static uint32_t true_cost(struct search *s, const struct rect *rects, int n)
{
    memcpy(s->sorted, rects, sizeof *rects * (size_t)n);
    qsort(s->sorted, (size_t)n, sizeof *rects, by_lines);
    const uint32_t a = cost_in_order(s, s->sorted, n);
    qsort(s->sorted, (size_t)n, sizeof *rects, by_columns);
    const uint32_t b = cost_in_order(s, s->sorted, n);
    return a < b ? a : b;
}

/* Makes a rectangle as small as what changed in it; false: nothing did. */
static bool trim(const struct search *s, struct rect *r)
{
    if (changed_in(s, r->x0, r->x1, r->y0, r->y1) == 0) {
        return false;
    }
    while (changed_in(s, r->x0, r->x0 + 1, r->y0, r->y1) == 0) {
        r->x0++;
    }
    while (changed_in(s, r->x1 - 1, r->x1, r->y0, r->y1) == 0) {
        r->x1--;
    }
    while (changed_in(s, r->x0, r->x1, r->y0, r->y0 + 1) == 0) {
        r->y0++;
    }
    while (changed_in(s, r->x0, r->x1, r->y1 - 1, r->y1) == 0) {
        r->y1--;
    }
    return true;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int most(int a, int b)
{
    return a > b ? a : b;
}

static void join_two(struct search *s)
{
    const int n = s->trial_count;
    const int i = (int)draw(s, (uint32_t)n), j = (int)draw(s, (uint32_t)n);
    struct rect *p = &s->trial[i], *q = &s->trial[j];
    if (i == j) {
        return;
    }
    *p = (struct rect){least(p->x0, q->x0), most(p->x1, q->x1), least(p->y0, q->y0), most(p->y1, q->y1)};
    *q = s->trial[--s->trial_count];
    /* What lies inside now is not needed any more. */
    const struct rect big = s->trial[i < s->trial_count ? i : j];
    for (int k = s->trial_count; k-- > 0;) {
        const struct rect *r = &s->trial[k];
        const bool same = memcmp(r, &big, sizeof big) == 0;
        if (!same && r->x0 >= big.x0 && r->x1 <= big.x1 && r->y0 >= big.y0 && r->y1 <= big.y1) {
            s->trial[k] = s->trial[--s->trial_count];
        }
    }
}

static void split_one(struct search *s)
{
    struct rect *r = &s->trial[draw(s, (uint32_t)s->trial_count)];
    struct rect a = *r, b = *r;
    if (draw(s, 2) == 0) {
        a.x1 = b.x0 = r->x0 + (int)draw(s, (uint32_t)(r->x1 - r->x0));
    } else {
        a.y1 = b.y0 = r->y0 + (int)draw(s, (uint32_t)(r->y1 - r->y0));
    }
    const bool has_a = trim(s, &a), has_b = trim(s, &b);
    *r = has_a ? a : b;
    if (has_a && has_b && s->trial_count < RECTS_MAX) {
        s->trial[s->trial_count++] = b;
    }
}

/* Moves a border of a rectangle to another's lines or columns: it becomes larger, and there is a border less. */
static void adopt_border(struct search *s)
{
    struct rect *p = &s->trial[draw(s, (uint32_t)s->trial_count)];
    const struct rect *q = &s->trial[draw(s, (uint32_t)s->trial_count)];
    if (draw(s, 2) == 0) {
        p->x0 = least(p->x0, q->x0);
        p->x1 = most(p->x1, q->x1);
    } else {
        p->y0 = least(p->y0, q->y0);
        p->y1 = most(p->y1, q->y1);
    }
}

static uint32_t anneal(struct search *s, uint32_t steps)
{
    uint32_t now = true_cost(s, s->rects, s->count), best = now;
    for (uint32_t i = 0; i < steps; i++) {
        memcpy(s->trial, s->rects, sizeof *s->rects * (size_t)s->count);
        s->trial_count = s->count;
        const uint32_t move = draw(s, 5);
        (move < 2 ? join_two : move < 4 ? split_one : adopt_border)(s);
        const uint32_t cost = true_cost(s, s->trial, s->trial_count);
        const double heat = 8.0 * (steps - i) / steps;
        if (cost <= now || exp(-((double)cost - now) / (heat + 0.01)) * 65536 > draw(s, 65536)) {
            memcpy(s->rects, s->trial, sizeof *s->rects * (size_t)s->trial_count);
            s->count = s->trial_count;
            now = cost;
            best = now < best ? now : best;
        }
    }
    return best;
}

uint32_t cover_search(const uint8_t *changed, uint32_t width, uint32_t height, const struct cover_costs *costs,
                      uint32_t steps)
{
    struct search *s = calloc(1, sizeof *s);
    const size_t w = width + 1, h = height + 1;
    uint32_t found = 0;
    *s = (struct search){.changed = changed, .width = (int)width, .height = (int)height, .costs = *costs, .random = 1};
    s->best = calloc(w * w * h * h, sizeof *s->best);
    sum_up(s);
    fill_best(s);
    trace(s);
    if (s->count > 0) {
        found = anneal(s, steps);
    }
    free(s->best);
    free(s);
    return found;
}
