/* See cull.h. */
#include "cull.h"

static struct ph_sides sides_of(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const bool small = ph_sides_are_short(dx1, dy1, dx2, dy2);
    return (struct ph_sides){dx1, dy1, dx2, dy2, small ? dx2 * dy1 - dx1 * dy2 : 1, small};
}

/* Whether corners without clip codes run counter-clockwise. */
static inline bool faces_viewer(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    return fx_mul_wide(c->x - a->x, b->y - a->y) > fx_mul_wide(b->x - a->x, c->y - a->y);
}

/* Whether a triangle may be seen. A corner with a clip code may have no x and y: then the caller must look closer. */
static inline bool is_candidate(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c,
                                bool coded)
{
    if (coded && ((a->code | b->code | c->code) & (PH_REJECT | PH_GUARD)) != 0) {
        return (a->code & b->code & c->code & PH_REJECT) == 0;
    }
    return faces_viewer(a, b, c);
}

/* `coded` is a constant at each call, so that meshes that lie wholly in the picture have a loop of their own. */
static inline bool cull_until(struct ph_cull_run *run, bool coded)
{
    const struct ph_vertex *const vertices = run->vertices;
    const uint16_t(*index)[3] = run->index, (*const end)[3] = run->end;
    for (; index < end; index++) {
        const struct ph_vertex *const a = &vertices[(*index)[0]], *const b = &vertices[(*index)[1]],
                                      *const c = &vertices[(*index)[2]];
        if (is_candidate(a, b, c, coded)) {
            run->index = index + 1;
            run->v[0] = a;
            run->v[1] = b;
            run->v[2] = c;
            return true;
        }
    }
    run->index = end;
    return false;
}

bool ph_cull(struct ph_cull_run *run)
{
    const bool coded = run->codes != 0;
    if (!(coded ? cull_until(run, true) : cull_until(run, false))) {
        return false;
    }
    run->sides = sides_of(run->v[0], run->v[1], run->v[2]);
    return true;
}
