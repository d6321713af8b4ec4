/* raster_walk: triangles that are walked row by row, and single pixels. Private to firmware/core. */
#ifndef PH_RASTER_WALK_H
#define PH_RASTER_WALK_H

#include "band.h"

/* n pixels of a row of a triangle. */
struct ph_run {
    uint16_t *pixels;
    void *depth;            /* as in struct ph_band; pixels and depth are those of the first pixel */
    uint32_t n, d, gd;      /* d: depth at the first pixel, in units of the plane or as a code, and per pixel */
    uint32_t light, glight; /* Gouraud: at the first pixel, and per pixel; else not read */
};

/* Draw a run along which the depth code is linear: codes of 16 bits, in one colour only; codes of 24 bits; linear-w.
 * Only formats name these functions and the next two. */
void ph_draw_run(const struct ph_triangle *t, const struct ph_run *run);
void ph_draw_run24(const struct ph_triangle *t, const struct ph_run *run);
void ph_draw_run_linear(const struct ph_triangle *t, const struct ph_run *run);

/* Draws a row of a flat triangle whose float of 16 bits crosses octaves. octave: one of the last row's, a guess. */
void ph_draw_flat_across(const struct ph_triangle *t, const struct ph_band *band, struct ph_octave *octave,
                         const struct ph_run *row);

/* Draws the part of a triangle that lies in the band, in linear-w or with codes of 24 bits; it has one colour or is a
 * Gouraud one. Returns the pixels tested. */
uint32_t ph_walk(const struct ph_triangle *t, const struct ph_band *band);

/* Draws the part of a triangle of one colour that lies in the band, with codes of 16 bits. Returns the pixels tested.
 */
uint32_t ph_walk_flat(const struct ph_triangle *t, const struct ph_band *band);

/* Draws pixel (x, y) of a flat triangle whose depth is not exact; the pixel lies in the band. */
void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band);

#endif
