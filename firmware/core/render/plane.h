/* plane: the plane through the values at three corners. Private to firmware/core. */
#ifndef PH_PLANE_H
#define PH_PLANE_H

#include "sides.h"
#include "triangle.h"

/* What all planes of a triangle share: the place of its first corner, and the reciprocal of its area. */
struct ph_plane_base {
    const struct ph_sides *sides;
    int32_t x, y;           /* from the first corner to the centre of pixel (0, 0): whole pixels */
    int32_t part_x, part_y; /* and the rest, 1/256 px */
    int32_t reciprocal;     /* is_short: 2^(47 - shift) / area; else 2^(61 - shift) / area */
    int shift;
};

void ph_plane_base(struct ph_plane_base *base, const struct ph_vertex *first, const struct ph_sides *sides);

/*
 * Planes through three unsigned values. Gradients beyond 2^limit per pixel are halved until they fit: so slivers, and
 * faces seen edge-on, become flat instead of wrapping.
 */
void ph_plane_through(struct ph_plane *out, const struct ph_plane_base *base, const uint32_t v[3], int limit);

/* The same to its last bit, for formats that keep 24 bits of the values. */
struct ph_plane ph_plane_exact(const struct ph_plane_base *base, const uint32_t v[3], int limit);

/* The plane through the light of the corners, in 2^-16. */
void ph_plane_light(struct ph_plane *out, const struct ph_plane_base *base, const struct ph_vertex *const v[3]);

#endif
