/* ph_float_depths of kernels.h; the format is in depth.h. */
#include "kernels.h"

#include "vertex.h"

/* The far plane in units of 2^-(30 + s), s being the exponent of a vertex. That of the far plane is the largest. */
static inline uint32_t far_at(const struct ph_lens *lens, int s)
{
    return lens->far_q >> ((lens->far_s - s) & 31);
}

/* How far q is in front of the far plane; 0 behind it. */
static inline uint32_t in_front(uint32_t q, uint32_t far)
{
    return q > far ? q - far : 0;
}

/* d of a vertex in units of 2^-(30 + s). */
static inline uint32_t own_depth(const struct ph_lens *lens, const struct ph_vertex *v)
{
    return in_front(v->q, far_at(lens, v->s));
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

/* The code of a d with the octave's offset; false if d is not in the octave. */
static bool code_in_octave(const struct ph_vertex *v, uint32_t d, const struct octave *octave, uint32_t *code)
{
    const uint32_t up = (uint32_t)(octave->below - v->s);
    if (up > 31 || d >> (31 - up) != 1) {
        return false;
    }
    *code = (d << up >> octave->down) + octave->offset;
    return true;
}

/* The codes of three corners with the same exponent, as most triangles have them. */
static inline bool depths_alike(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias,
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

bool ph_float_depths(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3])
{
    if (v[0]->s == v[1]->s && v[0]->s == v[2]->s) {
        return depths_alike(lens, v, bias, d);
    }
    const uint32_t d0 = own_depth(lens, v[0]);
    const struct octave octave = octave_of(lens, fx_clz32(d0) + v[0]->s, bias);
    return !is_lowest(&octave) && code_in_octave(v[0], d0, &octave, &d[0]) &&
           code_in_octave(v[1], own_depth(lens, v[1]), &octave, &d[1]) &&
           code_in_octave(v[2], own_depth(lens, v[2]), &octave, &d[2]);
}
