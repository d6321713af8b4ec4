/* ph_float_depths of kernels.h, in C for any CPU. */
#include "float_depths.h"

#include "kernels.h"

/* d of a vertex in units of 2^-(30 + s). */
static inline uint32_t own_depth(const struct ph_lens *lens, const struct ph_vertex *v)
{
    return in_front(v->q, far_at(lens, v->s));
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

bool ph_float_depths(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3])
{
    if (v[0]->s == v[1]->s && v[0]->s == v[2]->s) {
        return ph_float_depths_alike(lens, v, bias, d);
    }
    const uint32_t d0 = own_depth(lens, v[0]);
    const struct octave octave = octave_of(lens, fx_clz32(d0) + v[0]->s, bias);
    return !is_lowest(&octave) && code_in_octave(v[0], d0, &octave, &d[0]) &&
           code_in_octave(v[1], own_depth(lens, v[1]), &octave, &d[1]) &&
           code_in_octave(v[2], own_depth(lens, v[2]), &octave, &d[2]);
}
