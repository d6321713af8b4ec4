/* A triangle of a mesh, in the general case: it is lit, clipped and listed. See mesh.h. */
/* Kits on armv6m: -O3. */
#include "mesh.h"

#include "clipped.h"
#include "edge.h"
#include "fisheye.h"

PH_TIER(few) struct ph_clip_vertex ph_mesh_vertex(const struct ph_part_context *c, uint32_t index)
{
    struct ph_clip_vertex v = ph_clip_place(&c->r->lens, c->matrix, &c->mesh->positions[index]);
    v.light = ph_light_of(&c->vertices[index]);
    if (c->mesh->uvs != NULL) {
        v.uv[0] = c->mesh->uvs[index][0];
        v.uv[1] = c->mesh->uvs[index][1];
    }
    return v;
}

PH_TIER(few) static PH_NOINLINE void draw_clipped(const struct ph_part_context *c, const uint16_t index[3])
{
    struct ph_clip_vertex in[3];
    if (c->lit) {
        c->parts->light_corners(c, index);
    }
    for (int i = 0; i < 3; i++) {
        in[i] = ph_mesh_vertex(c, index[i]);
    }
    if (c->coloured) {
        c->r->config.colouring->take_colours(in, ph_lit_corners_of(c->material) == PH_FIRST_CORNER);
    } else if (ph_lit_corners_of(c->material) != PH_EACH_CORNER) { /* one light for the whole triangle */
        in[1].light = in[2].light = in[0].light;
    }
    ph_draw_clipped(c->r, c->material, c->draw.kind, in);
    ph_list_again(c->r, &c->draw);
}

PH_NOINLINE bool ph_draw_any(const struct ph_part_context *c, const uint16_t index[3])
{
    const struct ph_vertex *const v[3] = {&c->vertices[index[0]], &c->vertices[index[1]], &c->vertices[index[2]]};
    const unsigned code[3] = {ph_code_of(v[0]), ph_code_of(v[1]), ph_code_of(v[2])};
    const unsigned all = code[0] & code[1] & code[2], any = code[0] | code[1] | code[2];
    if ((all & PH_REJECT) != 0) {
        return false;
    }
    if (c->curved != NULL && (any & PH_CLIP) == 0 && c->curved->misses_picture(c->r, v)) {
        return false;
    }
    if ((any & PH_CLIP) != 0 || (c->curved != NULL && !c->curved->is_straight(&c->r->lens, v[0], v[1], v[2]))) {
        draw_clipped(c, index);
        return true;
    }
    const bool seen = ph_list_triangle(c->r, index, v, c->two_sided);
    if (seen && c->lit) {
        c->parts->light_corners(c, index);
    }
    return seen;
}
