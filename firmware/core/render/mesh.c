/* Meshes: triangles are rejected, culled, lit, clipped and listed. See clipped.h, list.h, render.h. */
/* Kits on armv6m: -O3. */
#include "check.h"
#include "clipped.h"
#include "colour.h"
#include "cores.h"
#include "cull.h"
#include "edge.h"
#include "fisheye.h"
#include "light.h"
#include "line.h"
#include "setup.h"
#include "transform.h"

#define BLOCK 128u /* triangles that two cores cull at a time where some may have to be clipped */

/* Triangles that are drawn one by one: fewer than these are drawn by one core, which draws so many before it asks for
 * the other core again. */
#define EACH_LEAST 6
#define EACH_ALONE 3

/* What is the same for all triangles of a part. */
struct part_context {
    struct ph_renderer *r;
    const struct ph_mesh *mesh;
    const struct ph_material *material, *lit_as; /* lit_as: of the part whose light the vertices have, or NULL */
    const struct ph_clip_matrix *matrix;
    struct ph_vertex *vertices;
    struct ph_draw draw;
    struct ph_local_lights lights;
    uint32_t codes;                      /* clip codes of all vertices, combined by OR */
    const struct ph_curved_lens *curved; /* NULL: straight lines stay straight */
    bool lit, two_sided;
    bool coloured, lit_coloured; /* the part has lit colours; lit_as has them */
    bool mixed;                  /* the vertices have the lights of several materials */
};

/* The light of a vertex, or its lit colour. */
static PH_NOINLINE uint16_t colour_of(const struct part_context *c, uint32_t i)
{
    const struct ph_mesh *const mesh = c->mesh;
    const int16_t *const normal =
        mesh->normals != NULL && c->material->shading != PH_SHADE_UNLIT ? mesh->normals[i] : NULL;
    return ph_light_colour(&c->lights, normal, &mesh->positions[i],
                           ph_wire16(mesh->colours != NULL ? mesh->colours[i] : c->material->colour));
}

static inline uint16_t light_of(const struct part_context *c, uint32_t i)
{
    return c->coloured ? colour_of(c, i) : ph_light_vertex(&c->lights, c->mesh->normals[i], &c->mesh->positions[i]);
}

/* Lights the corners of a triangle, unless they are lit already. ph_cull may have marked them only. */
PH_TIER(scenery) static void light_corners(const struct part_context *c, const uint16_t index[3])
{
    for (int i = 0; c->lit && i < 3; i++) {
        struct ph_vertex *const corner = &c->vertices[index[i]];
        const unsigned code = __atomic_load_n(&corner->code, __ATOMIC_ACQUIRE), lit = ph_light_of(corner);
        if (code >= PH_LIT && lit != 0) {
            continue;
        }
        const uint16_t light = light_of(c, index[i]); /* both cores may compute and write this light: it is the same */
        __atomic_store_n(&corner->light, light, __ATOMIC_RELAXED);
        __atomic_store_n(&corner->code, (uint8_t)(code | PH_LIT), __ATOMIC_RELEASE);
    }
}

PH_TIER(few) static struct ph_clip_vertex clip_vertex(const struct part_context *c, uint32_t index)
{
    struct ph_clip_vertex v = ph_clip_place(&c->r->lens, c->matrix, &c->mesh->positions[index]);
    v.light = ph_light_of(&c->vertices[index]);
    if (c->mesh->uvs != NULL) {
        v.uv[0] = c->mesh->uvs[index][0];
        v.uv[1] = c->mesh->uvs[index][1];
    }
    return v;
}

/* The channels of lit colours take the places of light, u and v, 16 bits each: see ph_list_corners. */
static PH_NOINLINE void take_colours(struct ph_clip_vertex in[3], bool flat)
{
    for (int i = 0; i < 3; i++) {
        const int32_t colour = in[flat ? 0 : i].light;
        in[i].uv[0] = (colour >> 5 & 63) << 10 | 1 << 9;
        in[i].uv[1] = (colour & 31) << 11 | 1 << 10;
        in[i].light = flat && i == 0 ? colour : (colour >> 11) << 11 | 1 << 10;
    }
    in[0].light = (in[0].light >> 11) << 11 | 1 << 10;
}

PH_TIER(few) static PH_NOINLINE void draw_clipped(const struct part_context *c, const uint16_t index[3])
{
    struct ph_clip_vertex in[3];
    light_corners(c, index);
    for (int i = 0; i < 3; i++) {
        in[i] = clip_vertex(c, index[i]);
    }
    if (c->coloured) {
        take_colours(in, c->material->shading == PH_SHADE_FLAT);
    } else if (c->material->shading != PH_SHADE_GOURAUD) { /* one light for the whole triangle */
        in[1].light = in[2].light = in[0].light;
    }
    ph_draw_clipped(c->r, c->material, c->draw.kind, in);
    ph_list_again(c->r, &c->draw);
}

/* Draws any triangle: with clip codes, facing away, under a fisheye. False if it cannot be seen. */
static PH_NOINLINE bool draw_any(const struct part_context *c, const uint16_t index[3])
{
    const struct ph_vertex *const v[3] = {&c->vertices[index[0]], &c->vertices[index[1]], &c->vertices[index[2]]};
    const unsigned code[3] = {ph_code_of(v[0]), ph_code_of(v[1]), ph_code_of(v[2])};
    const unsigned all = code[0] & code[1] & code[2], any = code[0] | code[1] | code[2];
    if ((all & PH_REJECT) != 0) {
        return false;
    }
    if (c->curved != NULL && (any & PH_CLIP) == 0 && c->curved->misses_picture(c->r, v)) {
        return false;
    }
    if ((any & PH_CLIP) != 0 || (c->curved != NULL && !c->curved->is_straight(&c->r->lens, v[0], v[1], v[2]))) {
        draw_clipped(c, index);
        return true;
    }
    const bool seen = ph_list_triangle(c->r, index, v, c->two_sided);
    if (seen) {
        light_corners(c, index);
    }
    return seen;
}

/* Triangles that two cores draw one by one: this core from the first on, the other one from the last back, until they
 * meet. They claim triangles as struct fresh of bands.c describes. This struct lies in the memory of the scene. */
struct each_lent {
    struct ph_lent lent;
    struct part_context c; /* the other core's */
    const uint16_t (*index)[3];
    uint32_t count, claimed[2];
    uint32_t counts[BLOCK + 1]; /* the other core's, see ph_list_take_back */
};

struct each_share {
    const struct part_context *c;
    struct each_lent *with;
    uint32_t core, seen;
};

static void each_share(void *argument) /* called as each */
{
    struct each_share *const s = argument;
    struct each_lent *const with = s->with;
    for (uint32_t n = 0;; n++) {
        __atomic_store_n(&with->claimed[s->core], n + 1, __ATOMIC_SEQ_CST);
        if (n + 1 + __atomic_load_n(&with->claimed[1 - s->core], __ATOMIC_SEQ_CST) > with->count) {
            break;
        }
        s->seen += draw_any(s->c, with->index[s->core == 0 ? n : with->count - 1 - n]);
        if (s->core == 1) {
            with->counts[n + 1] = ph_ref_count(s->c->r);
        }
    }
}

/* Draws triangles on two cores. False if there is too little room for that: then nothing is listed. */
static bool each_both(const struct part_context *c, const uint16_t (*index)[3], uint32_t count, uint32_t *seen)
{
    struct each_lent *const with = ph_list_lend(c->r, &c->draw, sizeof *with);
    if (with == NULL) {
        return false;
    }
    with->c = *c;
    with->c.r = &with->lent.renderer;
    with->index = index;
    with->count = count;
    with->claimed[0] = with->claimed[1] = with->counts[0] = 0;
    struct each_share mine = {c, with, 0, 0}, others = {&with->c, with, 1, 0};
    ph_run_both(c->r, each_share, &mine, &others);
    const uint32_t first = with->claimed[0] - 1, last = with->claimed[1] - 1;
    if (first + last < count) { /* both claimed one at the same time */
        mine.seen += draw_any(c, index[first]);
    }
    if (!ph_list_take_back(c->r, &with->lent, with->counts, last)) {
        return false;
    }
    *seen += mine.seen + others.seen;
    return true;
}

/* Draws all triangles of a part, one by one: where ph_cull cannot judge them. Returns how many can be seen. */
static uint32_t draw_each(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    uint32_t seen = 0;
    bool may_share = c->draw.uvs == NULL && !ph_has_uvs(c->material);
    while (index < end) {
        uint32_t count = (uint32_t)(end - index);
        if (may_share && count >= EACH_LEAST && ph_other_core_is_idle(c->r)) {
            count = count < BLOCK ? count : BLOCK;
            may_share = each_both(c, index, count, &seen);
            index += may_share ? count : 0;
            continue;
        }
        for (const uint16_t(*const stop)[3] = index + (count < EACH_ALONE ? count : EACH_ALONE); index < stop;
             index++) {
            seen += draw_any(c, *index);
        }
    }
    return seen;
}

/* Draws a part that shows both of its sides one behind the other: all far sides, then all near sides. Each triangle
 * counts once, also if pieces of it show either side. */
static PH_NOINLINE uint32_t draw_sides(struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_stats *const stats = &c->r->stats;
    const uint32_t culled = stats->triangles_culled, clipped = stats->triangles_clipped;
    uint32_t seen = 0;
    c->two_sided = false;
    for (const uint16_t(*i)[3] = index; i < end; i++) {
        const uint16_t turned[3] = {(*i)[0], (*i)[2], (*i)[1]};
        seen += draw_any(c, turned);
    }
    seen -= stats->triangles_culled - culled;
    stats->triangles_culled = culled;
    stats->triangles_clipped = clipped;
    seen += draw_each(c, index, end);
    const uint32_t most = (uint32_t)(end - index) + stats->triangles_culled - culled;
    return seen < most ? seen : most;
}

/* Triangles that one core lists, and where. */
struct cull_share {
    const struct part_context *c;
    struct ph_cull_run run;
    bool must_clip; /* it met a triangle that must be clipped, and stopped */
};

PH_TIER(mesh)
static struct ph_cull_run cull_run(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
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

/* Lists a triangle at which ph_cull stopped, in a list of its own. False if it must be clipped. */
PH_TIER(figure) static bool list_stopped(const struct part_context *c, struct ph_cull_run *run)
{
    const uint16_t *const index = run->index[-1];
    const struct ph_vertex *const v[3] = {&c->vertices[index[0]], &c->vertices[index[1]], &c->vertices[index[2]]};
    if (((ph_code_of(v[0]) | ph_code_of(v[1]) | ph_code_of(v[2])) & PH_CLIP) != 0) {
        return false;
    }
    const int32_t row = ph_sides(v[0], v[1], v[2]).area > 0 ? ph_first_row_of(c->r, v) : -1;
    if (row >= 0) {
        *--run->to = (struct ph_ref){{index[0], index[1], index[2]}, ph_band_of(c->r, row)};
        for (int i = 0; c->lit && i < 3; i++) {
            ph_mark(&c->vertices[index[i]]);
        }
    }
    return true;
}

PH_TIER(figure) static void cull_share(void *argument) /* called as run */
{
    struct cull_share *const s = argument;
    while (!s->must_clip && ph_cull(&s->run)) {
        s->must_clip = !list_stopped(s->c, &s->run);
    }
}

/* Lists triangles on two cores, each into its own half of the room. False if one must be clipped: then nothing is
 * listed. */
PH_TIER(mesh)
static bool cull_both(const struct part_context *c, const uint16_t (*index)[3], uint32_t count, uint32_t *seen)
{
    struct ph_list *const list = &c->r->list;
    const uint32_t half = count / 2;
    struct cull_share mine = {.c = c, .run = cull_run(c, index, index + half)};
    struct cull_share others = {.c = c, .run = cull_run(c, index + half, index + count)};
    others.run.to -= half;
    ph_run_both(c->r, cull_share, &mine, &others);
    if (mine.must_clip || others.must_clip) {
        return false;
    }
    const struct ph_ref *from = list->to - half;
    *seen += (uint32_t)(list->to - mine.run.to) + (uint32_t)(from - others.run.to);
    for (list->to = mine.run.to; from > others.run.to;) {
        *--list->to = *--from;
    }
    return true;
}

/* Lists the triangles of a part on this core. ph_cull lists most of them. */
PH_TIER(mesh)
static uint32_t cull_alone(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    struct ph_list *const list = &c->r->list;
    struct ph_cull_run run = cull_run(c, index, end);
    uint32_t seen = 0;
    for (bool stopped = true; stopped;) { /* one call of ph_cull_into: gcc copies it */
        stopped = ph_cull_into(list, &run, &seen);
        seen += stopped && draw_any(c, run.index[-1]);
    }
    return seen;
}

PH_TIER(mesh)
static uint32_t draw_facing(const struct part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    const struct ph_list *const list = &c->r->list;
    uint32_t seen = 0;
    while (index < end && c->r->config.other_core != NULL) {
        const uint32_t room = (uint32_t)(list->to - list->end), left = (uint32_t)(end - index);
        const uint32_t most = c->codes != 0 && left > BLOCK ? BLOCK : left, count = most < room ? most : room;
        if (count < PH_SHARED_LEAST) {
            break;
        }
        if (!cull_both(c, index, count, &seen)) {
            seen += cull_alone(c, index, index + count);
        }
        index += count;
    }
    return seen + cull_alone(c, index, end);
}

/* Vertices that one core lights. */
struct light_share {
    const struct part_context *c;
    uint32_t from, end;
};

/* Lights the vertices that ph_cull has marked. */
PH_TIER(mesh) static void light_share(void *argument) /* called as run */
{
    const struct light_share *const s = argument;
    const struct part_context *const c = s->c;
    struct ph_vertex *const end = c->vertices + s->end;
    for (struct ph_vertex *v = c->vertices + s->from; v < end; v++) {
        if (v->light == 0) {
            v->light = light_of(c, (uint32_t)(v - c->vertices));
        }
    }
}

static PH_NOINLINE void light_marked(const struct part_context *c)
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

PH_TIER(mesh) static void draw_triangles(struct part_context *c, const struct ph_part *part)
{
    const uint16_t(*index)[3] = &c->mesh->triangles[part->first], (*const end)[3] = index + part->count;
    const uint32_t seen = (c->draw.kind & PH_DRAW_ONE_SIDE) != 0 ? draw_sides(c, index, end)
                          : c->curved != NULL || c->two_sided    ? draw_each(c, index, end)
                                                                 : draw_facing(c, index, end);
    if (c->lit) {
        light_marked(c);
    }
    c->r->stats.triangles_culled += part->count - seen;
}

/* Draws each edge of the mesh once, as a line. */
PH_TIER(few) static PH_NOINLINE void draw_edges(const struct part_context *c)
{
    const uint16_t(*edge)[2] = c->mesh->edges, (*const end)[2] = edge + c->mesh->edge_count;
    for (;; edge++) {
        if (c->curved == NULL) {
            edge += ph_list_lines(c->r, edge, (uint32_t)(end - edge), c->vertices);
        }
        if (edge == end) {
            break;
        }
        if ((c->vertices[(*edge)[0]].code & c->vertices[(*edge)[1]].code & PH_REJECT) != 0) {
            continue;
        }
        const struct ph_clip_vertex ends[2] = {clip_vertex(c, (*edge)[0]), clip_vertex(c, (*edge)[1])};
        ph_draw_clipped_line(c->r, c->material, ends);
        ph_list_again(c->r, &c->draw);
    }
}

/* Whether the light of a vertex is the same in both materials. */
static bool is_lit_alike(const struct ph_material *a, const struct ph_material *b)
{
    return a->ambient == b->ambient && a->diffuse == b->diffuse && a->specular == b->specular &&
           a->shininess_log2 == b->shininess_log2;
}

/* Whether the vertices of a part have colours in place of light. */
static bool is_coloured(const struct part_context *c)
{
    const unsigned shading = c->material->shading;
    const bool lit = shading == PH_SHADE_FLAT || shading == PH_SHADE_GOURAUD;
    return c->mesh->colours != NULL ? lit || shading == PH_SHADE_UNLIT
                                    : lit && c->mesh->normals != NULL && ph_light_has_colour(&c->r->light);
}

/* Whether the vertices have the same own colour as in the part before. */
static bool is_coloured_alike(const struct part_context *c, const struct ph_material *before)
{
    return c->mesh->colours != NULL ? (before->shading == PH_SHADE_UNLIT) == (c->material->shading == PH_SHADE_UNLIT)
                                    : before->colour == c->material->colour;
}

/* Gives a part that needs another light of its vertices than the part before a copy of them. */
static bool copy_vertices(struct part_context *c)
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
static bool shares_light(const struct part_context *c, const struct ph_part *part)
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
static PH_NOINLINE bool light_part(struct part_context *c, const struct ph_part *part, const struct ph_xform *to_world)
{
    const struct ph_material *const material = c->material, *const before = c->lit_as;
    c->coloured = is_coloured(c);
    c->lit = c->coloured ||
             (c->mesh->normals != NULL && material->shading != PH_SHADE_UNLIT && material->shading != PH_SHADE_TEXTURE);
    if (!c->lit) {
        return true;
    }
    const bool alike = before != NULL && is_lit_alike(before, material) &&
                       (c->coloured ? c->lit_coloured && is_coloured_alike(c, before) : !c->lit_coloured);
    c->lit_as = material;
    c->lit_coloured = c->coloured;
    if (!alike) {
        ph_light_prepare(&c->lights, c->r, to_world, material, c->coloured);
    }
    if (before == NULL || (alike && !c->mixed)) {
        return true;
    }
    c->mixed = !shares_light(c, part);
    return c->mixed || copy_vertices(c);
}

PH_TIER(mesh) static void draw_part(struct part_context *c, const struct ph_part *part, const struct ph_xform *to_world)
{
    struct ph_renderer *r = c->r;
    c->material = &c->mesh->materials[part->material];
    const bool wire = c->material->shading == PH_SHADE_WIRE;
    const uint32_t count = wire ? c->mesh->edge_count : part->count;
    if (count == 0) { /* there may be no array */
        return;
    }
    const bool room = wire || light_part(c, part, to_world);
    c->draw.material = c->material;
    c->draw.uvs = ph_has_uvs(c->material) ? c->mesh->uvs : NULL;
    const struct ph_blend *const blend = c->material->blend;
    const bool blended = blend != NULL && blend->kind >= PH_BLEND_ALPHA;
    c->two_sided = c->material->two_sided != 0;
    c->draw.kind =
        wire ? PH_DRAW_LINES
             : PH_DRAW_SMALL | (c->coloured ? PH_DRAW_COLOURS : 0) | (blended && c->two_sided ? PH_DRAW_ONE_SIDE : 0);
    r->stats.triangles_in += wire ? 0 : part->count;
    if (!room || (blend != NULL && !ph_list_blend(r, blend)) || !ph_list_draw(r, &c->draw)) {
        r->stats.triangles_dropped += count;
        return;
    }
    const uint32_t before = ph_ref_count(r);
    c->curved = r->lens.kind == PH_FISHEYE ? r->projection.curved : NULL;
    if (wire) {
        draw_edges(c);
    } else {
        draw_triangles(c, part);
    }
    if (blend != NULL) {
        ph_list_put_after(r, before);
    }
}

PH_TIER(mesh) int ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (!ph_check_mesh(mesh) || to_world == NULL) {
        return PH_ERR_INVAL;
    }
    const struct ph_mark mark = ph_list_mark(r);
    const uint32_t n = mesh->vertex_count, place = n - 1 < r->config.vertex_max ? ph_list_vertices(r, n) : PH_NONE;
    if (place == PH_NONE) {
        return ph_list_leave_out(r, mesh, true);
    }
    const struct ph_xform object_to_view = ph_xform_mul(&r->view, to_world);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &object_to_view);
    struct part_context c; /* draw_part sets the rest */
    c.r = r;
    c.mesh = mesh;
    c.matrix = &matrix;
    c.vertices = ph_at(r, place);
    c.lit_as = NULL;
    c.mixed = false;
    c.draw = (struct ph_draw){.base = place};
    c.codes = ph_transform_mesh(r, &matrix, mesh, c.vertices);
    r->stats.vertices += n;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        draw_part(&c, &mesh->parts[i], to_world);
    }
    ph_list_rewind(r, &mark);
    r->stats.triangles_drawn = ph_ref_count(r);
    return PH_OK;
}
