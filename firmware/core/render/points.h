/*
 * points: squares and discs that face the viewer; render.h has the rule of their pixels. Private to firmware/core.
 *
 * All pixels of a point have one depth code and one colour, so a point needs no set-up: what is listed of it is what
 * its pixels take, and it lies where its transformed vertex was. The points of a call have a list for each band, in the
 * order of the points. A point that goes on below a band is moved to the list of the next one.
 */
#ifndef PH_POINTS_H
#define PH_POINTS_H

#include "list.h"

enum ph_spot_shape { PH_SPOT_PIXEL, PH_SPOT_SQUARE, PH_SPOT_DISC };

/* A point on the screen. */
struct ph_spot {
    uint32_t code; /* of depth, as in the buffer; from bit 24 on its shape, enum ph_spot_shape */
    union {
        uint32_t pixel; /* its number in the picture, row by row */
        struct {
            uint16_t x0, x1, y0, y1; /* columns x0 .. x1 - 1 and rows y0 .. y1 - 1, which lie in the picture */
        } square;
        struct {
            int32_t x_radius, y; /* of the centre, 1/256 px; the radius, 1/16 px, in the lower 12 bits, x above */
        } disc;
    } of;
    uint16_t colour; /* wire order */
    uint16_t next;   /* number of the next one of its list, or 0 */
};

static inline unsigned ph_spot_shape(const struct ph_spot *s)
{
    return s->code >> 24;
}

/* The points of a call. They stand behind it, and their numbers count from its own place, in points. */
struct ph_cloud {
    uint32_t next;     /* place of the cloud of the next call; PH_NONE: there is none */
    bool is_blended;   /* it has a draw in the list, whose base is the place of this */
    bool goes_below;   /* a point may have several rows */
    uint16_t first[1]; /* of the points in the list of each band of the picture, or 0 */
};

/* What draws points. Only what lists points names it, and gives it to the renderer: so the linker leaves it out of a
 * program without points. */
struct ph_pointing {
    /* Draws the opaque points of band number `number`, and moves points of the band above to it. */
    void (*draw_opaque)(struct ph_renderer *r, const struct ph_band *band, uint32_t number);
    /* Draws the points of a draw of PH_DRAW_POINTS into rows of a band. Returns the pixels tested. */
    uint32_t (*draw_blended)(const struct ph_renderer *r, const struct ph_band *band, const struct ph_draw *draw);
};

extern const struct ph_pointing ph_pointing;

#endif
