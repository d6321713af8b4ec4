/* See model_rig.h. The bind pose, joints and morph targets of each mesh, in fixed point and in the units of the
 * fitted model. */
#include "model_rig.h"

#include "model_rig_clips.h"
#include "model_rig_nodes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAC 15 /* of positions */

static int32_t q24(double value)
{
    return (int32_t)lround(model_rig_clamp(value, 127.9999) * PH_MOTION_ONE);
}

static int16_t q15(double value, double *error)
{
    const long rounded = lround(model_rig_clamp(value * 32768, 32767));
    model_rig_note(error, value - (double)rounded / 32768);
    return (int16_t)rounded;
}

/* ---- matrices of 3 x 4 ------------------------------------------------------------------------------------------- */

typedef double matrix[3][4];

static void multiply(matrix to, const double (*a)[4], const double (*b)[4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = column == 3 ? a[row][3] : 0;
            for (int k = 0; k < 3; k++) {
                to[row][column] += a[row][k] * b[k][column];
            }
        }
    }
}

/* Inverts a matrix. False: it has no inverse. */
static bool invert(matrix to, const double (*m)[4])
{
    double determinant = 0;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            const int a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
            to[column][row] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    for (int k = 0; k < 3; k++) {
        determinant += m[0][k] * to[k][0];
    }
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            to[row][column] /= determinant;
        }
        to[row][3] = -(to[row][0] * m[0][3] + to[row][1] * m[1][3] + to[row][2] * m[2][3]);
    }
    return determinant != 0 && isfinite(to[0][0] + to[1][1] + to[2][2] + to[0][3] + to[1][3] + to[2][3]);
}

static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

/* Makes a matrix of sixteen numbers, column by column, as glTF has them. */
static void from_columns(matrix to, const float *m)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = (double)m[4 * column + row];
        }
    }
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

/* A node of its own, the last one without a parent, draws what follows a skin, at the place that the first joint gives
 * it. */
static void move_skinned(struct model_rig *rig, struct model_scene *scene, uint32_t i)
{
    struct model_node *node = &scene->nodes[i], *own = &scene->nodes[scene->node_count];
    if (node->skin == MODEL_NONE || node->mesh_count == 0) {
        return;
    }
    const struct model_skin *skin = &scene->skins[node->skin];
    matrix bind, place;
    memcpy(bind, identity, sizeof bind);
    if (skin->bind != NULL) {
        from_columns(bind, skin->bind);
    }
    multiply(place, (const double(*)[4])rig->nodes[skin->joints[0]].world, (const double(*)[4])bind);
    *own = (struct model_node){.parent = MODEL_NONE,
                               .child = MODEL_NONE,
                               .next = MODEL_NONE,
                               .skin = MODEL_NONE,
                               .first_mesh = node->first_mesh,
                               .mesh_count = node->mesh_count};
    for (int k = 0; k < 12; k++) {
        own->m[k / 4][k % 4] = (float)place[k / 4][k % 4];
    }
    uint32_t last = scene->first_node;
    while (scene->nodes[last].next != MODEL_NONE) {
        last = scene->nodes[last].next;
    }
    scene->nodes[last].next = scene->node_count;
    rig->nodes[i].drawn = scene->node_count++;
    node->mesh_count = 0;
}

/* Finds an order in which each node follows its parent: nodes without a parent by their numbers, then the children of
 * each. */
static void find_order(struct model_rig *rig)
{
    const struct model_scene *scene = rig->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        rig->nodes[i].drawn = MODEL_NONE;
    }
    for (uint32_t i = scene->first_node; i != MODEL_NONE; i = model_scene_next(scene, i)) {
        rig->nodes[i].drawn = i;
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        if (rig->nodes[i].drawn != MODEL_NONE && scene->nodes[i].parent == MODEL_NONE) {
            rig->order[rig->node_count++] = i;
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        for (uint32_t i = scene->nodes[rig->order[k]].child; i != MODEL_NONE; i = scene->nodes[i].next) {
            rig->order[rig->node_count++] = i;
        }
    }
}

bool model_rig_find(struct model_shared *shared, struct model_scene *scene)
{
    if (!model_scene_moves(scene)) {
        return true;
    }
    const size_t n = scene->node_count;
    struct model_node *nodes = realloc(scene->nodes, sizeof *nodes * (2 * n + 1));
    if (nodes == NULL) {
        return false;
    }
    scene->nodes = nodes;
    struct model_rig *rig = calloc(1, sizeof *rig);
    if (rig == NULL) {
        return false;
    }
    shared->rig = rig;
    *rig = (struct model_rig){
        .scene = scene, .nodes = calloc(n + 1, sizeof *rig->nodes), .order = calloc(n + 1, sizeof *rig->order)};
    if (rig->nodes == NULL || rig->order == NULL) {
        return false;
    }
    find_order(rig);
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const uint32_t i = rig->order[k], parent = scene->nodes[i].parent;
        matrix base;
        memcpy(base, parent == MODEL_NONE ? (const void *)identity : rig->nodes[parent].world, sizeof base);
        model_scene_multiply(rig->nodes[i].world, base, (const float(*)[4])scene->nodes[i].m);
        rig->nodes[i].number = k;
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        move_skinned(rig, scene, rig->order[k]);
    }
    return true;
}

/* ---- the rig ----------------------------------------------------------------------------------------------------- */

static struct fx_quat quat_of(const double q[4])
{
    const double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), most = FX_Q30_ONE;
    if (!(size > 0) || !isfinite(size)) {
        return fx_quat_identity;
    }
    return (struct fx_quat){(int32_t)lround(q[3] / size * most), (int32_t)lround(q[0] / size * most),
                            (int32_t)lround(q[1] / size * most), (int32_t)lround(q[2] / size * most)};
}

/* The scale of a node in the rest pose that becomes a length. */
static double own_length(const double s[3])
{
    const double mean = (fabs(s[0]) + fabs(s[1]) + fabs(s[2])) / 3;
    return mean > 0 && isfinite(mean) ? mean : 1;
}

static void read_rest(struct model_rig *rig, uint32_t i, double unit, struct ph_rig_node *to)
{
    const struct model_node *from = &rig->scene->nodes[i];
    const double above = from->parent == MODEL_NONE ? unit : rig->nodes[from->parent].length;
    const double own = own_length(from->s);
    rig->nodes[i].length = above * own;
    to->parent = (int16_t)(from->parent == MODEL_NONE ? -1 : (int32_t)rig->nodes[from->parent].number);
    to->rest = (struct ph_pose){quat_of(from->q),
                                {q24(from->t[0] * above), q24(from->t[1] * above), q24(from->t[2] * above)},
                                {q24(from->s[0] / own), q24(from->s[1] / own), q24(from->s[2] / own)}};
}

/* The weights of morph targets that each node begins with, one behind the other. */
static bool read_weights(struct model_shared *shared, struct animation *to)
{
    const struct model_rig *rig = shared->rig;
    const struct model_node *nodes = rig->scene->nodes;
    for (uint32_t k = 0; k < rig->node_count; k++) {
        rig->nodes[rig->order[k]].first_weight = to->weight_count;
        to->weight_count += nodes[rig->order[k]].weight_count;
    }
    int32_t *weights = demo_alloc(&shared->arena, sizeof *weights * (to->weight_count + 1));
    for (uint32_t k = 0; weights != NULL && k < rig->node_count; k++) {
        const struct model_node *node = &nodes[rig->order[k]];
        for (uint32_t i = 0; i < node->weight_count; i++) {
            weights[rig->nodes[rig->order[k]].first_weight + i] = q24(node->weights != NULL ? node->weights[i] : 0);
        }
    }
    to->rest_weights = weights;
    return weights != NULL && to->weight_count <= UINT16_MAX;
}

bool model_rig_begin(struct model_shared *shared, const struct model_fit *fit, size_t meshes)
{
    struct model_rig *rig = shared->rig;
    if (rig == NULL || rig->node_count == 0 || rig->node_count > INT16_MAX) {
        return true;
    }
    const uint32_t n = rig->node_count;
    struct model_motion *to = demo_alloc(&shared->arena, sizeof *to);
    struct ph_rig_node *nodes = demo_alloc(&shared->arena, sizeof *nodes * n);
    rig->moving = demo_alloc(&shared->arena, sizeof *rig->moving * meshes);
    if (to == NULL || nodes == NULL || rig->moving == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    *to = (struct model_motion){.animation = {.rig = {nodes, n}, .root = ph_xform_identity, .meshes = rig->moving},
                                .scale = fit->scale};
    shared->model.motion = to;
    for (uint32_t k = 0; k < n; k++) {
        read_rest(rig, rig->order[k], fit->scale, &nodes[k]);
    }
    if (!read_weights(shared, &to->animation)) {
        return model_shared_failed(shared, "needs too much memory, or has too many morph targets");
    }
    for (int i = 0; i < 9; i++) {
        to->animation.root.r[i / 3][i % 3] = (int32_t)lround((double)rig->scene->root[i / 3][i % 3] * FX_Q30_ONE);
    }
    to->animation.root.t = (struct fx_vec3){q24(-fit->centre[0] * fit->scale), q24(-fit->centre[1] * fit->scale),
                                            q24(-fit->centre[2] * fit->scale)};
    return model_rig_clips_make(shared, to, fit->scale);
}

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* Fills the inverse bind matrix of a joint for positions that are in the model already. */
static void set_bind(struct ph_xform *to, const double (*back)[4], const float *bind, double length)
{
    matrix own, product;
    memcpy(own, identity, sizeof own);
    if (bind != NULL) {
        from_columns(own, bind);
    }
    multiply(product, (const double(*)[4])own, back);
    int32_t *const t[3] = {&to->t.x, &to->t.y, &to->t.z};
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++) {
            to->r[row][k] = (int32_t)lround(model_rig_clamp(product[row][k] * length, 1.9999999) * FX_Q30_ONE);
        }
        *t[row] = q24(product[row][3] * length);
    }
}

static bool set_skin(struct model_shared *shared, uint32_t node, const double (*back)[4], struct ph_skin *skin)
{
    const struct model_rig *rig = shared->rig;
    const uint32_t own = rig->scene->nodes[node].skin;
    const struct model_skin rigid = {.joints = &node, .count = 1};
    const struct model_skin *from = own != MODEL_NONE ? &rig->scene->skins[own] : &rigid;
    uint16_t *numbers = demo_alloc(&shared->arena, sizeof *numbers * from->count);
    struct ph_xform *inverse = demo_alloc(&shared->arena, sizeof *inverse * from->count);
    if (numbers == NULL || inverse == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    for (uint32_t k = 0; k < from->count; k++) {
        const struct model_rig_node *joint = &rig->nodes[from->joints[k]];
        numbers[k] = (uint16_t)joint->number;
        set_bind(&inverse[k], back, from->bind != NULL ? from->bind + 16 * (size_t)k : NULL, joint->length);
    }
    *skin = (struct ph_skin){numbers, inverse, from->count};
    return true;
}

/* Sets the four joints of a vertex, the greatest share first; shares sum to one. False: a joint is not there. */
static bool set_influence(const float *joints, const float *weights, uint32_t count, struct ph_influence *to,
                          double *error)
{
    double share[4], sum = 0;
    uint32_t rest = PH_INFLUENCE_ONE;
    *to = (struct ph_influence){{0}, {0}};
    for (int k = 0; k < 4; k++) {
        share[k] = isfinite(weights[k]) && weights[k] > 0 ? (double)weights[k] : 0;
        sum += share[k];
        if (share[k] > 0 && !(joints[k] >= 0 && joints[k] < (float)count)) {
            return false;
        }
    }
    for (int n = 0; n < 4 && sum > 0; n++) {
        int most = 0;
        for (int k = 1; k < 4; k++) {
            most = share[k] > share[most] ? k : most;
        }
        const uint32_t part = share[most] > 0 ? (uint32_t)lround(share[most] / sum * PH_INFLUENCE_ONE) : 0;
        to->weights[n] = (uint16_t)(part < rest ? part : rest);
        to->joints[n] = to->weights[n] > 0 ? (uint8_t)joints[most] : 0;
        rest -= to->weights[n];
        model_rig_note(error, share[most] > 0 ? share[most] / sum - (double)part / PH_INFLUENCE_ONE : 0);
        share[most] = -1;
    }
    to->weights[0] = (uint16_t)(to->weights[0] + rest);
    return true;
}

static bool set_influences(struct model_shared *shared, const struct model_moved *moved, const unsigned *vertices,
                           struct animation_mesh *to)
{
    struct ph_influence *influences = demo_alloc(&shared->arena, sizeof *influences * to->bound.vertex_count);
    for (uint32_t i = 0; influences != NULL && i < to->bound.vertex_count; i++) {
        const size_t at = 4 * (size_t)moved->sources[vertices[i]];
        if (!set_influence(moved->joints + at, moved->weights + at, to->skin.joint_count, &influences[i],
                           &shared->model.motion->rounding.share)) {
            return model_shared_failed(shared, "is broken: a vertex follows a joint that is not there");
        }
    }
    to->bound.influences = influences;
    return influences != NULL || model_shared_failed(shared, "needs too much memory");
}

static bool set_targets(struct model_shared *shared, const struct model_moved *moved, const unsigned *vertices,
                        const double (*to_model)[4], struct animation_mesh *to)
{
    const uint32_t n = to->bound.vertex_count;
    int16_t(*d)[3] = demo_alloc(&shared->arena, sizeof *d * n * moved->target_count);
    if (d == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    for (uint32_t t = 0; t < moved->target_count; t++) {
        for (uint32_t i = 0; i < n; i++) {
            const float *from = moved->targets[t] != NULL ? moved->targets[t] + 3 * (size_t)moved->sources[vertices[i]]
                                                          : (const float[3]){0, 0, 0};
            for (int row = 0; row < 3; row++) {
                const double v = to_model[row][0] * (double)from[0] + to_model[row][1] * (double)from[1] +
                                 to_model[row][2] * (double)from[2];
                d[(size_t)t * n + i][row] = q15(v, &shared->model.motion->rounding.target);
            }
        }
    }
    to->morph = (struct ph_morph){.positions = to->bound.positions,
                                  .d_positions = (const int16_t(*)[3])d,
                                  .vertex_count = n,
                                  .target_count = moved->target_count};
    return true;
}

/* What targets add to normals, turned as the normals are, and divided by the length that those had then. */
static bool set_target_normals(struct model_shared *shared, const struct model_moved *moved, const unsigned *vertices,
                               const struct model_place *place, struct animation_mesh *to)
{
    const uint32_t n = to->bound.vertex_count;
    int16_t(*d)[3] = demo_alloc(&shared->arena, sizeof *d * n * moved->target_count);
    for (size_t i = 0; d != NULL && i < (size_t)n * moved->target_count; i++) {
        const float *normals = moved->target_normals[i / n];
        const float *from = normals != NULL ? normals + 3 * (size_t)moved->sources[vertices[i % n]] : NULL;
        double base[3];
        model_places_normal(place, vertices[i % n], base);
        const double length = sqrt(base[0] * base[0] + base[1] * base[1] + base[2] * base[2]);
        for (int row = 0; row < 3; row++) {
            const double *c = place->cofactors[row], sign = place->mirrors ? -1 : 1;
            const double v =
                from != NULL ? sign * (c[0] * (double)from[0] + c[1] * (double)from[1] + c[2] * (double)from[2]) : 0;
            d[i][row] = (int16_t)lround(model_rig_clamp(v / length * 16384, 32767));
        }
    }
    to->morph.normals = to->bound.normals;
    to->morph.d_normals = (const int16_t(*)[3])d;
    return d != NULL || model_shared_failed(shared, "needs too much memory");
}

static bool copy_bind_pose(struct model_shared *shared, const struct ph_mesh *mesh, struct animation_mesh *to)
{
    const uint32_t n = mesh->vertex_count;
    int16_t(*positions)[3] = demo_alloc(&shared->arena, sizeof *positions * n);
    int16_t(*normals)[3] = demo_alloc(&shared->arena, sizeof *normals * n);
    if (positions == NULL || normals == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    for (uint32_t i = 0; i < n; i++) {
        const struct fx_vec3 *p = &mesh->positions[i];
        const double v[3] = {p->x / 65536.0, p->y / 65536.0, p->z / 65536.0};
        for (int k = 0; k < 3; k++) {
            positions[i][k] = q15(v[k], &shared->model.motion->rounding.position);
            normals[i][k] = mesh->normals[i][k];
        }
    }
    to->bound = (struct ph_bound){.positions = (const int16_t(*)[3])positions,
                                  .normals = (const int16_t(*)[3])normals,
                                  .vertex_count = n,
                                  .frac = FRAC};
    return true;
}

/* The node of the rig whose meshes this one draws; MODEL_NONE: there is none. */
static uint32_t moves_with(const struct model_rig *rig, uint32_t drawn)
{
    for (uint32_t k = 0; k < rig->node_count; k++) {
        if (rig->nodes[rig->order[k]].drawn == drawn) {
            return rig->order[k];
        }
    }
    return MODEL_NONE;
}

bool model_rig_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                    const unsigned *vertices, uint32_t mesh)
{
    const struct model_rig *rig = shared->rig;
    const struct model_moved *moved = &place->mesh->moved;
    struct model_motion *to = shared->model.motion;
    const uint32_t node = to != NULL ? moves_with(rig, place->node) : MODEL_NONE;
    if (node == MODEL_NONE) {
        return true;
    }
    if (moved->target_count != rig->scene->nodes[node].weight_count) {
        return model_shared_failed(shared, "is broken: parts of a mesh have different numbers of morph targets");
    }
    struct animation_mesh *moving = &rig->moving[to->animation.mesh_count];
    matrix to_model, back;
    for (int i = 0; i < 12; i++) {
        const double centre = i % 4 == 3 ? fit->centre[i / 4] : 0;
        to_model[i / 4][i % 4] = (place->m[i / 4][i % 4] - centre) * fit->scale;
    }
    if (!invert(back, (const double(*)[4])to_model)) {
        model_shared_note(shared, "what a node flattens does not move");
        return true;
    }
    *moving = (struct animation_mesh){.mesh = mesh, .first_weight = rig->nodes[node].first_weight};
    to->animation.mesh_count++;
    const bool is_skinned = rig->scene->nodes[node].skin != MODEL_NONE;
    if (is_skinned && (moved->joints == NULL || moved->weights == NULL)) {
        return model_shared_failed(shared, "is broken: a mesh with a skin names no joints");
    }
    return copy_bind_pose(shared, &shared->model.meshes[mesh], moving) &&
           set_skin(shared, node, (const double(*)[4])back, &moving->skin) &&
           (!is_skinned || set_influences(shared, moved, vertices, moving)) &&
           (moved->target_count == 0 || set_targets(shared, moved, vertices, (const double(*)[4])to_model, moving)) &&
           (!moved->has_normals || place->mesh->normals == NULL ||
            set_target_normals(shared, moved, vertices, place, moving));
}
