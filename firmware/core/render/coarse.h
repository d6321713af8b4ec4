/*
 * coarse: coarse depth, what a band knows of its depths without a look at pixels. Private to firmware/core.
 *
 * It is a list of occluders: rows between two edges in which every pixel has at least some depth already. A large
 * triangle that is drawn becomes one: its edges, and the farthest depth it can have between them. A triangle that is no
 * nearer and lies between the edges of an occluder is hidden: it would change no pixel, so it is not drawn. Depths only
 * come nearer while a band is drawn, so what an occluder says stays true until the band is finished.
 *
 * Two triangles that share an edge walk it through the same columns (edge.h), and so they become one occluder. Neither
 * the two halves of a quad nor a band's height leave a gap, and a test takes a few comparisons however many pixels it
 * spares. Triangles under PH_OCCLUDER_LEAST pixels in a band neither become occluders nor pay for it. Those of fewer
 * than PH_OCCLUDED_ROWS rows and small ones (ph_small_triangle) are not tested. Depth has to be a plane of codes
 * (PH_BLOCK_NONE). struct ph_config names the struct ph_occlusion, and nothing else refers to what it names.
 */
#ifndef PH_COARSE_H
#define PH_COARSE_H

#include "band.h"
#include "render.h"

#define PH_OCCLUDERS      2
#define PH_OCCLUDER_LEAST 512
#define PH_OCCLUDED_ROWS  8

struct ph_occluder {
    struct ph_half_rows in;
    uint32_t least; /* no pixel's depth is below: as in ph_depth.as.plane */
};

struct ph_coarse {
    uint32_t count; /* 0 when a band begins */
    const struct ph_occlusion *occlusion;
    struct ph_occluder at[PH_OCCLUDERS];
};

struct ph_occlusion {
    /* Draws a large triangle whose depth is a plane of codes, or only counts its pixels if an occluder hides it. One of
     * at least PH_OCCLUDER_LEAST pixels becomes an occluder. The band must have coarse depth. */
    uint32_t (*draw_unless_hidden)(const struct ph_triangle *t, const struct ph_band *band);
};

#endif
