/* Triangles and lines that may have to be clipped, or divided under a fisheye. See clipped.h. */
#include "clipped.h"

#include "edge.h"
#include "fisheye.h"
#include "line.h"
#include "transform.h"

/* A corner that clipping has made is rounded. Some LSB from the eye that may carry it far out of the guard band. */
PH_TIER(few) static struct ph_corner project_corner(const struct ph_lens *lens, const struct ph_clip_vertex *in)
{
    struct ph_vertex v;
    ph_project(lens, in->x, in->y, in->w, in->z, &v);
    v.x = ph_max(ph_min(v.x, PH_GUARD_MAX), -PH_GUARD_MAX);
    v.y = ph_max(ph_min(v.y, PH_GUARD_MAX), -PH_GUARD_MAX);
    v.light = (uint16_t)in->light;
    v.code = 0;
    return (struct ph_corner){v, {in->uv[0], in->uv[1]}};
}

/* ph_draw_clipped without a fisheye, whose stack is deep enough without these corners. */
PH_TIER(few)
static PH_NOINLINE void clip_triangle(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                                      const struct ph_clip_vertex in[3])
{
    struct ph_clip_vertex out[PH_CLIP_MAX];
    struct ph_corner corners[PH_CLIP_MAX];
    const int n = ph_clip(&r->lens, in, 3, out);
    r->stats.triangles_clipped++;
    for (int i = 0; i < n; i++) {
        corners[i] = project_corner(&r->lens, &out[i]);
    }
    r->stats.triangles_culled += n < 3 || !ph_list_fan(r, material, kind, corners, (uint32_t)n);
}

PH_TIER(few)
void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                     const struct ph_clip_vertex in[3])
{
    if (r->lens.kind == PH_FISHEYE) {
        r->projection.curved->draw_curved(r, material, kind, in);
    } else {
        clip_triangle(r, material, kind, in);
    }
}

PH_TIER(scenery)
void ph_draw_clipped_line(struct ph_renderer *r, const struct ph_material *material,
                          const struct ph_clip_vertex ends[2])
{
    if (r->lens.kind == PH_FISHEYE) {
        r->projection.curved->draw_curved_line(r, material, ends);
        return;
    }
    struct ph_clip_vertex out[PH_CLIP_MAX];
    if (ph_clip(&r->lens, ends, 2, out) == 2) {
        const struct ph_corner corners[2] = {project_corner(&r->lens, &out[0]), project_corner(&r->lens, &out[1])};
        ph_list_segment(r, material, corners);
    }
}

PH_TIER(scenery)
int ph_draw_line(struct ph_renderer *r, struct fx_vec3 a, struct fx_vec3 b, const struct ph_material *material)
{
    if (material == NULL) {
        return PH_ERR_INVAL;
    }
    if (r->list.stage == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &r->view);
    const struct ph_clip_vertex ends[2] = {ph_clip_place(&r->lens, &matrix, &a), ph_clip_place(&r->lens, &matrix, &b)};
    const uint32_t since = r->list.last, before = ph_ref_count(r);
    r->lines = &ph_lines;
    if (material->blend != NULL && !ph_list_blend(r, material)) {
        r->stats.triangles_dropped++;
        return PH_OK;
    }
    ph_draw_clipped_line(r, material, ends);
    if (material->blend != NULL) {
        material->blend->draw->put_after(r, since, before);
    }
    r->stats.triangles_drawn = ph_ref_count(r);
    return PH_OK;
}
