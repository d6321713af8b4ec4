/* Planar shadows: see shadow.h. Heights above the plane are Q18.46, as exact products of Q2.30 and Q16.16 are. */
#include "shadow.h"

#include "check.h"
#include "clipped.h"
#include "cull.h"
#include "fisheye.h"
#include "transform.h"

#define OUTSIDE     PH_GUARD /* clip code: not between plane and light */
#define POLYGON_MAX 5
#define CHUNK       16u /* vertices that are transformed at a time */

struct cast {
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_xform *to_world;
    const struct ph_plane_equation *plane;
    const struct ph_material *material;
    struct fx_vec3 light;
    int64_t light_height, highest; /* heights of the light, and of the highest point that casts a shadow */
    uint32_t whole;                /* light_height in units of 2^(down - 46), below 2^30 */
    int down;
    struct ph_clip_matrix matrix; /* world to clip coordinates, moved towards the viewer */
    struct ph_vertex *vertices;
    uint32_t codes; /* of all vertices, combined by OR */
    struct ph_draw draw;
};

/* A point of the object and its height above the plane. */
struct caster {
    struct fx_vec3 p;
    int64_t height;
};

/* A product of which one factor is often 0: planes are seldom oblique. */
static int64_t term(int32_t a, int32_t b)
{
    return a != 0 ? fx_mul_wide(a, b) : 0;
}

/* Components of the normal are -1 .. 1: the sum is then -2^63 or more, and below 2^63. */
static int64_t height_of(const struct ph_plane_equation *plane, struct fx_vec3 p)
{
    const struct fx_vec3 n = plane->normal_q30;
    return term(n.x, p.x) + term(n.y, p.y) + term(n.z, p.z) + term(plane->d, FX_Q30_ONE);
}

/* light + (p - light) ratio, ratio in Q24 up to 64, rounded to nearest, saturated. */
static fx_t along_ray(fx_t light, fx_t p, int32_t ratio)
{
    return fx_sat64(light + ((fx_mul_wide(fx_sat64((int64_t)p - light), ratio) + (1 << 23)) >> 24));
}

/* Projects a point that is not above `highest` onto the plane, from the light. */
static struct fx_vec3 shadow_of(const struct cast *c, const struct caster *v)
{
    const int64_t rest = (c->light_height - v->height) >> c->down;
    int shift;
    const uint32_t over_rest = fx_rcp_norm(rest > 0 ? (uint32_t)rest : 1, &shift); /* 2^(62 - shift) / rest */
    const uint64_t ratio = fx_mul_wide_u(c->whole, over_rest) >> (38 - shift);
    const int32_t r = (int32_t)(ratio < (uint64_t)1 << 30 ? ratio : (uint64_t)1 << 30);
    return (struct fx_vec3){along_ray(c->light.x, v->p.x, r), along_ray(c->light.y, v->p.y, r),
                            along_ray(c->light.z, v->p.z, r)};
}

static struct caster caster_of(const struct cast *c, uint32_t index)
{
    struct caster v = {.p = ph_xform_point(c->to_world, c->mesh->positions[index])};
    v.height = height_of(c->plane, v.p);
    return v;
}

static void transform_vertices(struct cast *c)
{
    const uint32_t all = c->mesh->vertex_count;
    struct fx_vec3 points[CHUNK];
    c->r->stats.vertices += all;
    for (uint32_t from = 0, n; from < all; from += n) {
        uint32_t outside = 0;
        n = all - from < CHUNK ? all - from : CHUNK;
        for (uint32_t i = 0; i < n; i++) {
            const struct caster v = caster_of(c, from + i);
            const bool is_outside = v.height < 0 || v.height > c->highest;
            points[i] = is_outside ? c->light : shadow_of(c, &v);
            outside |= (uint32_t)is_outside << i;
        }
        c->codes |= ph_transform_points(c->r, &c->matrix, points, n, c->vertices + from) | (outside != 0 ? OUTSIDE : 0);
        for (struct ph_vertex *v = c->vertices + from; outside != 0; outside >>= 1, v++) {
            v->code = (outside & 1) != 0 ? OUTSIDE : v->code;
        }
    }
}

/* ---- triangles that reach below the plane or too near to the light ---------------------------------------------- */

/*
 * The point of an edge at a height between those of its ends. It is computed from the inner end, so that both triangles
 * of the edge get the same point.
 */
static struct caster crossing(const struct caster *inside, const struct caster *outside, int64_t height)
{
    int64_t part = height - inside->height, whole = (outside->height >> 1) - (inside->height >> 1);
    part >>= 1;
    while (whole >= (int64_t)1 << 30 || whole <= -((int64_t)1 << 30)) { /* at most 33 times */
        whole /= 2;
        part /= 2;
    }
    const int64_t t = whole != 0 ? part * FX_Q30_ONE / whole : 0;
    const int32_t t_q30 = t < 0 ? 0 : t > FX_Q30_ONE ? FX_Q30_ONE : (int32_t)t;
    const fx_t from[3] = {inside->p.x, inside->p.y, inside->p.z};
    const fx_t to[3] = {outside->p.x, outside->p.y, outside->p.z};
    fx_t at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = fx_sat64(from[i] + ((fx_mul_wide((to[i] >> 1) - (from[i] >> 1), t_q30) + (1 << 28)) >> 29));
    }
    return (struct caster){{at[0], at[1], at[2]}, height};
}

/* Clips a polygon: keeps what is above (sign 1) or below (sign -1) a height. Returns the number of corners left. */
static int clip_at(const struct caster *in, int n, struct caster *out, int64_t height, int sign)
{
    int count = 0;
    for (int i = 0; i < n; i++) {
        const struct caster *a = &in[i], *b = &in[i + 1 < n ? i + 1 : 0];
        const bool a_in = sign * a->height >= sign * height, b_in = sign * b->height >= sign * height;
        if (a_in) {
            out[count++] = *a;
        }
        if (a_in != b_in) {
            out[count++] = a_in ? crossing(a, b, height) : crossing(b, a, height);
        }
    }
    return count;
}

static void draw_clipped(const struct cast *c, const uint16_t index[3])
{
    struct caster in[3], above[POLYGON_MAX], between[POLYGON_MAX];
    for (int i = 0; i < 3; i++) {
        in[i] = caster_of(c, index[i]);
    }
    const int n = clip_at(above, clip_at(in, 3, above, 0, 1), between, c->highest, -1);
    struct ph_clip_vertex corners[POLYGON_MAX];
    for (int i = 0; i < n; i++) {
        const struct fx_vec3 s = shadow_of(c, &between[i]);
        corners[i] = ph_clip_place(&c->r->lens, &c->matrix, &s);
        corners[i].light = PH_LIGHT_ZERO;
    }
    struct ph_stats *const stats = &c->r->stats;
    const uint32_t culled = stats->triangles_culled, clipped = stats->triangles_clipped, before = ph_ref_count(c->r);
    for (int i = 2; i < n; i++) {
        const struct ph_clip_vertex fan[3] = {corners[0], corners[i - 1], corners[i]};
        ph_draw_clipped(c->r, c->material, 0, fan);
    }
    stats->triangles_culled = culled + (ph_ref_count(c->r) == before); /* its pieces count as one */
    stats->triangles_clipped = clipped + 1;
    ph_list_again(c->r, &c->draw);
}

/* ---- triangles ------------------------------------------------------------------------------------------------ */

static void draw_any(const struct cast *c, const uint16_t index[3])
{
    const struct ph_vertex *const v[3] = {&c->vertices[index[0]], &c->vertices[index[1]], &c->vertices[index[2]]};
    const unsigned all = v[0]->code & v[1]->code & v[2]->code, any = v[0]->code | v[1]->code | v[2]->code;
    if ((all & PH_REJECT) != 0) {
        c->r->stats.triangles_culled++;
        return;
    }
    if ((any & PH_CLIP) != 0 ||
        (c->r->lens.kind == PH_FISHEYE && !c->r->projection.curved->is_straight(&c->r->lens, v[0], v[1], v[2]))) {
        draw_clipped(c, index);
        return;
    }
    c->r->stats.triangles_culled += !ph_list_triangle(c->r, index, v, c->material->two_sided != 0);
}

/* Draws the triangles of a part; ph_cull lists most of those of a shadow with one side. */
static void draw_triangles(const struct cast *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    if (c->material->two_sided != 0 || c->r->lens.kind == PH_FISHEYE) {
        for (; index < end; index++) {
            draw_any(c, *index);
        }
        return;
    }
    struct ph_list *const list = &c->r->list;
    struct ph_cull_run run = {
        .vertices = c->vertices, .index = index, .end = end, .codes = c->codes, .band_scale = list->band_scale};
    uint32_t judged = 0;
    for (; ph_cull_into(list, &run, &judged); judged++) {
        draw_any(c, run.index[-1]);
    }
    c->r->stats.triangles_culled += (uint32_t)(end - index) - judged;
}

/*
 * Moves the shadow towards the viewer, see shadow.h. A smaller matrix gives smaller x, y and w; the division by w
 * undoes this for x and y.
 */
static void move_nearer(struct ph_clip_matrix *m, const struct ph_lens *lens)
{
    if (lens->kind == PH_ORTHOGRAPHIC) {
        m->t[2] -= fx_mul_wide(lens->far_z / 2048 - lens->near_z / 2048, 1 << 28);
        return;
    }
    const int part = lens->kind == PH_FISHEYE ? 32 : 512;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            m->m[i][k] -= m->m[i][k] / part;
        }
        m->t[i] -= m->t[i] / part;
    }
}

/* Whether the viewer is on the lit side of the plane. An orthographic camera has no eye: its direction decides. */
static bool sees_lit_side(const struct ph_renderer *r, const struct ph_plane_equation *plane)
{
    const struct ph_xform camera = ph_xform_inverse_rigid(&r->view);
    if (r->lens.kind != PH_ORTHOGRAPHIC) {
        return height_of(plane, camera.t) > 0;
    }
    const struct fx_vec3 from = {camera.r[0][2] / 2, camera.r[1][2] / 2, camera.r[2][2] / 2};
    return height_of(&(struct ph_plane_equation){plane->normal_q30, 0}, from) > 0;
}

static int32_t within_one(int32_t q30)
{
    return q30 > FX_Q30_ONE ? FX_Q30_ONE : q30 < -FX_Q30_ONE ? -FX_Q30_ONE : q30;
}

int ph_draw_shadow(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world,
                   struct fx_vec3 light, const struct ph_plane_equation *plane, const struct ph_material *material)
{
    if (!ph_mesh_is_whole(mesh) || to_world == NULL || plane == NULL || material == NULL) {
        return PH_ERR_INVAL;
    }
    const struct fx_vec3 normal = plane->normal_q30;
    const struct ph_plane_equation in_range = {{within_one(normal.x), within_one(normal.y), within_one(normal.z)},
                                               plane->d};
    struct cast c = {
        .r = r, .mesh = mesh, .to_world = to_world, .plane = &in_range, .material = material, .light = light};
    c.light_height = height_of(&in_range, light);
    c.highest = c.light_height - (c.light_height >> 6);
    if (c.light_height <= 0 || (material->two_sided == 0 && !sees_lit_side(r, &in_range))) {
        return PH_OK;
    }
    while (c.light_height >> c.down >> 30 != 0) { /* at most 33 times */
        c.down++;
    }
    c.whole = (uint32_t)(c.light_height >> c.down);
    const struct ph_mark mark = ph_list_mark(r);
    const uint32_t n = mesh->vertex_count;
    c.draw = (struct ph_draw){.material = material, .kind = PH_DRAW_SMALL};
    c.draw.base = n - 1 < r->config.vertex_max ? ph_list_vertices(r, n) : UINT32_MAX;
    if (c.draw.base == UINT32_MAX || (material->blend != NULL && !ph_list_blend(r, material)) ||
        !ph_list_draw(r, &c.draw)) {
        ph_list_rewind(r, &mark);
        return ph_list_leave_out(r, mesh, false);
    }
    c.material = c.draw.material = ph_list_material(r);
    c.matrix = ph_clip_matrix(&r->lens, &r->view);
    move_nearer(&c.matrix, &r->lens);
    c.vertices = ph_at(r, c.draw.base);
    transform_vertices(&c);
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *part = &mesh->parts[i];
        if (ph_is_wire(&mesh->materials[part->material]) || part->count == 0) {
            continue;
        }
        r->stats.triangles_in += part->count;
        draw_triangles(&c, mesh->triangles + part->first, mesh->triangles + part->first + part->count);
    }
    if (material->blend != NULL) {
        material->blend->draw->put_after(r, mark.last, mark.count);
    }
    ph_list_rewind(r, &mark);
    r->stats.triangles_drawn = ph_ref_count(r);
    return PH_OK;
}
