/* mesh: what one core and two share to draw a mesh. Private to firmware/core. */
#ifndef PH_MESH_H
#define PH_MESH_H

#include "clip.h"
#include "colours.h"
#include "cull.h"
#include "light.h"
#include "list.h"
#include "transform.h"

#define PH_MESH_BLOCK 128u /* triangles that two cores cull at a time where some may have to be clipped */

/* What is the same for all triangles of a part. */
struct ph_part_context {
    bool lit, two_sided;
    bool coloured, lit_coloured; /* the part has lit colours; lit_as has them */
    bool mixed;                  /* the vertices have the lights of several materials */
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_material *material, *lit_as; /* lit_as: of the part whose light the vertices have, or NULL */
    const struct ph_clip_matrix *matrix;
    struct ph_vertex *vertices;
    struct ph_draw draw;
    uint32_t codes;                       /* clip codes of all vertices, combined by OR */
    const struct ph_lighting *lighting;   /* NULL: vertices have no light */
    const struct ph_part_lighting *parts; /* NULL: nothing can be lit */
    const struct ph_curved_lens *curved;  /* NULL: straight lines stay straight */
    struct ph_local_lights lights;        /* last, as in struct ph_renderer */
};

/* Lights the vertices of a part. Lit shadings and PH_COLOURS name it; the linker leaves it out of a program without. */
struct ph_part_lighting {
    /* Prepares the light. False if there is no room for another light of the vertices. */
    bool (*light_part)(struct ph_part_context *c, const struct ph_part *part, const struct ph_xform *to_world);
    /* Lights the vertices that ph_cull has marked. */
    void (*light_marked)(const struct ph_part_context *c);
    /* Lights the corners of a triangle, unless they are lit already. */
    void (*light_corners)(const struct ph_part_context *c, const uint16_t index[3]);
};

extern const struct ph_part_lighting ph_part_lighting;

/* The light of a vertex, or its lit colour. */
static inline uint16_t ph_vertex_light(const struct ph_part_context *c, uint32_t i)
{
    return c->coloured ? c->r->config.colouring->vertex_colour(c, i)
                       : c->lighting->light_vertex(&c->lights, c->mesh->normals[i], &c->mesh->positions[i]);
}

/* A vertex as clipping needs it. */
struct ph_clip_vertex ph_mesh_vertex(const struct ph_part_context *c, uint32_t index);

/* mesh.c: draws all triangles of a part, one by one: where ph_cull cannot judge them. Returns how many can be seen. */
uint32_t ph_draw_each(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);

/* Draws any triangle: with clip codes, facing away, under a fisheye. False if it cannot be seen. */
bool ph_draw_any(const struct ph_part_context *c, const uint16_t index[3]);

/* What ph_cull takes to list triangles of a part from the list's end on. */
static inline struct ph_cull_run ph_cull_run_of(const struct ph_part_context *c, const uint16_t (*index)[3],
                                                const uint16_t (*end)[3])
{
    const struct ph_list *const list = &c->r->list;
    return (struct ph_cull_run){.vertices = c->vertices,
                                .index = index,
                                .end = end,
                                .codes = c->codes,
                                .to = list->to,
                                .limit = list->end,
                                .band_scale = list->band_scale,
                                .mark = c->lit ? PH_LIT : 0};
}

/* mesh.c: lists the triangles of a part on this core. ph_cull lists most of them. Returns how many can be seen. */
uint32_t ph_cull_alone(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);

/* mesh_cores.c: draws triangles without texture coordinates as ph_draw_each does, on two cores where both are free. */
uint32_t ph_each_both(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);

/* mesh_cores.c: lists the triangles of a part as ph_cull_alone does, on two cores where both are free. */
uint32_t ph_cull_both(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);

/* mesh_edges.c: draws each edge of the mesh once, as a line. */
void ph_draw_edges(const struct ph_part_context *c);

#endif
