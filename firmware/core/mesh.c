/* Vertices and triangles of a mesh: transform, project, reject, cull. See pipeline.h. */
#include "fisheye.h"
#include "pipeline.h"

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

/* Elements below 2 in Q4.28 times 2^31: three products and the translation stay below 2^62. */
static int32_t row_times(const struct ph_clip_matrix *m, int row, const struct fx_vec3 *p)
{
    const int64_t sum =
        m->t[row] + fx_mul_wide(m->m[row][0], p->x) + fx_mul_wide(m->m[row][1], p->y) + fx_mul_wide(m->m[row][2], p->z);
    return fx_sat64(sum >> 28);
}

/* x / w of the reciprocal of w in 1/2^26; |x| <= 8 w. */
static int32_t divide_q26(int32_t x, uint32_t reciprocal, int shift)
{
    const int32_t aligned = shift >= 4 ? (int32_t)((uint32_t)x << (shift - 4)) : x >> (4 - shift);
    return (int32_t)(fx_mul_wide(aligned, (int32_t)(reciprocal >> 1)) >> 31);
}

void ph_project(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, int32_t z, struct ph_vertex *v)
{
    int32_t qx = x * 1024, qy = y * 1024; /* orthographic: w = 1, Q16.16 to 1/2^26 */
    if (lens->kind == PH_PERSPECTIVE) {
        int shift;
        const uint32_t reciprocal = fx_rcp_norm((uint32_t)w, &shift);
        qx = divide_q26(x, reciprocal, shift);
        qy = divide_q26(y, reciprocal, shift);
        v->depth = ph_depth_quotient_of(lens, reciprocal, shift);
    } else {
        v->depth = ph_depth_quotient(lens, z);
    }
    const int down = 18 - lens->focal_log2;
    const int32_t half = (1 << down) >> 1;
    v->x = lens->centre_x + ((qx + half) >> down);
    v->y = lens->centre_y + ((qy + half) >> down);
}

/* Clip codes of a vertex that is not projected: screen 256 (x 2^focal_log2 / w) + centre against 0 and size, times w.
 */
static uint8_t side_codes(int32_t x, int32_t w, const struct ph_lens *lens, int32_t centre, int32_t size, uint8_t below)
{
    const int64_t at = (int64_t)x * ((int64_t)1 << (lens->focal_log2 + 8)) + (int64_t)centre * w;
    return (uint8_t)(at < 0 ? below : at > (int64_t)size * 256 * w ? below * 2 : 0);
}

static inline void transform_vertex(const struct ph_renderer *r, const struct ph_clip_matrix *m,
                                    const struct fx_vec3 *p, struct ph_vertex *v)
{
    const struct ph_lens *lens = &r->lens;
    const int32_t x = row_times(m, 0, p), y = row_times(m, 1, p), z = row_times(m, 2, p);
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
    code |= v->x < 0 ? PH_LEFT : v->x > width * 256 ? PH_RIGHT : 0;
    code |= v->y < 0 ? PH_TOP : v->y > height * 256 ? PH_BOTTOM : 0;
    v->code = code;
}

void ph_transform(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *p,
                  struct ph_vertex *v)
{
    transform_vertex(r, m, p, v);
}

/* What the triangles of one part need. */
struct part_context {
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_material *material;
    const struct ph_clip_matrix *matrix;
    struct ph_vertex *vertices;
    struct ph_local_lights lights;
    bool lit;
};

static void light_vertex(const struct part_context *c, uint32_t index)
{
    struct ph_vertex *v = &c->vertices[index];
    if (c->lit && (v->code & PH_LIT) == 0) {
        v->light = ph_light_vertex(&c->lights, c->mesh->normals[index], c->mesh->positions[index]);
        v->code |= PH_LIT;
    }
}

struct ph_clip_vertex ph_clip_place(const struct ph_lens *lens, const struct ph_clip_matrix *m, const struct fx_vec3 *p)
{
    const int32_t x = row_times(m, 0, p), y = row_times(m, 1, p), z = row_times(m, 2, p);
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
    return (struct ph_corner){v.x, v.y, v.depth, (uint16_t)in->light, {in->uv[0], in->uv[1]}};
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
        any |= ph_setup_triangle(r, material, &first, &last, &next);
        last = next;
    }
    r->stats.triangles_culled += !any;
}

static void draw_clipped(const struct part_context *c, const uint16_t index[3])
{
    struct ph_clip_vertex in[3];
    for (int i = 0; i < 3; i++) {
        light_vertex(c, index[i]);
        in[i] = clip_vertex(c, index[i]);
    }
    if (c->material->shading != PH_SHADE_GOURAUD) { /* one light for the whole triangle */
        in[1].light = in[2].light = in[0].light;
    }
    ph_draw_clipped(c->r, c->material, in);
}

static struct ph_corner corner_of(const struct part_context *c, uint32_t index)
{
    light_vertex(c, index);
    const struct ph_vertex *v = &c->vertices[index];
    struct ph_corner corner = {v->x, v->y, v->depth, v->light, {0, 0}};
    if (c->mesh->uvs != NULL) {
        corner.uv[0] = c->mesh->uvs[index][0];
        corner.uv[1] = c->mesh->uvs[index][1];
    }
    return corner;
}

static void draw_triangle(const struct part_context *c, const uint16_t index[3])
{
    const struct ph_vertex *v0 = &c->vertices[index[0]], *v1 = &c->vertices[index[1]], *v2 = &c->vertices[index[2]];
    if ((v0->code & v1->code & v2->code & PH_REJECT) != 0) {
        c->r->stats.triangles_culled++;
        return;
    }
    if (((v0->code | v1->code | v2->code) & PH_CLIP) != 0 ||
        (c->r->lens.kind == PH_FISHEYE && !ph_fisheye_is_small(&c->r->lens, v0, v1, v2))) {
        draw_clipped(c, index);
        return;
    }
    if (c->material->two_sided == 0 && ph_area(v0->x, v0->y, v1->x, v1->y, v2->x, v2->y) <= 0) {
        c->r->stats.triangles_culled++;
        return;
    }
    const struct ph_corner a = corner_of(c, index[0]), b = corner_of(c, index[1]), d = corner_of(c, index[2]);
    c->r->stats.triangles_culled += !ph_setup_triangle(c->r, c->material, &a, &b, &d);
}

/* A line as a parallelogram, one pixel wide across its longer axis: one pixel a column (or row), no raster code of its
 * own. */
void ph_setup_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                   const struct ph_corner *b)
{
    const bool wide = fx_abs_sat(b->x - a->x) >= fx_abs_sat(b->y - a->y);
    const int32_t side_x = wide ? 0 : 128, side_y = 128 - side_x;
    const bool turned = wide ? b->x > a->x : b->y < a->y; /* its front is what must be seen */
    const struct ph_corner *const from = turned ? b : a, *const to = turned ? a : b;
    struct ph_corner quad[4] = {*from, *to, *to, *from};
    for (int i = 0; i < 4; i++) {
        const int32_t sign = i < 2 ? -1 : 1;
        quad[i].x += sign * side_x;
        quad[i].y += sign * side_y;
    }
    ph_setup_triangle(r, material, &quad[0], &quad[1], &quad[2]);
    ph_setup_triangle(r, material, &quad[0], &quad[2], &quad[3]);
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
static void draw_edges(const struct part_context *c)
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
    r->stats.triangles_in += part->count;
    for (uint32_t i = 0; i < part->count; i++) {
        draw_triangle(c, c->mesh->triangles[part->first + i]);
    }
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
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        transform_vertex(r, &matrix, &mesh->positions[i], &c.vertices[i]);
        c.vertices[i].light = PH_LIGHT_ZERO + PH_LIGHT_SPAN; /* of what is not lit */
    }
    r->stats.vertices += mesh->vertex_count;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        for (uint32_t k = 0; i > 0 && k < mesh->vertex_count; k++) { /* another material, another light */
            c.vertices[k].code &= (uint8_t)~PH_LIT;
        }
        draw_part(&c, &mesh->parts[i], to_world);
    }
    return PH_OK;
}

void ph_draw_line(struct ph_renderer *r, struct fx_vec3 a, struct fx_vec3 b, const struct ph_material *material)
{
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &r->view);
    const struct ph_clip_vertex ends[2] = {ph_clip_place(&r->lens, &matrix, &a), ph_clip_place(&r->lens, &matrix, &b)};
    draw_clip_line(r, material, ends);
}
