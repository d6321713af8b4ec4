/* Meshes: triangles are rejected, culled, lit, clipped and listed. See clipped.h, list.h, render.h. */
/* Kits on armv6m: -O3. */
#include "mesh.h"

#include "bounds.h"
#include "check.h"
#include "clipped.h"
#include "colour.h"
#include "cores.h"
#include "edge.h"
#include "fisheye.h"
#include "light.h"
#include "setup.h"
#include "transform.h"

uint32_t ph_draw_each(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    uint32_t seen = 0;
    if (c->r->config.other_core != NULL && c->draw.uvs == NULL && !ph_has_uvs(c->material)) {
        return c->r->config.cores->each_both(c, index, end);
    }
    for (; index < end; index++) {
        seen += ph_draw_any(c, *index);
    }
    return seen;
}

PH_TIER(mesh)
uint32_t ph_cull_alone(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_list *const list = &c->r->list;
    struct ph_cull_run run = ph_cull_run_of(c, index, end);
    uint32_t seen = 0;
    for (bool stopped = true; stopped;) { /* one call of ph_cull_into: gcc copies it */
        stopped = ph_cull_into(list, &run, &seen);
        seen += stopped && ph_draw_any(c, run.index[-1]);
    }
    return seen;
}

PH_TIER(mesh)
static uint32_t draw_facing(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    return c->r->config.other_core != NULL ? c->r->config.cores->cull_both(c, index, end)
                                           : ph_cull_alone(c, index, end);
}

PH_TIER(mesh) static void draw_triangles(struct ph_part_context *c, const struct ph_part *part)
{
    const uint16_t(*index)[3] = &c->mesh->triangles[part->first], (*const end)[3] = index + part->count;
    const uint32_t seen = (c->draw.kind & PH_DRAW_ONE_SIDE) != 0 ? c->material->blend->draw->draw_sides(c, index, end)
                          : c->curved != NULL || c->two_sided    ? ph_draw_each(c, index, end)
                                                                 : draw_facing(c, index, end);
    if (c->lit) {
        c->parts->light_marked(c);
    }
    c->r->stats.triangles_culled += part->count - seen;
}

/* What may light the vertices of a part: its shading, or colours; or NULL. */
static const struct ph_part_lighting *lighting_of(const struct ph_part_context *c)
{
    const struct ph_colouring *const colouring = c->r->config.colouring;
    return c->material->shading != NULL && c->material->shading->lighting != NULL
               ? c->material->shading->lighting->parts
           : colouring != NULL ? colouring->parts
                               : NULL;
}

PH_TIER(mesh)
static PH_NOINLINE void draw_part(struct ph_part_context *c, const struct ph_part *part,
                                  const struct ph_xform *to_world)
{
    struct ph_renderer *r = c->r;
    c->material = &c->mesh->materials[part->material];
    const bool wire = ph_is_wire(c->material);
    const uint32_t count = wire ? c->mesh->edge_count : part->count;
    if (count == 0) { /* there may be no array */
        return;
    }
    c->parts = wire ? NULL : lighting_of(c);
    c->lit = c->coloured = false;
    const bool room = c->parts == NULL || c->parts->light_part(c, part, to_world);
    c->draw.material = c->material;
    c->draw.uvs = ph_has_uvs(c->material) ? c->mesh->uvs : NULL;
    const struct ph_blend *const blend = c->material->blend;
    const bool blended = blend != NULL && blend->kind >= PH_BLEND_ALPHA;
    c->two_sided = c->material->two_sided != 0;
    c->draw.kind =
        wire ? PH_DRAW_LINES
             : PH_DRAW_SMALL | (c->coloured ? PH_DRAW_COLOURS : 0) | (blended && c->two_sided ? PH_DRAW_ONE_SIDE : 0);
    r->stats.triangles_in += wire ? 0 : part->count;
    if (!room || (blend != NULL && !ph_list_blend(r, c->material)) || !ph_list_draw(r, &c->draw)) {
        r->stats.triangles_dropped += count;
        return;
    }
    c->material = c->draw.material = ph_list_material(r);
    const uint32_t since = r->list.last, before = ph_ref_count(r);
    c->curved = r->lens.kind == PH_FISHEYE ? r->projection.curved : NULL;
    if (wire) {
        c->material->shading->draw_edges(c);
    } else {
        draw_triangles(c, part);
    }
    if (blend != NULL) {
        blend->draw->put_after(r, since, before);
    }
}

PH_TIER(mesh) int ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (!ph_mesh_is_whole(mesh) || to_world == NULL || (mesh->colours != NULL && r->config.colouring == NULL)) {
        return PH_ERR_INVAL;
    }
    const struct ph_culling *const culling = mesh->bounds != NULL ? mesh->bounds->culling : NULL;
    if (culling != NULL && culling->cull_mesh(r, mesh, to_world)) {
        return PH_OK;
    }
    const struct ph_mark mark = ph_list_mark(r);
    const uint32_t n = mesh->vertex_count, place = n - 1 < r->config.vertex_max ? ph_list_vertices(r, n) : PH_NONE;
    if (place == PH_NONE) {
        return ph_list_leave_out(r, mesh, true);
    }
    const struct ph_xform object_to_view = ph_xform_mul(&r->view, to_world);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &object_to_view);
    struct ph_part_context c; /* draw_part sets the rest */
    c.r = r;
    c.mesh = mesh;
    c.matrix = &matrix;
    c.vertices = ph_at(r, place);
    c.lit_as = NULL;
    c.mixed = false;
    c.draw.base = place;
    c.codes = ph_transform_mesh(r, &matrix, mesh, c.vertices);
    r->stats.vertices += n;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        if (culling == NULL || !culling->cull_part(r, mesh, i, to_world)) {
            draw_part(&c, &mesh->parts[i], to_world);
        }
    }
    ph_list_rewind(r, &mark);
    r->stats.triangles_drawn = ph_ref_count(r);
    return PH_OK;
}
