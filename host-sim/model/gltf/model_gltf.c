/* See model_gltf.h. Converts meshes, nodes, skins, cameras and animations of a glTF file to our scene. */
#include "model_gltf.h"

#include "model_gltf_motion.h"
#include "model_weld.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEPTH_MAX   500 /* of nodes */
#define TARGETS_MAX 200 /* of a mesh */

/* A primitive as the file gives it. */
struct primitive {
    float *positions, *normals, *uvs, *colours; /* NULL: it has none */
    uint32_t *indices;                          /* three for each triangle */
    uint32_t vertex_count, triangle_count, material;
    unsigned channels; /* of a colour: 3 or 4 */
    struct model_moved moved;
};

struct reader {
    struct gltf_file *file;
    const struct model_gltf_uv *uvs;
    struct model_scene *scene;
    uint64_t triangle_count;
    uint32_t *first_mesh;     /* of each mesh of the file, and one more */
    bool has_whole_positions; /* some positions are integers */
    bool has_alphas;          /* some vertex colours are not opaque */
    bool has_more_joints;     /* some vertex follows more than four */
};

static bool read_attribute(struct gltf_file *file, const struct gltf_json *attributes, const char *name,
                           unsigned components, uint32_t *vertex_count, float **to)
{
    const struct gltf_json *item = gltf_json_get(attributes, name);
    uint32_t count = 0;
    if (item == NULL) {
        return true;
    }
    *to = gltf_file_numbers(file, gltf_file_whole(attributes, name, GLTF_NONE), components, &count);
    if (*to != NULL && *vertex_count != 0 && count != *vertex_count) {
        return gltf_file_failed(file, "a primitive has %u positions and %u values of %s", *vertex_count, count, name);
    }
    *vertex_count = count;
    return *to != NULL;
}

#define TYPE_FLOAT 5126

static bool has_integers(const struct gltf_file *file, const struct gltf_json *attributes, const char *name)
{
    const struct gltf_json *from = gltf_file_item(file, GLTF_ACCESSORS, gltf_file_whole(attributes, name, GLTF_NONE));
    return gltf_file_whole(from, "componentType", TYPE_FLOAT) != TYPE_FLOAT;
}

static bool read_colours(struct gltf_file *file, const struct gltf_json *attributes, struct primitive *p)
{
    static const char name[] = "COLOR_0";
    const struct gltf_json *from = gltf_file_item(file, GLTF_ACCESSORS, gltf_file_whole(attributes, name, GLTF_NONE));
    const char *type = gltf_json_text(gltf_json_get(from, "type"));
    p->channels = type != NULL && strcmp(type, "VEC4") == 0 ? 4 : 3;
    return read_attribute(file, attributes, name, p->channels, &p->vertex_count, &p->colours);
}

/* Offers a joint to a vertex, which keeps four: those with the largest weights. Returns whether one is lost. */
static bool offer_joint(float joints[4], float weights[4], float joint, float weight)
{
    int least = 0;
    for (int k = 1; k < 4; k++) {
        const bool is_less = weights[least] > 0 && weights[k] < weights[least];
        least = is_less || !(weights[k] > 0) ? k : least;
    }
    const bool has_room = !(weights[least] > 0);
    if (weight > 0 && (has_room || weight > weights[least])) {
        joints[least] = joint;
        weights[least] = weight;
    }
    return weight > 0 && !has_room;
}

/* Reads the joints of each vertex and their weights: four in each set, of which a file may have any number. */
static bool read_joints(struct reader *reader, const struct gltf_json *attributes, struct primitive *p)
{
    struct model_moved *m = &p->moved;
    for (unsigned set = 0;; set++) {
        char names[2][32];
        float *joints = NULL, *weights = NULL;
        snprintf(names[0], sizeof names[0], "JOINTS_%u", set);
        snprintf(names[1], sizeof names[1], "WEIGHTS_%u", set);
        if (!read_attribute(reader->file, attributes, names[0], 4, &p->vertex_count, &joints) ||
            !read_attribute(reader->file, attributes, names[1], 4, &p->vertex_count, &weights)) {
            return false;
        }
        if (set == 0) {
            m->joints = joints;
            m->weights = weights;
        }
        if (joints == NULL || weights == NULL) {
            return set == 0 || joints == weights ||
                   gltf_file_failed(reader->file, "a primitive has only one of %s and %s", names[0], names[1]);
        }
        if (set == 0) {
            continue;
        }
        for (size_t i = 0; i < 4 * (size_t)p->vertex_count; i++) {
            const size_t vertex = i & ~(size_t)3;
            reader->has_more_joints =
                offer_joint(m->joints + vertex, m->weights + vertex, joints[i], weights[i]) || reader->has_more_joints;
        }
        free(joints);
        free(weights);
    }
}

static bool read_targets(struct gltf_file *file, const struct gltf_json *from, struct primitive *p)
{
    const struct gltf_json *item, *targets = gltf_json_get(from, "targets");
    struct model_moved *m = &p->moved;
    const uint32_t count = gltf_json_is(targets, GLTF_JSON_ARRAY) ? targets->count : 0;
    m->targets = calloc((size_t)count + 1, sizeof *m->targets);
    m->target_normals = calloc((size_t)count + 1, sizeof *m->target_normals);
    if (m->targets == NULL || m->target_normals == NULL || count > TARGETS_MAX) {
        return gltf_file_failed(file, "a mesh has more than %d morph targets", TARGETS_MAX);
    }
    GLTF_JSON_EACH(item, targets)
    {
        if (!read_attribute(file, item, "POSITION", 3, &p->vertex_count, &m->targets[m->target_count]) ||
            !read_attribute(file, item, "NORMAL", 3, &p->vertex_count, &m->target_normals[m->target_count])) {
            return false;
        }
        m->has_normals = m->has_normals || m->target_normals[m->target_count] != NULL;
        m->target_count++;
    }
    return true;
}

/* Whether a vertex colour is not opaque. */
static bool has_alphas(const struct primitive *p)
{
    for (size_t i = 0; p->colours != NULL && p->channels == 4 && i < p->vertex_count; i++) {
        if (p->colours[4 * i + 3] < 1) {
            return true;
        }
    }
    return false;
}

/* Makes triangles of strips and fans; every index is checked. */
static bool make_triangles(struct gltf_file *file, struct primitive *p, const uint32_t *from, uint32_t n, uint32_t mode)
{
    const uint32_t count = mode == 4 ? n / 3 : n < 3 ? 0 : n - 2;
    p->indices = calloc((size_t)count * 3 + 1, sizeof *p->indices);
    if (p->indices == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    for (uint32_t i = 0; i < n; i++) {
        if (from != NULL && from[i] >= p->vertex_count) {
            return gltf_file_failed(file, "a primitive has index %u of %u vertices", from[i], p->vertex_count);
        }
    }
    for (uint32_t t = 0; t < count; t++) {
        const uint32_t odd = mode == 5 ? t & 1 : 0;
        const uint32_t corners[3] = {mode == 4   ? 3 * t
                                     : mode == 6 ? 0
                                                 : t,
                                     mode == 4 ? 3 * t + 1 : t + 1 + odd, mode == 4 ? 3 * t + 2 : t + 2 - odd};
        for (int i = 0; i < 3; i++) {
            p->indices[3 * t + i] = from != NULL ? from[corners[i]] : corners[i];
        }
    }
    p->triangle_count = count;
    return true;
}

static bool read_primitive(struct reader *reader, const struct gltf_json *from, struct primitive *p)
{
    struct gltf_file *file = reader->file;
    const struct gltf_json *attributes = gltf_json_get(from, "attributes");
    const uint32_t mode = gltf_file_whole(from, "mode", 4), indices = gltf_file_whole(from, "indices", GLTF_NONE);
    const uint32_t materials = file->lists[GLTF_MATERIALS].count;
    *p = (struct primitive){.material = gltf_file_whole(from, "material", materials)};
    if (mode < 4) {
        return true; /* points and lines */
    }
    if (mode > 6 || (p->material >= materials && gltf_json_get(from, "material") != NULL)) {
        return gltf_file_failed(file, "a primitive has a mode or a material that is not there");
    }
    char name[24];
    snprintf(name, sizeof name, "TEXCOORD_%u", reader->uvs[p->material].set);
    if (!read_attribute(file, attributes, "POSITION", 3, &p->vertex_count, &p->positions) || p->vertex_count == 0) {
        return p->vertex_count == 0 && file->error[0] == '\0';
    }
    if (!read_attribute(file, attributes, "NORMAL", 3, &p->vertex_count, &p->normals) ||
        !read_attribute(file, attributes, name, 2, &p->vertex_count, &p->uvs) || !read_colours(file, attributes, p) ||
        !read_joints(reader, attributes, p) || !read_targets(file, from, p)) {
        return false;
    }
    reader->has_whole_positions = reader->has_whole_positions || has_integers(file, attributes, "POSITION");
    reader->has_alphas = reader->has_alphas || has_alphas(p);
    uint32_t n = p->vertex_count, *list = NULL;
    if (gltf_json_get(from, "indices") != NULL) {
        list = gltf_file_indices(file, indices, &n);
        if (list == NULL) {
            return false;
        }
    }
    const bool done = make_triangles(file, p, list, n, mode);
    free(list);
    return done;
}

/* What model_weld() reads of a primitive. */
struct corners {
    const struct primitive *p;
    const struct model_gltf_uv *uv;
};

static void set_corner(const void *context, size_t corner, struct model_vertex *to)
{
    const struct corners *from = context;
    const struct primitive *p = from->p;
    const uint32_t i = p->indices[corner];
    to->source = p->moved.joints != NULL || p->moved.target_count > 0 ? i : 0;
    memcpy(to->position, p->positions + 3 * (size_t)i, sizeof to->position);
    if (p->normals != NULL) {
        memcpy(to->normal, p->normals + 3 * (size_t)i, sizeof to->normal);
    }
    for (int k = 0; k < 2 && p->uvs != NULL; k++) {
        const double *m = from->uv->m[k], u = (double)p->uvs[2 * (size_t)i], v = (double)p->uvs[2 * (size_t)i + 1];
        to->uv[k] = (float)(m[0] * u + m[1] * v + m[2]);
    }
    for (int c = 0; c < 3 && p->colours != NULL; c++) {
        const double linear = (double)p->colours[p->channels * (size_t)i + (size_t)c];
        to->colour[c] = (float)model_gltf_channel(from->uv->factor[c] * linear) / 255;
    }
}

static bool make_meshes(struct reader *reader, const struct primitive *p)
{
    const struct corners corners = {p, &reader->uvs[p->material]};
    return model_weld(reader->scene, &(struct model_triangles){.count = p->triangle_count,
                                                               .material = p->material,
                                                               .has_normals = p->normals != NULL,
                                                               .has_uvs = p->uvs != NULL,
                                                               .has_colours = p->colours != NULL,
                                                               .moved = p->moved,
                                                               .corner = set_corner,
                                                               .context = &corners}) ||
           gltf_file_failed(reader->file, "it needs too much memory");
}

static bool read_meshes(struct reader *reader)
{
    const uint32_t count = reader->file->lists[GLTF_MESHES].count;
    for (uint32_t m = 0; m < count; m++) {
        const struct gltf_json *item, *list = gltf_json_get(gltf_file_item(reader->file, GLTF_MESHES, m), "primitives");
        reader->first_mesh[m] = reader->scene->mesh_count;
        GLTF_JSON_EACH(item, list)
        {
            struct primitive p;
            if (!read_primitive(reader, item, &p)) {
                return false;
            }
            reader->triangle_count += p.triangle_count;
            if (reader->triangle_count > MODEL_TRIANGLES_MAX) {
                return gltf_file_failed(reader->file, "it has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
            }
            if (p.triangle_count > 0 && !make_meshes(reader, &p)) {
                return false;
            }
            free(p.positions);
            free(p.normals);
            free(p.uvs);
            free(p.colours);
            free(p.indices);
        }
    }
    reader->first_mesh[count] = reader->scene->mesh_count;
    return true;
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

/* Takes a matrix apart into translation, rotation and scale; what it shears is lost. */
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

/* Reads the matrix of a node, or makes it of translation, rotation and scale. */
static void read_matrix(const struct gltf_json *from, struct model_node *to)
{
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double *const q = to->q;
    to->q[3] = to->s[0] = to->s[1] = to->s[2] = 1;
    if (gltf_file_vector(from, "matrix", 16, m)) {
        take_apart(m, to->t, to->q, to->s);
    } else {
        gltf_file_vector(from, "translation", 3, to->t);
        gltf_file_vector(from, "rotation", 4, to->q);
        gltf_file_vector(from, "scale", 3, to->s);
        memcpy(m + 12, to->t, sizeof to->t);
        for (int column = 0; column < 3; column++) {
            const int j = (column + 1) % 3, k = (column + 2) % 3;
            m[4 * column + column] = to->s[column] * (1 - 2 * (q[j] * q[j] + q[k] * q[k]));
            m[4 * column + j] = to->s[column] * 2 * (q[column] * q[j] + q[3] * q[k]);
            m[4 * column + k] = to->s[column] * 2 * (q[column] * q[k] - q[3] * q[j]);
        }
    }
    for (int i = 0; i < 12; i++) {
        to->m[i / 4][i % 4] = (float)m[i / 4 + 4 * (i % 4)];
    }
}

/* Reads a node that the tree has reached, without what is below it. */
static bool read_node(struct reader *reader, uint32_t i, uint32_t parent, unsigned depth)
{
    struct gltf_file *file = reader->file;
    const struct gltf_json *from = gltf_file_item(file, GLTF_NODES, i);
    const uint32_t mesh = gltf_file_whole(from, "mesh", GLTF_NONE), meshes = file->lists[GLTF_MESHES].count;
    struct model_node *to = from != NULL ? &reader->scene->nodes[i] : NULL;
    if (from == NULL || depth > DEPTH_MAX || to->is_shown) {
        return gltf_file_failed(file, "node %u is missing, has two parents or lies too deep", i);
    }
    to->is_shown = true;
    to->parent = parent;
    to->child = to->next = to->skin = MODEL_NONE;
    read_matrix(from, to);
    if (gltf_json_get(from, "mesh") != NULL) {
        if (mesh >= meshes) {
            return gltf_file_failed(file, "node %u has a mesh that is not there", i);
        }
        to->first_mesh = reader->first_mesh[mesh];
        to->mesh_count = reader->first_mesh[mesh + 1] - reader->first_mesh[mesh];
    }
    return true;
}

static bool read_children(struct reader *reader, const struct gltf_json *list, uint32_t parent, uint32_t *first,
                          unsigned depth);

/* Reads a node and what is below it; *link takes its number, and then is where its next brother's goes. */
static bool read_tree(struct reader *reader, uint32_t i, uint32_t parent, uint32_t **link, unsigned depth)
{
    if (!read_node(reader, i, parent, depth)) {
        return false;
    }
    **link = i;
    *link = &reader->scene->nodes[i].next;
    const struct gltf_json *below = gltf_json_get(gltf_file_item(reader->file, GLTF_NODES, i), "children");
    return read_children(reader, below, i, &reader->scene->nodes[i].child, depth + 1);
}

/* The number of the node that an item of a list names; GLTF_NONE: none. */
static uint32_t node_number(const struct gltf_json *item)
{
    const double number = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : -1;
    return number >= 0 && number < GLTF_NONE ? (uint32_t)number : GLTF_NONE;
}

/* Reads the children of a node: recursive, at most DEPTH_MAX deep. *first is the first node of the list, behind which
 * its brothers hang. */
static bool read_children(struct reader *reader, const struct gltf_json *list, uint32_t parent, uint32_t *first,
                          unsigned depth)
{
    const struct gltf_json *item = gltf_json_is(list, GLTF_JSON_ARRAY) ? list->child : NULL;
    *first = MODEL_NONE;
    for (; item != NULL; item = item->next) {
        if (!read_tree(reader, node_number(item), parent, &first, depth)) {
            return false;
        }
    }
    return true;
}

/* Reads all nodes that are nobody's child: what a file without scenes shows. */
static bool read_roots(struct reader *reader)
{
    struct gltf_file *file = reader->file;
    const uint32_t count = file->lists[GLTF_NODES].count;
    uint32_t *link = &reader->scene->first_node;
    bool *const is_child = calloc(count + (size_t)1, sizeof *is_child);
    if (is_child == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct gltf_json *below = gltf_json_get(gltf_file_item(file, GLTF_NODES, i), "children");
        const struct gltf_json *item = gltf_json_is(below, GLTF_JSON_ARRAY) ? below->child : NULL;
        for (; item != NULL; item = item->next) {
            const uint32_t child = node_number(item);
            is_child[child < count ? child : count] = true;
        }
    }
    bool is_read = true;
    *link = MODEL_NONE;
    for (uint32_t i = 0; is_read && i < count; i++) {
        is_read = is_child[i] || read_tree(reader, i, MODEL_NONE, &link, 0);
    }
    free(is_child);
    return is_read;
}

/* ---- the scene --------------------------------------------------------------------------------------------------- */

static const char *name_of(const struct gltf_file *file, uint32_t node)
{
    const char *name = gltf_json_text(gltf_json_get(gltf_file_item(file, GLTF_NODES, node), "name"));
    return name != NULL && *name != '\0' ? name : "0";
}

/* Reads the first camera, where the first node that has it stands. */
static void read_camera(const struct gltf_file *file, struct model_scene *scene)
{
    const struct gltf_json *from = gltf_file_item(file, GLTF_CAMERAS, 0);
    const struct gltf_json *lens = gltf_json_get(from, "perspective");
    const struct gltf_json *box = gltf_json_get(from, "orthographic");
    uint32_t node = scene->first_node;
    while (node != MODEL_NONE && gltf_file_whole(gltf_file_item(file, GLTF_NODES, node), "camera", GLTF_NONE) != 0) {
        node = model_scene_next(scene, node);
    }
    const double aspect = gltf_file_number(lens, "aspectRatio", 0);
    const double half = tan(gltf_file_number(lens, "yfov", 0) / 2), x = gltf_file_number(box, "xmag", 0);
    scene->camera_count = file->lists[GLTF_CAMERAS].count;
    scene->camera =
        (struct model_camera){.name = name_of(file, node),
                              .node = node,
                              .forward = {0, 0, -1},
                              .up = {0, 1, 0},
                              .fov_x = (float)(2 * atan(half * (aspect > 0 ? aspect : 1))),
                              .half_width = (float)x,
                              .aspect = (float)(box != NULL ? x / gltf_file_number(box, "ymag", x) : aspect),
                              .near_z = (float)gltf_file_number(box != NULL ? box : lens, "znear", 0),
                              .far_z = (float)gltf_file_number(box != NULL ? box : lens, "zfar", 0)};
}

static bool read_scene(struct reader *reader)
{
    struct gltf_file *file = reader->file;
    struct model_scene *scene = reader->scene;
    const struct gltf_json *from = gltf_file_item(file, GLTF_SCENES, gltf_file_whole(file->json, "scene", 0));
    const bool names_none = gltf_json_get(file->json, "scene") == NULL && file->lists[GLTF_SCENES].count == 0;
    if (from == NULL && !names_none) {
        return gltf_file_failed(file, "its scene is not there");
    }
    if (!(names_none ? read_roots(reader)
                     : read_children(reader, gltf_json_get(from, "nodes"), MODEL_NONE, &scene->first_node, 0))) {
        return false;
    }
    if (file->lists[GLTF_CAMERAS].count > 0) {
        read_camera(file, scene);
    }
    return model_gltf_skins_read(file, scene);
}

/* Says what the file has and the model does not get. */
static void note_ignored(struct model_shared *shared, const struct reader *reader)
{
    const struct gltf_file *file = reader->file;
    if (reader->has_alphas) {
        model_shared_note(shared, "alphas of vertex colours are ignored");
    }
    if (reader->has_more_joints) {
        model_shared_note(shared, "of more than four joints of a vertex the four with the largest weights count");
    }
    if (reader->has_whole_positions && !gltf_file_uses(file, "KHR_mesh_quantization")) {
        model_shared_note(shared, "its positions are integers, which takes the extension KHR_mesh_quantization, and it "
                                  "does not name that");
    }
    if (gltf_json_get(gltf_json_get(file->json, "extensions"), "KHR_lights_punctual") != NULL) {
        model_shared_note(shared, "lights are ignored");
    }
}

bool model_gltf_read(struct model_shared *shared, struct model_scene *scene)
{
    struct gltf_file file;
    if (!gltf_file_open(&file, &shared->folder)) {
        return model_shared_failed(shared, "is no model that can be read: %s", file.error);
    }
    const uint32_t materials = file.lists[GLTF_MATERIALS].count, nodes = file.lists[GLTF_NODES].count;
    struct model_gltf_uv *uvs = calloc((size_t)materials + 1, sizeof *uvs);
    struct reader reader = {.file = &file,
                            .uvs = uvs,
                            .scene = scene,
                            .first_mesh = calloc((size_t)file.lists[GLTF_MESHES].count + 1, sizeof(uint32_t))};
    scene->nodes = calloc((size_t)nodes + 1, sizeof *scene->nodes);
    scene->node_count = nodes;
    scene->materials = uvs != NULL ? model_gltf_materials(shared, &file, uvs) : NULL;
    scene->material_count = materials + 1;
    if (scene->materials == NULL || scene->nodes == NULL || reader.first_mesh == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    if (!read_meshes(&reader) || !read_scene(&reader)) {
        return model_shared_failed(shared, "is no model that can be read: %s", file.error);
    }
    note_ignored(shared, &reader);
    return model_gltf_clips_read(&file, scene) ||
           model_shared_failed(shared, "has an animation that cannot be read: %s", file.error);
}
