/* Triangles that cannot be seen, passed over: see hot.h. */
#include "hot.h"

static struct ph_sides sides_of(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const bool small = ph_sides_small(dx1, dy1, dx2, dy2);
    return (struct ph_sides){dx1, dy1, dx2, dy2, small ? dx2 * dy1 - dx1 * dy2 : 1, small};
}

/* Of corners without clip codes. */
static inline bool faces_viewer(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    return fx_mul_wide(c->x - a->x, b->y - a->y) > fx_mul_wide(b->x - a->x, c->y - a->y);
}

bool ph_visit(struct ph_visit *visit)
{
    const struct ph_vertex *const vertices = visit->vertices;
    const uint32_t codes = visit->codes;
    for (const uint16_t(*index)[3] = visit->index; index < visit->end; index++) {
        const struct ph_vertex *const a = &vertices[(*index)[0]], *const b = &vertices[(*index)[1]],
                                      *const c = &vertices[(*index)[2]];
        const bool coded = codes != 0 && ((a->code | b->code | c->code) & (PH_REJECT | PH_GUARD)) != 0;
        if (coded ? (a->code & b->code & c->code & PH_REJECT) != 0 : !faces_viewer(a, b, c)) {
            continue;
        }
        visit->index = index + 1;
        visit->v[0] = a;
        visit->v[1] = b;
        visit->v[2] = c;
        if (!coded) {
            visit->sides = sides_of(a, b, c);
        }
        return true;
    }
    visit->index = visit->end;
    return false;
}
