/* Meshes of the small profile: vertices are transformed and lit, and parts are kept for the bands. See small.h. */
#include "small.h"

#include "check.h"
#include "shading.h"

/* The shadings of the profile; all others have no corners, and are refused. */
const struct ph_shading ph_shade_flat = {.corners = PH_FIRST_CORNER};
const struct ph_shading ph_shade_gouraud = {.corners = PH_EACH_CORNER};
const struct ph_shading ph_shade_texture, ph_shade_texture_lit, ph_shade_wire, ph_shade_texture_gouraud;

/* Whether the profile draws such a mesh. */
static bool is_drawn(const struct ph_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_material *const m = &mesh->materials[mesh->parts[i].material];
        if (m->blend != NULL || m->depth_bias_slope != 0 ||
            (m->shading != NULL && m->shading->corners == PH_NO_CORNER)) {
            return false;
        }
    }
    return mesh->colours == NULL;
}

/* Keeps a vertex. */
static void store(struct ph_small_vertex *to, const struct ph_vertex *v)
{
    const bool far = (v->code & PH_CLIP) != 0 || ((uint32_t)v->x | (uint32_t)v->y) >> 16 != 0;
    const uint32_t over = far ? 0 : ph_depth_before((struct ph_quotient){v->q, v->s}, 0, 0);
    *to = (struct ph_small_vertex){(uint16_t)(far ? v->code : v->x),
                                   (uint16_t)(far ? v->light : v->y),
                                   {(uint16_t)over, (uint16_t)(over >> 16)},
                                   far ? 0 : v->light};
}

/* Transforms and lights the vertices of a mesh for a material. NULL: there is no room. */
static PH_NOINLINE const struct ph_small_vertex *transform(struct ph_renderer *r, const struct ph_mesh *mesh,
                                                           const struct ph_clip_matrix *matrix,
                                                           const struct ph_xform *to_world,
                                                           const struct ph_material *material)
{
    struct ph_small_vertex *const to = ph_small_vertices(r, mesh->vertex_count);
    const bool lit = mesh->normals != NULL && ph_lit_corners_of(material) != PH_NO_CORNER;
    struct ph_local_lights lights;
    struct ph_vertex v;
    unsigned codes = 0;
    if (to == NULL) {
        return NULL;
    }
    if (lit) {
        ph_small_light_prepare(&lights, r, to_world, material);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        ph_transform(r, matrix, &mesh->positions[i], &v);
        v.light = lit ? ph_small_light_vertex(&lights, mesh->normals[i]) : PH_LIGHT_ZERO + PH_LIGHT_SPAN;
        codes |= v.code;
        store(&to[i], &v);
    }
    if ((codes & PH_CLIP) != 0 && r->clip == NULL) {
        r->clip = ph_small_room(r, sizeof(struct ph_small_clip)); /* without room, what must be clipped is left out */
    }
    return to;
}

/* Whether vertices that are lit for one material serve another. */
static bool is_lit_alike(const struct ph_material *a, const struct ph_material *b)
{
    return ph_lit_corners_of(b) == PH_NO_CORNER ||
           (ph_lit_corners_of(a) != PH_NO_CORNER && a->ambient == b->ambient && a->diffuse == b->diffuse &&
            a->specular == b->specular && a->shininess_log2 == b->shininess_log2);
}

/* Out of line, for its copies of a matrix would stay on the stack. */
static PH_NOINLINE void set_matrix(const struct ph_renderer *r, const struct ph_xform *to_world,
                                   struct ph_clip_matrix *matrix)
{
    const struct ph_xform object_to_view = ph_xform_mul(&r->view, to_world);
    *matrix = ph_clip_matrix(&r->lens, &object_to_view);
}

int ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (!ph_mesh_is_whole(mesh) || to_world == NULL || !is_drawn(mesh)) {
        return PH_ERR_INVAL;
    }
    if (r->state != PH_SMALL_OPEN) {
        return PH_ERR_STATE;
    }
    const struct ph_material *lit_as = NULL;
    const struct ph_small_vertex *vertices = NULL;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        const struct ph_material *const material = &mesh->materials[part->material];
        struct ph_small_part *const to = ph_small_room(r, sizeof *to);
        r->stats.triangles_in += part->count;
        if (to != NULL) {
            set_matrix(r, to_world, &to->matrix);
        }
        if (to != NULL && (vertices == NULL || !is_lit_alike(lit_as, material))) {
            lit_as = material;
            vertices = transform(r, mesh, &to->matrix, to_world, material);
        }
        if (to == NULL || vertices == NULL) {
            r->stats.triangles_dropped += part->count;
            continue;
        }
        to->material = material;
        to->positions = mesh->positions;
        to->triangles = &mesh->triangles[part->first];
        to->vertices = vertices;
        to->count = part->count;
        to->next = NULL;
        *(r->last != NULL ? &r->last->next : &r->first) = to;
        r->last = to;
    }
    return PH_OK;
}
