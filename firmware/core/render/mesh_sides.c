/* A part that shows both of its sides one behind the other. See list.h. */
/* Kits on armv6m: -O3. */
#include "mesh.h"

/* Draws all far sides, then all near sides. Each triangle counts once, also if pieces of it show either side. */
uint32_t ph_draw_sides(struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_stats *const stats = &c->r->stats;
    const uint32_t culled = stats->triangles_culled, clipped = stats->triangles_clipped;
    uint32_t seen = 0;
    c->two_sided = false;
    for (const uint16_t(*i)[3] = index; i < end; i++) {
        const uint16_t turned[3] = {(*i)[0], (*i)[2], (*i)[1]};
        seen += ph_draw_any(c, turned);
    }
    seen -= stats->triangles_culled - culled;
    stats->triangles_culled = culled;
    stats->triangles_clipped = clipped;
    seen += ph_draw_each(c, index, end);
    const uint32_t most = (uint32_t)(end - index) + stats->triangles_culled - culled;
    return seen < most ? seen : most;
}
