/* Vertices and triangles of a mesh: transform, project, reject, cull. See pipeline.h. */
#include "fisheye.h"
#include "kernels.h"
#include "pipeline.h"

#define NOINLINE                                                                                                       \
    __attribute__((noinline)) /* keeps what is rare, or has values enough, from the registers of a loop                \
                               */

static void fold_row(struct ph_clip_matrix *out, int row, const struct ph_xform *object_to_view, int from,
                     int32_t scale)
{
    for (int j = 0; j < 3; j++) {
        out->m[row][j] = (int32_t)((fx_mul_wide(object_to_view->r[from][j], scale) + ((int64_t)1 << 31)) >> 32);
    }
    const struct fx_vec3 t = object_to_view->t;
    const int32_t along = from == 0 ? t.x : from == 1 ? t.y : t.z;
    out->t[row] = fx_mul_wide(fx_sat64((fx_mul_wide(along, scale) + (1 << 29)) >> 30), 1 << 28) + (1 << 27);
}

/* Rotation, place, focal length and the direction of the screen's axes in one matrix. */
struct ph_clip_matrix ph_clip_matrix(const struct ph_lens *lens, const struct ph_xform *object_to_view)
{
    struct ph_clip_matrix m;
    fold_row(&m, 0, object_to_view, 0, lens->focal_x);
    fold_row(&m, 1, object_to_view, 1, -lens->focal_y);
    fold_row(&m, 2, object_to_view, 2, -FX_Q30_ONE);
    return m;
}

/* x / w of the reciprocal of w (31 bits) in 2^-25; |x| <= 8 w. */
static inline int32_t divide_q25(int32_t x, int32_t reciprocal, int shift)
{
    const int32_t aligned = shift >= 4 ? (int32_t)((uint32_t)x << (shift - 4)) : x >> (4 - shift);
    return (int32_t)(fx_mul_wide(aligned, reciprocal) >> 32);
}

/* 2^-25 to 1/256 px, rounded. */
static inline int32_t screen_q8(const struct ph_lens *lens, int32_t q25)
{
    const int down = 17 - lens->focal_log2;
    return down > 0 ? (q25 + ((1 << down) >> 1)) >> down : q25 * (1 << -down);
}

static inline void project_perspective(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v)
{
    int shift;
    const uint32_t reciprocal = fx_rcp_norm((uint32_t)w, &shift);
    const int32_t positive = (int32_t)(reciprocal >> 1);
    v->x = lens->centre_x + screen_q8(lens, divide_q25(x, positive, shift));
    v->y = lens->centre_y + screen_q8(lens, divide_q25(y, positive, shift));
    ph_vertex_depth(v, ph_depth_quotient_of(lens, reciprocal, shift));
}

void ph_project(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, int32_t z, struct ph_vertex *v)
{
    if (lens->kind == PH_PERSPECTIVE) {
        project_perspective(lens, x, y, w, v);
        return;
    }
    ph_vertex_depth(v, ph_depth_quotient(lens, z)); /* orthographic: w = 1, Q16.16 to 2^-25 */
    v->x = lens->centre_x + screen_q8(lens, x * 512);
    v->y = lens->centre_y + screen_q8(lens, y * 512);
}

/* Clip codes of a vertex that is not projected: screen 256 (x 2^focal_log2 / w) + centre against 0 and size, times w.
 */
static uint8_t side_codes(int32_t x, int32_t w, const struct ph_lens *lens, int32_t centre, int32_t size, uint8_t below)
{
    const int64_t at = (int64_t)((uint64_t)(int64_t)x << (lens->focal_log2 + 8)) + (int64_t)centre * w;
    return (uint8_t)(at < 0 ? below : at > (int64_t)(size * 256) * w ? below * 2 : 0);
}

/* Clip codes of the sides, of a vertex that is projected. */
static uint8_t screen_codes(const struct ph_renderer *r, const struct ph_vertex *v)
{
    const int32_t right = r->config.width * 256, bottom = r->config.height * 256;
    const unsigned across = v->x < 0 ? PH_LEFT : v->x > right ? PH_RIGHT : 0;
    return (uint8_t)(across | (v->y < 0 ? PH_TOP : v->y > bottom ? PH_BOTTOM : 0u));
}

/* A vertex of any lens, wherever it is. */
static NOINLINE void place_vertex(const struct ph_renderer *r, int32_t x, int32_t y, int32_t z, struct ph_vertex *v)
{
    const struct ph_lens *lens = &r->lens;
    if (lens->kind == PH_FISHEYE) {
        ph_fisheye_vertex(lens, x, y, z, v);
        return;
    }
    const int32_t w = lens->kind == PH_PERSPECTIVE ? z : FX_ONE;
    const int32_t width = r->config.width, height = r->config.height;
    uint8_t code = z < lens->near_z ? PH_NEAR : z > lens->far_z ? PH_FAR : 0;
    if (w < 0 || code == PH_NEAR || ((fx_magnitude(x) | fx_magnitude(y)) >> 31) != 0 ||
        (fx_magnitude(x) + 7) >> 3 > (uint32_t)w >> lens->guard_up ||
        (fx_magnitude(y) + 7) >> 3 > (uint32_t)w >> lens->guard_up) {
        code |= side_codes(x, w, lens, lens->centre_x, width, PH_LEFT);
        code |= side_codes(y, w, lens, lens->centre_y, height, PH_TOP);
        v->code = code | PH_GUARD;
        return;
    }
    ph_project(lens, x, y, w, z, v);
    v->code = code | screen_codes(r, v);
}

void ph_transform(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *p,
                  struct ph_vertex *v)
{
    place_vertex(r, ph_matrix_row_mul(m, 0, p), ph_matrix_row_mul(m, 1, p), ph_matrix_row_mul(m, 2, p), v);
}

/* Vertices from here on, 4096.0 and beyond, are not for ph_vertices. */
#define USUAL_W ((uint32_t)1 << 28)

/* A centre, with half a unit of what will be rounded: see struct ph_vertex_run. */
static int64_t rounded_centre(int32_t centre, int down)
{
    return (int64_t)((uint64_t)((uint32_t)centre << down | (uint32_t)1 << (down - 1)) << 32);
}

/* False where nothing is for ph_vertices: it knows a perspective whose numbers keep to their usual size. */
static bool start_run(struct ph_vertex_run *run, const struct ph_renderer *r, const struct ph_clip_matrix *m)
{
    const struct ph_lens *lens = &r->lens;
    const uint32_t near = (uint32_t)lens->near_z, far = (uint32_t)lens->far_z;
    const int down = 17 - lens->focal_log2;
    ph_matvec_prepare(&run->rows, m);
    if (lens->kind != PH_PERSPECTIVE || near >= USUAL_W || down < 1 || run->rows.reach == 0) {
        return false;
    }
    run->near = near;
    run->range = (far < USUAL_W ? far : USUAL_W - 1) - near;
    run->round_x = rounded_centre(lens->centre_x, down);
    run->round_y = rounded_centre(lens->centre_y, down);
    run->depth_scale = lens->depth_scale;
    run->near_shift = lens->near_shift;
    run->right = (uint32_t)r->config.width * 256;
    run->bottom = (uint32_t)r->config.height * 256;
    run->guard_up = lens->guard_up;
    run->down = (uint32_t)down;
    return true;
}

/* All vertices of a mesh. Returns their clip codes, together. */
static NOINLINE uint32_t transform_mesh(const struct ph_renderer *r, const struct ph_clip_matrix *m,
                                        const struct ph_mesh *mesh, struct ph_vertex *vertices)
{
    struct ph_vertex_run run;
    run.from = mesh->positions;
    run.end = mesh->positions + mesh->vertex_count;
    run.to = vertices;
    run.codes = 0;
    const bool usual = start_run(&run, r, m);
    while (run.from < run.end) {
        if (usual) {
            ph_vertices(&run);
            if (run.from == run.end) {
                break;
            }
        }
        const bool known = usual && ph_matvec_in_range(&run.rows, run.from);
        const struct fx_vec3 at = known ? run.at : ph_matrix_mul(m, run.from);
        place_vertex(r, at.x, at.y, at.z, run.to);
        run.to->light = PH_LIGHT_ZERO + PH_LIGHT_SPAN; /* of what is not lit */
        run.codes |= run.to->code;
        run.from++;
        run.to++;
    }
    return run.codes;
}

/* What the triangles of one part need. */
struct part_context {
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_material *material;
    const struct ph_clip_matrix *matrix;
    struct ph_vertex *vertices;
    struct ph_local_lights lights;
    uint32_t codes; /* of all vertices together */
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

struct ph_clip_vertex ph_clip_place(const struct ph_lens *lens, const struct ph_clip_matrix *m, const struct fx_vec3 *p)
{
    const int32_t x = ph_matrix_row_mul(m, 0, p), y = ph_matrix_row_mul(m, 1, p), z = ph_matrix_row_mul(m, 2, p);
    const int32_t w = lens->kind == PH_ORTHOGRAPHIC ? FX_ONE : z;
    return (struct ph_clip_vertex){.x = x, .y = y, .w = w, .z = z};
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

static struct ph_corner project_corner(const struct ph_lens *lens, const struct ph_clip_vertex *in)
{
    struct ph_vertex v;
    ph_project(lens, in->x, in->y, in->w, in->z, &v);
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

/* A triangle that needs no clipping. False: it is not to be seen. */
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

/*
 * A triangle of which a corner may have a clip code, which may face away, or under a fisheye. False: it is not to be
 * seen, which is not counted yet.
 */
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

/* All triangles of a part, in a mesh of which none can be passed over. Returns how many are to be seen. */
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

static uint32_t draw_facing(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_cull_run visit = {.vertices = c->vertices, .index = index, .end = end, .codes = c->codes};
    uint32_t seen = 0;
    while (ph_cull(&visit)) {
        seen += visit.codes == 0 ? draw_whole(c, visit.index[-1], visit.v, &visit.sides)
                                 : draw_any(c, visit.index[-1], visit.v);
    }
    return seen;
}

static void draw_triangles(const struct part_context *c, const struct ph_part *part)
{
    const uint16_t(*index)[3] = &c->mesh->triangles[part->first], (*const end)[3] = index + part->count;
    const uint32_t seen = c->curved || c->two_sided ? draw_each(c, index, end) : draw_facing(c, index, end);
    c->r->stats.triangles_culled += part->count - seen;
}

/* A line as a parallelogram, one pixel wide across its longer axis: one pixel a column (or row), no raster code of its
 * own. */
void ph_setup_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                   const struct ph_corner *b)
{
    const bool wide = fx_abs_sat(b->at.x - a->at.x) >= fx_abs_sat(b->at.y - a->at.y);
    const int32_t side_x = wide ? 0 : 128, side_y = 128 - side_x;
    const bool turned = wide ? b->at.x > a->at.x : b->at.y < a->at.y; /* its front is what must be seen */
    const struct ph_corner *const from = turned ? b : a, *const to = turned ? a : b;
    struct ph_corner quad[4] = {*from, *to, *to, *from};
    for (int i = 0; i < 4; i++) {
        const int32_t sign = i < 2 ? -1 : 1;
        quad[i].at.x += sign * side_x;
        quad[i].at.y += sign * side_y;
    }
    ph_setup_corners(r, material, &quad[0], &quad[1], &quad[2]);
    ph_setup_corners(r, material, &quad[0], &quad[2], &quad[3]);
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

/* Each edge of the mesh once, as a line of its own. */
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
    c.codes = transform_mesh(r, &matrix, mesh, c.vertices);
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
