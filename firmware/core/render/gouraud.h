/* gouraud: what only Gouraud triangles need. Private to firmware/core. */
#ifndef PH_GOURAUD_H
#define PH_GOURAUD_H

#include "band.h"

/* A shading names it, and nothing else refers to these functions. */
struct ph_gouraud {
    /* Makes a small triangle of one that has a plane of codes, if it is as narrow as a small one: it is drawn and
     * carried on faster. Edges and planes stay what they are. */
    void (*take_tall)(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                      const struct ph_sides *sides);
    uint32_t (*draw_long)(const struct ph_triangle *t, const struct ph_band *band); /* raster_rows.h: ph_draw_long */
};

extern const struct ph_gouraud ph_gouraud;

#endif
