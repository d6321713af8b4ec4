#include "model_gltf.h"

#include "model_gltf_motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEPTH_MAX 500 /* of nodes */

/* A vertex as it is compared with others. */
struct vertex {
    float position[3], normal[3], uv[2], colour[3];
    uint32_t source; /* of what moves: the primitive's vertex */
};

/* A primitive as the file gives it. */
struct primitive {
    float *positions, *normals, *uvs, *colours; /* NULL: it has none */
    uint32_t *indices;                          /* three for each triangle */
    uint32_t vertex_count, triangle_count, material;
    unsigned channels; /* of a colour: 3 or 4 */
    struct model_gltf_moved moved;
};

struct reader {
    struct gltf_file *file;
    const struct model_gltf_uv *uvs;
    struct aiMesh **meshes;
    struct model_gltf_moved *moved; /* of each */
    struct model_gltf_node *nodes;
    uint32_t mesh_count, mesh_room;
    uint64_t triangle_count;
    uint32_t *first_mesh;     /* of each mesh of the file, and one more */
    uint8_t *is_child;        /* of each node: it has a parent already */
    bool has_whole_positions; /* some positions are integers */
    bool has_alphas;          /* some vertex colours are not opaque */
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

static bool read_moved(struct gltf_file *file, const struct gltf_json *from, const struct gltf_json *attributes,
                       struct primitive *p)
{
    const struct gltf_json *item, *targets = gltf_json_get(from, "targets");
    struct model_gltf_moved *m = &p->moved;
    if (!read_attribute(file, attributes, "JOINTS_0", 4, &p->vertex_count, &m->joints) ||
        !read_attribute(file, attributes, "WEIGHTS_0", 4, &p->vertex_count, &m->weights)) {
        return false;
    }
    const uint32_t count = gltf_json_is(targets, GLTF_JSON_ARRAY) ? targets->count : 0;
    m->targets = calloc((size_t)count + 1, sizeof *m->targets);
    m->target_normals = calloc((size_t)count + 1, sizeof *m->target_normals);
    if (m->targets == NULL || m->target_normals == NULL || count > MODEL_GLTF_TARGETS_MAX) {
        return gltf_file_failed(file, "a mesh has more than %d morph targets", MODEL_GLTF_TARGETS_MAX);
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
        !read_moved(file, from, attributes, p)) {
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

static struct vertex vertex_at(const struct primitive *p, uint32_t i, const struct model_gltf_uv *uv)
{
    struct vertex v = {.source = p->moved.joints != NULL || p->moved.target_count > 0 ? i : 0};
    memcpy(v.position, p->positions + 3 * (size_t)i, sizeof v.position);
    if (p->normals != NULL) {
        memcpy(v.normal, p->normals + 3 * (size_t)i, sizeof v.normal);
    }
    for (int k = 0; k < 2 && p->uvs != NULL; k++) {
        const float *from = p->uvs + 2 * (size_t)i;
        v.uv[k] = (float)(uv->m[k][0] * (double)from[0] + uv->m[k][1] * (double)from[1] + uv->m[k][2]);
    }
    for (int c = 0; c < 3 && p->colours != NULL; c++) {
        v.colour[c] = (float)model_gltf_channel(uv->factor[c] * (double)p->colours[p->channels * (size_t)i + c]) / 255;
    }
    return v;
}

/* A mesh that grows vertex by vertex; equal vertices are found by a hash table. */
struct welder {
    struct vertex *vertices;
    uint32_t *table, mask, count; /* the table holds index + 1, or 0 */
};

static uint32_t weld(struct welder *w, const struct vertex *v)
{
    uint32_t words[sizeof *v / 4], hash = 2166136261u;
    memcpy(words, v, sizeof words);
    for (size_t i = 0; i < sizeof words / 4; i++) {
        hash = (hash ^ words[i]) * 16777619u;
        hash ^= hash >> 15;
    }
    for (;; hash++) {
        uint32_t *slot = &w->table[hash & w->mask];
        if (*slot == 0) {
            w->vertices[w->count] = *v;
            *slot = ++w->count;
        }
        /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c): the same bits are meant */
        if (memcmp(&w->vertices[*slot - 1], v, sizeof *v) == 0) {
            return *slot - 1;
        }
    }
}

static struct aiVector3D vector_of(const float *p)
{
    return (struct aiVector3D){p[0], p[1], p[2]};
}

/* The vertices of the welder as arrays of a mesh. */
static bool fill_mesh(struct aiMesh *mesh, const struct welder *w, const struct primitive *p)
{
    mesh->mVertices = calloc(w->count, sizeof *mesh->mVertices);
    mesh->mNormals = p->normals != NULL ? calloc(w->count, sizeof *mesh->mNormals) : NULL;
    mesh->mTextureCoords[0] = p->uvs != NULL ? calloc(w->count, sizeof *mesh->mTextureCoords[0]) : NULL;
    mesh->mColors[0] = p->colours != NULL ? calloc(w->count, sizeof *mesh->mColors[0]) : NULL;
    if (mesh->mVertices == NULL || (p->normals != NULL && mesh->mNormals == NULL) ||
        (p->uvs != NULL && mesh->mTextureCoords[0] == NULL) || (p->colours != NULL && mesh->mColors[0] == NULL)) {
        return false;
    }
    for (uint32_t i = 0; i < w->count; i++) {
        const struct vertex *v = &w->vertices[i];
        mesh->mVertices[i] = vector_of(v->position);
        if (mesh->mNormals != NULL) {
            mesh->mNormals[i] = vector_of(v->normal);
        }
        if (mesh->mTextureCoords[0] != NULL) {
            mesh->mTextureCoords[0][i] = (struct aiVector3D){v->uv[0], v->uv[1], 0};
        }
        if (mesh->mColors[0] != NULL) {
            mesh->mColors[0][i] = (struct aiColor4D){v->colour[0], v->colour[1], v->colour[2], 1};
        }
    }
    mesh->mNumVertices = w->count;
    mesh->mMaterialIndex = p->material;
    return true;
}

static bool add_mesh(struct reader *reader, struct aiMesh *mesh, const struct model_gltf_moved *moved)
{
    if (reader->mesh_count == reader->mesh_room) {
        reader->mesh_room = reader->mesh_room * 2 + 16;
        struct aiMesh **more = realloc(reader->meshes, sizeof *more * reader->mesh_room);
        struct model_gltf_moved *more_moved = realloc(reader->moved, sizeof *more_moved * reader->mesh_room);
        reader->meshes = more != NULL ? more : reader->meshes;
        reader->moved = more_moved != NULL ? more_moved : reader->moved;
        if (more == NULL || more_moved == NULL) {
            return false;
        }
    }
    reader->moved[reader->mesh_count] = *moved;
    reader->meshes[reader->mesh_count++] = mesh;
    return true;
}

/* Makes a mesh of triangles from *next on, as many as there are or as its vertices allow. */
static bool make_mesh(struct reader *reader, const struct primitive *p, struct welder *w, uint32_t *next)
{
    struct aiMesh *mesh = calloc(1, sizeof *mesh);
    const uint32_t rest = p->triangle_count - *next;
    struct aiFace *faces = calloc(rest, sizeof *faces);
    unsigned *indices = calloc((size_t)rest * 3, sizeof *indices);
    if (mesh == NULL || faces == NULL || indices == NULL) {
        return false;
    }
    memset(w->table, 0, sizeof *w->table * (w->mask + 1));
    w->count = 0;
    mesh->mFaces = faces;
    for (; *next < p->triangle_count && w->count + 3 <= MODEL_VERTICES_MAX; ++*next) {
        struct aiFace *face = &faces[mesh->mNumFaces];
        *face = (struct aiFace){3, indices + 3 * (size_t)mesh->mNumFaces};
        for (int i = 0; i < 3; i++) {
            const struct vertex v = vertex_at(p, p->indices[3 * (size_t)*next + i], &reader->uvs[p->material]);
            face->mIndices[i] = weld(w, &v);
        }
        mesh->mNumFaces++;
    }
    struct model_gltf_moved moved = p->moved;
    moved.sources = calloc(w->count + 1, sizeof *moved.sources);
    for (uint32_t i = 0; moved.sources != NULL && i < w->count; i++) {
        moved.sources[i] = w->vertices[i].source;
    }
    return moved.sources != NULL && fill_mesh(mesh, w, p) && add_mesh(reader, mesh, &moved);
}

static bool make_meshes(struct reader *reader, const struct primitive *p)
{
    struct welder w = {.mask = 15};
    const uint64_t corners = (uint64_t)p->triangle_count * 3;
    while (w.mask < 2 * MODEL_VERTICES_MAX && w.mask < 2 * corners) {
        w.mask = w.mask * 2 + 1;
    }
    w.table = calloc(w.mask + 1, sizeof *w.table);
    w.vertices = calloc(w.mask + 1, sizeof *w.vertices);
    bool done = w.table != NULL && w.vertices != NULL;
    for (uint32_t next = 0; done && next < p->triangle_count;) {
        done = make_mesh(reader, p, &w, &next);
    }
    free(w.table);
    free(w.vertices);
    return done || gltf_file_failed(reader->file, "it needs too much memory");
}

static bool read_meshes(struct reader *reader)
{
    const uint32_t count = reader->file->lists[GLTF_MESHES].count;
    for (uint32_t m = 0; m < count; m++) {
        const struct gltf_json *item, *list = gltf_json_get(gltf_file_item(reader->file, GLTF_MESHES, m), "primitives");
        reader->first_mesh[m] = reader->mesh_count;
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
    reader->first_mesh[count] = reader->mesh_count;
    return true;
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

static void set_matrix(struct aiMatrix4x4 *to, const double m[16])
{
    *to = (struct aiMatrix4x4){
        (float)m[0], (float)m[4], (float)m[8],  (float)m[12], (float)m[1], (float)m[5], (float)m[9], (float)m[13],
        (float)m[2], (float)m[6], (float)m[10], (float)m[14], 0,           0,           0,           1};
}

/* Reads the matrix of a node, or makes it of translation, rotation and scale. */
static void read_matrix(const struct gltf_json *node, struct aiMatrix4x4 *to)
{
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    double q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (!gltf_file_vector(node, "matrix", 16, m)) {
        gltf_file_vector(node, "translation", 3, m + 12);
        gltf_file_vector(node, "rotation", 4, q);
        gltf_file_vector(node, "scale", 3, s);
        for (int column = 0; column < 3; column++) {
            const int j = (column + 1) % 3, k = (column + 2) % 3;
            m[4 * column + column] = s[column] * (1 - 2 * (q[j] * q[j] + q[k] * q[k]));
            m[4 * column + j] = s[column] * 2 * (q[column] * q[j] + q[3] * q[k]);
            m[4 * column + k] = s[column] * 2 * (q[column] * q[k] - q[3] * q[j]);
        }
    }
    set_matrix(to, m);
}

static bool read_children(struct reader *reader, const struct gltf_json *list, struct aiNode *to, unsigned depth);

static bool read_node(struct reader *reader, uint32_t i, struct aiNode *to, unsigned depth)
{
    struct gltf_file *file = reader->file;
    const struct gltf_json *node = gltf_file_item(file, GLTF_NODES, i);
    const uint32_t mesh = gltf_file_whole(node, "mesh", GLTF_NONE), meshes = file->lists[GLTF_MESHES].count;
    if (node == NULL || depth > DEPTH_MAX || reader->is_child[i]++) {
        return gltf_file_failed(file, "node %u is missing, has two parents or lies too deep", i);
    }
    reader->nodes[i].drawn = to;
    read_matrix(node, &to->mTransformation);
    if (gltf_file_whole(node, "camera", GLTF_NONE) == 0) {
        const char *name = gltf_json_text(gltf_json_get(node, "name"));
        snprintf(to->mName.data, sizeof to->mName.data, "%.100s", name != NULL && *name != '\0' ? name : "0");
    }
    if (gltf_json_get(node, "mesh") != NULL) {
        if (mesh >= meshes) {
            return gltf_file_failed(file, "node %u has a mesh that is not there", i);
        }
        to->mNumMeshes = reader->first_mesh[mesh + 1] - reader->first_mesh[mesh];
        to->mMeshes = calloc(to->mNumMeshes + 1, sizeof *to->mMeshes);
        for (uint32_t k = 0; to->mMeshes != NULL && k < to->mNumMeshes; k++) {
            to->mMeshes[k] = reader->first_mesh[mesh] + k;
        }
    }
    return read_children(reader, gltf_json_get(node, "children"), to, depth + 1);
}

/* Recursive, at most DEPTH_MAX deep. */
static bool read_children(struct reader *reader, const struct gltf_json *list, struct aiNode *to, unsigned depth)
{
    const size_t n = gltf_json_is(list, GLTF_JSON_ARRAY) ? list->count : 0;
    struct aiNode *nodes = calloc(n + 1, sizeof *nodes);
    to->mChildren = calloc(n + 1, sizeof *to->mChildren);
    if (nodes == NULL || to->mChildren == NULL) {
        return gltf_file_failed(reader->file, "it needs too much memory");
    }
    const struct gltf_json *item = n > 0 ? list->child : NULL;
    for (; item != NULL; item = item->next) {
        struct aiNode *child = &nodes[to->mNumChildren];
        const double i = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : -1;
        if (!read_node(reader, i >= 0 && i < GLTF_NONE ? (uint32_t)i : GLTF_NONE, child, depth)) {
            return false;
        }
        to->mChildren[to->mNumChildren++] = child;
    }
    return true;
}

static const char *find_camera_node(const struct aiNode *node)
{
    const char *name = node->mName.data[0] != '\0' ? node->mName.data : NULL;
    for (unsigned i = 0; i < node->mNumChildren && name == NULL; i++) {
        name = find_camera_node(node->mChildren[i]);
    }
    return name;
}

static bool read_camera(struct gltf_file *file, struct aiScene *scene)
{
    const struct gltf_json *from = gltf_file_item(file, GLTF_CAMERAS, 0);
    const struct gltf_json *lens = gltf_json_get(from, "perspective");
    const struct gltf_json *box = gltf_json_get(from, "orthographic");
    struct aiCamera *camera = calloc(1, sizeof *camera);
    scene->mCameras = calloc(1, sizeof *scene->mCameras);
    if (camera == NULL || scene->mCameras == NULL) {
        return gltf_file_failed(file, "it needs too much memory");
    }
    const char *name = find_camera_node(scene->mRootNode);
    snprintf(camera->mName.data, sizeof camera->mName.data, "%s", name != NULL ? name : "0");
    const double aspect = gltf_file_number(lens, "aspectRatio", 0);
    const double half = tan(gltf_file_number(lens, "yfov", 0) / 2), x = gltf_file_number(box, "xmag", 0);
    camera->mLookAt.z = -1;
    camera->mUp.y = 1;
    camera->mHorizontalFOV = (float)(2 * atan(half * (aspect > 0 ? aspect : 1)));
    camera->mOrthographicWidth = (float)x;
    camera->mAspect = (float)(box != NULL ? x / gltf_file_number(box, "ymag", x) : aspect);
    camera->mClipPlaneNear = (float)gltf_file_number(box != NULL ? box : lens, "znear", 0);
    camera->mClipPlaneFar = (float)gltf_file_number(box != NULL ? box : lens, "zfar", 0);
    scene->mCameras[0] = camera;
    scene->mNumCameras = file->lists[GLTF_CAMERAS].count;
    return true;
}

static bool read_scene(struct reader *reader, struct aiScene *scene)
{
    struct gltf_file *file = reader->file;
    const uint32_t first = gltf_file_whole(file->json, "scene", 0);
    const struct gltf_json *from = gltf_file_item(file, GLTF_SCENES, first);
    struct aiNode *root = calloc(1, sizeof *root);
    const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (from == NULL || root == NULL) {
        return gltf_file_failed(file, "it has no scene to show");
    }
    set_matrix(&root->mTransformation, identity);
    const struct gltf_json *extensions = gltf_json_get(file->json, "extensions");
    const struct gltf_json *lights = gltf_json_get(extensions, "KHR_lights_punctual");
    scene->mRootNode = root;
    scene->mMeshes = reader->meshes;
    scene->mNumMeshes = reader->mesh_count;
    scene->mNumMaterials = file->lists[GLTF_MATERIALS].count + 1;
    scene->mNumLights = lights != NULL;
    return read_children(reader, gltf_json_get(from, "nodes"), root, 0) &&
           (file->lists[GLTF_CAMERAS].count == 0 || read_camera(file, scene));
}

const struct aiScene *model_gltf_read(struct model_shared *shared, struct gltf_file *file,
                                      const struct model_gltf_uv *uvs)
{
    struct reader reader = {.file = file,
                            .uvs = uvs,
                            .first_mesh = calloc(file->lists[GLTF_MESHES].count + 1, sizeof(uint32_t)),
                            .nodes = calloc(file->lists[GLTF_NODES].count + 1, sizeof(struct model_gltf_node)),
                            .is_child = calloc(file->lists[GLTF_NODES].count + 1, 1)};
    struct model_gltf_motion *motion = calloc(1, sizeof *motion);
    struct aiScene *scene = calloc(1, sizeof *scene);
    const bool has_memory =
        scene != NULL && reader.first_mesh != NULL && reader.is_child != NULL && reader.nodes != NULL && motion != NULL;
    if (!has_memory || !read_meshes(&reader) || !read_scene(&reader, scene)) {
        model_shared_failed(shared, "is no model that can be read: %s", has_memory ? file->error : "out of memory");
        return NULL;
    }
    if (reader.has_alphas) {
        model_shared_note(shared, "alphas of vertex colours are ignored");
    }
    if (reader.has_whole_positions && !gltf_file_uses(file, "KHR_mesh_quantization")) {
        model_shared_note(shared, "its positions are integers, which takes the extension KHR_mesh_quantization, and it "
                                  "does not name that");
    }
    *motion = (struct model_gltf_motion){.file = file, .scene = scene, .moved = reader.moved, .nodes = reader.nodes};
    if (!model_gltf_motion_find(motion, scene->mRootNode)) {
        model_shared_failed(shared, "is no model that can be read: %s", file->error);
        return NULL;
    }
    shared->motion = motion;
    return scene;
}
