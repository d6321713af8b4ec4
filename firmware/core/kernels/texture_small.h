/*
 * texture_small: the kernels that draw rows of a small textured triangle (see texels.h). See kernels.h.
 *
 * u and v are as in texture_tile.h, also in their pairs of pixels, but the second differences do not change: over the
 * whole triangle u and v are polynomials of the second order. Columns count from one of the triangle's own; they may be
 * negative.
 */
#ifndef PH_TEXTURE_SMALL_H
#define PH_TEXTURE_SMALL_H

#include "texel_row.h"

#include <stdbool.h>

struct ph_texel_line {
    uint32_t at, step;       /* of the row */
    uint32_t at_dy, step_dy; /* how much they grow to the row below */
    uint32_t at_ddy;         /* how much at_dy grows */
    uint32_t bend;
};

struct ph_texel_run;

/* Draws rows of a run: see ph_texel_run_rows. */
typedef uint32_t ph_texel_run_kernel(struct ph_texel_run *r, struct ph_texel_row *row);

struct ph_texel_run {
    struct ph_texel_rows row;                               /* until the lower edge takes over; above 0 rows */
    uint32_t x;                                             /* column 0 in the picture, for the caller's use */
    struct ph_texel_line u, v;                              /* units as in ph_tile_rows */
    uint32_t lower_rows, lower_is_right, lower_x, lower_dx; /* 0 rows or more; 0, 1; as left and left_dx */
    ph_texel_row_kernel *draw_row;                          /* of ph_texel_run_rows: draws a row */
    ph_texel_run_kernel *draw_rows;                         /* calls it; for the caller's use */
};

/* Draws the rows and returns the number of their pixels. No row has more than PH_SMALL_COLUMNS. Afterwards u and v
 * stand at the next row. */
uint32_t ph_texture_small(struct ph_texel_run *r);

/* Draws rows with light or a filter until none are left above the lower edge, or none at all, or until one whose light
 * is not 0 .. 32 everywhere: that one is not drawn, row->level becomes UINT32_MAX, row->light its first light. Returns
 * the number of pixels, also of that row. Of `row` the members are set that are the same in all rows: gd, the masks,
 * texels, light_step, and both bends. */
ph_texel_run_kernel ph_texel_run_rows;

/* ph_texel_run_rows where draw_row is ph_texel_row_lit. */
ph_texel_run_kernel ph_texel_run_rows_lit;

/* Goes on from the upper rows to the lower ones, where the lower edge takes over; false if there are none. */
static inline bool ph_texel_run_lower(struct ph_texel_run *r)
{
    if (r->lower_is_right != 0) {
        r->row.right = r->lower_x;
        r->row.right_dx = r->lower_dx;
    } else {
        r->row.left = r->lower_x;
        r->row.left_dx = r->lower_dx;
    }
    r->row.rows = r->lower_rows;
    r->lower_rows = 0;
    return r->row.rows > 0;
}

/* Steps the coefficients of u or v to the next row. */
static inline void ph_texel_line_down(struct ph_texel_line *l)
{
    l->at += l->at_dy;
    l->step += l->step_dy;
    l->at_dy += l->at_ddy;
}

#endif
