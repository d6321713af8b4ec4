/* band_rest: what one core and two share to draw a band. Private to firmware/core. */
#ifndef PH_BAND_REST_H
#define PH_BAND_REST_H

#include "feed.h"

/* The rest of a band that is being drawn. */
struct ph_rest {
    struct ph_renderer *r;
    const struct ph_band *rows;
    struct ph_triangle *begun;  /* those that were carried on, as far as they are not drawn */
    struct ph_triangle **carry; /* where the next one is linked that is carried on from here */
    uint32_t put, fragments;    /* put: what ph_feed_put_below takes */
};

/* The reference after number ref, which stands at `at`. */
static inline uint32_t ph_next_ref(const struct ph_feed *f, const struct ph_ref *at, uint32_t ref)
{
    return at->link - 1u < PH_LINK_FAR - 1u ? ref + at->link : ph_feed_next(f, ref);
}

/* slots.c: takes a slot that was never used. NULL: there is none. */
struct ph_triangle *ph_take_fresh_slot(struct ph_renderer *r);

/* Takes an unused slot. NULL: there is none. */
static inline struct ph_triangle *ph_take_slot(struct ph_renderer *r)
{
    struct ph_triangle *const t = r->slots;
    if (t == NULL) {
        return ph_take_fresh_slot(r);
    }
    r->slots = t->next;
    return t;
}

/* Gives a slot back. */
static inline void ph_free_slot(struct ph_renderer *r, struct ph_triangle *t)
{
    t->next = r->slots;
    r->slots = t;
}

/* Clears the depth of a band's rows. */
void ph_clear_depth(const struct ph_band *rows);

/* Clears the rows of a band; of samples only depth, see ph_samples_clear. */
void ph_clear_rows(const struct ph_renderer *r, const struct ph_band *rows);

/* Draws the band that a feed stands at: its triangles, its points, and what comes after them. */
void ph_draw_rows(struct ph_feed *f, struct ph_band *rows);

/* bands_cores.c: draws some triangles of a band with two cores: those that are set up already, or the next. Triangles
 * that come next are set up meanwhile, also of the band below, where no reference is put any more then. False: the band
 * is finished. */
bool ph_draw_chunk(struct ph_feed *f, struct ph_rest *rest, bool clears);

#endif
