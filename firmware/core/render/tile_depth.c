/*
 * Rows of a tile in one or two octaves of depth: each is drawn in 16.16 codes on both sides of the line on which the
 * octaves meet, which is walked as an edge. See tile_depth.h.
 */
#include "tile_depth.h"

#include "edge.h"
#include "planes.h"

PH_TIER(scenery)
bool ph_tile_octaves(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_tile_depth *depth)
{
    const struct ph_plane *const plane = &t->as.large.depth.as.plane;
    const uint32_t gx = ph_without_sign((int32_t)plane->gx), gy = ph_without_sign((int32_t)plane->gy);
    if (gx >> (30 - tile->width_log2) != 0 || gy >> (30 - tile->height_log2) != 0) { /* differences below 2^31 */
        return false;
    }
    const uint32_t right = ((1u << tile->width_log2) - 1) * plane->gx;
    const uint32_t below = ((1u << tile->height_log2) - 1) * plane->gy;
    const uint32_t d = ph_plane_at(plane, tile->x, tile->y);
    const uint32_t least = d + ((int32_t)right < 0 ? right : 0) + ((int32_t)below < 0 ? below : 0);
    const uint32_t most = d + ((int32_t)right < 0 ? 0 : right) + ((int32_t)below < 0 ? 0 : below);
    struct ph_octave *const least_in = &depth->octaves[0], *const most_in = &depth->octaves[1];
    depth->d = d;
    depth->d_dy = plane->gy;
    ph_octave_of(least_in, t, least, plane->gx);
    if (ph_octave_holds(least_in, least, most)) {
        most_in->up = least_in->up;
        return least <= most;
    }
    ph_octave_of(most_in, t, most, plane->gx);
    return least_in->size > 0 && most_in->size > 0 && least <= most && least_in->up - most_in->up < 2;
}
/* Draws rows in one octave; the first of them is row `row` of the tile. */
PH_TIER(scenery)
static void draw_rows_in_octave(const struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_tile_depth *depth,
                                bool near, uint32_t row)
{
    const struct ph_octave *const octave = &depth->octaves[near];
    const uint32_t d = r->row.d, gd = r->row.gd, rows = r->row.rows;
    r->row.d_dy = ph_depth_float16_slope(depth->d_dy, octave->up);
    r->row.d = ph_depth_float16_value(depth->d, octave->up) + octave->offset +
               row * r->row.d_dy; /* no bit is lost: round_depth */
    r->row.gd = octave->slope;
    ph_draw_fast_rows(k, r);
    r->row.d = d + rows * depth->d_dy;
    r->row.gd = gd;
    r->row.d_dy = depth->d_dy;
}

/* The line on which d is at the octaves' border, as an edge of the tile at row `row`. */
static struct ph_edge border_edge(const struct ph_tile_depth *depth, uint32_t gd, uint32_t row)
{
    int shift;
    const int32_t reciprocal = ph_wide_reciprocal(fx_magnitude((int32_t)gd), &shift);
    const uint32_t sign = (int32_t)gd < 0 ? UINT32_MAX : 1, way = depth->octaves[1].bottom - depth->d;
    const int64_t x = fx_mul_wide((int32_t)(way * sign), reciprocal) >> (45 - shift);
    const uint32_t dx = (uint32_t)(fx_mul_wide((int32_t)((0u - depth->d_dy) * sign), reciprocal) >> (45 - shift));
    return (struct ph_edge){(int32_t)((uint32_t)x + 65535u + row * dx), (int32_t)dx};
}

/* The first of the columns 1 .. last of a row that is on the other side of the octaves' border than column 0, from a
 * guess. d, gd: depth above the border at column 0 and per column. */
static uint32_t border_column(uint32_t d, uint32_t gd, uint32_t last, int32_t guess)
{
    uint32_t x = guess < 1 ? 1 : guess > (int32_t)last ? last : (uint32_t)guess, at = d + x * gd;
    for (; x < last && (int32_t)(at ^ d) >= 0; at += gd) {
        x++;
    }
    for (at -= gd; x > 1 && (int32_t)(at ^ d) < 0; at -= gd) {
        x--;
    }
    return x;
}

/* On which side of the octaves' border the pixels of a row lie, from left to right. */
enum side { FAR, NEAR, FAR_NEAR, NEAR_FAR };

/* The side of a row; left, right, d: its edges and the depth above the border at column 0. *x is where the border is
 * expected, and becomes where it is if the row has pixels on both sides. */
static inline enum side side_of(const struct ph_tile_rows *r, uint32_t left, uint32_t right, uint32_t d, int32_t *x)
{
    const enum side first = (int32_t)d < 0 ? FAR : NEAR, other = NEAR - first;
    const uint32_t last = r->columns - 1;
    if ((int32_t)((d + last * r->row.gd) ^ d) >= 0) {
        return first;
    }
    const int32_t column = (int32_t)border_column(d, r->row.gd, last, *x);
    if (column <= (int32_t)left >> 16) {
        return other;
    }
    if (column >= (int32_t)right >> 16) {
        return first;
    }
    *x = column;
    return FAR_NEAR + first;
}

/* How many next rows lie on the same side as the first, or on both sides of this border, to the pixel. If it is not
 * where it is in the first row, it is put right there. */
static uint32_t rows_alike(const struct ph_tile_rows *r, uint32_t bottom, enum side *side, struct ph_edge *border)
{
    uint32_t left = r->row.left, right = r->row.right, d = r->row.d - bottom, at = (uint32_t)border->x;
    for (uint32_t n = 0; n < r->row.rows; n++) {
        const int32_t guess = (int32_t)at >> 16;
        int32_t x = guess;
        const enum side here = side_of(r, left, right, d, &x);
        if (n > 0 && (here != *side || x != guess)) {
            return n;
        }
        *side = here;
        if (x != guess) {
            border->x = (int32_t)((uint32_t)x << 16);
            return 1;
        }
        left += r->row.left_dx;
        right += r->row.right_dx;
        d += r->row.d_dy;
        at += (uint32_t)border->dx;
    }
    return r->row.rows;
}

/* Draws the next rows on both sides of the border, of which the first is row `row` of the tile. */
static void draw_rows_at_border(const struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_tile_depth *depth,
                                uint32_t row, bool near, const struct ph_edge *border)
{
    const uint32_t left_dx = r->row.left_dx, left = r->row.left + r->row.rows * left_dx;
    struct ph_tile_rows part = *r;
    part.row.right = (uint32_t)border->x;
    part.row.right_dx = (uint32_t)border->dx;
    draw_rows_in_octave(k, &part, depth, near, row);
    r->row.left = (uint32_t)border->x;
    r->row.left_dx = (uint32_t)border->dx;
    r->count = part.count;
    draw_rows_in_octave(k, r, depth, !near, row);
    r->row.left = left;
    r->row.left_dx = left_dx;
}

/* Draws rows of a tile that has a near and a far octave in it, from row `row` of the tile on. */
static void draw_rows_in_two(const struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_tile_depth *depth,
                             uint32_t row)
{
    const uint32_t bottom = depth->octaves[1].bottom, way = bottom - depth->d;
    struct ph_edge border = {0, 0};
    if (fx_magnitude((int32_t)r->row.gd) > fx_magnitude((int32_t)way) >> 29) { /* else it is almost a row */
        border = border_edge(depth, r->row.gd, row);
    }
    uint32_t n;
    for (uint32_t rows = r->row.rows; rows > 0; rows -= n, row += n) {
        struct ph_edge edge = border;
        enum side side = FAR;
        r->row.rows = rows;
        r->row.rows = n = rows_alike(r, bottom, &side, &edge);
        border.x = (int32_t)((uint32_t)border.x + n * (uint32_t)border.dx);
        if (side <= NEAR) {
            draw_rows_in_octave(k, r, depth, side == NEAR, row);
        } else {
            draw_rows_at_border(k, r, depth, row, side == NEAR_FAR, &edge);
        }
    }
    r->row.rows = 0;
}

void ph_draw_rows_in_octaves(const struct ph_tile_kind *k, struct ph_tile_rows *r, const struct ph_tile_depth *depth,
                             uint32_t row)
{
    if (depth->octaves[0].up == depth->octaves[1].up) {
        draw_rows_in_octave(k, r, depth, false, row);
    } else {
        draw_rows_in_two(k, r, depth, row);
    }
}
