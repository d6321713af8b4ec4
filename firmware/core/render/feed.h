/*
 * feed: the references of a frame, sorted into bands, and those of a band one after the other. Private to
 * firmware/core.
 */
#ifndef PH_FEED_H
#define PH_FEED_H

#include "list.h"
#include "setting.h"

/* The references of a band, one after the other. */
struct ph_feed {
    struct ph_renderer *r;
    uint32_t ref, band;         /* ref: PH_NONE at the end */
    const struct ph_draw *draw; /* of the last reference that was looked up; NULL before the first */
    uint32_t next_first;        /* first reference of the draw after that */
    struct ph_setting setting;
};

/* Puts the references of a frame into the lists of their bands. */
void ph_feed_sort(struct ph_renderer *r);

/* Begins with the first reference of a band. */
void ph_feed_start(struct ph_feed *f, struct ph_renderer *r, uint32_t band);

/* Finds the draw of a reference that is behind the current draw. */
void ph_feed_find(struct ph_feed *f, uint32_t ref);

/* The next reference of the band's list when it is PH_LINK_FAR or further away: the next one that has rows in the band.
 * It may be carried already; then it is drawn twice, and the second time changes nothing. */
uint32_t ph_feed_far(const struct ph_feed *f, uint32_t ref);

/* The reference after number ref in the list of a band; PH_NONE at the end. */
PH_TIER(mesh) static inline uint32_t ph_feed_next(const struct ph_feed *f, uint32_t ref)
{
    const uint32_t link = ph_ref_at(f->r, ref)->link;
    return link == 0 ? PH_NONE : link < PH_LINK_FAR ? ref + link : ph_feed_far(f, ref);
}

/* Puts a reference into the list of the band below; *after is the one put there before, or PH_NONE. */
void ph_feed_put_below(const struct ph_feed *f, uint32_t ref, uint32_t *after);

#endif
