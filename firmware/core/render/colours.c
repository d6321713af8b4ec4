/*
 * Colours: red, green and blue are three planes on the screen. A channel of n bits stands in the upper n bits of 16,
 * and half a step is added, so that it is rounded to nearest, and so that none leaves its 16 bits as long as it is off
 * by less than that. A large triangle has 16 bits more behind these, and leaves them out along PIECE pixels. See
 * colours.h.
 */
/* Kits on armv6m: -O2. */
#include "colours.h"

#include "edge.h"
#include "span.h"

enum {
    PIECE = 256, /* pixels: their gradient, right to 2^-17, is off by 1/8 step of green in the end */
};

/* Draws a row with codes of 24 bits. */
static void draw_row24(const struct ph_small *row, uint32_t *depth, uint16_t *pixels)
{
    uint32_t d = row->rows.d, red_blue = row->rows.light, green = row->of.own.green.base;
    for (uint32_t n = row->rows.right >> 16; n > 0; n--, pixels++, depth++) {
        if (ph_nearer24(depth, d)) {
            *pixels = ph_pixel_colour(red_blue, green);
        }
        d += row->rows.gd;
        red_blue += row->rows.glight;
        green += row->of.own.green.gx;
    }
}

/* A channel of a large triangle in 16 bits, rounded. */
static inline uint32_t upper_half(uint32_t v)
{
    return (v + (1 << 15)) >> 16;
}

/* Draws n pixels of a row from x on, piece by piece. row: all is set that is the same in all rows. */
static void draw_row(const struct ph_triangle *t, const struct ph_band *band, struct ph_small *row, uint32_t x,
                     uint32_t y, uint32_t left)
{
    const struct ph_plane *const a = t->as.large.of.colours, *const depth = &t->as.large.depth.as.plane;
    for (uint32_t n; left > 0; left -= n, x += n) { /* each turn draws at least one pixel */
        n = left < PIECE ? left : PIECE;
        const uint32_t at = (y - (uint32_t)band->y0) * band->stride + x;
        const struct ph_piece piece = ph_depth_piece(t, ph_plane_at(depth, x, y), &n);
        row->rows.right = n << 16;
        row->rows.d = piece.d;
        row->rows.gd = piece.gd;
        row->rows.light = (ph_plane_at(&a[0], x, y) & 0xffff0000) | ph_plane_at(&a[2], x, y) >> 16;
        row->of.own.green.base = ph_plane_at(&a[1], x, y) >> (16 - PH_GREEN_LOG2);
        if (band->depth24) {
            draw_row24(row, (uint32_t *)band->depth + at, band->pixels + at);
        } else {
            ph_small_colours(row, (uint16_t *)band->depth + at, band->pixels + at, 0);
        }
    }
}

uint32_t ph_draw_colours(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct ph_plane *const a = t->as.large.of.colours;
    struct ph_small row = {.rows = {.upper_rows = 1, .glight = ph_red_blue(upper_half(a[0].gx), upper_half(a[2].gx))}};
    uint32_t count = 0;
    row.of.own.green.gx = upper_half(a[1].gx) << PH_GREEN_LOG2;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (!ph_rows_of_half_apart(t, band, half, &in)) {
            continue;
        }
        for (; in.y < in.y_end; in.y++) {
            int32_t from, to;
            if (ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
                draw_row(t, band, &row, (uint32_t)from, (uint32_t)in.y, (uint32_t)(to - from));
                count += (uint32_t)(to - from);
            }
        }
    }
    return count;
}
