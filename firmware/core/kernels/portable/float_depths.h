/* float_depths: what ph_float_depths and ph_setup_fast of kernels.h share in C; the format is in depth.h. */
#ifndef PH_FLOAT_DEPTHS_H
#define PH_FLOAT_DEPTHS_H

#include "vertex.h"

/* The far plane in units of 2^-(30 + s), where s is the exponent of a vertex. The far plane has the largest
 * exponent. */
static inline uint32_t far_at(const struct ph_lens *lens, int s)
{
    return lens->far_q >> ((lens->far_s - s) & 31);
}

/* How far q is in front of the far plane; 0 behind it. */
static inline uint32_t in_front(uint32_t q, uint32_t far)
{
    return q > far ? q - far : 0;
}

/* An octave with its offset; below: how many octaves it is below the range of q, 2 more than in ph_depth_octave. */
struct octave {
    int below, down; /* down: ph_lens.float_down */
    uint32_t offset;
};

/* 2^32 - below 2^(31 - down): with e bits of exponent, 2^e is the `below` of which the exponent would be 0. */
static inline struct octave octave_of(const struct ph_lens *lens, int below, uint32_t bias)
{
    const int down = lens->float_down;
    return (struct octave){below, down, bias - ((uint32_t)below << (31 - down))};
}

static inline bool is_lowest(const struct octave *octave)
{
    return octave->below >> octave->down >= 2;
}

/* The codes of three corners with the same exponent, as most triangles have them. */
static inline bool ph_float_depths_alike(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias,
                                         uint32_t d[3])
{
    const int s = v[0]->s;
    const uint32_t far = far_at(lens, s);
    const uint32_t d0 = in_front(v[0]->q, far), d1 = in_front(v[1]->q, far), d2 = in_front(v[2]->q, far);
    const int up = fx_clz32(d0);
    const struct octave octave = octave_of(lens, up + s, bias);
    if (is_lowest(&octave) || d0 == 0 || ((d0 ^ d1) | (d0 ^ d2)) >> (31 - up) != 0) {
        return false;
    }
    d[0] = (d0 << up >> octave.down) + octave.offset;
    d[1] = (d1 << up >> octave.down) + octave.offset;
    d[2] = (d2 << up >> octave.down) + octave.offset;
    return true;
}

#endif
