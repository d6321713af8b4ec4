/*
 * bands_loop: the loop over the triangles of a band, which is compiled once for all light and once for dithered light.
 * Private to firmware/core.
 */
#ifndef PH_BANDS_LOOP_H
#define PH_BANDS_LOOP_H

#include "band_rest.h"
#include "cores.h"
#include "fog.h"
#include "points.h"
#include "raster.h"
#include "setup.h"

#define PH_ASKS_REFS 16 /* after so many references one core asks whether the other is idle */
#define PH_HELPED    0  /* draw_begun returns this instead of a reference when the other core has become idle */

/* bands.c: prepares the draw of a reference that is behind the current draw. */
void ph_enter_draw(struct ph_feed *f, uint32_t ref);

/* What is known of a triangle that was set up. */
enum ph_fast_draw {
    PH_FAST_DRAWN, /* it ended in the band, and is drawn */
    PH_FAST_ABOVE, /* it can be drawn fast, begins in the band and goes on below */
    PH_FAST_NOT,
};

/* What may be faster than the general case. */
struct ph_fast_draws {
    /* Sets up a triangle as ph_setup does. Draws it, too, and counts its pixels, where it can do so fast. */
    enum ph_fast_draw (*draw_whole)(const struct ph_feed *f, const struct ph_ref *ref, struct ph_triangle *t,
                                    const struct ph_band *rows, uint32_t *fragments);
    /* ph_draw_above, ph_draw_end. known: what draw_whole returned */
    uint32_t (*draw_above)(struct ph_triangle *t, const struct ph_band *band, enum ph_fast_draw known);
    uint32_t (*draw_end)(const struct ph_triangle *t, const struct ph_band *band);
};

static inline struct ph_triangle *ph_take_slot_or(struct ph_renderer *r, struct ph_triangle *scratch)
{
    struct ph_triangle *const t = ph_take_slot(r);
    return t != NULL ? t : scratch;
}

/* Draws a triangle that stands in a slot and goes on below the band. Returns its pixels. carry: as in struct ph_rest.
 * fast, known: as in ph_rest_loop. */
static inline uint32_t ph_draw_beyond(struct ph_triangle ***carry, struct ph_triangle *t, const struct ph_band *rows,
                                      const struct ph_fast_draws *fast, enum ph_fast_draw known)
{
    **carry = t;
    *carry = &t->next;
    return fast != NULL ? fast->draw_above(t, rows, known) : ph_draw_above(t, rows);
}

/* Whether the other core is idle, and there is a row for each. Without another core this saves the call. */
static inline bool ph_is_helped(const struct ph_renderer *r, const struct ph_band *rows)
{
    return r->config.other_core != NULL && rows->y1 - rows->y0 >= 2 && r->config.cores->is_idle(r);
}

/* Draws the carried triangles that come before the next reference, and prepares its draw. Returns the first
 * reference for which there is something to do here; none at the end of the list. fast: as below. */
static inline __attribute__((always_inline)) uint32_t ph_begun_loop(struct ph_feed *f, struct ph_rest *rest,
                                                                    const struct ph_fast_draws *fast)
{
    const uint32_t ref = f->ref;
    struct ph_renderer *const r = f->r;
    const struct ph_band *const rows = rest->rows;
    const int32_t y1 = rows->y1;
    struct ph_triangle *t = rest->begun, **carry = rest->carry;
    uint32_t fragments = rest->fragments;
    while (t != NULL && t->order < ref) {
        struct ph_triangle *const next = t->next;
        if (t->y_bottom <= y1) {
            fragments += fast != NULL ? fast->draw_end(t, rows) : ph_draw_end(t, rows);
            ph_free_slot(r, t);
        } else {
            fragments += ph_draw_beyond(&carry, t, rows, fast, PH_FAST_NOT);
        }
        t = next;
    }
    rest->carry = carry;
    rest->begun = t;
    rest->fragments = fragments;
    if (ref >= f->next_first && ref != PH_NONE) {
        ph_enter_draw(f, ref);
    }
    const uint32_t after = t != NULL ? t->order + 1 : PH_NONE;
    const uint32_t stop = after < f->next_first ? after : f->next_first;
    if (r->config.other_core == NULL) {
        return stop;
    }
    const uint32_t asks = stop < ref + PH_ASKS_REFS ? stop : ref + PH_ASKS_REFS;
    return ph_is_helped(r, rows) ? PH_HELPED : asks;
}

/* Draws the triangles of a band that are left, until the other core is idle: each is set up, drawn, and carried on if
 * it goes on below. fast: NULL, or what is asked first. It is a constant. */
static inline __attribute__((always_inline)) void
ph_rest_loop(struct ph_feed *f, struct ph_rest *rest, uint32_t (*draw_begun)(struct ph_feed *f, struct ph_rest *rest),
             const struct ph_fast_draws *fast)
{
    struct ph_renderer *const r = f->r;
    const struct ph_band *const rows = rest->rows;
    const int32_t y1 = rows->y1;
    struct ph_triangle scratch, *t = ph_take_slot_or(r, &scratch);
    const struct ph_ref *const first = ph_ref_at(r, 0);
    uint32_t fragments = 0, ref = f->ref;
    for (uint32_t stop = 0;;) {
        if (ref >= stop) { /* so it is at the end of the list */
            f->ref = ref;
            stop = draw_begun(f, rest);
            if (ref == PH_NONE || stop == PH_HELPED) {
                break;
            }
        }
        const struct ph_ref *const at = first - ref;
        enum ph_fast_draw known = PH_FAST_NOT;
        if (fast == NULL) {
            ph_setup(&f->setting, at, t);
        } else if ((known = fast->draw_whole(f, at, t, rows, &fragments)) == PH_FAST_DRAWN) {
            ref = ph_next_ref(f, at, ref);
            continue;
        }
        t->order = ref;
        ref = ph_next_ref(f, at, ref);
        if (t->y_bottom <= y1) {
            fragments += ph_draw_fresh(t, rows);
        } else if (t != &scratch) {
            fragments += ph_draw_beyond(&rest->carry, t, rows, fast, known);
            t = ph_take_slot_or(f->r, &scratch); /* not r: no register is left for it in this loop */
        } else {
            fragments += ph_draw_triangle(t, rows);
            ph_feed_put_below(f, t->order, &rest->put);
        }
    }
    rest->fragments += fragments;
    if (t != &scratch) {
        ph_free_slot(r, t);
    }
}

/* Draws the triangles of a band, with the other core from the moment when it is idle. */
static inline __attribute__((always_inline)) void ph_triangles_loop(struct ph_feed *f, const struct ph_band *rows,
                                                                    void (*draw_rest)(struct ph_feed *f,
                                                                                      struct ph_rest *rest))
{
    struct ph_renderer *const r = f->r;
    struct ph_rest rest = {r, rows, r->carried, &r->carried, PH_NONE, 0};
    bool clears = r->ahead != NULL || ph_is_helped(r, rows);
    for (const struct ph_triangle *t = r->ahead; t != NULL; t = t->next) {
        f->ref = ph_feed_next(f, t->order);
    }
    bool more = clears;
    if (!clears) {
        ph_clear_rows(r, rows);
        draw_rest(f, &rest);
        more = rest.begun != NULL || f->ref != PH_NONE;
    }
    for (; more; clears = false) {
        more = r->config.cores->draw_chunk(f, &rest, clears);
    }
    *rest.carry = NULL;
    r->stats.fragments += rest.fragments;
}

/* Draws the band that a feed stands at: its triangles, its points, and what comes after them. */
static inline __attribute__((always_inline)) void
ph_rows_loop(struct ph_feed *f, struct ph_band *rows, void (*draw_rest)(struct ph_feed *f, struct ph_rest *rest))
{
    struct ph_renderer *const r = f->r;
    ph_triangles_loop(f, rows, draw_rest);
    if (r->points != NULL) {
        r->points->draw_opaque(r, rows, f->band);
    }
    if (r->after != NULL) {
        rows->coarse = NULL; /* blended triangles are drawn into rows of their own */
        r->after->draw_after(r, rows);
    } else if (r->fog != NULL) {
        r->fog->fog_band(r, rows);
    }
}

#endif
