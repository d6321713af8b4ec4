/*
 * samples: antialiased pictures, whose pixels have four samples each. Private to firmware/core.
 *
 * struct ph_config names the struct ph_antialiasing, and nothing else refers to what it names: so the linker leaves it
 * out of a program that draws without. samples.c makes pixels of a band's samples, samples_triangles.c draws a band,
 * and has what is particular about its triangles and lines.
 */
#ifndef PH_SAMPLES_H
#define PH_SAMPLES_H

#include "band.h"

struct ph_feed;
struct ph_setting;

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

/* Dithered light has one of its own: see dither.c. */
struct ph_antialiasing {
    /* Draws the band that a feed stands at into samples, and makes pixels of them. */
    void (*draw_samples)(struct ph_feed *f, struct ph_band *rows, uint16_t *pixels);
    /* Ends the preparation of a draw: lets ph_setup_fast take longer sides. */
    void (*prepare)(struct ph_setting *s);
    /* Makes a small triangle that has long rows one of PH_KIND_SMALL_OWN. has_rows: it exceeds a small one in height,
     * too. */
    void (*set_kind)(struct ph_triangle *t, bool has_rows);
    /* setup.h */
    enum ph_excess (*excess_of)(const struct ph_setting *s, const struct ph_sides *sides,
                                const struct ph_vertex *const v[3]);
    /* Sets up a line. */
    void (*setup_sample_line)(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t);
};

#endif
