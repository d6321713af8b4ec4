/* See vertices.h. */
#include "vertices.h"

/* Whether |x| and |y| are below limit. */
static inline bool are_within(int32_t x, int32_t y, uint32_t limit)
{
    return ((uint32_t)(x ^ x >> 31) | (uint32_t)(y ^ y >> 31)) < limit;
}

/* Clip code of a coordinate on the screen, 0 .. most inside; `below` is the code below 0. */
static inline uint8_t side_code(int32_t at, uint32_t most, unsigned below)
{
    return (uint8_t)(at < 0 ? below : (uint32_t)at > most ? 2 * below : 0);
}

/* Projects a vertex. at.z has 4 leading zeros or more, and x and y are within 8 z, so that no shift up loses a bit. q
 * is shifted up by one if its upper bit is not at 30, as struct ph_quotient wants it. */
static inline void project(const struct ph_vertex_run *run, struct fx_vec3 at, struct ph_vertex *v)
{
    int shift;
    const uint32_t reciprocal = fx_rcp_norm((uint32_t)at.z, &shift), up = (uint32_t)shift - 4;
    const int32_t positive = (int32_t)(reciprocal >> 1), x = (int32_t)((uint32_t)at.x << up),
                  y = (int32_t)((uint32_t)at.y << up);
    const uint32_t q = fx_mulhi_u32(run->depth_scale, reciprocal), half = (q >> 30) ^ 1;
    v->x = (int32_t)((run->round_x + fx_mul_wide(x, positive)) >> 32) >> run->down;
    v->y = (int32_t)((run->round_y + fx_mul_wide(y, positive)) >> 32) >> run->down;
    v->q = q << half;
    v->s = (int8_t)(run->near_shift - shift + (int32_t)half);
    v->code = 0;
    v->light = PH_LIGHT_ZERO + PH_LIGHT_SPAN;
}

void ph_vertices(struct ph_vertex_run *run)
{
    struct ph_vertex *v = run->to;
    const struct fx_vec3 *p = run->from;
    for (; p < run->end && ph_matvec_in_range(&run->matvec, p); p++, v++) {
        const struct fx_vec3 at = ph_matvec_near(&run->matvec, p);
        if ((uint32_t)at.z - run->near > run->range || !are_within(at.x, at.y, ((uint32_t)at.z >> run->guard_up) * 8)) {
            run->at = at;
            break;
        }
        project(run, at, v);
        if ((uint32_t)v->x > run->right || (uint32_t)v->y > run->bottom) {
            v->code = side_code(v->x, run->right, PH_LEFT) | side_code(v->y, run->bottom, PH_TOP);
            run->codes |= v->code;
        }
    }
    run->from = p;
    run->to = v;
}
