#include "model_gltf_motion.h"

#include "model_gltf_clips.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JOINTS_MAX 256
#define FRAC       15 /* of positions */

static int32_t q24(double value)
{
    return (int32_t)lround(model_gltf_clamp(value, 127.9999) * PH_MOTION_ONE);
}

static int16_t q15(double value, double *error)
{
    const long rounded = lround(model_gltf_clamp(value * 32768, 32767));
    model_gltf_note(error, value - (double)rounded / 32768);
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

/* False: it has no inverse. */
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

/* Sixteen numbers, column by column, as glTF has them. */
static void from_columns(matrix to, const float *m)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = (double)m[4 * column + row];
        }
    }
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

/* The inverse bind matrices of a skin; NULL: there are none. */
static float *bind_matrices(struct gltf_file *file, const struct gltf_json *skin, uint32_t joints)
{
    const uint32_t accessor = gltf_file_whole(skin, "inverseBindMatrices", GLTF_NONE);
    uint32_t count = 0;
    float *matrices = accessor != GLTF_NONE ? gltf_file_numbers(file, accessor, 16, &count) : NULL;
    if (matrices != NULL && count < joints) {
        gltf_file_failed(file, "a skin has %u joints and %u matrices", joints, count);
    }
    return count >= joints ? matrices : NULL;
}

/* Reads the joints of a skin, numbers of nodes in the scene. 0: file->error. */
static uint32_t read_joints(struct model_gltf_motion *motion, const struct gltf_json *skin, uint32_t *to)
{
    const struct gltf_json *item, *list = gltf_json_get(skin, "joints");
    uint32_t count = 0;
    GLTF_JSON_EACH(item, list)
    {
        const double i = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : -1;
        if (!(i >= 0 && i < motion->file->lists[GLTF_NODES].count) || count == JOINTS_MAX ||
            motion->nodes[(uint32_t)i].drawn == NULL) {
            gltf_file_failed(motion->file, "a skin has a joint that is not in the scene, or more than %d", JOINTS_MAX);
            return 0;
        }
        to[count++] = (uint32_t)i;
    }
    if (count == 0) {
        gltf_file_failed(motion->file, "a skin has no joints");
    }
    return count;
}

static const struct gltf_json *skin_of(const struct model_gltf_motion *motion, uint32_t node)
{
    return gltf_file_item(motion->file, GLTF_SKINS, gltf_file_whole(motion->nodes[node].json, "skin", GLTF_NONE));
}

/* A node of its own below the root draws what follows a skin, at the place that the first joint gives it. */
static bool move_skinned(struct model_gltf_motion *motion, struct aiNode *root, uint32_t i)
{
    struct model_gltf_node *node = &motion->nodes[i];
    const struct gltf_json *skin = skin_of(motion, i);
    uint32_t joints[JOINTS_MAX];
    if (skin == NULL && gltf_json_get(node->json, "skin") != NULL) {
        return gltf_file_failed(motion->file, "node %u has a skin that is not there", i);
    }
    if (skin == NULL || node->drawn->mNumMeshes == 0) {
        return true;
    }
    const uint32_t count = read_joints(motion, skin, joints);
    const float *matrices = bind_matrices(motion->file, skin, count);
    struct aiNode *own = calloc(1, sizeof *own);
    struct aiNode **children = realloc(root->mChildren, sizeof *children * (root->mNumChildren + 2));
    if (count == 0 || motion->file->error[0] != '\0' || own == NULL || children == NULL) {
        return gltf_file_failed(motion->file, "it needs too much memory");
    }
    matrix bind, place;
    memcpy(bind, identity, sizeof bind);
    if (matrices != NULL) {
        from_columns(bind, matrices);
    }
    multiply(place, (const double(*)[4])motion->nodes[joints[0]].world, (const double(*)[4])bind);
    own->mTransformation = (struct aiMatrix4x4){(float)place[0][0],
                                                (float)place[0][1],
                                                (float)place[0][2],
                                                (float)place[0][3],
                                                (float)place[1][0],
                                                (float)place[1][1],
                                                (float)place[1][2],
                                                (float)place[1][3],
                                                (float)place[2][0],
                                                (float)place[2][1],
                                                (float)place[2][2],
                                                (float)place[2][3],
                                                0,
                                                0,
                                                0,
                                                1};
    own->mNumMeshes = node->drawn->mNumMeshes;
    own->mMeshes = node->drawn->mMeshes;
    node->drawn->mNumMeshes = 0;
    node->drawn = own;
    root->mChildren = children;
    root->mChildren[root->mNumChildren++] = own;
    return true;
}

static void find_order(struct model_gltf_motion *motion, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        motion->nodes[i].parent = -1;
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct gltf_json *item, *list;
        motion->nodes[i].json = gltf_file_item(motion->file, GLTF_NODES, i);
        list = gltf_json_get(motion->nodes[i].json, "children");
        GLTF_JSON_EACH(item, list)
        {
            if (motion->nodes[i].drawn != NULL && gltf_json_is(item, GLTF_JSON_NUMBER) && item->number >= 0 &&
                item->number < count) {
                motion->nodes[(uint32_t)item->number].parent = (int32_t)i;
            }
        }
    }
    /* The reader has found that each node of the scene has one parent, so that each is met once. */
    for (uint32_t i = 0; i < count; i++) {
        if (motion->nodes[i].drawn != NULL && motion->nodes[i].parent < 0) {
            motion->order[motion->node_count++] = i;
        }
    }
    for (uint32_t k = 0; k < motion->node_count; k++) {
        const struct gltf_json *item, *list = gltf_json_get(motion->nodes[motion->order[k]].json, "children");
        GLTF_JSON_EACH(item, list)
        {
            motion->order[motion->node_count++] = (uint32_t)item->number;
        }
    }
}

bool model_gltf_motion_find(struct model_gltf_motion *motion, struct aiNode *root)
{
    const uint32_t count = motion->file->lists[GLTF_NODES].count;
    motion->order = calloc((size_t)count + 1, sizeof *motion->order);
    if (motion->order == NULL) {
        return gltf_file_failed(motion->file, "it needs too much memory");
    }
    find_order(motion, count);
    for (uint32_t k = 0; k < motion->node_count; k++) {
        struct model_gltf_node *node = &motion->nodes[motion->order[k]];
        matrix base;
        memcpy(base, node->parent < 0 ? (const void *)identity : motion->nodes[node->parent].world, sizeof base);
        model_places_multiply(node->world, base, &node->drawn->mTransformation);
        node->number = k;
    }
    for (uint32_t k = 0; k < motion->node_count; k++) {
        if (!move_skinned(motion, root, motion->order[k])) {
            return false;
        }
    }
    return true;
}

/* ---- the rig ----------------------------------------------------------------------------------------------------- */

/* Translation, rotation and scale of a matrix; what it shears is lost. */
static void take_apart(const double m[16], double t[3], double q[4], double s[3])
{
    double r[3][3]; /* columns */
    const double cross =
        m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);
    for (int c = 0; c < 3; c++) {
        t[c] = m[12 + c];
        s[c] = sqrt(m[4 * c] * m[4 * c] + m[4 * c + 1] * m[4 * c + 1] + m[4 * c + 2] * m[4 * c + 2]);
        s[c] = c == 0 && cross < 0 ? -s[c] : s[c];
        for (int i = 0; i < 3; i++) {
            r[c][i] = s[c] != 0 ? m[4 * c + i] / s[c] : c == i;
        }
    }
    const double most = fmax(fmax(r[0][0] + r[1][1] + r[2][2], r[0][0]), fmax(r[1][1], r[2][2]));
    if (most == r[0][0] + r[1][1] + r[2][2]) {
        q[3] = 1 + most, q[0] = r[1][2] - r[2][1], q[1] = r[2][0] - r[0][2], q[2] = r[0][1] - r[1][0];
        return;
    }
    const int i = most == r[0][0] ? 0 : most == r[1][1] ? 1 : 2, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + r[i][i] - r[j][j] - r[k][k];
    q[j] = r[i][j] + r[j][i];
    q[k] = r[i][k] + r[k][i];
    q[3] = r[j][k] - r[k][j];
}

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

static void read_rest(struct model_gltf_motion *motion, struct model_gltf_node *node, double unit,
                      struct ph_rig_node *to)
{
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    const double above = node->parent < 0 ? unit : motion->nodes[node->parent].length;
    if (gltf_file_vector(node->json, "matrix", 16, m)) {
        take_apart(m, t, q, s);
    } else {
        gltf_file_vector(node->json, "translation", 3, t);
        gltf_file_vector(node->json, "rotation", 4, q);
        gltf_file_vector(node->json, "scale", 3, s);
    }
    const double own = own_length(s);
    node->length = above * own;
    to->parent = (int16_t)(node->parent < 0 ? -1 : (int32_t)motion->nodes[node->parent].number);
    to->rest = (struct ph_pose){quat_of(q),
                                {q24(t[0] * above), q24(t[1] * above), q24(t[2] * above)},
                                {q24(s[0] / own), q24(s[1] / own), q24(s[2] / own)}};
}

/* The weights of morph targets that each node begins with, one behind the other. */
static bool read_weights(struct model_shared *shared, struct animation *to)
{
    struct model_gltf_motion *motion = shared->motion;
    for (int pass = 0; pass < 2; pass++) {
        int32_t *weights = pass == 1 ? demo_alloc(&shared->arena, sizeof *weights * (to->weight_count + 1)) : NULL;
        if (pass == 1 && weights == NULL) {
            return false;
        }
        to->weight_count = 0;
        for (uint32_t k = 0; k < motion->node_count; k++) {
            struct model_gltf_node *node = &motion->nodes[motion->order[k]];
            const struct gltf_json *mesh =
                gltf_file_item(motion->file, GLTF_MESHES, gltf_file_whole(node->json, "mesh", GLTF_NONE));
            const struct gltf_json *own = gltf_json_get(node->json, "weights"),
                                   *list = own != NULL ? own : gltf_json_get(mesh, "weights");
            const struct aiNode *drawn = node->drawn;
            node->weight_count = drawn->mNumMeshes > 0 ? motion->moved[drawn->mMeshes[0]].target_count : 0;
            node->first_weight = to->weight_count;
            for (uint32_t i = 0; pass == 1 && i < node->weight_count; i++) {
                const struct gltf_json *item = gltf_json_at(list, i);
                weights[to->weight_count + i] = q24(gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : 0);
            }
            to->weight_count += node->weight_count;
        }
        to->rest_weights = weights;
    }
    return to->weight_count <= UINT16_MAX;
}

static bool has_motion(const struct model_gltf_motion *motion)
{
    bool moves = motion->file->lists[GLTF_SKINS].count > 0 || motion->file->lists[GLTF_ANIMATIONS].count > 0;
    for (unsigned m = 0; m < motion->scene->mNumMeshes; m++) {
        moves = moves || motion->moved[m].target_count > 0;
    }
    return moves && motion->node_count > 0 && motion->node_count <= INT16_MAX;
}

bool model_gltf_motion_begin(struct model_shared *shared, const struct model_fit *fit, size_t meshes)
{
    struct model_gltf_motion *motion = shared->motion;
    if (motion == NULL || !has_motion(motion)) {
        return true;
    }
    const uint32_t n = motion->node_count;
    struct model_motion *to = demo_alloc(&shared->arena, sizeof *to);
    struct ph_rig_node *nodes = demo_alloc(&shared->arena, sizeof *nodes * n);
    motion->moving = demo_alloc(&shared->arena, sizeof *motion->moving * meshes);
    if (to == NULL || nodes == NULL || motion->moving == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    *to = (struct model_motion){.animation = {.rig = {nodes, n}, .root = ph_xform_identity, .meshes = motion->moving},
                                .scale = fit->scale};
    shared->model.motion = to;
    for (uint32_t k = 0; k < n; k++) {
        read_rest(motion, &motion->nodes[motion->order[k]], fit->scale, &nodes[k]);
    }
    if (!read_weights(shared, &to->animation)) {
        return model_shared_failed(shared, "needs too much memory, or has too many morph targets");
    }
    const struct aiMatrix4x4 *m = &motion->scene->mRootNode->mTransformation;
    const float r[9] = {m->a1, m->a2, m->a3, m->b1, m->b2, m->b3, m->c1, m->c2, m->c3};
    for (int i = 0; i < 9; i++) {
        to->animation.root.r[i / 3][i % 3] = (int32_t)lround((double)r[i] * FX_Q30_ONE);
    }
    to->animation.root.t = (struct fx_vec3){q24(-fit->centre[0] * fit->scale), q24(-fit->centre[1] * fit->scale),
                                            q24(-fit->centre[2] * fit->scale)};
    return model_gltf_clips_read(shared, to, fit->scale);
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
            to->r[row][k] = (int32_t)lround(model_gltf_clamp(product[row][k] * length, 1.9999999) * FX_Q30_ONE);
        }
        *t[row] = q24(product[row][3] * length);
    }
}

static bool set_skin(struct model_shared *shared, uint32_t node, const double (*back)[4], struct ph_skin *skin)
{
    struct model_gltf_motion *motion = shared->motion;
    const struct gltf_json *json = skin_of(motion, node);
    uint32_t joints[JOINTS_MAX] = {node};
    const uint32_t count = json != NULL ? read_joints(motion, json, joints) : 1;
    const float *bind = json != NULL ? bind_matrices(motion->file, json, count) : NULL;
    uint16_t *numbers = demo_alloc(&shared->arena, sizeof *numbers * count);
    struct ph_xform *inverse = demo_alloc(&shared->arena, sizeof *inverse * count);
    if (count == 0 || numbers == NULL || inverse == NULL) {
        return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        numbers[k] = (uint16_t)motion->nodes[joints[k]].number;
        set_bind(&inverse[k], back, bind != NULL ? bind + 16 * (size_t)k : NULL, motion->nodes[joints[k]].length);
    }
    *skin = (struct ph_skin){numbers, inverse, count};
    return true;
}

/* Four joints, the greatest share first, that sum to one. False: a joint is not there. */
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
        model_gltf_note(error, share[most] > 0 ? share[most] / sum - (double)part / PH_INFLUENCE_ONE : 0);
        share[most] = -1;
    }
    to->weights[0] = (uint16_t)(to->weights[0] + rest);
    return true;
}

static bool set_influences(struct model_shared *shared, const struct model_gltf_moved *moved, const unsigned *vertices,
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

static bool set_targets(struct model_shared *shared, const struct model_gltf_moved *moved, const unsigned *vertices,
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
static bool set_target_normals(struct model_shared *shared, const struct model_gltf_moved *moved,
                               const unsigned *vertices, const struct model_place *place, struct animation_mesh *to)
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
            d[i][row] = (int16_t)lround(model_gltf_clamp(v / length * 16384, 32767));
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

bool model_gltf_motion_bind(struct model_shared *shared, const struct model_place *place, const struct model_fit *fit,
                            const unsigned *vertices, uint32_t mesh)
{
    const struct model_gltf_motion *motion = shared->motion;
    struct model_motion *to = shared->model.motion;
    uint32_t node = GLTF_NONE, m = 0;
    for (uint32_t k = 0; to != NULL && k < motion->node_count; k++) {
        node = motion->nodes[motion->order[k]].drawn == place->node ? motion->order[k] : node;
    }
    if (node == GLTF_NONE) {
        return true;
    }
    while (motion->scene->mMeshes[m] != place->mesh) {
        m++;
    }
    const struct model_gltf_moved *moved = &motion->moved[m];
    if (moved->target_count != motion->nodes[node].weight_count) {
        return model_shared_failed(shared, "is broken: parts of a mesh have different numbers of morph targets");
    }
    struct animation_mesh *moving = &motion->moving[to->animation.mesh_count];
    matrix to_model, back;
    for (int i = 0; i < 12; i++) {
        const double centre = i % 4 == 3 ? fit->centre[i / 4] : 0;
        to_model[i / 4][i % 4] = (place->m[i / 4][i % 4] - centre) * fit->scale;
    }
    if (!invert(back, (const double(*)[4])to_model)) {
        model_shared_note(shared, "what a node flattens does not move");
        return true;
    }
    *moving = (struct animation_mesh){.mesh = mesh, .first_weight = motion->nodes[node].first_weight};
    to->animation.mesh_count++;
    const bool is_skinned = skin_of(motion, node) != NULL;
    if (is_skinned && (moved->joints == NULL || moved->weights == NULL)) {
        return model_shared_failed(shared, "is broken: a mesh with a skin names no joints");
    }
    return copy_bind_pose(shared, &shared->model.meshes[mesh], moving) &&
           (set_skin(shared, node, (const double(*)[4])back, &moving->skin) ||
            model_shared_failed(shared, "is broken: %s", motion->file->error)) &&
           (!is_skinned || set_influences(shared, moved, vertices, moving)) &&
           (moved->target_count == 0 || set_targets(shared, moved, vertices, (const double(*)[4])to_model, moving)) &&
           (!moved->has_normals || place->mesh->mNormals == NULL ||
            set_target_normals(shared, moved, vertices, place, moving));
}
