/*
 * samples: an antialiased picture's pixels from its samples. Private to firmware/core.
 */
#ifndef PH_SAMPLES_H
#define PH_SAMPLES_H

#include "band.h"

/* Columns, from the first to behind the last. */
struct ph_columns {
    int32_t from, end;
};

/* The columns of pixels in which a band may differ from the background: edges are rounded, and lines have a width. */
void ph_samples_columns(struct ph_renderer *r, uint32_t band, struct ph_columns *in);

/* Clears the samples of these columns: nothing is drawn beside them, and nothing is read. */
void ph_samples_clear(const struct ph_band *rows, const struct ph_columns *in, uint16_t background);

/* Makes pixels of the samples of a band; outside `in` they are the background's. */
void ph_samples_resolve(const struct ph_band *rows, const struct ph_columns *in, uint16_t background, uint16_t *pixels);

#endif
