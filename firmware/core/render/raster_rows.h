/* raster_rows: rows of triangles as kernels draw them, and of triangles that cross octaves. Private to firmware/core.
 */
#ifndef PH_RASTER_ROWS_H
#define PH_RASTER_ROWS_H

#include "band.h"
#include "small_texels.h"

/* Whether what draws a triangle takes the stride for the width of the picture. */
static inline bool ph_ends_at_stride(const struct ph_triangle *t)
{
    return t->block != PH_BLOCK_NONE || t->kind == PH_KIND_GOURAUD || t->kind == PH_KIND_SMALL_OWN;
}

/* Column 0 of the row in which a triangle goes on. */
struct ph_place {
    uint16_t *depth, *pixels;
    uint32_t stride; /* pixels; see ph_ends_at_stride */
    /* ph_small_gouraud; or ph_long_gouraud, if rows may leave the picture or have more than PH_SMALL_COLUMNS pixels; or
     * those of dithered light */
    ph_gouraud_kernel *draw_gouraud;
    uint32_t light_down; /* PH_LIGHT_DOWN, or PH_DITHERED_DOWN */
};

/* Steps n rows down, which are the upper ones and so many of the lower ones; those that are left become the upper rows.
 */
static inline void ph_skip_to_lower_rows(struct ph_small_triangle *r, uint32_t n, uint32_t lower, uint32_t left)
{
    const uint32_t dx = (uint32_t)r->lower.dx, x = (uint32_t)r->lower.x + lower * dx;
    r->d += n * r->d_dy;
    r->light += n * r->light_dy;
    if (r->lower_is_right) {
        r->left += n * r->left_dx;
        r->right = x;
        r->right_dx = dx;
    } else {
        r->right += n * r->right_dx;
        r->left = x;
        r->left_dx = dx;
    }
    r->upper_rows = (uint16_t)left;
    r->lower_rows = 0;
}

/* Steps n rows down, through both halves. Without lower rows the edges go on as they are. */
static inline void ph_skip_rows_of(struct ph_small_triangle *r, uint32_t n)
{
    if (n < r->upper_rows || r->lower_rows == 0) {
        ph_small_step(r, n);
        r->upper_rows = (uint16_t)(r->upper_rows - n);
    } else {
        const uint32_t lower = n - r->upper_rows;
        ph_skip_to_lower_rows(r, n, lower, r->lower_rows - lower);
    }
}

/* Steps a small triangle n rows down, through both halves. */
void ph_skip_rows(struct ph_small_triangle *r, uint32_t n);

/* ph_draw_above for a small triangle that begins in the band, and whose depth is a plane of codes. */
static inline uint32_t ph_draw_above_with(struct ph_triangle *t, const struct ph_band *band,
                                          ph_gouraud_kernel *draw_gouraud)
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    const uint32_t rows = (uint32_t)(band->y1 - t->y_top), upper_rows = small->upper_rows, stride = band->stride;
    const uint32_t lower_rows = small->lower_rows, start = (uint32_t)(t->y_top - band->y0) * stride;
    uint16_t *const depth = (uint16_t *)band->depth + start, *const pixels = band->pixels + start;
    t->y_top = (int16_t)band->y1;
    if (rows < upper_rows) {
        small->upper_rows = (uint16_t)rows;
        small->lower_rows = 0;
        const uint32_t count = draw_gouraud(small, depth, pixels, 2 * stride);
        ph_small_step(small, rows);
        small->upper_rows = (uint16_t)(upper_rows - rows);
        small->lower_rows = (uint16_t)lower_rows;
        return count;
    }
    small->lower_rows = (uint16_t)(rows - upper_rows);
    const uint32_t count = draw_gouraud(small, depth, pixels, 2 * stride);
    const uint32_t below = small->lower_rows;
    ph_skip_to_lower_rows(small, rows, below, lower_rows - below);
    return count;
}

/* Cuts r, the rows of t or a copy of them, down to its rows in the band. Returns the place of the first of them. */
struct ph_place ph_cut_rows(const struct ph_triangle *t, const struct ph_band *band, struct ph_small_triangle *r);

/* Draws the part of a Gouraud triangle that lies in the band, with depth of 16 bits. draw_gouraud, light_down:
 * ph_long_gouraud and PH_LIGHT_DOWN, or ph_long_dithered and PH_DITHERED_DOWN. Returns the pixels tested. */
uint32_t ph_draw_long(const struct ph_triangle *t, const struct ph_band *band, ph_gouraud_kernel *draw_gouraud,
                      uint32_t light_down);

/* Draws the part of a small triangle that lies in the band; it crosses octaves, and may have a texture. Only formats
 * name this function and the next one. */
uint32_t ph_draw_split(const struct ph_triangle *t, const struct ph_band *band);

/* Draws the rows of r, which crosses octaves. texels: NULL without a texture. */
uint32_t ph_draw_rows_split(const struct ph_triangle *t, struct ph_small_triangle *r, const struct ph_place *place,
                            struct ph_small_texels *texels);

#endif
