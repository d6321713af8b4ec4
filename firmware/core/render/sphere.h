/* sphere: distances, for spheres around vertices. Private to firmware/core. */
#ifndef PH_SPHERE_H
#define PH_SPHERE_H

#include "geom.h"

/* The square of the distance of two points, in LSB^2; UINT64_MAX if a coordinate differs by 32768.0 or more. */
static inline uint64_t ph_distance2(const struct fx_vec3 *a, const struct fx_vec3 *b)
{
    const uint32_t x = a->x > b->x ? (uint32_t)a->x - (uint32_t)b->x : (uint32_t)b->x - (uint32_t)a->x;
    const uint32_t y = a->y > b->y ? (uint32_t)a->y - (uint32_t)b->y : (uint32_t)b->y - (uint32_t)a->y;
    const uint32_t z = a->z > b->z ? (uint32_t)a->z - (uint32_t)b->z : (uint32_t)b->z - (uint32_t)a->z;
    return ((x | y | z) >> 31) != 0 ? UINT64_MAX : fx_mul_wide_u(x, x) + fx_mul_wide_u(y, y) + fx_mul_wide_u(z, z);
}

/* An upper bound of sqrt(a^2 + b^2), at most 8 % too large; a and b are below 2^30. */
static inline uint32_t ph_hypot_above(uint32_t a, uint32_t b)
{
    const uint32_t most = a > b ? a : b, least = a > b ? b : a;
    return most + (least >> 1) - (least >> 4) - (least >> 6) + 1; /* 27/64 > sqrt 2 - 1 */
}

#endif
