/* The list of triangles: rows and the halves of lines, from any corners that are in reach. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/list.c"

void proof_line_half(void)
{
    const struct ph_vertex a = any_vertex(), b = any_vertex();
    struct ph_vertex out[3];
    ASSUME(a.x >= -PH_REACH && a.x <= PH_REACH && a.y >= -PH_REACH && a.y <= PH_REACH);
    ASSUME(b.x >= -PH_REACH && b.x <= PH_REACH && b.y >= -PH_REACH && b.y <= PH_REACH);
    ph_line_half(&a, &b, i32_between(0, 1), 0, out);
    for (int i = 0; i < 3; i++) {
        CLAIM(out[i].x >= -REACH && out[i].x <= REACH && out[i].y >= -REACH && out[i].y <= REACH);
    }
}

void proof_first_row(void)
{
    struct ph_renderer r;
    struct triangle t;
    any_triangle(&t);
    r.config.width = (uint16_t)u32_between(1, 1024);
    r.config.height = (uint16_t)u32_between(1, 1024);
    const int32_t row = ph_first_row_of(&r, t.v);
    CLAIM(row >= -1 && row < r.config.height);
}
