/* transform: from the coordinates of a mesh to clip coordinates and to the screen. Private to firmware/core. */
#ifndef PH_TRANSFORM_H
#define PH_TRANSFORM_H

#include "clip.h"
#include "vertex.h"

/* Object to clip coordinates. Elements are Q4.28. The translation is Q20.44 and contains half an LSB of Q16.16, which
 * rounds the result. Row 2 gives the distance along the view. */
struct ph_clip_matrix {
    int32_t m[3][3];
    int64_t t[3];
};

/* The matrix of a lens: the view, the focal lengths, and the direction of the screen's axes in one. */
struct ph_clip_matrix ph_clip_matrix(const struct ph_lens *lens, const struct ph_xform *object_to_view);

/* A row of the matrix times a point. Elements are below 2 in Q4.28, points below 2^31: the sum stays below 2^62. */
PH_TIER(mesh) static inline int32_t ph_matrix_row_mul(const struct ph_clip_matrix *m, int row, const struct fx_vec3 *p)
{
    const int64_t sum =
        m->t[row] + fx_mul_wide(m->m[row][0], p->x) + fx_mul_wide(m->m[row][1], p->y) + fx_mul_wide(m->m[row][2], p->z);
    return fx_sat64(sum >> 28);
}

static inline struct fx_vec3 ph_matrix_mul(const struct ph_clip_matrix *m, const struct fx_vec3 *p)
{
    return (struct fx_vec3){ph_matrix_row_mul(m, 0, p), ph_matrix_row_mul(m, 1, p), ph_matrix_row_mul(m, 2, p)};
}

/* A point in clip coordinates, without light and texture. */
struct ph_clip_vertex ph_clip_place(const struct ph_lens *lens, const struct ph_clip_matrix *m,
                                    const struct fx_vec3 *p);

/* Projects a corner that lies inside the near plane and the guard band: sets x, y, q and s of the vertex. */
void ph_project(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, int32_t z, struct ph_vertex *v);

/* Transforms a point and sets its clip codes; projects it if it can be projected. */
void ph_transform(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *p,
                  struct ph_vertex *v);

/* Transforms n points on this core alone, and gives them full light. Returns their clip codes, combined by OR. */
uint32_t ph_transform_points(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *points,
                             uint32_t n, struct ph_vertex *vertices);

/* transform_mesh.c: transforms all vertices of a mesh and gives them full light. Returns their clip codes, combined by
 * OR. */
uint32_t ph_transform_mesh(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct ph_mesh *mesh,
                           struct ph_vertex *vertices);

/* Does what ph_transform_mesh does, on two cores. Only a renderer with two cores names it. */
uint32_t ph_transform_both(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct ph_mesh *mesh,
                           struct ph_vertex *vertices);

#endif
