/* See cull.h. */
#include "cull.h"

#include "edge.h"

enum answer { PASS, LIST, LOOK };

/* Decides what to do with a triangle whose corners have no clip codes. */
static inline enum answer judge(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c,
                                int32_t *row)
{
    const int64_t ax = a->x, ay = a->y, dx1 = b->x - ax, dx2 = c->x - ax, dy1 = b->y - ay, dy2 = c->y - ay;
    if (dx2 * dy1 <= dx1 * dy2) { /* in whole words of 64 bits: no difference is extended on its own */
        return PASS;
    }
    *row = ph_first_row(ph_min(ph_min(a->y, b->y), c->y));
    if (*row >= ph_first_row(ph_max(ph_max(a->y, b->y), c->y))) {
        return PASS;
    }
    return (((uint32_t)dx1 + 256) | ((uint32_t)dx2 + 256)) < 512 ? LOOK : LIST;
}

/* Lists a triangle; all that the loop needs of *run is loaded before it, since the vertices may be marked. */
static inline struct ph_ref *list(struct ph_ref *to, const uint16_t corner[3], uint32_t band, bool mark,
                                  struct ph_vertex *const v[3])
{
    to--;
    __builtin_memcpy(to->corner, corner, sizeof to->corner); /* without it gcc shifts the four members together */
    to->link = (uint16_t)band;
    if (mark) {
        ph_mark(v[0]);
        ph_mark(v[1]);
        ph_mark(v[2]);
    }
    return to;
}

/* `coded` is a constant at each call, so that meshes that lie wholly in the picture have a loop of their own. */
static inline bool cull_until(struct ph_cull_run *run, bool coded)
{
    struct ph_vertex *const vertices = run->vertices;
    const uint16_t(*index)[3] = run->index, (*const end)[3] = run->end;
    struct ph_ref *to = run->to, *const limit = run->limit;
    const uint32_t band_scale = run->band_scale;
    const bool mark = run->mark != 0;
    enum answer answer = PASS;
    while (answer != LOOK && index < end) {
        const uint16_t *const corner = *index++;
        struct ph_vertex *const v[3] = {&vertices[corner[0]], &vertices[corner[1]], &vertices[corner[2]]};
        const unsigned a = coded ? ph_code_of(v[0]) : 0, b = coded ? ph_code_of(v[1]) : 0,
                       c = coded ? ph_code_of(v[2]) : 0;
        int32_t row = 0;
        answer = (a & b & c & PH_REJECT) != 0 ? PASS : LOOK;
        if (((a | b | c) & (PH_REJECT | PH_GUARD)) == 0) {
            answer = judge(v[0], v[1], v[2], &row);
        }
        if (answer == LIST && to == limit) {
            answer = LOOK;
        } else if (answer == LIST) {
            to = list(to, corner, (uint32_t)row * band_scale >> 20, mark, v);
        }
    }
    run->index = index;
    run->to = to;
    return answer == LOOK;
}

bool ph_cull(struct ph_cull_run *run)
{
    return run->codes != 0 ? cull_until(run, true) : cull_until(run, false);
}
