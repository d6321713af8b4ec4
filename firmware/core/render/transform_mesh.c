/* The vertices of a mesh, on one core or on two. See transform.h. */
#include "cores.h"
#include "transform.h"

/* Vertices that one core transforms. */
struct share_of_mesh {
    const struct ph_renderer *r;
    const struct ph_clip_matrix *m;
    const struct fx_vec3 *points;
    uint32_t n;
    struct ph_vertex *to;
    uint32_t codes;
};

PH_TIER(mesh) static void transform_share(void *argument) /* called as run */
{
    struct share_of_mesh *const s = argument;
    s->codes = ph_transform_points(s->r, s->m, s->points, s->n, s->to);
}

PH_TIER(mesh)
uint32_t ph_transform_mesh(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct ph_mesh *mesh,
                           struct ph_vertex *vertices)
{
    return r->config.other_core != NULL && mesh->vertex_count >= PH_SHARED_LEAST
               ? r->config.cores->transform_both(r, m, mesh, vertices)
               : ph_transform_points(r, m, mesh->positions, mesh->vertex_count, vertices);
}

PH_TIER(mesh)
uint32_t ph_transform_both(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct ph_mesh *mesh,
                           struct ph_vertex *vertices)
{
    const uint32_t n = mesh->vertex_count, half = n / 2;
    struct share_of_mesh mine = {r, m, mesh->positions, half, vertices, 0};
    struct share_of_mesh others = {r, m, mesh->positions + half, n - half, vertices + half, 0};
    ph_run_both(r, transform_share, &mine, &others);
    return mine.codes | others.codes;
}
