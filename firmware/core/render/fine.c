/* fine: see fine.h. */
#include "fine.h"

#include "edge.h"
#include "feed.h"
#include "kernels.h"

/* Widens `all`, in 1/256 sample, by the corners of a reference. */
static inline void reach_ref(struct ph_reach *all, struct ph_feed *f, uint32_t ref)
{
    if (ref >= f->next_first) {
        ph_feed_find(f, ref);
    }
    const uint32_t kind = f->draw->kind, last = (kind & PH_DRAW_LINES) != 0 ? 0 : 2;
    const size_t size = (kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    const uint8_t *const base = ph_at(f->r, f->draw->base);
    const struct ph_ref *const at = ph_ref_at(f->r, ref);
    const int32_t a = ((const struct ph_vertex *)(const void *)(base + at->corner[0] * size))->x;
    const int32_t b = ((const struct ph_vertex *)(const void *)(base + at->corner[1] * size))->x;
    const int32_t c = ((const struct ph_vertex *)(const void *)(base + at->corner[last] * size))->x;
    all->from = ph_min(all->from, ph_min(ph_min(a, b), c));
    all->end = ph_max(all->end, ph_max(ph_max(a, b), c));
}

void ph_fine_reach(struct ph_renderer *r, uint32_t band, struct ph_reach *in)
{
    const int32_t width = r->config.width, margin = 2 * 256;
    struct ph_reach all = {width << 8, -margin};
    struct ph_feed f, carried;
    ph_feed_start(&f, r, band);
    ph_feed_start(&carried, r, band);
    for (; f.ref != PH_NONE; f.ref = ph_feed_next(&f, f.ref)) {
        reach_ref(&all, &f, f.ref);
    }
    for (const struct ph_triangle *t = r->carried; t != NULL; t = t->next) {
        reach_ref(&all, &carried, t->order);
    }
    if (r->after != NULL) {
        all = (struct ph_reach){0, width << 8};
    }
    in->end = ph_min((all.end + margin + 511) >> 9, width / 2);
    in->from = ph_min(ph_max((all.from - margin) >> 9, 0), in->end);
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
