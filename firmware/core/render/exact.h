/*
 * exact: depth of triangles whose plane does not fit 32 bits. Private to firmware/core.
 *
 * Such a triangle is nearly edge-on, or crosses many octaves of a float. Its plane has 64 bits.
 *
 * The sum is exact modulo 2^64 however steep the plane is. Only at a centre that lies outside the corners by the
 * rounding of an edge may it be far off; so it is clamped to the corners' range.
 *
 * The unit is 2^-56 of N/w - N/f, for linear-w of N/w. The triangle is drawn in runs: strips of rows where
 * that is possible, else parts of a row. In a run depth is stepped in 32 bits; it stays in one octave of a float, and
 * so its codes have all of their bits.
 */
#ifndef PH_EXACT_H
#define PH_EXACT_H

#include "sides.h"
#include "triangle.h"

#define PH_EXACT_RUN  512 /* pixels; the rounded step of a run is half a 24-bit code off at its ends */
#define PH_EXACT_ROWS 16  /* a strip of rows begins at each multiple */

/* How depth becomes codes in the frame's format; NULL in the fixed formats. Only formats name these. */
extern const struct ph_exact_ways ph_exact_float, ph_exact_linear;

/* Makes an exact plane of a depth for which 32 bits are not enough; `over_w` is set already. */
void ph_set_exact(const struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                  const struct ph_sides *sides, struct ph_depth *depth);

/* Rows y .. y_end - 1 of one half of a triangle, and its edges at row y. */
struct ph_exact_strip {
    struct ph_half_rows rows;
    int32_t width; /* of the picture */
    const struct ph_exact_ways *ways;
};

/* Makes `run`, a copy of t, these rows, if their depth is in one octave and far from the ends of the range. Else
 * false. */
bool ph_exact_rows(const struct ph_triangle *t, const struct ph_exact_strip *strip, struct ph_triangle *run);

/* Makes `run`, a copy of t, the next run of a row from pixel (x, y) on. Returns its pixels, at least one. */
int32_t ph_exact_run(const struct ph_triangle *t, const struct ph_exact_ways *ways, int32_t x, int32_t x_end, int32_t y,
                     struct ph_triangle *run);

#endif
