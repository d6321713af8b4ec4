/*
 * Colours: red, green and blue are three planes on the screen. A channel of n bits stands in the upper n bits of 32,
 * and half a step is added, so that it is rounded to nearest. See colours.h.
 */
#include "colours.h"

#include "colour.h"
#include "edge.h"
#include "span.h"

/* n pixels of a row. */
struct piece_of_row {
    uint16_t *pixels;
    void *depth; /* depth and pixels of the first pixel */
    uint32_t n, d, gd;
    uint32_t red, green, blue; /* at the first pixel */
};

static inline bool is_nearer(void *depth, uint32_t i, bool depth24, uint32_t d)
{
    return depth24 ? ph_nearer24((uint32_t *)depth + i, d) : ph_nearer16((uint16_t *)depth + i, d);
}

/* Draws pixels along which the depth code is linear, and steps the colours. */
static inline void draw_piece(const struct ph_triangle *t, bool depth24, struct piece_of_row *p)
{
    const uint32_t gd = p->gd, red_gx = t->as.large.of.colours[0].gx;
    const uint32_t green_gx = t->as.large.of.colours[1].gx, blue_gx = t->as.large.of.colours[2].gx;
    uint32_t d = p->d, red = p->red, green = p->green, blue = p->blue;
    for (uint32_t i = 0; i < p->n; i++) {
        if (is_nearer(p->depth, i, depth24, d)) {
            p->pixels[i] = ph_wire16((uint16_t)(red >> 27 << 11 | green >> 26 << 5 | blue >> 27));
        }
        d += gd;
        red += red_gx;
        green += green_gx;
        blue += blue_gx;
    }
    p->red = red;
    p->green = green;
    p->blue = blue;
}

static void draw_row(const struct ph_triangle *t, const struct ph_band *band, uint32_t x, uint32_t y, uint32_t left)
{
    const uint32_t at = (y - (uint32_t)band->y0) * band->stride + x;
    const struct ph_plane *const a = t->as.large.of.colours, *const depth = &t->as.large.depth.as.plane;
    uint32_t d = ph_plane_at(depth, x, y);
    struct piece_of_row p = {.red = ph_plane_at(&a[0], x, y),
                             .green = ph_plane_at(&a[1], x, y),
                             .blue = ph_plane_at(&a[2], x, y),
                             .depth = ph_depth_from(band->depth, at, band->depth24)};
    p.pixels = band->pixels + at;
    for (; left > 0; left -= p.n) { /* each turn draws at least one pixel */
        p.n = left;
        const struct ph_piece piece = ph_depth_piece(t, d, &p.n);
        p.d = piece.d;
        p.gd = piece.gd;
        if (band->depth24) {
            draw_piece(t, true, &p);
        } else {
            draw_piece(t, false, &p);
        }
        p.pixels += p.n;
        p.depth = ph_depth_from(p.depth, p.n, band->depth24);
        d += depth->gx * p.n;
    }
}

uint32_t ph_draw_colours(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (!ph_rows_of_half_apart(t, band, half, &in)) {
            continue;
        }
        for (; in.y < in.y_end; in.y++) {
            int32_t from, to;
            if (ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
                draw_row(t, band, (uint32_t)from, (uint32_t)in.y, (uint32_t)(to - from));
                count += (uint32_t)(to - from);
            }
        }
    }
    return count;
}
