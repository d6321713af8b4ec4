/* fine: see fine.h. */
#include "fine.h"

#include "edge.h"
#include "feed.h"
#include "kernels.h"

#define NOWHERE INT32_MIN

/* The columns of a band's corners, in 1/256 sample: from .. from + size. None: from NOWHERE on. */
struct columns {
    int32_t from;
    uint32_t size;
    struct ph_feed *f;
    const uint8_t *base; /* those of the draw of f */
    uint32_t corner_bytes, last;
};

static PH_NOINLINE void widen_to(struct columns *all, int32_t x)
{
    const bool is_first = all->from == NOWHERE;
    const int32_t end = is_first ? x : ph_max(all->from + (int32_t)all->size, x);
    all->from = is_first ? x : ph_min(all->from, x);
    all->size = (uint32_t)(end - all->from);
}

static PH_NOINLINE void take_draw(struct columns *all, uint32_t ref)
{
    ph_feed_find(all->f, ref);
    const struct ph_draw *const draw = all->f->draw;
    all->base = ph_at(all->f->r, draw->base);
    all->corner_bytes = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    all->last = (draw->kind & PH_DRAW_LINES) != 0 ? 0 : 2;
}

static inline __attribute__((always_inline)) void widen(struct columns *all, uint32_t corner)
{
    const int32_t x = ((const struct ph_vertex *)(const void *)(all->base + corner * all->corner_bytes))->x;
    if ((uint32_t)x - (uint32_t)all->from > all->size) {
        widen_to(all, x);
    }
}

/* Widens them by the corners of a reference, of which most lie within. */
static inline void take_ref(struct columns *all, uint32_t ref, const struct ph_ref *at)
{
    if (ref >= all->f->next_first) {
        take_draw(all, ref);
    }
    widen(all, at->corner[0]);
    widen(all, at->corner[1]);
    widen(all, at->corner[all->last]);
}

void ph_fine_reach(struct ph_renderer *r, uint32_t band, struct ph_reach *in)
{
    const int32_t width = r->config.width, margin = 2 * 256;
    const struct ph_ref *const first = ph_ref_at(r, 0);
    struct ph_feed f;
    ph_feed_start(&f, r, band);
    struct columns all = {.from = NOWHERE, .f = &f, .base = ph_at(r, 0)}; /* take_draw sets the first base */
    const struct ph_triangle *carried = r->carried;
    for (uint32_t ref = carried != NULL ? carried->order : f.ref; ref != PH_NONE;) {
        const struct ph_ref *const at = first - ref;
        take_ref(&all, ref, at);
        if (carried == NULL) {
            ref = at->link - 1u < PH_LINK_FAR - 1u ? ref + at->link : ph_feed_next(&f, ref);
        } else {
            carried = carried->next;
            if (carried == NULL) {
                ph_feed_start(&f, r, band); /* its references begin with the first draw again */
            }
            ref = carried != NULL ? carried->order : f.ref;
        }
    }
    if (r->after != NULL) {
        all.from = 0;
        all.size = (uint32_t)width << 8;
    }
    *in = (struct ph_reach){0, 0};
    if (all.from != NOWHERE) {
        in->end = ph_max(ph_min((all.from + (int32_t)all.size + margin + 511) >> 9, width / 2), 0);
        in->from = ph_min(ph_max((all.from - margin) >> 9, 0), in->end);
    }
}

void ph_fine_means(const struct ph_band *rows, const struct ph_reach *in, uint16_t background, uint16_t *pixels)
{
    const uint32_t width = (uint32_t)rows->width, lines = (uint32_t)(rows->y1 - rows->y0) / 2;
    const uint32_t from = (uint32_t)in->from, end = (uint32_t)in->end;
    const uint16_t *upper = rows->pixels + 2 * from;
    for (uint32_t y = 0; y < lines; y++, upper += 2 * width, pixels += width / 2) {
        ph_fill(pixels, background, from);
        ph_halve(pixels + from, upper, upper + width, end - from);
        ph_fill(pixels + end, background, width / 2 - end);
    }
}
