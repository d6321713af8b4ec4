/* The edges of a mesh as lines. See mesh.h. */
#include "mesh.h"

#include "clipped.h"
#include "line.h"

PH_TIER(few) void ph_draw_edges(const struct ph_part_context *c)
{
    const uint16_t(*edge)[2] = c->mesh->edges, (*const end)[2] = edge + c->mesh->edge_count;
    c->r->lines = &ph_lines;
    for (;; edge++) {
        if (c->curved == NULL) {
            edge += ph_list_lines(c->r, edge, (uint32_t)(end - edge), c->vertices);
        }
        if (edge == end) {
            break;
        }
        if ((c->vertices[(*edge)[0]].code & c->vertices[(*edge)[1]].code & PH_REJECT) != 0) {
            continue;
        }
        const struct ph_clip_vertex ends[2] = {ph_mesh_vertex(c, (*edge)[0]), ph_mesh_vertex(c, (*edge)[1])};
        ph_draw_clipped_line(c->r, c->material, ends);
        ph_list_again(c->r, &c->draw);
    }
}
