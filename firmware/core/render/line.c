/* See line.h. */
/* Kits on armv6m: -O2. */
#include "line.h"

#include "edge.h"
#include "exact.h"
#include "kernels.h"
#include "planes.h"
#include "raster_walk.h"
#include "span.h"

/* ---- listing ---------------------------------------------------------------------------------------------------- */

/* Puts the smaller one first. */
static inline void sort(int32_t *a, int32_t *b)
{
    if (*a > *b) {
        const int32_t larger = *a;
        *a = *b;
        *b = larger;
    }
}

/* Lists a line that is one sample wide; which: as in struct ph_ref. */
static inline void list_line(struct ph_renderer *r, const uint16_t ends[2], const struct ph_vertex *a,
                             const struct ph_vertex *b, unsigned which)
{
    int32_t left = a->x, right = b->x, top = a->y, low = b->y;
    sort(&left, &right);
    sort(&top, &low);
    if (right - left >= low - top) { /* ph_line_is_x_major */
        left = ph_first_row(left);
        right = ph_first_row(right);
        top = ph_line_pixel(top);
        low = ph_line_pixel(low) + 1;
    } else {
        left = ph_line_pixel(left);
        right = ph_line_pixel(right) + 1;
        top = ph_first_row(top);
        low = ph_first_row(low);
    }
    if (left < right && right > 0 && left < r->config.width && top < low && low > 0 && top < r->config.height) {
        struct ph_ref *const ref = ph_list_next(r);
        if (ref != NULL) {
            *ref = (struct ph_ref){{ends[0], ends[1], (uint16_t)which}, ph_band_of(r, ph_max(top, 0))};
        }
    }
}

PH_TIER(scenery)
PH_NOINLINE void ph_list_line(struct ph_renderer *r, const uint16_t ends[2], const struct ph_vertex *a,
                              const struct ph_vertex *b)
{
    for (unsigned which = 0; which <= r->samples_log2; which++) {
        struct ph_vertex of_a = *a, of_b = *b;
        if (r->samples_log2 != 0) {
            ph_line_of_samples(&of_a, &of_b, (int)which);
        }
        list_line(r, ends, &of_a, &of_b, which);
    }
}

void ph_list_segment(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner ends[2])
{
    const struct ph_mark mark = ph_list_mark(r);
    const int32_t first = ph_list_corners(r, material, PH_DRAW_LINES, ends, 2);
    if (first < 0) {
        r->stats.triangles_dropped++;
        return;
    }
    const uint16_t number[2] = {(uint16_t)first, (uint16_t)(first + 1)};
    ph_list_line(r, number, &ends[0].at, &ends[1].at);
    ph_list_rewind(r, &mark);
}

PH_TIER(scenery)
uint32_t ph_list_lines(struct ph_renderer *r, const uint16_t (*edges)[2], uint32_t n, const struct ph_vertex *vertices)
{
    const uint16_t(*edge)[2] = edges, (*const end)[2] = edges + n;
    for (; edge < end; edge++) {
        const struct ph_vertex *const a = &vertices[(*edge)[0]], *const b = &vertices[(*edge)[1]];
        if ((a->code & b->code & PH_REJECT) != 0) {
            continue;
        }
        if (((a->code | b->code) & PH_CLIP) != 0) {
            break;
        }
        if (r->samples_log2 == 0) {
            list_line(r, *edge, a, b, 0);
        } else {
            ph_list_line(r, *edge, a, b);
        }
    }
    return (uint32_t)(edge - edges);
}

/* ---- set-up ----------------------------------------------------------------------------------------------------- */

/* The length of a line, and how much of it lies before the centre of its first pixel, 1/256 px. */
struct part {
    int32_t length, before;
    int32_t reciprocal; /* 2^(61 - shift) / length */
    int shift;
};

/* n / length in Q28; |n| <= length. */
static inline int32_t part_q28(int32_t reciprocal, int shift, int32_t n)
{
    return (int32_t)(fx_mul_wide((int32_t)((uint32_t)n << (shift - 1)), reciprocal) >> 32);
}

/* change per pixel; a length of 256 or more. */
static inline int32_t step_of(const struct part *part, int32_t change)
{
    const int32_t high = (int32_t)(fx_mul_wide(change, part->reciprocal) >> 32);
    return part->shift <= 21 ? high >> (21 - part->shift) : high * (1 << (part->shift - 21));
}

/* change times before / length. */
static PH_NOINLINE int32_t change_before(int32_t change, int32_t before, int32_t reciprocal, int shift)
{
    return (int32_t)(fx_mul_wide(change, part_q28(reciprocal, shift, before)) >> 28);
}

/* Whether a line is over a pixel long and its upper end is in the picture: before < 256 <= length. */
static inline bool is_fast(const struct part *part)
{
    return part->before < 256 && part->length >= 256;
}

static inline void step(struct ph_line *l, int32_t n)
{
    l->along = (int16_t)(l->along + n * l->step);
    l->across += n * l->slope;
    l->count = (int16_t)(l->count - n);
}

/* How many of the next pixels lie above row y. */
PH_TIER(scenery) static PH_NOINLINE int32_t pixels_above(const struct ph_line *l, int32_t y)
{
    const int32_t slope = l->slope, count = l->count;
    int32_t n = 0;
    if (!l->x_major) {
        return ph_min(ph_max(y - l->along, 0), count);
    }
    if ((l->across + (count - 1) * slope) >> 16 < y) {
        return count;
    }
    for (int32_t row = l->across; row >> 16 < y; row += slope) {
        n++;
    }
    return n;
}

/* Sets the pixels of a line along its longer axis, in a picture of that size. */
static inline void pixels_of(struct ph_line *l, struct part *part, int32_t from, int32_t to, bool back, int32_t size)
{
    const int32_t first = ph_max(ph_first_row(back ? to : from), 0);
    const int32_t end = ph_min(ph_first_row(back ? from : to), size), along = back ? end - 1 : first;
    const int32_t before = along * 256 + 128 - from;
    l->along = (int16_t)along;
    l->count = (int16_t)(end - first);
    l->step = back ? -1 : 1;
    part->length = back ? from - to : to - from;
    part->before = back ? -before : before;
}

/* Sets the first pixel and the steps of the line from a to b, which is not above a, and its rows. */
static inline void walk_of(const struct ph_renderer *r, const struct ph_vertex *a, const struct ph_vertex *b,
                           struct ph_triangle *t, struct part *part)
{
    struct ph_line *const l = &t->as.line.way;
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    const bool x_major = fx_magnitude(dx) >= (uint32_t)dy; /* ph_line_is_x_major */
    int32_t across = a->y, change = dy;
    if (x_major) {
        pixels_of(l, part, a->x, b->x, dx < 0, r->config.width);
    } else {
        pixels_of(l, part, a->y, b->y, false, r->config.height);
        across = a->x;
        change = dx;
    }
    l->x_major = x_major;
    part->reciprocal = ph_wide_reciprocal((uint32_t)part->length, &part->shift);
    const int32_t slope_q28 = part_q28(part->reciprocal, part->shift, change);
    l->slope = (slope_q28 + (1 << 11)) >> 12;
    l->across = across * 256 - 1 +
                (is_fast(part) ? (slope_q28 >> 8) * part->before >> 12
                               : change_before(change * 256, part->before, part->reciprocal, part->shift));
    int32_t top = l->along, end = l->along + l->count;
    if (x_major) {
        top = ph_max(l->across >> 16, 0);
        end = ph_min(((l->across + (l->count - 1) * l->slope) >> 16) + 1, r->config.height);
    }
    t->y_top = (int16_t)top;
    t->y_bottom = (int16_t)end;
}

/* Three corners of the parallelogram that the line is when it is one pixel across its longer axis. */
static void line_corners(const struct ph_vertex *a, const struct ph_vertex *b, struct ph_vertex out[3])
{
    const bool x_major = ph_line_is_x_major(a, b),
               turned = x_major ? b->x > a->x : b->y < a->y; /* so that it faces the viewer */
    const int32_t side_x = x_major ? 0 : 128, side_y = 128 - side_x;
    out[0] = turned ? *b : *a;
    out[1] = out[2] = turned ? *a : *b;
    for (int i = 0; i < 3; i++) {
        const int32_t sign = i == 2 ? 1 : -1;
        out[i].x += sign * side_x;
        out[i].y += sign * side_y;
    }
}

/* Depth in any format, as that of a triangle that is one pixel across the longer axis. */
static PH_NOINLINE void any_depth(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                                  struct ph_triangle *t)
{
    struct ph_vertex corners[3];
    line_corners(a, b, corners);
    const struct ph_vertex *const v[3] = {&corners[0], &corners[1], &corners[2]};
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    struct ph_depth *const depth = &t->as.line.depth.any;
    t->kind = PH_KIND_ANY_LINE;
    if (!ph_set_depth(s->r, t->material, v, &sides, depth, &t->block)) {
        ph_set_exact(s->r, t->material, v, &sides, depth);
        t->block = PH_BLOCK_EXACT;
    }
}

/* Finds the depth of both ends as 16.16 codes, less than 2^31 apart. False if this format has no such codes. */
static inline bool end_codes(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                             uint32_t d[3])
{
    if (!s->has_codes) {
        return false;
    }
    const struct ph_vertex *const v[3] = {a, b, b};
    if (s->octaves == NULL) {
        d[0] = ph_depth_before(ph_depth_of(a), 0, 0) + s->fast.bias;
        d[1] = ph_depth_before(ph_depth_of(b), 0, 0) + s->fast.bias;
    } else if (!s->octaves->set_codes(&s->r->lens, v, s->fast.bias, d)) {
        return false;
    }
    return (d[0] ^ d[1]) >> 31 == 0;
}

PH_TIER(scenery)
void ph_setup_line(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                   struct ph_triangle *t)
{
    const bool down = b->y > a->y || (b->y == a->y && b->x > a->x);
    const struct ph_vertex *const from = down ? a : b, *const to = down ? b : a;
    struct part part;
    uint32_t d[3];
    t->kind = PH_KIND_LINE;
    t->block = PH_BLOCK_NONE;
    t->material = s->fast.material;
    t->as.line.colour = t->material->colour;
    t->as.line.lines = &ph_lines;
    walk_of(s->r, from, to, t, &part);
    if (t->material->depth_bias_slope != 0 || !end_codes(s, from, to, d)) {
        any_depth(s, from, to, t);
        return;
    }
    const int32_t change = (int32_t)(d[1] - d[0]);
    const int32_t gd = part.length >= 256 ? step_of(&part, change) : 0;
    t->as.line.depth.codes.gd = (uint32_t)gd;
    t->as.line.depth.codes.d =
        d[0] + (uint32_t)(is_fast(&part) ? (gd >> 8) * part.before
                                         : change_before(change, part.before, part.reciprocal, part.shift));
}

/* Cuts a line's *count pixels down to those that lie in columns 0 .. width - 1, where its longer axis is y; the first
 * lies at `across`. Returns how many pixels before the first one that stays were cut off. */
static PH_NOINLINE int32_t trim(int32_t across, int32_t slope, uint32_t width, int32_t *count)
{
    int32_t skipped = 0, left = *count, last = across + (left - 1) * slope;
    for (; left > 0 && (uint32_t)(across >> 16) >= width; across += slope, left--) {
        skipped++;
    }
    for (; left > 0 && (uint32_t)(last >> 16) >= width; last -= slope) {
        left--;
    }
    *count = left;
    return skipped;
}

/* Draws count pixels of a line one by one, in any depth format, after the first ones, which are skipped. Each is drawn
 * as a pixel of a flat triangle with the line's depth. */
static PH_NOINLINE void draw_any(const struct ph_triangle *t, int32_t skipped, int32_t count,
                                 const struct ph_band *band)
{
    struct ph_line l = t->as.line.way;
    struct ph_triangle flat, pixel;
    flat.material = t->material;
    flat.kind = PH_KIND_FLAT;
    flat.block = t->block;
    flat.as.large.depth = t->as.line.depth.any;
    flat.as.large.of.colour = t->as.line.colour;
    pixel = flat;
    for (step(&l, skipped); count > 0; step(&l, 1), count--) {
        const int32_t across = l.across >> 16, x = l.x_major ? l.along : across, y = l.x_major ? across : l.along;
        if (t->block == PH_BLOCK_EXACT) {
            ph_exact_run(&flat, band->ways->exact, x, x + 1, y, &pixel);
        }
        ph_draw_pixel(&pixel, x, y, band);
    }
}

/* Draws count pixels of a line, which lie in the band's rows, after the first ones, which are skipped. */
static inline __attribute__((always_inline)) uint32_t
draw_pixels(const struct ph_triangle *t, const struct ph_band *band, int32_t skipped, int32_t count)
{
    const struct ph_line *const l = &t->as.line.way;
    const int32_t stride = band->stride, slope = l->slope;
    int32_t at = l->along, across = l->across + skipped * slope; /* at: of the memory */
    struct ph_line_run run;
    run.slope = slope;
    if (l->x_major) {
        across -= band->y0 * 65536;
        run.stride = stride;
        run.forward = l->step;
    } else {
        const uint32_t width = (uint32_t)band->width;
        at = (at - band->y0) * stride;
        run.stride = 1;
        run.forward = stride;
        if ((uint32_t)(across >> 16) >= width || (uint32_t)((across + (count - 1) * slope) >> 16) >= width) {
            const int32_t more = trim(across, slope, width, &count);
            across += more * slope;
            skipped += more;
        }
    }
    if (count <= 0) {
        return 0;
    }
    if (t->kind == PH_KIND_ANY_LINE) {
        draw_any(t, skipped, count, band);
        return (uint32_t)count;
    }
    at += skipped * run.forward;
    run.across = across;
    run.gd = t->as.line.depth.codes.gd;
    run.d = t->as.line.depth.codes.d + (uint32_t)skipped * run.gd;
    run.colour = t->as.line.colour;
    ph_line_pixels(&run, band->pixels + at, (uint16_t *)band->depth + at, (uint32_t)count);
    return (uint32_t)count;
}

PH_TIER(scenery) static uint32_t draw_line(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct ph_line *const l = &t->as.line.way;
    const int32_t skipped = t->y_top > band->y0 ? 0 : pixels_above(l, band->y0);
    const int32_t end = t->y_bottom < band->y1 ? l->count : pixels_above(l, band->y1);
    return draw_pixels(t, band, skipped, end - skipped);
}

/* Steps a line over its next n pixels, all that lie above row y. */
static inline void step_below(struct ph_triangle *t, int32_t n, int32_t y)
{
    step(&t->as.line.way, n);
    if (t->kind == PH_KIND_LINE) {
        t->as.line.depth.codes.d += (uint32_t)n * t->as.line.depth.codes.gd;
    }
    t->y_top = (int16_t)y;
}

PH_TIER(figure) static void step_line(struct ph_triangle *t, int32_t y)
{
    step_below(t, pixels_above(&t->as.line.way, y), y);
}

PH_TIER(scenery) static uint32_t draw_and_step(struct ph_triangle *t, const struct ph_band *band)
{
    const int32_t skipped = pixels_above(&t->as.line.way, band->y0), n = pixels_above(&t->as.line.way, band->y1);
    const uint32_t count = draw_pixels(t, band, skipped, n - skipped);
    step_below(t, n, band->y1);
    return count;
}

const struct ph_lines ph_lines = {
    .setup_line = ph_setup_line, .draw_line = draw_line, .draw_and_step = draw_and_step, .step_line = step_line};
