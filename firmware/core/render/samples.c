/* samples: see samples.h. */
#include "samples.h"

#include "edge.h"
#include "feed.h"
#include "kernels.h"

/* Columns in 1/256 sample: from .. from + size. */
struct columns {
    int32_t from;
    uint32_t size;
};

/* The references of a band, and the corners of a draw. */
struct walk {
    struct ph_feed f;
    const struct ph_ref *first, *draw_end; /* reference 0, and the first one of the next draw; NULL: there is none */
    const uint8_t *base;
    uint32_t corner_bytes, last; /* last: corner of a reference */
};

/* Prepares the draw of a reference. */
static PH_NOINLINE void take_draw(struct walk *w, const struct ph_ref *at)
{
    ph_feed_find(&w->f, (uint32_t)(w->first - at));
    const struct ph_draw *const draw = w->f.draw;
    w->draw_end = w->f.next_first == PH_NONE ? NULL : w->first - w->f.next_first;
    w->base = ph_at(w->f.r, draw->base);
    w->corner_bytes = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    w->last = (draw->kind & PH_DRAW_LINES) != 0 ? 0 : 2;
}

static const struct ph_ref *at_number(const struct walk *w, uint32_t ref)
{
    return ref != PH_NONE ? w->first - ref : NULL;
}

static inline const struct ph_ref *next_of(const struct walk *w, const struct ph_ref *at)
{
    const uint32_t link = at->link;
    return link - 1u < PH_LINK_FAR - 1u ? at - link
           : link == 0                  ? NULL
                                        : at_number(w, ph_feed_far(&w->f, (uint32_t)(w->first - at)));
}

/* Begins with the first reference of a band; NULL: there is none. */
static const struct ph_ref *begin(struct walk *w)
{
    ph_feed_start(&w->f, w->f.r, w->f.band);
    return at_number(w, w->f.ref);
}

static inline __attribute__((always_inline)) int32_t column_of(const uint8_t *corner)
{
    return ((const struct ph_vertex *)(const void *)corner)->x;
}

/* Widens a range of columns so that it holds x; mostly it does already. */
static inline __attribute__((always_inline)) void widen(struct columns *all, int32_t x)
{
    const uint32_t more = (uint32_t)x - (uint32_t)all->from;
    if (more > all->size) {
        all->size = x < all->from ? all->size - more : more;
        all->from = ph_min(all->from, x);
    }
}

/* The range of columns that the corners of a band's triangles span, from the reference `at` on. */
static inline struct columns columns_of(struct walk *w, const struct ph_ref *at, const struct ph_triangle *carried)
{
    const struct ph_ref *draw_end = w->draw_end;
    const uint8_t *base = w->base;
    uint32_t bytes = w->corner_bytes, last = w->last;
    struct columns all = {column_of(base + at->corner[0] * bytes), 0};
    while (at != NULL) {
        if (at <= draw_end) {
            take_draw(w, at);
            draw_end = w->draw_end;
            base = w->base;
            bytes = w->corner_bytes;
            last = w->last;
        }
        widen(&all, column_of(base + at->corner[0] * bytes));
        widen(&all, column_of(base + at->corner[1] * bytes));
        widen(&all, column_of(base + at->corner[last] * bytes));
        if (carried == NULL) {
            at = next_of(w, at);
        } else {
            carried = carried->next;
            at = carried != NULL ? w->first - carried->order : begin(w);
            draw_end = carried != NULL ? draw_end : w->first;
        }
    }
    return all;
}

PH_TIER(seldom) void ph_samples_columns(struct ph_renderer *r, uint32_t band, struct ph_columns *in)
{
    const int32_t width = r->config.width, margin = 2 * 256;
    const struct ph_triangle *const carried = r->carried;
    struct walk w;
    struct columns all = {0, (uint32_t)width << 8};
    w.first = ph_ref_at(r, 0);
    ph_feed_start(&w.f, r, band);
    const struct ph_ref *const at = carried != NULL ? w.first - carried->order : at_number(&w, w.f.ref);
    *in = (struct ph_columns){0, 0};
    if (r->after == NULL && r->points == NULL) {
        if (at == NULL) {
            return;
        }
        take_draw(&w, at);
        all = columns_of(&w, at, carried);
    }
    in->end = ph_max(ph_min((all.from + (int32_t)all.size + margin + 511) >> 9, width / 2), 0);
    in->from = ph_min(ph_max((all.from - margin) >> 9, 0), in->end);
}

PH_TIER(seldom) void ph_samples_clear(const struct ph_band *rows, const struct ph_columns *in, uint16_t background)
{
    uint16_t *samples = rows->pixels + 2 * in->from;
    for (int32_t y = rows->y0; y < rows->y1; y++, samples += rows->stride) {
        ph_fill(samples, background, 2 * (uint32_t)(in->end - in->from));
    }
}

void ph_samples_resolve(const struct ph_band *rows, const struct ph_columns *in, uint16_t background, uint16_t *pixels)
{
    const uint32_t width = (uint32_t)rows->width, lines = (uint32_t)(rows->y1 - rows->y0) / 2;
    const uint32_t from = (uint32_t)in->from, n = (uint32_t)in->end - from;
    const uint16_t *upper = rows->pixels + 2 * from;
    ph_fill(pixels, background, lines * (width / 2));
    pixels += from;
    for (uint32_t y = 0; y < lines; y++, upper += 2 * width, pixels += width / 2) {
        ph_halve(pixels, upper, upper + width, n);
    }
}
