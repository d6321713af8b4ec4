/* raster_rows: rows of triangles as kernels draw them, and of triangles that cross octaves. Private to firmware/core.
 */
#ifndef PH_RASTER_ROWS_H
#define PH_RASTER_ROWS_H

#include "band.h"
#include "small_texels.h"

/* Whether what draws a triangle takes the stride for the width of the picture. */
static inline bool ph_ends_at_stride(const struct ph_triangle *t)
{
    return t->block != PH_BLOCK_NONE || t->kind == PH_KIND_GOURAUD || t->kind == PH_KIND_SMALL_LONG;
}

/* Column 0 of the row in which a triangle goes on. */
struct ph_place {
    uint16_t *depth, *pixels;
    uint32_t stride; /* pixels; see ph_ends_at_stride */
    bool long_rows;  /* rows may leave the picture, or have more than PH_SMALL_COLUMNS pixels */
};

/* Draws the part of a Gouraud triangle that lies in the band, with depth of 16 bits. Returns the pixels tested. */
uint32_t ph_draw_long(const struct ph_triangle *t, const struct ph_band *band);

/* Draws the rows of r, which crosses octaves. texels: NULL without a texture. */
uint32_t ph_draw_rows_split(const struct ph_triangle *t, struct ph_small_triangle *r, struct ph_place at,
                            struct ph_small_texels *texels);

#endif
