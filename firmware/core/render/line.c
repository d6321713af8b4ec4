/* See line.h. */
#include "line.h"

#include "edge.h"
#include "exact.h"
#include "kernels.h"
#include "planes.h"
#include "span.h"

/* The length of a line, and how much of it lies before the centre of its first pixel, 1/256 px. */
struct part {
    int32_t length, before;
    int32_t reciprocal; /* 2^(61 - shift) / length */
    int shift;
    bool usual; /* before < 256 <= length: it is over a pixel long, and its upper end is in the picture */
};

/* n / length in Q28; |n| <= length. */
static inline int32_t part_q28(const struct part *part, int32_t n)
{
    return (int32_t)(fx_mul_wide((int32_t)((uint32_t)n << (part->shift - 1)), part->reciprocal) >> 32);
}

/* change per pixel; a length of 256 or more. */
static inline int32_t step_of(const struct part *part, int32_t change)
{
    const int32_t high = (int32_t)(fx_mul_wide(change, part->reciprocal) >> 32);
    return part->shift <= 21 ? high >> (21 - part->shift) : high * (1 << (part->shift - 21));
}

/* change times before / length. */
static PH_NOINLINE int32_t change_before(const struct part *part, int32_t change)
{
    return (int32_t)(fx_mul_wide(change, part_q28(part, part->before)) >> 28);
}

static inline void step(struct ph_line *l, int32_t n)
{
    l->along = (int16_t)(l->along + n * l->step);
    l->across += n * l->slope;
    l->count = (int16_t)(l->count - n);
}

/* How many of the next pixels lie above row y. */
static int32_t pixels_above(const struct ph_line *l, int32_t y)
{
    int32_t n = 0;
    if (!l->wide) {
        return ph_max(y - l->along, 0);
    }
    for (int32_t row = l->across; n < l->count && row >> 16 < y; row += l->slope) {
        n++;
    }
    return n;
}

/* Sets the first pixel and the steps of the line from a to b, and its rows. */
static void walk_of(const struct ph_renderer *r, const struct ph_vertex *a, const struct ph_vertex *b,
                    struct ph_triangle *t, struct part *part)
{
    const bool wide = ph_line_is_wide(a, b);
    const int32_t from = wide ? a->x : a->y, to = wide ? b->x : b->y, size = wide ? r->config.width : r->config.height;
    const int32_t across = wide ? a->y : a->x, change = (wide ? b->y : b->x) - across;
    const int32_t first = ph_max(ph_first_row(ph_min(from, to)), 0), end = ph_min(ph_first_row(ph_max(from, to)), size);
    struct ph_line *const l = &t->line;
    l->wide = wide;
    l->step = to < from ? -1 : 1;
    l->along = (int16_t)(to < from ? end - 1 : first);
    l->count = (int16_t)(end - first);
    part->length = (int32_t)fx_magnitude(to - from);
    part->before = (int32_t)fx_magnitude(l->along * 256 + 128 - from);
    part->usual = part->before < 256 && part->length >= 256;
    part->reciprocal = ph_wide_reciprocal((uint32_t)part->length, &part->shift);
    const int32_t slope_q28 = part_q28(part, change);
    l->slope = (slope_q28 + (1 << 11)) >> 12;
    l->across =
        across * 256 - 1 + (part->usual ? (slope_q28 >> 8) * part->before >> 12 : change_before(part, change * 256));
    if (!wide) {
        t->y_top = l->along;
        t->y_bottom = (int16_t)end;
        return;
    }
    const int32_t last = (l->across + (l->count - 1) * l->slope) >> 16;
    t->y_top = (int16_t)ph_max(l->across >> 16, 0);
    t->y_bottom = (int16_t)ph_min(last + 1, r->config.height);
}

/* Three corners of the parallelogram that the line is when it is one pixel wide across its longer axis. */
static void line_corners(const struct ph_vertex *a, const struct ph_vertex *b, struct ph_vertex out[3])
{
    const bool wide = ph_line_is_wide(a, b),
               turned = wide ? b->x > a->x : b->y < a->y; /* so that it faces the viewer */
    const int32_t side_x = wide ? 0 : 128, side_y = 128 - side_x;
    out[0] = turned ? *b : *a;
    out[1] = out[2] = turned ? *a : *b;
    for (int i = 0; i < 3; i++) {
        const int32_t sign = i == 2 ? 1 : -1;
        out[i].x += sign * side_x;
        out[i].y += sign * side_y;
    }
}

/* Depth in any format, as that of a triangle that is one pixel wide across the longer axis. */
static PH_NOINLINE void any_depth(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                                  struct ph_triangle *t)
{
    struct ph_vertex corners[3];
    line_corners(a, b, corners);
    const struct ph_vertex *const v[3] = {&corners[0], &corners[1], &corners[2]};
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    t->kind = PH_KIND_ANY_LINE;
    if (!ph_set_depth(t, s->r, v, &sides) || t->material->depth_bias_slope != 0) {
        ph_set_exact(s->r, t, v, &sides);
    }
}

/* Depth of both ends as 16.16 codes, less than 2^31 apart. False if they are none in this format. */
static inline bool end_codes(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                             uint32_t d[3])
{
    const struct ph_vertex *const v[3] = {a, b, b};
    if (s->r->stats.depth_format > PH_DEPTH_FLOAT16 || s->draw.material->depth_bias_slope != 0) {
        return false;
    }
    if (!s->floats) {
        d[0] = ph_depth_before(ph_depth_of(a), 0, 0) + s->usual.bias;
        d[1] = ph_depth_before(ph_depth_of(b), 0, 0) + s->usual.bias;
    } else if (!ph_float_depths(&s->r->lens, v, s->usual.bias, d)) {
        return false;
    }
    return (d[0] ^ d[1]) >> 31 == 0;
}

void ph_setup_line(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                   struct ph_triangle *t)
{
    const bool down = b->y > a->y || (b->y == a->y && b->x > a->x);
    const struct ph_vertex *const from = down ? a : b, *const to = down ? b : a;
    struct part part;
    uint32_t d[3];
    t->kind = PH_KIND_LINE;
    t->block = PH_BLOCK_NONE;
    t->material = s->draw.material;
    t->colour = t->material->colour;
    walk_of(s->r, from, to, t, &part);
    if (!end_codes(s, from, to, d)) {
        any_depth(s, from, to, t);
        return;
    }
    const int32_t change = (int32_t)(d[1] - d[0]);
    const int32_t gd = part.length >= 256 ? step_of(&part, change) : 0;
    t->depth.gx = (uint32_t)gd;
    t->depth.base = d[0] + (uint32_t)(part.usual ? (gd >> 8) * part.before : change_before(&part, change));
}

/* Leaves out the pixels that do not lie in rows or columns low .. low + size - 1 across the longer axis. Returns how
 * many that are before the first one. */
static PH_NOINLINE int32_t trim(struct ph_line *l, int32_t low, uint32_t size)
{
    int32_t skipped = 0, last = l->across + (l->count - 1) * l->slope;
    for (; l->count > 0 && (uint32_t)((l->across >> 16) - low) >= size; skipped++) {
        step(l, 1);
    }
    for (; l->count > 0 && (uint32_t)((last >> 16) - low) >= size; last -= l->slope) {
        l->count--;
    }
    return skipped;
}

/* The pixels of a line that lie in the band. Returns how many are left out before them. */
static inline int32_t cut(struct ph_line *l, const struct ph_band *band)
{
    int32_t skipped = 0, low = band->y0, size = band->y1 - low;
    if (!l->wide) {
        skipped = ph_max(low - l->along, 0);
        step(l, skipped);
        l->count = (int16_t)ph_min(l->count, band->y1 - l->along);
        low = 0;
        size = band->width;
    }
    const int32_t last = l->across + (l->count - 1) * l->slope;
    const bool inside =
        (uint32_t)((l->across >> 16) - low) < (uint32_t)size && (uint32_t)((last >> 16) - low) < (uint32_t)size;
    return inside ? skipped : skipped + trim(l, low, (uint32_t)size);
}

/* Draws the pixels of a line in any depth format, one by one. */
static PH_NOINLINE void draw_any(const struct ph_triangle *t, struct ph_line *l, const struct ph_band *band)
{
    for (; l->count > 0; step(l, 1)) {
        const int32_t across = l->across >> 16;
        ph_draw_pixel(t, l->wide ? l->along : across, l->wide ? across : l->along, band);
    }
}

uint32_t ph_draw_line_rows(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_line l = t->line;
    const int32_t width = band->width, skipped = cut(&l, band), count = l.count;
    if (t->kind == PH_KIND_ANY_LINE) {
        draw_any(t, &l, band);
        return (uint32_t)count;
    }
    const int32_t stride = l.wide ? width : 1, forward = l.wide ? l.step : width, slope = l.slope;
    int32_t at = l.wide ? l.along - band->y0 * width : (l.along - band->y0) * width, across = l.across;
    uint16_t *const pixels = band->pixels, *const depth = band->depth;
    const uint16_t colour = t->colour;
    const uint32_t gd = t->depth.gx;
    uint32_t d = t->depth.base + (uint32_t)skipped * gd;
    for (const int32_t end = at + ph_max(count, 0) * forward; at != end; at += forward) {
        const int32_t pixel = at + (across >> 16) * stride;
        ph_pixel_flat(&pixels[pixel], &depth[pixel], d, colour);
        across += slope;
        d += gd;
    }
    return (uint32_t)count;
}

void ph_line_step_below(struct ph_triangle *t, int32_t y)
{
    if (t->kind == PH_KIND_LINE) {
        const int32_t n = pixels_above(&t->line, y);
        step(&t->line, n);
        t->depth.base += (uint32_t)n * t->depth.gx;
        t->y_top = (int16_t)y;
    }
}
