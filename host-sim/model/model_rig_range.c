/* See model_rig_range.h. */
#include "model_rig_range.h"

#include "model_rig_pose.h"

#include <stdlib.h>
#include <string.h>

#define JOINTS_MAX   256
#define ELEMENT_MOST 1.1         /* of a bind matrix along one axis: turned, an element has at most 1.1 sqrt 3 */
#define AXIS_LEAST   (1 / 1024.) /* of the longest axis: what is thinner is bound as if it were so thick */
#define CONFORMAL    (1 / 256.)  /* axes that differ by less count as scaled by the same */
#define REST_COUNTS  8           /* times as much as another moment, where a pose is chosen to bind in */
#define VISITS_MOST  (1 << 25)   /* vertices */
#define STEPS_LEAST  16          /* moments that are visited at least */

/* What is known of the places of a node, or of the matrices of a skin, in all moments. */
struct reach {
    double most[3]; /* the greatest length of each axis */
    model_matrix
        shown;   /* the place that it is bound in: at rest, or where it is much larger there, at another moment */
    double size; /* the determinant of shown */
    bool used[JOINTS_MAX]; /* the joints of a skin that some vertex follows */
};

static void widen(struct reach *reach, const double (*m)[4], bool is_rest)
{
    const double size = fabs(model_matrix_determinant(m)) * (is_rest ? REST_COUNTS : 1);
    for (int k = 0; k < 3; k++) {
        reach->most[k] = fmax(reach->most[k], model_matrix_column(m, k));
    }
    if (is_rest || size > reach->size) {
        memcpy(reach->shown, m, sizeof reach->shown);
        reach->size = size;
    }
}

/* ---- skins ------------------------------------------------------------------------------------------------------- */

static const struct model_skin *skin_of(const struct model_rig *rig, uint32_t node)
{
    const struct model_node *n = &rig->scene->nodes[node];
    return n->skin != MODEL_NONE ? &rig->scene->skins[n->skin] : NULL;
}

/* Finds which joints of a skin some vertex of a node follows; the first counts where none does. */
static void find_used(const struct model_scene *scene, const struct model_node *node, bool used[JOINTS_MAX])
{
    bool any = false;
    for (uint32_t m = 0; m < node->mesh_count; m++) {
        const struct model_mesh *mesh = &scene->meshes[node->first_mesh + m];
        for (size_t i = 0; mesh->moved.joints != NULL && mesh->moved.weights != NULL && i < mesh->vertex_count; i++) {
            for (size_t k = 4 * (size_t)mesh->moved.sources[i]; k < 4 * (size_t)mesh->moved.sources[i] + 4; k++) {
                const float joint = mesh->moved.joints[k];
                if (mesh->moved.weights[k] > 0 && joint >= 0 && joint < JOINTS_MAX) {
                    any = used[(int)joint] = true;
                }
            }
        }
    }
    used[0] = used[0] || !any;
}

/* The bind matrix of a joint as the file has it; NULL: the identity. */
static const float *bind_of(const struct model_skin *skin, uint32_t joint)
{
    return skin->bind != NULL ? skin->bind + 16 * (size_t)joint : NULL;
}

/* Where joint k of a skin has the vertices at this moment. */
static void skin_place(const struct model_rig *rig, const struct model_skin *skin, uint32_t k, model_matrix to)
{
    model_matrix bind;
    model_matrix_from_columns(bind, bind_of(skin, k));
    model_matrix_multiply(to, (const double(*)[4])rig->nodes[skin->joints[k]].world, (const double(*)[4])bind);
}

/* The place that a skin is bound in is that of its first joint. */
static void widen_skin(const struct model_rig *rig, const struct model_skin *skin, bool is_rest, struct reach *reach)
{
    const double most[3] = {reach->most[0], reach->most[1], reach->most[2]};
    model_matrix place;
    skin_place(rig, skin, 0, place);
    widen(reach, (const double(*)[4])place, is_rest);
    memcpy(reach->most, most, sizeof most);
    for (uint32_t k = 0; k < skin->count; k++) {
        skin_place(rig, skin, k, place);
        for (int axis = 0; reach->used[k] && axis < 3; axis++) {
            reach->most[axis] = fmax(reach->most[axis], model_matrix_column((const double(*)[4])place, axis));
        }
    }
}

/* The lengths that the axes of a node's vertices need at least, so that the elements of bind matrices keep small. */
static void find_least(const struct model_rig *rig, uint32_t node, const bool *used, double least[3])
{
    const struct model_skin *skin = skin_of(rig, node);
    for (uint32_t k = 0; k < (skin != NULL ? skin->count : 1); k++) {
        const double *length = rig->nodes[skin != NULL ? skin->joints[k] : node].length;
        model_matrix bind;
        model_matrix_from_columns(bind, skin != NULL ? bind_of(skin, k) : NULL);
        for (int i = 0; i < 9; i++) {
            bind[i / 3][i % 3] *= length[i / 3];
        }
        for (int axis = 0; (skin == NULL || used[k]) && axis < 3; axis++) {
            least[axis] = fmax(least[axis], model_matrix_column((const double(*)[4])bind, axis) / ELEMENT_MOST);
        }
    }
}

/* ---- the place in which a mesh is bound -------------------------------------------------------------------------- */

/* The directions of the axes of m, at right angles; false: those of m are not. */
static bool directions(const double (*m)[4], double to[3][3])
{
    double most = 0, off = 0;
    for (int k = 0; k < 3; k++) {
        const double length = model_matrix_column(m, k);
        for (int i = 0; i < 3; i++) {
            to[k][i] = m[i][k] / length;
        }
        most = fmax(most, length);
    }
    for (int k = 0; k < 3; k++) {
        const double *a = to[k], *b = to[(k + 1) % 3];
        off = fmax(off, fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]));
    }
    const double size = model_matrix_determinant(m);
    if (fabs(size) > 1e-9 * most * most * most && off < 1e-4) {
        return true;
    }
    for (int i = 0; i < 9; i++) { /* no matter which, as long as they mirror what m mirrors */
        to[i / 3][i % 3] = i % 4 != 0 ? 0 : size < 0 ? -1 : 1;
    }
    return false;
}

/* The middle of the box of a node's vertices. */
static void find_middle(const struct model_scene *scene, const struct model_node *node, double middle[3])
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t m = 0; m < node->mesh_count; m++) {
        const struct model_mesh *mesh = &scene->meshes[node->first_mesh + m];
        for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
            low[i % 3] = fmin(low[i % 3], (double)mesh->positions[i / 3][i % 3]);
            high[i % 3] = fmax(high[i % 3], (double)mesh->positions[i / 3][i % 3]);
        }
    }
    for (int k = 0; k < 3; k++) {
        middle[k] = model_rig_clamp((low[k] + high[k]) / 2, HUGE_VAL);
    }
}

static void set_reference(const struct reach *reach, const double least[3], const double middle[3], model_matrix to)
{
    const double(*shown)[4] = (const double(*)[4])reach->shown;
    double axes[3][3];
    bool is_same = directions(shown, axes);
    for (int k = 0; k < 3; k++) {
        const double length = fmax(reach->most[k], least[k]);
        is_same = is_same && fabs(model_matrix_column(shown, k) - length) <= 1e-6 * length;
        for (int i = 0; i < 3; i++) {
            to[i][k] = axes[k][i] * length;
        }
    }
    if (is_same) {
        memcpy(to, shown, sizeof reach->shown);
        return;
    }
    for (int i = 0; i < 3; i++) {
        to[i][3] = shown[i][3];
        for (int k = 0; k < 3; k++) {
            to[i][3] += (shown[i][k] - to[i][k]) * middle[k];
        }
    }
}

/* ---- all nodes --------------------------------------------------------------------------------------------------- */

static void widen_all(struct model_rig *rig, struct reach *nodes, struct reach *meshes)
{
    for (size_t at = 0; at < rig->moment_count; at++) {
        model_rig_pose(rig, &rig->moments[at]);
        for (uint32_t k = 0; k < rig->node_count; k++) {
            const uint32_t i = rig->order[k];
            struct model_rig_node *node = &rig->nodes[i];
            widen(&nodes[i], (const double(*)[4])node->world, at == 0);
            if (skin_of(rig, i) != NULL && rig->scene->nodes[i].mesh_count > 0) {
                widen_skin(rig, skin_of(rig, i), at == 0, &meshes[i]);
            }
            for (uint32_t w = 0; w < rig->scene->nodes[i].weight_count; w++) {
                model_rig_note(&node->most_weights[w], node->weights[w]);
            }
        }
    }
}

/* A node that others of the rig stand in has one length for its three axes: others turn in it. */
static void find_lengths(struct model_rig *rig, const struct reach *nodes)
{
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const double *most = nodes[rig->order[k]].most;
        const double longest = fmax(most[0], fmax(most[1], most[2]));
        for (int axis = 0; axis < 3; axis++) {
            const double length = fmax(most[axis], longest * AXIS_LEAST);
            rig->nodes[rig->order[k]].length[axis] = length > 0 && isfinite(length) ? length : 1;
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const uint32_t parent = rig->scene->nodes[rig->order[k]].parent;
        double *length = parent != MODEL_NONE ? rig->nodes[parent].length : NULL;
        if (length != NULL) {
            length[0] = length[1] = length[2] = fmax(length[0], fmax(length[1], length[2]));
        }
    }
}

/* Whether a place turns what is bound at `reference` and scales all axes of it by the same. */
static bool is_conformal(const double (*place)[4], const double (*reference)[4])
{
    model_matrix back, m;
    if (!model_matrix_invert(back, reference)) {
        return true;
    }
    model_matrix_multiply(m, place, (const double(*)[4])back);
    double most = 0;
    for (int k = 0; k < 3; k++) {
        most = fmax(most, model_matrix_column((const double(*)[4])m, k));
    }
    for (int k = 0; k < 3; k++) {
        const int j = (k + 1) % 3;
        const double dot = m[0][k] * m[0][j] + m[1][k] * m[1][j] + m[2][k] * m[2][j];
        if (model_matrix_column((const double(*)[4])m, k) < most * (1 - CONFORMAL) ||
            fabs(dot) > most * most * CONFORMAL) {
            return false;
        }
    }
    return true;
}

/* Notes how a place differs from the one in which a node's meshes are bound. */
static void note_place(struct model_rig_node *node, const double (*place)[4], const double (*reference)[4])
{
    node->scales_axes = node->scales_axes || !is_conformal(place, reference);
    node->mirrors = node->mirrors || model_matrix_determinant(place) * model_matrix_determinant(reference) < 0;
}

static void note_node(struct model_rig *rig, uint32_t i, const bool *used, const double (*reference)[4])
{
    const struct model_skin *skin = skin_of(rig, i);
    struct model_rig_node *node = &rig->nodes[i];
    if (skin == NULL) {
        note_place(node, (const double(*)[4])node->world, reference);
    }
    for (uint32_t k = 0; skin != NULL && k < skin->count; k++) {
        model_matrix place;
        skin_place(rig, skin, k, place);
        if (used[k]) {
            note_place(node, (const double(*)[4])place, reference);
        }
    }
}

static void note_all(struct model_rig *rig, const struct reach *meshes, model_matrix *references)
{
    for (size_t at = 0; at < rig->moment_count; at++) {
        model_rig_pose(rig, &rig->moments[at]);
        for (uint32_t k = 0; k < rig->node_count; k++) {
            const uint32_t i = rig->order[k];
            if (rig->scene->nodes[i].mesh_count > 0) {
                note_node(rig, i, meshes[i].used, (const double(*)[4])references[i]);
            }
        }
    }
    model_rig_pose(rig, &rig->moments[0]);
}

bool model_rig_ranges_find(struct model_rig *rig, model_matrix *references)
{
    const size_t n = rig->scene->node_count;
    struct reach *nodes = calloc(n + 1, sizeof *nodes), *meshes = calloc(n + 1, sizeof *meshes);
    if (nodes == NULL || meshes == NULL) {
        free(nodes);
        free(meshes);
        return false;
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        find_used(rig->scene, &rig->scene->nodes[rig->order[k]], meshes[rig->order[k]].used);
    }
    widen_all(rig, nodes, meshes);
    find_lengths(rig, nodes);
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const uint32_t i = rig->order[k];
        const struct model_node *node = &rig->scene->nodes[i];
        double least[3] = {0, 0, 0}, middle[3];
        if (node->mesh_count == 0) {
            continue;
        }
        find_least(rig, i, meshes[i].used, least);
        find_middle(rig->scene, node, middle);
        set_reference(skin_of(rig, i) != NULL ? &meshes[i] : &nodes[i], least, middle, references[i]);
    }
    note_all(rig, meshes, references);
    free(nodes);
    free(meshes);
    return true;
}

/* ---- the fit ----------------------------------------------------------------------------------------------------- */

/* Whether a vertex of a place is outside of the model's sphere, in which its middle has to be then. */
static bool is_outside(const struct model_place *place, const struct model_fit *fit, double middle[3])
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, p[3], most = 0;
    for (uint32_t i = 0; i < place->mesh->vertex_count; i++) {
        double square = 0;
        model_places_point(place, i, p);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
            square += (p[k] - fit->centre[k]) * (p[k] - fit->centre[k]);
        }
        most = fmax(most, square);
    }
    for (int k = 0; k < 3; k++) {
        middle[k] = (low[k] + high[k]) / 2;
    }
    return sqrt(most) * fit->scale > 1.00001;
}

void model_rig_settle(const struct model_rig *rig, const struct model_places *places, const struct model_fit *fit)
{
    double by[3] = {0, 0, 0}, middle[3];
    for (size_t k = 0; rig != NULL && k < places->count; k++) {
        struct model_place *place = &places->list[k];
        const bool is_first = k == 0 || place->node != places->list[k - 1].node;
        if (model_rig_mover(rig, place->node) == MODEL_NONE) {
            continue;
        }
        const bool moves = is_first && is_outside(place, fit, middle);
        for (int axis = 0; axis < 3; axis++) {
            by[axis] = moves ? fit->centre[axis] - middle[axis] : is_first ? 0 : by[axis];
            place->m[axis][3] += by[axis];
        }
    }
}

/* ---- vertices ---------------------------------------------------------------------------------------------------- */

uint32_t model_rig_mover(const struct model_rig *rig, uint32_t drawn)
{
    for (uint32_t k = 0; rig != NULL && k < rig->node_count; k++) {
        if (rig->nodes[rig->order[k]].drawn == drawn) {
            return rig->order[k];
        }
    }
    return MODEL_NONE;
}

/* A vertex with what the targets add to it at this moment. */
static void morph(const struct model_moved *moved, const double *weights, uint32_t source, double p[3])
{
    for (uint32_t t = 0; t < moved->target_count; t++) {
        for (int axis = 0; moved->targets[t] != NULL && weights[t] != 0 && axis < 3; axis++) {
            p[axis] += weights[t] * (double)moved->targets[t][3 * (size_t)source + (size_t)axis];
        }
    }
}

/* The weighted mean of the joints' matrices; without weights the first joint's, as on a kit. False: it has no numbers.
 */
static bool mean_place(const struct model_moved *moved, uint32_t source, model_matrix *joints, uint32_t count,
                       model_matrix to)
{
    double sum = 0;
    memset(to, 0, sizeof(model_matrix));
    for (size_t k = 4 * (size_t)source; k < 4 * (size_t)source + 4; k++) {
        const double share = (double)moved->weights[k];
        if (!(share > 0) || !(moved->joints[k] >= 0 && moved->joints[k] < (float)count)) {
            continue;
        }
        for (int i = 0; i < 12; i++) {
            to[i / 4][i % 4] += share * joints[(int)moved->joints[k]][i / 4][i % 4];
        }
        sum += share;
    }
    if (sum == 0) {
        memcpy(to, joints[0], sizeof(model_matrix));
        return count > 0;
    }
    for (int i = 0; i < 12; i++) {
        to[i / 4][i % 4] /= sum;
    }
    return isfinite(sum);
}

static void visit_place(const struct model_rig *rig, const struct model_place *place, uint32_t node,
                        model_matrix *joints, void (*visit)(void *context, const double point[3]), void *context)
{
    const struct model_moved *moved = &place->mesh->moved;
    const struct model_skin *skin = skin_of(rig, node);
    const bool is_skinned = skin != NULL && moved->joints != NULL && moved->weights != NULL;
    model_matrix root, local, world;
    for (int i = 0; i < 12; i++) {
        root[i / 4][i % 4] = (double)rig->scene->root[i / 4][i % 4];
    }
    for (uint32_t k = 0; is_skinned && k < skin->count; k++) {
        skin_place(rig, skin, k, local);
        model_matrix_multiply(joints[k], (const double(*)[4])root, (const double(*)[4])local);
    }
    model_matrix_multiply(world, (const double(*)[4])root, (const double(*)[4])rig->nodes[node].world);
    for (uint32_t v = 0; v < place->mesh->vertex_count; v++) {
        const float *from = place->mesh->positions[v];
        double p[3] = {(double)from[0], (double)from[1], (double)from[2]}, point[3];
        const uint32_t source = moved->sources != NULL ? moved->sources[v] : 0;
        morph(moved, rig->nodes[node].weights, source, p);
        if (is_skinned && !mean_place(moved, source, joints, skin->count, world)) {
            continue;
        }
        for (int i = 0; i < 3; i++) {
            point[i] = world[i][0] * p[0] + world[i][1] * p[1] + world[i][2] * p[2] + world[i][3];
        }
        visit(context, point);
    }
}

bool model_rig_visit(struct model_rig *rig, const struct model_places *places,
                     void (*visit)(void *context, const double point[3]), void *context)
{
    model_matrix *joints = calloc(JOINTS_MAX, sizeof *joints);
    uint32_t *movers = calloc(places->count + 1, sizeof *movers);
    size_t count = 1;
    for (size_t k = 0; movers != NULL && k < places->count; k++) {
        movers[k] = model_rig_mover(rig, places->list[k].node);
        count += movers[k] != MODEL_NONE ? places->list[k].mesh->vertex_count : 0;
    }
    const size_t most = VISITS_MOST / count, step = rig->moment_count / (most > STEPS_LEAST ? most : STEPS_LEAST) + 1;
    for (size_t at = rig->moment_count > 1; joints != NULL && movers != NULL && at < rig->moment_count; at += step) {
        model_rig_pose(rig, &rig->moments[at]);
        for (size_t k = 0; k < places->count; k++) {
            if (movers[k] != MODEL_NONE) {
                visit_place(rig, &places->list[k], movers[k], joints, visit, context);
            }
        }
    }
    model_rig_pose(rig, &rig->moments[0]);
    const bool done = joints != NULL && movers != NULL;
    free(joints);
    free(movers);
    return done;
}
