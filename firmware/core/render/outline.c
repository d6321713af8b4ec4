/* See outline.h. */
#include "outline.h"

#include "edge.h"
#include "planes.h"

PH_TIER(scenery)
struct ph_sides ph_sides(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const bool is_short = ph_sides_are_short(dx1, dy1, dx2, dy2);
    const int32_t area = is_short ? dx2 * dy1 - dx1 * dy2 : ph_wide_area_sign(dx1, dy1, dx2, dy2);
    return (struct ph_sides){dx1, dy1, dx2, dy2, area, is_short};
}

/* The edge from a down to b at row y0, which it reaches, in 64 bits. A step down a row has 16 bits behind the point.
 * From a corner far above the picture thousands of them would lose up to 1/16 px, so y0 is reached at once. */
PH_TIER(scenery)
static PH_NOINLINE void wide_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0,
                                  struct ph_edge *edge)
{
    int shift;
    const int32_t reciprocal = ph_wide_reciprocal((uint32_t)(b->y - a->y), &shift);
    const int64_t slope = fx_mul_wide(b->x - a->x, reciprocal), down = y0 * 256 + 128 - a->y;
    const uint32_t offset = (uint32_t)((slope >> 10) * down >> (43 - shift)); /* the product is below 2^63 */
    *edge =
        ph_edge_at_row((int32_t)((uint32_t)a->x * 256 + offset), (int32_t)(uint32_t)(slope >> (45 - shift)), y0, y0);
}

/* The edge from a down to b at row y0. */
PH_TIER(scenery)
static FX_APART void setup_edge(const struct ph_vertex *a, const struct ph_vertex *b, int32_t y0, struct ph_edge *edge)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    if ((((uint32_t)dx + PH_SIDE_SHORT) | ((uint32_t)dy << 1)) < 2 * PH_SIDE_SHORT) {
        *edge = ph_short_edge(a, dx, dy, ph_first_row(a->y), y0);
    } else {
        wide_edge(a, b, y0, edge);
    }
}

PH_TIER(scenery)
void ph_setup_outline(int32_t height, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    const struct ph_outline o = ph_outline(v);
    const int32_t y_top = ph_max(o.row_top, 0), y_bottom = ph_min(o.row_low, height);
    const int32_t y_mid = ph_max(ph_min(o.row_mid, height), 0);
    struct ph_large *const large = &t->as.large;
    t->y_top = (int16_t)y_top;
    t->y_bottom = (int16_t)y_bottom;
    large->long_left = o.long_left;
    large->y_mid = (int16_t)y_mid;
    setup_edge(o.top, o.low, y_top, &large->long_edge);
    if (y_mid > y_top) {
        setup_edge(o.top, o.mid, y_top, &large->upper);
    }
    if (y_bottom > y_mid) {
        setup_edge(o.mid, o.low, y_mid, &large->lower);
    }
}
