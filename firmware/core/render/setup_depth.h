/* setup_depth: depth of a triangle's corners, and the plane through it. Private to firmware/core. */
#ifndef PH_SETUP_DEPTH_H
#define PH_SETUP_DEPTH_H

#include "plane.h"

/* The material's bias, within its range. */
static inline uint32_t ph_depth_bias(const struct ph_material *material)
{
    return material->depth_bias < 56 ? material->depth_bias : 56;
}

static inline struct ph_quotient ph_depth_of(const struct ph_vertex *v)
{
    return (struct ph_quotient){v->q, v->s};
}

/* The exponent of the nearest corner. */
static inline int ph_least_exponent(const struct ph_vertex *const v[3])
{
    const int a = v[0]->s < v[1]->s ? v[0]->s : v[1]->s;
    return v[2]->s < a ? v[2]->s : a;
}

/* N/w of a corner in units of 2^-(28 + least), with the exponent `least` of the nearest corner: below 2^29. */
static inline uint32_t ph_over_w(const struct ph_vertex *v, int least)
{
    const int down = v->s - least + 2;
    return down < 32 ? v->q >> down : 0;
}

/*
 * Depth of the corners in a float format. If all lie in one octave they become 16.16 codes, and PH_BLOCK_NONE is
 * returned; else the block exponent of the triangle.
 */
uint8_t ph_block_depths(const struct ph_renderer *r, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3]);

/* Sets t->depth and t->block. */
void ph_setup_depth(const struct ph_renderer *r, const struct ph_plane_base *base, const struct ph_vertex *const v[3],
                    struct ph_triangle *t);

#endif
