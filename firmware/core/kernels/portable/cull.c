/* See cull.h. */
#include "cull.h"

#include "edge.h"

enum answer { PASS, LIST, LOOK };

/* What to do with a triangle whose corners have no clip codes. */
static inline enum answer judge(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c,
                                int32_t *row)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    if (fx_mul_wide(dx2, dy1) <= fx_mul_wide(dx1, dy2)) {
        return PASS;
    }
    *row = ph_first_row(ph_min(ph_min(a->y, b->y), c->y));
    if (*row >= ph_first_row(ph_max(ph_max(a->y, b->y), c->y))) {
        return PASS;
    }
    return (((uint32_t)dx1 + 256) | ((uint32_t)dx2 + 256)) < 512 ? LOOK : LIST;
}

/* `coded` is a constant at each call, so that meshes that lie wholly in the picture have a loop of their own. */
static inline bool cull_until(struct ph_cull_run *run, bool coded)
{
    struct ph_vertex *const vertices = run->vertices;
    const uint16_t(*index)[3] = run->index, (*const end)[3] = run->end;
    for (; index < end; index++) {
        struct ph_vertex *const v[3] = {&vertices[(*index)[0]], &vertices[(*index)[1]], &vertices[(*index)[2]]};
        const unsigned a = coded ? ph_code_of(v[0]) : 0, b = coded ? ph_code_of(v[1]) : 0,
                       c = coded ? ph_code_of(v[2]) : 0;
        int32_t row = 0;
        enum answer answer = (a & b & c & PH_REJECT) != 0 ? PASS : LOOK;
        if (((a | b | c) & (PH_REJECT | PH_GUARD)) == 0) {
            answer = judge(v[0], v[1], v[2], &row);
        }
        if (answer == LOOK || (answer == LIST && run->to == run->limit)) {
            run->index = index + 1;
            return true;
        }
        if (answer == LIST) {
            const uint16_t band = (uint16_t)((uint32_t)row * run->band_scale >> 20);
            *--run->to = (struct ph_ref){{(*index)[0], (*index)[1], (*index)[2]}, band};
            for (int i = 0; run->mark != 0 && i < 3; i++) {
                ph_mark(v[i]);
            }
        }
    }
    run->index = end;
    return false;
}

bool ph_cull(struct ph_cull_run *run)
{
    return run->codes != 0 ? cull_until(run, true) : cull_until(run, false);
}
