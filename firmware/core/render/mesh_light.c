/* The light, or the lit colours, of the vertices of a mesh. See mesh.h. */
/* Kits on armv6m: -O3. */
#include "colours.h"
#include "cores.h"
#include "edge.h"
#include "mesh.h"
#include "shading.h"

/* Vertices that one core lights. */
struct light_share {
    const struct ph_part_context *c;
    uint32_t from, end;
};

/* Lights the vertices that ph_cull has marked. */
PH_TIER(mesh) static void light_share(void *argument) /* called as run */
{
    const struct light_share *const s = argument;
    const struct ph_part_context *const c = s->c;
    struct ph_vertex *const end = c->vertices + s->end;
    for (struct ph_vertex *v = c->vertices + s->from; v < end; v++) {
        if (v->light == 0) {
            v->light = ph_vertex_light(c, (uint32_t)(v - c->vertices));
        }
    }
}

static void light_marked(const struct ph_part_context *c)
{
    const uint32_t n = c->mesh->vertex_count;
    struct light_share mine = {c, 0, n / 2}, others = {c, n / 2, n};
    if (n < PH_SHARED_LEAST || c->r->config.other_core == NULL) {
        mine.end = n;
        light_share(&mine);
    } else {
        ph_run_both(c->r, light_share, &mine, &others);
    }
}

/* Whether the light of a vertex is the same in both materials. */
static bool is_lit_alike(const struct ph_material *a, const struct ph_material *b)
{
    return a->ambient == b->ambient && a->diffuse == b->diffuse && a->specular == b->specular &&
           a->shininess_log2 == b->shininess_log2;
}

/* Gives a part that needs another light of its vertices than the part before a copy of them. */
static bool copy_vertices(struct ph_part_context *c)
{
    const uint32_t n = c->mesh->vertex_count, place = ph_list_vertices(c->r, n);
    if (place == PH_NONE) {
        return false;
    }
    struct ph_vertex *const to = ph_at(c->r, place);
    for (uint32_t i = 0; i < n; i++) {
        to[i] = c->vertices[i];
        to[i].code &= (uint8_t)~PH_LIT;
    }
    c->vertices = to;
    c->draw.base = place;
    return true;
}

/* Whether the part has vertices that are lit already. */
static bool shares_light(const struct ph_part_context *c, const struct ph_part *part)
{
    for (uint32_t i = part->first; i < part->first + part->count; i++) {
        const uint16_t *const index = c->mesh->triangles[i];
        if ((c->vertices[index[0]].code | c->vertices[index[1]].code | c->vertices[index[2]].code) >= PH_LIT) {
            return true;
        }
    }
    return false;
}

/* Prepares the light of a part. False if there is no room for another light of its vertices. */
static bool light_part(struct ph_part_context *c, const struct ph_part *part, const struct ph_xform *to_world)
{
    const struct ph_material *const material = c->material, *const before = c->lit_as;
    const struct ph_colouring *const colouring = c->r->config.colouring;
    c->coloured = colouring != NULL && colouring->is_coloured(c);
    c->lighting = material->shading != NULL ? material->shading->lighting : NULL;
    c->lit = c->coloured || (c->mesh->normals != NULL && c->lighting != NULL);
    if (!c->lit) {
        return true;
    }
    const bool alike = before != NULL && is_lit_alike(before, material) &&
                       (c->coloured ? c->lit_coloured && colouring->is_alike(c, before) : !c->lit_coloured);
    c->lit_as = material;
    c->lit_coloured = c->coloured;
    if (!alike && c->lighting != NULL) {
        c->lighting->light_prepare(&c->lights, c->r, to_world, material, c->coloured);
    }
    if (before == NULL || (alike && !c->mixed)) {
        return true;
    }
    c->mixed = !shares_light(c, part);
    return c->mixed || copy_vertices(c);
}

/* See mesh.h. ph_cull may have marked corners only. */
PH_TIER(scenery) static void light_corners(const struct ph_part_context *c, const uint16_t index[3])
{
    for (int i = 0; i < 3; i++) {
        struct ph_vertex *const corner = &c->vertices[index[i]];
        const unsigned code = __atomic_load_n(&corner->code, __ATOMIC_ACQUIRE), lit = ph_light_of(corner);
        if (code >= PH_LIT && lit != 0) {
            continue;
        }
        const uint16_t light =
            ph_vertex_light(c, index[i]); /* both cores may compute and write this light: it is the same */
        __atomic_store_n(&corner->light, light, __ATOMIC_RELAXED);
        __atomic_store_n(&corner->code, (uint8_t)(code | PH_LIT), __ATOMIC_RELEASE);
    }
}

const struct ph_part_lighting ph_part_lighting = {
    .light_part = light_part, .light_marked = light_marked, .light_corners = light_corners};
