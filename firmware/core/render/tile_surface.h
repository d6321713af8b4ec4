/*
 * tile_surface: u and v over a tile of a textured triangle. Private to firmware/core; the method is in texture.c.
 */
#ifndef PH_TILE_SURFACE_H
#define PH_TILE_SURFACE_H

#include "texture_tile.h"
#include "triangle.h"

/* u or v, in 2^-25 of their range, at the top and the bottom of the left and the right side of a tile. */
struct ph_corners {
    int32_t left[2], right[2];
};

/* u and v over a tile. A side's number is the part of the change of u or v along it by which the parabola through its
 * ends and its middle bends: the change of 1/w over the mean of 1/w, in 2^-16. */
struct ph_surface {
    struct ph_corners u, v;
    int32_t top, bottom, left, right;
};

struct ph_tile {
    uint32_t x, y;
    int width_log2, height_log2;
};

/* The plane of 1/w; linear-w has it as its depth. */
static inline const struct ph_plane *ph_over_w(const struct ph_triangle *t)
{
    return t->block == PH_BLOCK_LINEAR ? &t->as.large.depth.as.plane : &t->as.large.depth.over_w.plane;
}

/* Divides at the left side of the first tile of a strip. */
void ph_surface_begin(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_surface *s);

/* Goes on to the next tile: its left side is the right side of the one before. */
void ph_surface_next(const struct ph_triangle *t, const struct ph_tile *tile, struct ph_surface *s);

/* Finds the coefficients of u or v over a tile, in 2^-(25 + up) of their range; c: s->u or s->v. */
void ph_surface_way(struct ph_texel_way *way, const struct ph_corners *c, const struct ph_surface *s,
                    const struct ph_tile *tile, int up);

#endif
