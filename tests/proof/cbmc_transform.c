/* The divide by w: no overflow and no bad shift. See proof.h. gappa.sh proves that the result is in reach of set-up. */
#include "proof_render.h"

#include "../../firmware/core/render/transform.c"

/* A corner that passed the guard band, w on the near plane or beyond. */
void proof_project(void)
{
    struct ph_lens lens = lens_of(u32_between(PH_PERSPECTIVE, PH_ORTHOGRAPHIC));
    const int log2 = i32_between(10, 18);
    lens.focal_log2 = (int8_t)log2;
    lens.guard_up = (uint8_t)(log2 - 8);
    lens.centre_x = i32_between(-512 * 256, 1536 * 256);
    lens.centre_y = i32_between(-512 * 256, 1536 * 256);
    const int32_t z = i32_between(lens.near_z, lens.far_z), w = lens.kind == PH_ORTHOGRAPHIC ? FX_ONE : z;
    const int64_t reach = (int64_t)w * 8 >> lens.guard_up;
    const int32_t x = nondet_i32(), y = nondet_i32();
    ASSUME(x >= -reach && x <= reach && y >= -reach && y <= reach);
    struct ph_vertex v;
    ph_project(&lens, x, y, w, z, &v);
}
