/* Coarse depth. See coarse.h. */
#include "coarse.h"

#include "edge.h"
#include "raster_large.h"

#define GENTLE ((uint32_t)1 << 20) /* 16 codes a pixel: 1024 times this and that still fit 32 bits */

/* Where an edge of rows meets row y. */
static inline int32_t edge_at(const struct ph_half_rows *in, const struct ph_edge *edge, int32_t y)
{
    return ph_edge_below(*edge, y - in->y).x;
}

/* The most that a value grows from column x on within from .. to, if it grows by g a column. */
static inline uint32_t most_growth(int32_t g, int32_t x, int32_t from, int32_t to)
{
    return g < 0 ? (0u - (uint32_t)g) * (uint32_t)(x - from) : (uint32_t)g * (uint32_t)(to - x);
}

/*
 * Sets the rows of the upper or lower half that lie in the band; without any o->in.y_end is not above o->in.y. Sets the
 * farthest and the nearest depth that its pixels may have. An edge that stays beyond the picture moves away. False:
 * there are no rows, or the depths are not known.
 */
static PH_NOINLINE bool measure(const struct ph_triangle *t, const struct ph_band *band, int half,
                                struct ph_occluder *o, uint32_t *nearest)
{
    struct ph_half_rows *const in = &o->in;
    if (!ph_rows_of_half_apart(t, band, half, in)) {
        return false;
    }
    const struct ph_plane *const depth = &t->as.large.depth.as.plane;
    const int32_t last = in->y_end - 1, gx = (int32_t)depth->gx, gy = (int32_t)depth->gy, width = band->width;
    const int32_t from = (int32_t)ph_from_column((uint32_t)in->left.x);
    const int32_t from_last = (int32_t)ph_from_column((uint32_t)edge_at(in, &in->left, last));
    const int32_t to = (int32_t)ph_to_column((uint32_t)in->right.x, (uint32_t)width);
    const int32_t to_last = (int32_t)ph_to_column((uint32_t)edge_at(in, &in->right, last), (uint32_t)width);
    if (from >= to || from_last >= to_last || fx_magnitude(gx) >= GENTLE || fx_magnitude(gy) >= GENTLE) {
        return false;
    }
    const int32_t x0 = ph_min(from, from_last), x1 = ph_max(to, to_last) - 1;
    const uint32_t d = ph_plane_at(depth, (uint32_t)from, (uint32_t)in->y); /* the depth of a pixel */
    o->least = d - most_growth(-gx, from, x0, x1) - most_growth(-gy, in->y, in->y, last);
    *nearest = d + most_growth(gx, from, x0, x1) + most_growth(gy, in->y, in->y, last);
    if (ph_max(from, from_last) == 0) {
        in->left = (struct ph_edge){INT32_MIN, 0};
    }
    if (ph_min(to, to_last) == width) {
        in->right = (struct ph_edge){INT32_MAX, 0};
    }
    return o->least <= d && *nearest >= d;
}

/* Whether rows lie in others. Edges are straight, so its first and its last row tell. */
static bool lies_in(const struct ph_half_rows *a, const struct ph_half_rows *b)
{
    const int32_t last = a->y_end - 1;
    return a->y >= b->y && a->y_end <= b->y_end && a->left.x >= edge_at(b, &b->left, a->y) &&
           edge_at(a, &a->left, last) >= edge_at(b, &b->left, last) && a->right.x <= edge_at(b, &b->right, a->y) &&
           edge_at(a, &a->right, last) <= edge_at(b, &b->right, last);
}

/* Whether an occluder of the band hides all pixels of o. */
static inline bool is_hidden(const struct ph_occluder *o, uint32_t nearest, const struct ph_band *band)
{
    const struct ph_coarse *const c = band->coarse;
    const int down = band->depth24 ? 8 : 16;
    for (uint32_t i = 0; i < c->count; i++) {
        if (nearest >> down <= c->at[i].least >> down && lies_in(&o->in, &c->at[i].in)) {
            return true;
        }
    }
    return false;
}

static inline uint32_t count_pixels(struct ph_half_rows in, int32_t width)
{
    uint32_t count = 0;
    for (; in.y < in.y_end; in.y++) {
        int32_t from, to;
        if (ph_next_row(&in.left, &in.right, width, &from, &to)) {
            count += (uint32_t)(to - from);
        }
    }
    return count;
}

/* The pixels in the band of a triangle that occluders hide there; 0 if it may be seen. */
static PH_NOINLINE uint32_t count_hidden(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0, nearest;
    if (band->coarse->count == 0) {
        return 0;
    }
    for (int half = 0; half < 2; half++) {
        struct ph_occluder o;
        if (measure(t, band, half, &o, &nearest)) {
            if (!is_hidden(&o, nearest, band)) {
                return 0;
            }
            count += count_pixels(o.in, band->width);
        } else if (o.in.y < o.in.y_end) {
            return 0;
        }
    }
    return count;
}

static inline bool is_same_edge(const struct ph_edge *a, const struct ph_edge *b)
{
    return a->x == b->x && a->dx == b->dx;
}

/* Makes one occluder of two that share an edge. */
static bool join(struct ph_occluder *to, const struct ph_occluder *o)
{
    if (to->in.y != o->in.y || to->in.y_end != o->in.y_end) {
        return false;
    }
    if (is_same_edge(&to->in.right, &o->in.left)) {
        to->in.right = o->in.right;
    } else if (is_same_edge(&to->in.left, &o->in.right)) {
        to->in.left = o->in.left;
    } else {
        return false;
    }
    to->least = to->least < o->least ? to->least : o->least;
    return true;
}

/* Keeps an occluder. Without room for it the farthest one goes. */
static void keep(struct ph_coarse *c, const struct ph_occluder *o)
{
    struct ph_occluder *farthest = &c->at[0];
    for (uint32_t i = 0; i < c->count; i++) {
        if (join(&c->at[i], o)) {
            return;
        }
        farthest = c->at[i].least < farthest->least ? &c->at[i] : farthest;
    }
    if (c->count < PH_OCCLUDERS) {
        c->at[c->count++] = *o;
    } else if (o->least >= farthest->least) {
        *farthest = *o;
    }
}

/* Makes an occluder of a triangle that was drawn. */
static PH_NOINLINE void add_occluder(const struct ph_triangle *t, const struct ph_band *band)
{
    for (int half = 0; half < 2; half++) {
        struct ph_occluder o;
        uint32_t nearest;
        if (measure(t, band, half, &o, &nearest)) {
            keep(band->coarse, &o);
        }
    }
}

/* See struct ph_occlusion. */
PH_TIER(loop) static uint32_t draw_unless_hidden(const struct ph_triangle *t, const struct ph_band *band)
{
    const uint32_t hidden = count_hidden(t, band);
    if (hidden > 0) {
        return hidden;
    }
    const uint32_t count = ph_draw_large(t, band);
    if (count >= PH_OCCLUDER_LEAST) {
        add_occluder(t, band);
    }
    return count;
}

const struct ph_occlusion ph_coarse_depth = {.draw_unless_hidden = draw_unless_hidden};
