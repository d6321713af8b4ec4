/* raster: the ways in which the rows of a triangle are drawn; raster.c chooses one. Private to these files. */
#ifndef PH_RASTER_H
#define PH_RASTER_H

#include "band.h"
#include "small_texels.h"

/* Whether what draws a triangle takes the stride for the width of the picture. */
static inline bool ph_ends_at_stride(const struct ph_triangle *t)
{
    return t->block != PH_BLOCK_NONE || t->kind == PH_KIND_GOURAUD || t->kind == PH_KIND_SMALL_WIDE;
}

/* Column 0 of the row in which a triangle goes on. */
struct ph_place {
    uint16_t *depth, *pixels;
    uint32_t stride; /* pixels; see ph_ends_at_stride */
    bool wide;       /* rows may leave the picture, or have more than PH_SMALL_COLUMNS pixels */
};

/* Each draws what of a triangle lies in the band, and returns the pixels tested. */
uint32_t ph_walk(const struct ph_triangle *t, const struct ph_band *band);       /* row by row */
uint32_t ph_draw_wide(const struct ph_triangle *t, const struct ph_band *band);  /* Gouraud, depth of 16 bits */
uint32_t ph_draw_large(const struct ph_triangle *t, const struct ph_band *band); /* neither small nor exact */
uint32_t ph_draw_exact(const struct ph_triangle *t, const struct ph_band *band); /* depth takes 64 bits */

/* Draws the rows of r, which crosses octaves. texels: NULL without a texture. */
uint32_t ph_draw_rows_split(const struct ph_triangle *t, struct ph_small_triangle *r, struct ph_place at,
                            struct ph_small_texels *texels);

/* Draws a triangle without texture that is not small. */
static inline uint32_t ph_draw_plain(const struct ph_triangle *t, const struct ph_band *band)
{
    return t->kind == PH_KIND_GOURAUD && t->block != PH_BLOCK_LINEAR && !band->depth24 ? ph_draw_wide(t, band)
                                                                                       : ph_walk(t, band);
}

#endif
