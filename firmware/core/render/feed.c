/* feed: see feed.h. */
#include "feed.h"

#include "edge.h"
#include "list.h"

/* Links a reference to one that is far away. Out of line: it is rare, and inlined it would lengthen the loop of
 * sort_refs. */
static PH_NOINLINE void link_far(struct ph_ref *at, uint32_t next)
{
    at->link = next == PH_NONE ? 0 : PH_LINK_FAR;
}

/* A reference (number ref, at *at) holds how much further the next one of its list is; 0: there is none. */
static inline __attribute__((always_inline)) void link_ref(struct ph_ref *at, uint32_t ref, uint32_t next)
{
    if (next - ref < PH_LINK_FAR) {
        at->link = (uint16_t)(next - ref);
    } else {
        link_far(at, next);
    }
}

/* Puts a reference before the others of its band's list. */
static inline __attribute__((always_inline)) void sort_ref(uint32_t *bins, struct ph_ref *ref, uint32_t i)
{
    const uint32_t band = ref->link, next = bins[band];
    bins[band] = i;
    link_ref(ref, i, next);
}

PH_TIER(mesh) void ph_sort_opaque(uint32_t *bins, struct ph_ref *ref, uint32_t n)
{
    for (; n > 0; ref++) {
        n--;
        if (ref->link < PH_LINK_AFTER) {
            sort_ref(bins, ref, n);
        }
    }
}

/* Puts the references into the lists of their bands, from the last, so that each list is in drawing order. */
PH_TIER(mesh) static void sort_refs(struct ph_renderer *r)
{
    uint32_t *const bins = r->config.bins;
    uint32_t i = ph_ref_count(r);
    struct ph_ref *ref = r->list.to;
    if (r->after != NULL) {
        r->after->sort_opaque(bins, ref, i);
        return;
    }
    for (; i >= 8; i -= 8, ref += 8) {
        for (uint32_t k = 0; k < 8; k++) { /* unrolled where the compiler does not optimize for size */
            sort_ref(bins, ref + k, i - 1 - k);
        }
    }
    for (; i > 0; i--, ref++) {
        sort_ref(bins, ref, i - 1);
    }
}

PH_TIER(mesh) void ph_feed_sort(struct ph_renderer *r)
{
    uint32_t *const bins = r->config.bins;
    for (uint32_t i = r->band_count; i > 0; i--) {
        bins[i - 1] = PH_NONE;
    }
    sort_refs(r);
}

/* ---- the list of a band ----------------------------------------------------------------------------------------- */

/* Whether a triangle has rows in the band. Called only when the next reference of a list is PH_LINK_FAR or more
 * away. */
static bool touches(const struct ph_feed *f, const struct ph_draw *draw, const struct ph_ref *ref)
{
    const int32_t height = f->r->config.band_height, y0 = (int32_t)f->band * height;
    const struct ph_box box = ph_box_of(f->r, draw, ref);
    return draw->material->blend == NULL && box.y0 < y0 + height && box.y1 > y0;
}

PH_TIER(seldom) uint32_t ph_feed_far(const struct ph_feed *f, uint32_t ref)
{
    const struct ph_renderer *const r = f->r;
    const uint32_t count = ph_ref_count(r);
    const struct ph_draw *draw = ph_at(r, r->list.first);
    for (uint32_t i = ref + PH_LINK_FAR; i < count; i++) {
        while (draw->next != PH_NONE && ((const struct ph_draw *)ph_at(r, draw->next))->first <= i) {
            draw = ph_at(r, draw->next);
        }
        if (touches(f, draw, ph_ref_at(r, i))) {
            return i;
        }
    }
    return PH_NONE;
}

void ph_feed_put_below(const struct ph_feed *f, uint32_t ref, uint32_t *after)
{
    struct ph_feed below; /* only these two members are read */
    below.r = f->r;
    below.band = f->band + 1;
    uint32_t *const bin = &f->r->config.bins[below.band], before = *after;
    uint32_t next = before == PH_NONE ? *bin : ph_feed_next(&below, before);
    while (next < ref) {
        before = next;
        next = ph_feed_next(&below, next);
    }
    link_ref(ph_ref_at(f->r, ref), ref, next);
    if (before == PH_NONE) {
        *bin = ref;
    } else {
        link_ref(ph_ref_at(f->r, before), before, ref);
    }
    *after = ref;
}

PH_TIER(mesh) void ph_feed_start(struct ph_feed *f, struct ph_renderer *r, uint32_t band)
{
    f->r = r;
    f->band = band;
    f->ref = r->config.bins[band];
    f->draw = NULL;
    f->next_first = 0;
}

PH_TIER(mesh) void ph_feed_find(struct ph_feed *f, uint32_t ref)
{
    const struct ph_renderer *const r = f->r;
    while (ref >= f->next_first) {
        f->draw = ph_at(r, f->draw == NULL ? r->list.first : f->draw->next);
        f->next_first = f->draw->next == PH_NONE ? PH_NONE : ((const struct ph_draw *)ph_at(r, f->draw->next))->first;
    }
}
