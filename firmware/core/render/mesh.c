/* Meshes and lines: triangles are rejected, culled, lit, clipped, and handed on to set-up. See mesh.h, render.h. */
#include "mesh.h"

#include "cull.h"
#include "edge.h"
#include "fisheye.h"
#include "light.h"
#include "setup.h"
#include "transform.h"

#define NOINLINE __attribute__((noinline)) /* keeps rare work out of the registers of a loop */

/* What is the same for all triangles of a part. */
struct part_context {
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_material *material;
    const struct ph_clip_matrix *matrix;
    struct ph_vertex *vertices;
    struct ph_local_lights lights;
    uint32_t codes; /* clip codes of all vertices, combined by OR */
    bool lit, two_sided, curved;
};

static FX_APART void light_vertex(const struct part_context *c, uint32_t index)
{
    struct ph_vertex *v = &c->vertices[index];
    v->light = ph_light_vertex(&c->lights, c->mesh->normals[index], &c->mesh->positions[index]);
    v->code |= PH_LIT;
}

static void light_corners(const struct part_context *c, const uint16_t index[3], const struct ph_vertex *const v[3])
{
    for (int i = 0; c->lit && i < 3; i++) {
        if (v[i]->code < PH_LIT) {
            light_vertex(c, index[i]);
        }
    }
}

static struct ph_clip_vertex clip_vertex(const struct part_context *c, uint32_t index)
{
    struct ph_clip_vertex v = ph_clip_place(&c->r->lens, c->matrix, &c->mesh->positions[index]);
    v.light = c->vertices[index].light;
    if (c->mesh->uvs != NULL) {
        v.uv[0] = c->mesh->uvs[index][0];
        v.uv[1] = c->mesh->uvs[index][1];
    }
    return v;
}

/* A corner that clipping has made is rounded. Some LSB from the eye that may carry it far out of the guard band. */
static struct ph_corner project_corner(const struct ph_lens *lens, const struct ph_clip_vertex *in)
{
    struct ph_vertex v;
    ph_project(lens, in->x, in->y, in->w, in->z, &v);
    v.x = ph_max(ph_min(v.x, PH_REACH), -PH_REACH);
    v.y = ph_max(ph_min(v.y, PH_REACH), -PH_REACH);
    v.light = (uint16_t)in->light;
    v.code = 0;
    return (struct ph_corner){v, {in->uv[0], in->uv[1]}};
}

void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex in[3])
{
    if (r->lens.kind == PH_FISHEYE) {
        ph_fisheye_triangle(r, material, in);
        return;
    }
    struct ph_clip_vertex out[PH_CLIP_MAX];
    const int n = ph_clip(&r->lens, in, 3, out);
    r->stats.triangles_clipped++;
    if (n < 3) {
        r->stats.triangles_culled++;
        return;
    }
    bool any = false;
    const struct ph_corner first = project_corner(&r->lens, &out[0]);
    struct ph_corner last = project_corner(&r->lens, &out[1]);
    for (int i = 2; i < n; i++) {
        const struct ph_corner next = project_corner(&r->lens, &out[i]);
        any |= ph_setup_corners(r, material, &first, &last, &next);
        last = next;
    }
    r->stats.triangles_culled += !any;
}

static NOINLINE void draw_clipped(const struct part_context *c, const uint16_t index[3],
                                  const struct ph_vertex *const v[3])
{
    struct ph_clip_vertex in[3];
    light_corners(c, index, v);
    for (int i = 0; i < 3; i++) {
        in[i] = clip_vertex(c, index[i]);
    }
    if (c->material->shading != PH_SHADE_GOURAUD) { /* one light for the whole triangle */
        in[1].light = in[2].light = in[0].light;
    }
    ph_draw_clipped(c->r, c->material, in);
}

/* Lights and sets up a triangle that needs no clipping. False if it cannot be seen. */
static FX_APART bool draw_whole(const struct part_context *c, const uint16_t index[3],
                                const struct ph_vertex *const v[3], const struct ph_sides *sides)
{
    const fx_t *of_corners[3], *const *uv = NULL;
    light_corners(c, index, v);
    if (c->mesh->uvs != NULL) {
        for (int i = 0; i < 3; i++) {
            of_corners[i] = c->mesh->uvs[index[i]];
        }
        uv = of_corners;
    }
    return sides->area > 0 ? ph_setup_front(c->r, c->material, v, uv, sides)
                           : ph_setup_triangle(c->r, c->material, v, uv);
}

/* Draws any triangle: with clip codes, facing away, under a fisheye. False if it cannot be seen. */
static NOINLINE bool draw_any(const struct part_context *c, const uint16_t index[3], const struct ph_vertex *const v[3])
{
    const unsigned all = v[0]->code & v[1]->code & v[2]->code, any = v[0]->code | v[1]->code | v[2]->code;
    if ((all & PH_REJECT) != 0) {
        return false;
    }
    if ((any & PH_CLIP) != 0 || (c->curved && !ph_fisheye_is_small(&c->r->lens, v[0], v[1], v[2]))) {
        draw_clipped(c, index, v);
        return true;
    }
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    return (sides.area > 0 || c->two_sided) && draw_whole(c, index, v, &sides);
}

/* Draws all triangles of a part, one by one: where ph_cull cannot judge them. Returns how many can be seen. */
static uint32_t draw_each(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    uint32_t seen = 0;
    for (; index < end; index++) {
        const struct ph_vertex *const v[3] = {&c->vertices[(*index)[0]], &c->vertices[(*index)[1]],
                                              &c->vertices[(*index)[2]]};
        seen += draw_any(c, *index, v);
    }
    return seen;
}

/* The same with ph_cull, which passes over the triangles that cannot be seen. */
static uint32_t draw_facing(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_cull_run run = {.vertices = c->vertices, .index = index, .end = end, .codes = c->codes};
    uint32_t seen = 0;
    while (ph_cull(&run)) {
        seen += run.codes == 0 ? draw_whole(c, run.index[-1], run.v, &run.sides) : draw_any(c, run.index[-1], run.v);
    }
    return seen;
}

static void draw_triangles(const struct part_context *c, const struct ph_part *part)
{
    const uint16_t(*index)[3] = &c->mesh->triangles[part->first], (*const end)[3] = index + part->count;
    const uint32_t seen = c->curved || c->two_sided ? draw_each(c, index, end) : draw_facing(c, index, end);
    c->r->stats.triangles_culled += part->count - seen;
}

static void draw_clip_line(struct ph_renderer *r, const struct ph_material *material,
                           const struct ph_clip_vertex ends[2])
{
    if (r->lens.kind == PH_FISHEYE) {
        ph_fisheye_line(r, material, ends);
        return;
    }
    struct ph_clip_vertex out[PH_CLIP_MAX];
    if (ph_clip(&r->lens, ends, 2, out) == 2) {
        const struct ph_corner a = project_corner(&r->lens, &out[0]), b = project_corner(&r->lens, &out[1]);
        ph_setup_line(r, material, &a, &b);
    }
}

/* Draws each edge of the mesh once, as a line. */
static NOINLINE void draw_edges(const struct part_context *c)
{
    for (uint32_t i = 0; i < c->mesh->edge_count; i++) {
        const uint16_t *edge = c->mesh->edges[i];
        const struct ph_vertex *v0 = &c->vertices[edge[0]], *v1 = &c->vertices[edge[1]];
        if ((v0->code & v1->code & PH_REJECT) != 0) {
            continue;
        }
        const struct ph_clip_vertex ends[2] = {clip_vertex(c, edge[0]), clip_vertex(c, edge[1])};
        draw_clip_line(c->r, c->material, ends);
    }
}

static void draw_part(struct part_context *c, const struct ph_part *part, const struct ph_xform *to_world)
{
    struct ph_renderer *r = c->r;
    c->material = &c->mesh->materials[part->material];
    const uint8_t shading = c->material->shading;
    if (shading == PH_SHADE_WIRE) {
        draw_edges(c);
        return;
    }
    c->lit = c->mesh->normals != NULL && shading != PH_SHADE_UNLIT && shading != PH_SHADE_TEXTURE;
    if (c->lit) {
        ph_light_prepare(&c->lights, r, to_world, c->material);
    }
    ph_setup_part(r, c->material);
    r->stats.triangles_in += part->count;
    c->curved = r->lens.kind == PH_FISHEYE;
    c->two_sided = c->material->two_sided != 0;
    draw_triangles(c, part);
}

int ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (mesh->vertex_count > r->config.vertex_max) {
        r->stats.vertices_dropped += mesh->vertex_count;
        return PH_ERR_NOMEM;
    }
    const struct ph_xform object_to_view = ph_xform_mul(&r->view, to_world);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &object_to_view);
    struct part_context c = {.r = r, .mesh = mesh, .matrix = &matrix, .vertices = r->config.vertices};
    c.codes = ph_transform_mesh(r, &matrix, mesh, c.vertices);
    r->stats.vertices += mesh->vertex_count;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        for (uint32_t k = 0; i > 0 && k < mesh->vertex_count; k++) { /* another material, another light */
            c.vertices[k].code &= (uint8_t)~PH_LIT;
        }
        draw_part(&c, &mesh->parts[i], to_world);
    }
    r->small.material = NULL; /* the caller may change it */
    return PH_OK;
}

void ph_draw_line(struct ph_renderer *r, struct fx_vec3 a, struct fx_vec3 b, const struct ph_material *material)
{
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &r->view);
    const struct ph_clip_vertex ends[2] = {ph_clip_place(&r->lens, &matrix, &a), ph_clip_place(&r->lens, &matrix, &b)};
    draw_clip_line(r, material, ends);
}
