/* Lines: their corners and their walk, from any ends that are in reach. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/line.c"

static struct ph_vertex any_end(void)
{
    const struct ph_vertex v = any_vertex();
    ASSUME(v.x >= -PH_GUARD_MAX && v.x <= PH_GUARD_MAX && v.y >= -PH_GUARD_MAX && v.y <= PH_GUARD_MAX);
    return v;
}

void proof_corners(void)
{
    const struct ph_vertex a = any_end(), b = any_end();
    struct ph_vertex out[3];
    line_corners(&a, &b, out);
    for (int i = 0; i < 3; i++) {
        CLAIM(out[i].x >= -REACH && out[i].x <= REACH && out[i].y >= -REACH && out[i].y <= REACH);
    }
}

void proof_walk(void)
{
    const struct ph_vertex a = any_end(), b = any_end();
    ASSUME(b.y >= a.y); /* as ph_setup_line takes them */
    struct ph_renderer r;
    struct ph_triangle t;
    struct part part;
    r.config.width = (uint16_t)u32_between(1, 1024);
    r.config.height = (uint16_t)u32_between(1, 1024);
    const bool x_major = ph_line_is_x_major(&a, &b);
    const int32_t from = x_major ? a.x : a.y, to = x_major ? b.x : b.y,
                  size = x_major ? r.config.width : r.config.height;
    ASSUME(ph_max(ph_first_row(ph_min(from, to)), 0) < ph_min(ph_first_row(ph_max(from, to)), size)); /* list_line */
    walk_of(&r, &a, &b, &t, &part);
    const struct ph_line *const way = &t.as.line.way;
    CLAIM(way->count > 0 && way->along >= 0 && way->along < size && t.y_bottom <= r.config.height);
}
