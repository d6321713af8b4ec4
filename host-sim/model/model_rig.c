/* See model_rig.h. The bind pose, joints and morph targets of each mesh, in fixed point and in the units of the
 * fitted model. */
#include "model_rig.h"

#include "model_rig_clips.h"
#include "model_rig_pose.h"
#include "model_rig_range.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAC_MOST  15 /* of positions */
#define FRAC_LEAST 12

static int32_t q24(double value)
{
    return (int32_t)lround(model_rig_clamp(value, 127.9999) * PH_MOTION_ONE);
}

static int16_t fixed16(double value, int frac, double *error)
{
    const long rounded = lround(model_rig_clamp(ldexp(value, frac), 32767));
    model_rig_note(error, value - ldexp((double)rounded, -frac));
    return (int16_t)rounded;
}

/* Refuses a number of a node that its fixed point has no room for. */
static bool fits(struct model_shared *shared, uint32_t node, const char *what, const double v[3])
{
    const double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    return most <= MODEL_RIG_MOST ||
           model_shared_failed(shared, "cannot be shown: %s of node %u is %.4g, and at most %d is possible", what, node,
                               most, MODEL_RIG_MOST);
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

static void set_matrix(float to[3][4], const double (*from)[4])
{
    for (int i = 0; i < 12; i++) {
        to[i / 4][i % 4] = (float)from[i / 4][i % 4];
    }
}

/* Shows the meshes of a node where they are bound. A node of its own, the last one without a parent, draws what follows
 * a skin. */
static void show_bound(struct model_rig *rig, struct model_scene *scene, uint32_t i, const double (*place)[4])
{
    struct model_node *node = &scene->nodes[i], *own = &scene->nodes[scene->node_count];
    if (rig->nodes[i].drawn == MODEL_NONE) {
        return;
    }
    if (node->skin == MODEL_NONE) {
        node->is_bound = memcmp(place, rig->nodes[i].world, sizeof rig->nodes[i].world) != 0;
        set_matrix(node->bound, place);
        return;
    }
    *own = (struct model_node){.parent = MODEL_NONE,
                               .child = MODEL_NONE,
                               .next = MODEL_NONE,
                               .skin = MODEL_NONE,
                               .first_mesh = node->first_mesh,
                               .mesh_count = node->mesh_count};
    set_matrix(own->m, place);
    uint32_t last = scene->first_node;
    while (scene->nodes[last].next != MODEL_NONE) {
        last = scene->nodes[last].next;
    }
    scene->nodes[last].next = scene->node_count;
    rig->nodes[i].drawn = scene->node_count++;
    node->mesh_count = 0;
}

/* Finds an order of all nodes that are shown in which each follows its parent: nodes without a parent by their numbers,
 * then the children of each. */
static void find_order(struct model_rig *rig)
{
    const struct model_scene *scene = rig->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        rig->nodes[i].drawn = rig->nodes[i].number = MODEL_NONE;
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        if (scene->nodes[i].is_shown && scene->nodes[i].parent == MODEL_NONE) {
            rig->order[rig->node_count++] = i;
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        for (uint32_t i = scene->nodes[rig->order[k]].child; i != MODEL_NONE; i = scene->nodes[i].next) {
            rig->order[rig->node_count++] = i;
        }
    }
}

/* Marks nodes that a clip moves, and the meshes that move. */
static void find_moving(struct model_rig *rig)
{
    const struct model_scene *scene = rig->scene;
    for (uint32_t c = 0; c < scene->clip_count; c++) {
        for (uint32_t i = 0; i < scene->clips[c].count; i++) {
            const struct model_track *track = &scene->clips[c].tracks[i];
            rig->nodes[track->node].moves = rig->nodes[track->node].moves || track->path != PH_PATH_WEIGHTS;
            rig->nodes[track->node].drawn =
                track->path == PH_PATH_WEIGHTS ? track->node : rig->nodes[track->node].drawn;
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const uint32_t i = rig->order[k];
        const struct model_node *from = &scene->nodes[i];
        struct model_rig_node *node = &rig->nodes[i];
        node->moves = node->moves || (from->parent != MODEL_NONE && rig->nodes[from->parent].moves);
        node->drawn = node->moves || from->skin != MODEL_NONE ? i : node->drawn;
        for (uint32_t w = 0; from->weights != NULL && w < from->weight_count; w++) {
            node->drawn = from->weights[w] != 0 ? i : node->drawn;
        }
        node->drawn = from->mesh_count > 0 ? node->drawn : MODEL_NONE;
    }
}

/* Leaves in the order what moves meshes, and what that stands in. */
static void keep_movers(struct model_rig *rig)
{
    const struct model_scene *scene = rig->scene;
    uint32_t kept = 0;
    for (uint32_t k = 0; k < rig->node_count; k++) {
        const struct model_node *node = &scene->nodes[rig->order[k]];
        const struct model_skin *skin =
            node->skin != MODEL_NONE && node->mesh_count > 0 ? &scene->skins[node->skin] : NULL;
        for (uint32_t j = 0; skin != NULL && j < skin->count; j++) {
            rig->nodes[skin->joints[j]].number = 0;
        }
    }
    for (uint32_t k = rig->node_count; k-- > 0;) {
        const uint32_t i = rig->order[k], parent = scene->nodes[i].parent;
        rig->nodes[i].number = rig->nodes[i].drawn != MODEL_NONE ? 0 : rig->nodes[i].number;
        if (rig->nodes[i].number == 0 && parent != MODEL_NONE) {
            rig->nodes[parent].number = 0;
        }
    }
    for (uint32_t k = 0; k < rig->node_count; k++) {
        if (rig->nodes[rig->order[k]].number == 0) {
            rig->nodes[rig->order[k]].number = kept;
            rig->order[kept++] = rig->order[k];
        }
    }
    rig->node_count = kept;
}

static bool make_weights(struct model_rig *rig)
{
    bool done = true;
    for (uint32_t k = 0; k < rig->node_count; k++) {
        struct model_rig_node *node = &rig->nodes[rig->order[k]];
        const uint32_t n = rig->scene->nodes[rig->order[k]].weight_count;
        node->weights = calloc(n + (size_t)1, sizeof *node->weights);
        node->most_weights = calloc(n + (size_t)1, sizeof *node->most_weights);
        done = done && node->weights != NULL && node->most_weights != NULL;
    }
    return done;
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
    model_matrix *references = calloc(n + 1, sizeof *references);
    bool done = rig->nodes != NULL && rig->order != NULL && references != NULL;
    if (done) {
        find_order(rig);
        find_moving(rig);
        keep_movers(rig);
        done = make_weights(rig) && model_rig_moments_find(rig) && model_rig_ranges_find(rig, references);
    }
    for (uint32_t k = 0; done && k < rig->node_count; k++) {
        show_bound(rig, scene, rig->order[k], (const double(*)[4])references[rig->order[k]]);
    }
    free(references);
    return done;
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

double model_rig_above(const struct model_rig *rig, uint32_t node)
{
    const uint32_t parent = rig->scene->nodes[node].parent;
    return parent == MODEL_NONE ? 1 : rig->nodes[parent].length[0];
}

void model_rig_origin(const struct model_rig *rig, uint32_t node, const struct model_fit *fit, double origin[3])
{
    for (int k = 0; k < 3; k++) {
        origin[k] = 0;
        for (int i = 0; rig->scene->nodes[node].parent == MODEL_NONE && i < 3; i++) {
            origin[k] += (double)rig->scene->root[i][k] * fit->centre[i];
        }
    }
}

/* Whether every clip says what a property of a node is, so that it is never at rest. */
static bool is_never_at_rest(const struct model_scene *scene, uint32_t node, uint8_t path)
{
    uint32_t has = 0;
    for (uint32_t c = 0; c < scene->clip_count; c++) {
        bool is_keyed = false;
        for (uint32_t i = 0; i < scene->clips[c].count; i++) {
            is_keyed = is_keyed || (scene->clips[c].tracks[i].node == node && scene->clips[c].tracks[i].path == path);
        }
        has += is_keyed;
    }
    return has > 0 && has == scene->clip_count;
}

static bool read_rest(struct model_shared *shared, uint32_t i, const struct model_fit *fit, struct ph_rig_node *to)
{
    const struct model_rig *rig = shared->rig;
    const struct model_node *from = &rig->scene->nodes[i];
    const double above = model_rig_above(rig, i);
    double t[3], s[3];
    model_rig_origin(rig, i, fit, t);
    for (int k = 0; k < 3; k++) {
        t[k] = (from->t[k] - t[k]) * above * fit->scale;
        s[k] = from->s[k] * above / rig->nodes[i].length[k];
    }
    to->parent = (int16_t)(from->parent == MODEL_NONE ? -1 : (int32_t)rig->nodes[from->parent].number);
    to->rest = (struct ph_pose){quat_of(from->q), {q24(t[0]), q24(t[1]), q24(t[2])}, {q24(s[0]), q24(s[1]), q24(s[2])}};
    return (is_never_at_rest(rig->scene, i, PH_PATH_TRANSLATION) ||
            fits(shared, i, "the translation in radii of the model", t)) &&
           (is_never_at_rest(rig->scene, i, PH_PATH_SCALE) || fits(shared, i, "the scale beside its largest", s));
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
        const struct model_rig_node *own = &rig->nodes[rig->order[k]];
        for (uint32_t i = 0; i < node->weight_count; i++) {
            const double most = own->most_weights[i];
            weights[own->first_weight + i] = q24(node->weights != NULL && most > 0 ? node->weights[i] / most : 0);
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
                                .centre = {fit->centre[0], fit->centre[1], fit->centre[2]}};
    shared->model.motion = to;
    for (uint32_t k = 0; k < n; k++) {
        if (!read_rest(shared, rig->order[k], fit, &nodes[k])) {
            return false;
        }
    }
    if (!read_weights(shared, &to->animation)) {
        return model_shared_failed(shared, "needs too much memory, or has too many morph targets");
    }
    for (int i = 0; i < 9; i++) {
        to->animation.root.r[i / 3][i % 3] = (int32_t)lround((double)rig->scene->root[i / 3][i % 3] * FX_Q30_ONE);
    }
    return model_rig_clips_make(shared, to, fit);
}

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* Fills the inverse bind matrix of a joint for positions that are in the model already. */
static bool set_bind(struct model_shared *shared, uint32_t joint, const double (*back)[4], const float *bind,
                     struct ph_xform *to)
{
    const double unit = shared->model.scale, *length = shared->rig->nodes[joint].length;
    model_matrix own, product;
    double t[3];
    model_matrix_from_columns(own, bind);
    model_matrix_multiply(product, (const double(*)[4])own, back);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++) {
            const double element = product[row][k] * length[row] * unit;
            to->r[row][k] = (int32_t)lround(model_rig_clamp(element, 1.9999999) * FX_Q30_ONE);
        }
        t[row] = product[row][3] * length[row] * unit;
    }
    to->t = (struct fx_vec3){q24(t[0]), q24(t[1]), q24(t[2])};
    return fits(shared, joint, "the distance in radii of the model of what follows the axes", t);
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
    *skin = (struct ph_skin){numbers, inverse, from->count};
    for (uint32_t k = 0; k < from->count; k++) {
        numbers[k] = (uint16_t)rig->nodes[from->joints[k]].number;
        if (!set_bind(shared, from->joints[k], back, from->bind != NULL ? from->bind + 16 * (size_t)k : NULL,
                      &inverse[k])) {
            return false;
        }
    }
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

/* What target t adds to a vertex in the model, where its weight is largest. */
static void shift_of(const struct model_moved *moved, uint32_t t, unsigned vertex, const double (*to_model)[4],
                     double most, double shift[3])
{
    const float *from =
        moved->targets[t] != NULL ? moved->targets[t] + 3 * (size_t)moved->sources[vertex] : (const float[3]){0, 0, 0};
    for (int row = 0; row < 3; row++) {
        shift[row] = most * (to_model[row][0] * (double)from[0] + to_model[row][1] * (double)from[1] +
                             to_model[row][2] * (double)from[2]);
    }
}

static bool set_targets(struct model_shared *shared, const struct model_moved *moved, const unsigned *vertices,
                        const double (*to_model)[4], const double *most, struct animation_mesh *to)
{
    const uint32_t n = to->bound.vertex_count;
    int16_t(*d)[3] = demo_alloc(&shared->arena, sizeof *d * n * moved->target_count);
    if (d == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    for (size_t i = 0; i < (size_t)n * moved->target_count; i++) {
        double shift[3];
        shift_of(moved, (uint32_t)(i / n), vertices[i % n], to_model, most[i / n], shift);
        for (int row = 0; row < 3; row++) {
            d[i][row] = fixed16(shift[row], to->bound.frac, &shared->model.motion->rounding.target);
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
                               const struct model_place *place, const double *most, struct animation_mesh *to)
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
            d[i][row] = (int16_t)lround(model_rig_clamp(v * most[i / n] / length * 16384, 32767));
        }
    }
    to->morph.normals = to->bound.normals;
    to->morph.d_normals = (const int16_t(*)[3])d;
    return d != NULL || model_shared_failed(shared, "needs too much memory");
}

/* Finds the bits of fraction that positions have, as the targets move them. */
static bool find_frac(struct model_shared *shared, const struct ph_mesh *mesh, const struct model_moved *moved,
                      const unsigned *vertices, const double (*to_model)[4], uint32_t node, uint8_t *frac)
{
    double most = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const struct fx_vec3 *p = &mesh->positions[i];
        double sums[3] = {fabs(p->x / 65536.0), fabs(p->y / 65536.0), fabs(p->z / 65536.0)}, shift[3];
        for (uint32_t t = 0; t < moved->target_count; t++) {
            shift_of(moved, t, vertices[i], to_model, shared->rig->nodes[node].most_weights[t], shift);
            for (int k = 0; k < 3; k++) {
                sums[k] += fabs(shift[k]);
            }
        }
        most = fmax(most, fmax(sums[0], fmax(sums[1], sums[2])));
    }
    *frac = FRAC_MOST;
    while (*frac > FRAC_LEAST && ldexp(most, *frac) > 32769) {
        --*frac;
    }
    return ldexp(most, *frac) <= 32769 ||
           model_shared_failed(shared,
                               "cannot be shown: a vertex of node %u can get %.4g radii of the model away from where "
                               "it is bound, and at most %d are possible",
                               node, most, 1 << (FRAC_MOST - FRAC_LEAST));
}

static bool copy_bind_pose(struct model_shared *shared, const struct ph_mesh *mesh, uint8_t frac,
                           struct animation_mesh *to)
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
            positions[i][k] = fixed16(v[k], frac, &shared->model.motion->rounding.position);
            normals[i][k] = mesh->normals[i][k];
        }
    }
    to->bound = (struct ph_bound){.positions = (const int16_t(*)[3])positions,
                                  .normals = (const int16_t(*)[3])normals,
                                  .vertex_count = n,
                                  .frac = frac};
    return true;
}

bool model_rig_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                    const unsigned *vertices, uint32_t mesh)
{
    const struct model_rig *rig = shared->rig;
    const struct model_moved *moved = &place->mesh->moved;
    struct model_motion *to = shared->model.motion;
    const uint32_t node = to != NULL ? model_rig_mover(rig, place->node) : MODEL_NONE;
    if (node == MODEL_NONE) {
        return true;
    }
    if (moved->target_count != rig->scene->nodes[node].weight_count) {
        return model_shared_failed(shared, "is broken: parts of a mesh have different numbers of morph targets");
    }
    struct animation_mesh *moving = &rig->moving[to->animation.mesh_count];
    model_matrix to_model, back;
    uint8_t frac;
    for (int i = 0; i < 12; i++) {
        const double centre = i % 4 == 3 ? fit->centre[i / 4] : 0;
        to_model[i / 4][i % 4] = (place->m[i / 4][i % 4] - centre) * fit->scale;
    }
    if (!model_matrix_invert(back, (const double(*)[4])to_model)) {
        model_shared_note(shared, "what a node flattens does not move");
        return true;
    }
    *moving = (struct animation_mesh){.mesh = mesh, .first_weight = rig->nodes[node].first_weight};
    to->animation.mesh_count++;
    const bool is_skinned = rig->scene->nodes[node].skin != MODEL_NONE;
    if (is_skinned && (moved->joints == NULL || moved->weights == NULL)) {
        return model_shared_failed(shared, "is broken: a mesh with a skin names no joints");
    }
    const double(*const linear)[4] = (const double(*)[4])to_model, *most = rig->nodes[node].most_weights;
    const struct ph_mesh *drawn = &shared->model.meshes[mesh];
    if (!find_frac(shared, drawn, moved, vertices, linear, node, &frac) ||
        !copy_bind_pose(shared, drawn, frac, moving)) {
        return false;
    }
    moving->bound.scales_axes = rig->nodes[node].scales_axes;
    if (rig->nodes[node].mirrors) { /* faces turn over; the depth test shows those that look outwards */
        ((struct ph_material *)(uintptr_t)drawn->materials)->two_sided = true;
    }
    return set_skin(shared, node, (const double(*)[4])back, &moving->skin) &&
           (!is_skinned || set_influences(shared, moved, vertices, moving)) &&
           (moved->target_count == 0 || set_targets(shared, moved, vertices, linear, most, moving)) &&
           (!moved->has_normals || place->mesh->normals == NULL ||
            set_target_normals(shared, moved, vertices, place, most, moving));
}
