/* Depth of a triangle's corners as floats: see hot.h. */
#include "hot.h"

/* d of a vertex in units of its own, 2^-(30 + s). */
static uint32_t own_depth(const struct ph_lens *lens, const struct ph_vertex *v)
{
    const uint32_t far = lens->far_q >> ((lens->far_s - v->s) & 31); /* the far plane has the largest s */
    return v->q > far ? v->q - far : 0;
}

/* Code of a d with the octave's offset; false where d is not in it. octave: see ph_depth_octave. */
static bool code_in_octave(const struct ph_vertex *v, uint32_t d, int octave, uint32_t offset, uint32_t *code)
{
    const uint32_t up = (uint32_t)(octave + 2 - v->s);
    if (up > 31 || d >> (31 - up) != 1) {
        return false;
    }
    *code = (d << up >> 3) + offset;
    return true;
}

bool ph_float_depths(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3])
{
    const uint32_t d0 = own_depth(lens, v[0]);
    const int octave = fx_clz32(d0) - 2 + v[0]->s;
    const uint32_t offset = ((uint32_t)(14 - octave) << 28) + bias;
    return octave < 14 && code_in_octave(v[0], d0, octave, offset, &d[0]) &&
           code_in_octave(v[1], own_depth(lens, v[1]), octave, offset, &d[1]) &&
           code_in_octave(v[2], own_depth(lens, v[2]), octave, offset, &d[2]);
}
