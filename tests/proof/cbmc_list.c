/* The list of triangles: rows, from any corners that are in reach. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/list.c"

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
