/* See asset_net.h. */
#include "asset_net.h"

#include "asset_quadric.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What an error of one costs, in sizes of the model: of a normal, whose length is 1; of a colour, whose channels are 0
 * .. 1. */
#define NORMAL_WEIGHT .05
#define COLOUR_WEIGHT .2
/* An error of texture coordinates costs so much of the way that it is on the surface; a texture counts as at most so
 * large. */
#define UV_WEIGHT    1.0
#define UV_SIZES_MAX 16.0
/* An edge without a second triangle, and one where the surface changes its colour or bends, keeps its place as if
 * triangles of so many times its square stood upright on it. */
#define BORDER_WEIGHT 2.0
#define SEAM_WEIGHT   4.0

/* All that a vertex has, by which vertices are sorted: those in one place come together. APART differs where vertices
 * must stay apart though all else is equal. */
enum { PLACE, MESH = 3, UV, NORMAL = 6, COLOUR = 9, APART, KEY_NUMBERS };

struct key {
    int32_t k[KEY_NUMBERS];
    unsigned source;
};

/* What the vertices of all meshes carry, and where it is among the numbers of a wedge; 0: not there. */
struct layout {
    int uv, normal, colour;
    double *uv_weights; /* of each mesh */
};

static int compare(const struct key *a, const struct key *b, int numbers)
{
    for (int i = 0; i < numbers; i++) {
        if (a->k[i] != b->k[i]) {
            return a->k[i] < b->k[i] ? -1 : 1;
        }
    }
    return 0;
}

static int by_key(const void *p, const void *q)
{
    const struct key *a = p, *b = q;
    const int order = compare(a, b, KEY_NUMBERS);
    return order != 0 ? order : a->source < b->source ? -1 : 1;
}

bool asset_net_is_flat(const struct ph_mesh *mesh)
{
    for (uint32_t t = 0; t < mesh->triangle_count && mesh->normals != NULL; t++) {
        const uint16_t *c = mesh->triangles[t];
        if (memcmp(mesh->normals[c[0]], mesh->normals[c[1]], sizeof mesh->normals[0]) != 0 ||
            memcmp(mesh->normals[c[0]], mesh->normals[c[2]], sizeof mesh->normals[0]) != 0) {
            return false;
        }
    }
    return true;
}

void asset_net_normal(const double *const corners[3], double normal[3])
{
    const double *a = corners[0], *b = corners[1], *c = corners[2];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* ---- wedges ----------------------------------------------------------------------------------------------------- */

/* Vertices that morph stay apart; those that joints move, where these differ. */
static int32_t apart_of(const struct animation_mesh *moving, uint32_t vertex)
{
    const struct ph_influence *of = moving != NULL ? moving->bound.influences : NULL;
    if (moving != NULL && moving->morph.target_count > 0) {
        return (int32_t)vertex;
    }
    uint32_t hash = 2166136261U; /* FNV-1a */
    for (int i = 0; i < 4 && of != NULL; i++) {
        hash = (hash ^ of[vertex].joints[i]) * 16777619U;
        hash = (hash ^ of[vertex].weights[i]) * 16777619U;
    }
    return (int32_t)hash;
}

static void add_keys(struct key *keys, const struct model *model, uint32_t m, unsigned first)
{
    const struct ph_mesh *const mesh = &model->meshes[m];
    const struct animation_mesh *const moving = model_moving(model, m);
    const bool is_flat = asset_net_is_flat(mesh);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct key *const key = &keys[first + i];
        const struct fx_vec3 *const p = &mesh->positions[i];
        *key = (struct key){.k = {p->x, p->y, p->z, (int32_t)m}, .source = first + i};
        if (mesh->uvs != NULL) {
            memcpy(&key->k[UV], mesh->uvs[i], sizeof mesh->uvs[i]);
        }
        for (int axis = 0; axis < 3 && !is_flat; axis++) {
            key->k[NORMAL + axis] = mesh->normals[i][axis];
        }
        key->k[COLOUR] = mesh->colours != NULL ? mesh->colours[i] : 0;
        key->k[APART] = apart_of(moving, i);
    }
}

/* The weight of a mesh's texture coordinates: how much of the surface one of them is, in the mean. */
static double uv_weight(const struct ph_mesh *mesh, double size)
{
    double on_surface = 0, on_texture = 0;
    for (uint32_t t = 0; t < mesh->triangle_count && mesh->uvs != NULL; t++) {
        double places[3][3], uvs[3][3], normal[3];
        for (int i = 0; i < 3; i++) {
            const uint16_t v = mesh->triangles[t][i];
            const struct fx_vec3 *p = &mesh->positions[v];
            memcpy(places[i], (double[3]){(double)p->x / FX_ONE, (double)p->y / FX_ONE, (double)p->z / FX_ONE},
                   sizeof places[i]);
            memcpy(uvs[i], (double[3]){(double)mesh->uvs[v][0] / FX_ONE, (double)mesh->uvs[v][1] / FX_ONE, 0},
                   sizeof uvs[i]);
        }
        asset_net_normal((const double *const[3]){places[0], places[1], places[2]}, normal);
        on_surface += length_of(normal);
        asset_net_normal((const double *const[3]){uvs[0], uvs[1], uvs[2]}, normal);
        on_texture += length_of(normal);
    }
    const double side = UV_SIZES_MAX * size; /* of a texture on the surface */
    return UV_WEIGHT / size / FX_ONE * (on_surface < side * side * on_texture ? sqrt(on_surface / on_texture) : side);
}

static void set_colour(double *x, uint16_t colour)
{
    uint8_t wire[2];
    memcpy(wire, &colour, sizeof wire);
    const unsigned c = (unsigned)wire[0] << 8 | wire[1];
    x[0] = COLOUR_WEIGHT * (c >> 11) / 31;
    x[1] = COLOUR_WEIGHT * (c >> 5 & 63) / 63;
    x[2] = COLOUR_WEIGHT * (c & 31) / 31;
}

static void set_numbers(double *x, const struct key *key, const struct layout *layout, double size)
{
    for (int i = 0; i < 3; i++) {
        x[i] = (double)key->k[PLACE + i] / FX_ONE / size;
    }
    for (int i = 0; i < 2 && layout->uv > 0; i++) {
        x[layout->uv + i] = key->k[UV + i] * layout->uv_weights[key->k[MESH]];
    }
    for (int i = 0; i < 3 && layout->normal > 0; i++) {
        x[layout->normal + i] = key->k[NORMAL + i] * NORMAL_WEIGHT / 16384;
    }
    if (layout->colour > 0) {
        set_colour(x + layout->colour, (uint16_t)key->k[COLOUR]);
    }
}

static double size_of(const struct model *model)
{
    fx_t most = 1;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        for (uint32_t i = 0; i < model->meshes[m].vertex_count; i++) {
            const struct fx_vec3 *const p = &model->meshes[m].positions[i];
            const fx_t places[3] = {p->x, p->y, p->z};
            for (int axis = 0; axis < 3; axis++) {
                const fx_t far = places[axis] < -FX_MAX ? FX_MAX : places[axis] < 0 ? -places[axis] : places[axis];
                most = far > most ? far : most;
            }
        }
    }
    return (double)most / FX_ONE;
}

/* Chooses which numbers a wedge has. */
static bool lay_out(struct asset_net *net, const struct model *model, struct layout *layout)
{
    bool has_uvs = false, has_normals = false, has_colours = false;
    *layout = (struct layout){.uv_weights = malloc(sizeof *layout->uv_weights * ((size_t)model->mesh_count + 1))};
    for (uint32_t m = 0; m < model->mesh_count && layout->uv_weights != NULL; m++) {
        const struct ph_mesh *const mesh = &model->meshes[m];
        layout->uv_weights[m] = uv_weight(mesh, net->size);
        has_uvs = has_uvs || mesh->uvs != NULL;
        has_normals = has_normals || !asset_net_is_flat(mesh);
        has_colours = has_colours || mesh->colours != NULL;
    }
    net->dimensions = 3; /* the place */
    layout->uv = has_uvs ? net->dimensions : 0;
    net->dimensions += has_uvs ? 2 : 0;
    layout->normal = has_normals ? net->dimensions : 0;
    net->dimensions += has_normals ? 3 : 0;
    layout->colour = has_colours ? net->dimensions : 0;
    net->dimensions += has_colours ? 3 : 0;
    net->numbers = asset_quadric_numbers(net->dimensions);
    return layout->uv_weights != NULL;
}

/* Makes points and wedges of the sorted keys; wedge_of: of each vertex of the model. */
static bool make_wedges(struct asset_net *net, const struct key *keys, uint32_t count, const struct layout *layout,
                        uint32_t *wedge_of)
{
    for (uint32_t i = 0; i < count; i++) {
        net->wedge_count += i == 0 || compare(&keys[i - 1], &keys[i], KEY_NUMBERS) != 0;
    }
    net->wedges = calloc((size_t)net->wedge_count + 1, sizeof *net->wedges);
    net->x = calloc((size_t)net->wedge_count + 1, sizeof *net->x * (size_t)net->dimensions);
    net->quadrics = calloc((size_t)net->wedge_count + 1, sizeof *net->quadrics * (size_t)net->numbers);
    net->areas = calloc((size_t)net->wedge_count + 1, sizeof *net->areas);
    if (net->wedges == NULL || net->areas == NULL || net->x == NULL || net->quadrics == NULL) {
        return false;
    }
    uint32_t wedge = ASSET_NET_NONE;
    for (uint32_t i = 0; i < count; i++) {
        net->point_count += i == 0 || compare(&keys[i - 1], &keys[i], MESH) != 0;
        if (i == 0 || compare(&keys[i - 1], &keys[i], KEY_NUMBERS) != 0) {
            net->wedges[++wedge] =
                (struct asset_wedge){net->point_count - 1, (uint32_t)keys[i].k[MESH], keys[i].source};
            set_numbers(net->x + (size_t)wedge * (size_t)net->dimensions, &keys[i], layout, net->size);
        }
        wedge_of[keys[i].source] = wedge;
    }
    return true;
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

static void add_triangles(struct asset_net *net, const struct ph_mesh *mesh, const uint32_t *wedge_of)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *const to = net->triangles[net->triangle_count];
        for (int i = 0; i < 3; i++) {
            to[i] = wedge_of[mesh->triangles[t][i]];
        }
        const uint32_t a = net->wedges[to[0]].point, b = net->wedges[to[1]].point, c = net->wedges[to[2]].point;
        net->is_live[net->triangle_count] = true;
        net->triangle_count += a != b && b != c && c != a;
    }
}

static bool make_triangles(struct asset_net *net, const struct model *model, const uint32_t *wedge_of)
{
    const size_t most = (size_t)model->triangle_count + 1;
    uint32_t first = 0;
    net->triangles = calloc(most, sizeof *net->triangles);
    net->is_live = calloc(most, sizeof *net->is_live);
    net->next = calloc(3 * most, sizeof *net->next);
    net->heads = calloc((size_t)net->point_count + 1, sizeof *net->heads);
    if (net->triangles == NULL || net->is_live == NULL || net->next == NULL || net->heads == NULL) {
        return false;
    }
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        add_triangles(net, &model->meshes[m], wedge_of + first);
        first += model->meshes[m].vertex_count;
    }
    memset(net->heads, 0xFF, sizeof *net->heads * net->point_count); /* NONE */
    for (uint32_t corner = 3 * net->triangle_count; corner-- > 0;) {
        uint32_t *const head = &net->heads[asset_net_point(net, corner)];
        net->next[corner] = *head;
        *head = corner;
    }
    return true;
}

/* ---- quadrics --------------------------------------------------------------------------------------------------- */

/* An edge of a triangle: its points, the lesser first, and the corner that it begins at. */
struct edge {
    uint32_t a, b, corner;
};

static int by_points(const void *p, const void *q)
{
    const struct edge *a = p, *b = q;
    return a->a != b->a   ? (a->a < b->a ? -1 : 1)
           : a->b != b->b ? (a->b < b->b ? -1 : 1)
                          : (a->corner > b->corner) - (a->corner < b->corner);
}

/* Keeps an edge in place: adds the plane through it that stands upright on its triangle. */
static void hold_edge(struct asset_net *net, const struct edge *edge, double weight)
{
    const uint32_t t = edge->corner / 3, i = edge->corner % 3;
    const uint32_t wedges[3] = {net->triangles[t][i], net->triangles[t][(i + 1) % 3], net->triangles[t][(i + 2) % 3]};
    const double *const p[3] = {asset_net_x(net, wedges[0]), asset_net_x(net, wedges[1]), asset_net_x(net, wedges[2])};
    double up[3], side[3];
    asset_net_normal(p, up);
    const double above[3] = {p[0][0] + up[0], p[0][1] + up[1], p[0][2] + up[2]};
    asset_net_normal((const double *const[3]){p[0], p[1], above}, side);
    const double length = length_of(side);
    const double edge_2 = (p[1][0] - p[0][0]) * (p[1][0] - p[0][0]) + (p[1][1] - p[0][1]) * (p[1][1] - p[0][1]) +
                          (p[1][2] - p[0][2]) * (p[1][2] - p[0][2]);
    for (int axis = 0; axis < 3; axis++) {
        side[axis] = length > 0 ? side[axis] / length : 0;
    }
    const double d = side[0] * p[0][0] + side[1] * p[0][1] + side[2] * p[0][2];
    for (int k = 0; k < 2; k++) {
        asset_quadric_plane(asset_net_quadric(net, wedges[k]), net->dimensions, side, d, weight * edge_2);
    }
}

/* Whether the two triangles of an edge have other wedges there. */
static bool is_seam_between(const struct asset_net *net, const struct edge *edges)
{
    uint32_t wedges[2][2];
    for (int k = 0; k < 2; k++) {
        const uint32_t corner = edges[k].corner, next = corner % 3 == 2 ? corner - 2 : corner + 1;
        const bool is_turned = asset_net_point(net, corner) != edges[k].a;
        wedges[k][0] = asset_net_wedge(net, is_turned ? next : corner);
        wedges[k][1] = asset_net_wedge(net, is_turned ? corner : next);
    }
    return wedges[0][0] != wedges[1][0] || wedges[0][1] != wedges[1][1];
}

static bool hold_edges(struct asset_net *net)
{
    const size_t count = (size_t)net->triangle_count * 3;
    struct edge *const edges = calloc(count + 1, sizeof *edges);
    for (uint32_t corner = 0; corner < count && edges != NULL; corner++) {
        const uint32_t p = asset_net_point(net, corner),
                       q = asset_net_point(net, corner % 3 == 2 ? corner - 2 : corner + 1);
        edges[corner] = (struct edge){p < q ? p : q, p < q ? q : p, corner};
    }
    if (edges == NULL) {
        return false;
    }
    qsort(edges, count, sizeof *edges, by_points);
    for (size_t first = 0, end; first < count; first = end) {
        end = first + 1;
        while (end < count && edges[end].a == edges[first].a && edges[end].b == edges[first].b) {
            end++;
        }
        const bool is_border = end - first != 2, is_seam = !is_border && is_seam_between(net, &edges[first]);
        for (size_t i = first; i < end && (is_border || is_seam); i++) {
            hold_edge(net, &edges[i], is_border ? BORDER_WEIGHT : SEAM_WEIGHT);
        }
    }
    free(edges);
    return true;
}

static void add_planes(struct asset_net *net)
{
    for (uint32_t t = 0; t < net->triangle_count; t++) {
        const uint32_t *const wedges = net->triangles[t];
        const double *const corners[3] = {asset_net_x(net, wedges[0]), asset_net_x(net, wedges[1]),
                                          asset_net_x(net, wedges[2])};
        double normal[3];
        asset_net_normal(corners, normal);
        for (int i = 0; i < 3; i++) {
            asset_quadric_triangle(asset_net_quadric(net, wedges[i]), net->dimensions, corners, length_of(normal) / 2);
            net->areas[wedges[i]] += length_of(normal) / 2;
        }
    }
}

bool asset_net_make(struct asset_net *net, const struct model *model)
{
    size_t count = 0;
    struct layout layout;
    *net = (struct asset_net){.size = size_of(model)};
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        count += model->meshes[m].vertex_count;
    }
    struct key *const keys = calloc(count + 1, sizeof *keys);
    uint32_t *const wedge_of = calloc(count + 1, sizeof *wedge_of);
    bool is_done = lay_out(net, model, &layout) && keys != NULL && wedge_of != NULL;
    for (uint32_t m = 0, first = 0; m < model->mesh_count && is_done; m++) {
        add_keys(keys, model, m, first);
        first += model->meshes[m].vertex_count;
    }
    if (is_done) {
        qsort(keys, count, sizeof *keys, by_key);
    }
    is_done = is_done && make_wedges(net, keys, (uint32_t)count, &layout, wedge_of) &&
              make_triangles(net, model, wedge_of) && hold_edges(net);
    if (is_done) {
        add_planes(net);
    }
    free(layout.uv_weights);
    free(keys);
    free(wedge_of);
    return is_done;
}

void asset_net_free(struct asset_net *net)
{
    free(net->wedges);
    free(net->x);
    free(net->quadrics);
    free(net->areas);
    free(net->triangles);
    free(net->is_live);
    free(net->heads);
    free(net->next);
}
