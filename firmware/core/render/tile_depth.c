/*
 * Rows of a tile in one or two octaves of depth: each is drawn in 16.16 codes on both sides of the line on which the
 * octaves meet, which is walked as an edge. See tile_depth.h.
 */
#include "tile_depth.h"

#include "edge.h"
#include "planes.h"

bool ph_tile_octaves(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_tile_depth *depth)
{
    const uint32_t gx = ph_without_sign((int32_t)t->depth.gx), gy = ph_without_sign((int32_t)t->depth.gy);
    if (gx >> (31 - tile->width_log2) != 0 || gy >> (31 - tile->height_log2) != 0) { /* over the tile d could wrap */
        return false;
    }
    const uint32_t right = ((1u << tile->width_log2) - 1) * t->depth.gx;
    const uint32_t below = ((1u << tile->height_log2) - 1) * t->depth.gy;
    const uint32_t d = ph_plane_at(&t->depth, tile->x, tile->y);
    const uint32_t least = d + ((int32_t)right < 0 ? right : 0) + ((int32_t)below < 0 ? below : 0);
    const uint32_t most = d + ((int32_t)right < 0 ? 0 : right) + ((int32_t)below < 0 ? 0 : below);
    struct ph_octave *const least_in = &depth->octaves[0], *const most_in = &depth->octaves[1];
    depth->d = d;
    depth->d_dy = t->depth.gy;
    ph_octave_of(least_in, t, least, t->depth.gx);
    ph_octave_of(most_in, t, most, t->depth.gx);
    return least_in->size > 0 && most_in->size > 0 && least <= most && least_in->up - most_in->up < 2;
}
/* Draws rows in one octave; the first of them is row `row` of the tile. */
static void draw_rows_in_octave(const struct ph_tile_kind *k, struct ph_texel_rows *r,
                                const struct ph_tile_depth *depth, bool near, uint32_t row)
{
    const struct ph_octave *const octave = &depth->octaves[near];
    const uint32_t d = r->d, gd = r->gd, rows = r->rows;
    r->d_dy = ph_depth_float16_slope(depth->d_dy, octave->up);
    r->d =
        ph_depth_float16_value(depth->d, octave->up) + octave->offset + row * r->d_dy; /* no bit is lost: round_depth */
    r->gd = octave->slope;
    ph_draw_plain_rows(k, r);
    r->d = d + rows * depth->d_dy;
    r->gd = gd;
    r->d_dy = depth->d_dy;
}

/* How many next rows begin and end on the same sides of the octaves' border as the first. Without pixels: far. */
static uint32_t rows_alike(const struct ph_texel_rows *r, uint32_t border, bool near[2])
{
    uint32_t left = r->left, right = r->right, d = r->d, n = 0;
    for (; n < r->rows; n++) {
        uint32_t i, pixels;
        const bool any = ph_tile_columns(left, right, r->columns, &i, &pixels);
        const bool first = any && d + i * r->gd >= border, last = any && d + (i + pixels - 1) * r->gd >= border;
        if (n > 0 && (first != near[0] || last != near[1])) {
            break;
        }
        near[0] = first;
        near[1] = last;
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
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

/* The first of the columns i + 1 .. i + n - 1 of a row that is on the other side of the octaves' border than column i,
 * from a guess. d, gd: depth at column 0 and per column. */
static uint32_t border_column(uint32_t d, uint32_t gd, uint32_t border, bool near, uint32_t i, uint32_t n,
                              int32_t guess)
{
    uint32_t x = guess <= (int32_t)i ? i + 1 : guess >= (int32_t)(i + n) ? i + n - 1 : (uint32_t)guess;
    while (x < i + n - 1 && (d + x * gd >= border) == near) {
        x++;
    }
    while (x > i + 1 && (d + (x - 1) * gd >= border) != near) {
        x--;
    }
    return x;
}

/* For how many of n rows the edge is the border to the pixel. If it is not in the first row, it is put right there. */
static uint32_t rows_at_border(const struct ph_texel_rows *r, uint32_t border, bool near, struct ph_edge *edge,
                               uint32_t n)
{
    uint32_t left = r->left, right = r->right, d = r->d;
    for (uint32_t row = 0; row < n; row++) {
        uint32_t i, pixels;
        const int32_t guess = (int32_t)((uint32_t)edge->x + row * (uint32_t)edge->dx) >> 16;
        ph_tile_columns(left, right, r->columns, &i, &pixels);
        const uint32_t x = border_column(d, r->gd, border, near, i, pixels, guess);
        if ((int32_t)x != guess) {
            edge->x = row > 0 ? edge->x : (int32_t)(x << 16);
            return row > 0 ? row : 1;
        }
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* Draws rows that have a near and a far octave in them, from row `row` of the tile on. */
static void draw_rows_in_two(const struct ph_tile_kind *k, struct ph_texel_rows *r, const struct ph_tile_depth *depth,
                             uint32_t row)
{
    const uint32_t bottom = depth->octaves[1].bottom, way = bottom - depth->d;
    uint32_t n;
    for (uint32_t rows = r->rows; rows > 0; rows -= n, row += n) {
        bool near[2] = {false, false};
        r->rows = rows;
        r->rows = n = rows_alike(r, bottom, near);
        if (near[0] == near[1]) {
            draw_rows_in_octave(k, r, depth, near[0], row);
            continue;
        }
        struct ph_edge border = {0, 0};
        if (fx_magnitude((int32_t)r->gd) > fx_magnitude((int32_t)way) >> 29) { /* else it is almost a row */
            border = border_edge(depth, r->gd, row);
        }
        r->rows = n = rows_at_border(r, bottom, near[0], &border, n);
        const uint32_t left = r->left, left_dx = r->left_dx;
        struct ph_texel_rows part = *r;
        part.right = (uint32_t)border.x;
        part.right_dx = (uint32_t)border.dx;
        draw_rows_in_octave(k, &part, depth, near[0], row);
        r->left = (uint32_t)border.x;
        r->left_dx = (uint32_t)border.dx;
        r->count = part.count;
        draw_rows_in_octave(k, r, depth, near[1], row);
        r->left = left + n * left_dx;
        r->left_dx = left_dx;
    }
    r->rows = 0;
}

void ph_draw_rows_in_octaves(const struct ph_tile_kind *k, struct ph_texel_rows *r, const struct ph_tile_depth *depth,
                             uint32_t row)
{
    if (depth->octaves[0].up == depth->octaves[1].up) {
        draw_rows_in_octave(k, r, depth, false, row);
    } else {
        draw_rows_in_two(k, r, depth, row);
    }
}
