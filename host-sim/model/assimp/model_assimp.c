/* See model_assimp.h. What assimp has read is checked, since its readers check little, and then copied into our
 * scene. */
#include "model_assimp.h"

#include "model_file_io.h"
#include "model_materials.h"
#include "model_normals.h"
#include "model_weld.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <stdlib.h>
#include <string.h>

/* Counts triangles after every node has its own copy of its meshes, up to the limit. */
static uint64_t count_triangles(const struct aiScene *scene, const struct aiNode *node)
{
    uint64_t count = 0;
    for (unsigned i = 0; i < node->mNumMeshes && count <= MODEL_TRIANGLES_MAX; i++) {
        const struct aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            count += mesh->mFaces[f].mNumIndices > 2 ? mesh->mFaces[f].mNumIndices - 2 : 0;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren && count <= MODEL_TRIANGLES_MAX; i++) {
        count += count_triangles(scene, node->mChildren[i]);
    }
    return count;
}

/* Some readers of assimp 5.2 look at no index before they use it. */
static bool has_stray_index(const struct aiScene *scene)
{
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            for (unsigned i = 0; i < mesh->mFaces[f].mNumIndices; i++) {
                if (mesh->mFaces[f].mIndices[i] >= mesh->mNumVertices) {
                    return true;
                }
            }
        }
    }
    return false;
}

/* assimp makes normals, with creases, where each face has vertices of its own. Where faces share vertices it would keep
 * the normal of the last face; those are made flat. */
static bool shares_vertices(const struct aiScene *scene)
{
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        uint64_t corners = 0;
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            corners += mesh->mFaces[f].mNumIndices;
        }
        if (mesh->mNormals == NULL && corners > mesh->mNumVertices) {
            return true;
        }
    }
    return false;
}

static const struct aiScene *import(const char *path, struct aiFileIO *io)
{
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyFloat(settings, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, MODEL_CREASE_DEGREES);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, io, settings);
    aiReleasePropertyStore(settings);
    return scene;
}

/* Triangles are counted before anything is made of them. */
static bool check(struct model_shared *shared, const struct aiScene *scene)
{
    const uint64_t count = scene->mRootNode != NULL ? count_triangles(scene, scene->mRootNode) : 0;
    if (count == 0) {
        return model_shared_failed(shared, "has no triangles");
    }
    if (count > MODEL_TRIANGLES_MAX) {
        return model_shared_failed(shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
    }
    if (has_stray_index(scene)) {
        return model_shared_failed(shared, "is broken: a face has a vertex that is not there");
    }
    if (scene->mNumLights > 0) {
        model_shared_note(shared, "lights are ignored");
    }
    if (scene->mNumAnimations > 0) {
        model_shared_note(shared, "animations are ignored");
    }
    return true;
}

/* ---- what it has read, as a scene ---------------------------------------------------------------------------------
 */

static void set_corner(const void *context, size_t i, struct model_vertex *to)
{
    const struct aiMesh *from = context;
    const uint32_t v = from->mFaces[i / 3].mIndices[i % 3];
    memcpy(to->position, &from->mVertices[v], sizeof to->position);
    if (from->mNormals != NULL) {
        memcpy(to->normal, &from->mNormals[v], sizeof to->normal);
    }
    if (from->mTextureCoords[0] != NULL) {
        memcpy(to->uv, &from->mTextureCoords[0][v], sizeof to->uv);
    }
    if (from->mColors[0] != NULL) {
        memcpy(to->colour, &from->mColors[0][v], sizeof to->colour);
    }
}

/* Adds a mesh to the scene, as some of at most MODEL_VERTICES_MAX vertices; one that is not of triangles is left out.
 */
static bool convert_mesh(const struct aiMesh *from, struct model_scene *to)
{
    for (unsigned f = 0; f < from->mNumFaces; f++) {
        if (from->mFaces[f].mNumIndices != 3) {
            return true;
        }
    }
    return model_weld(to, &(struct model_triangles){.count = from->mNumFaces,
                                                    .material = from->mMaterialIndex,
                                                    .has_normals = from->mNormals != NULL,
                                                    .has_uvs = from->mTextureCoords[0] != NULL,
                                                    .has_colours = from->mColors[0] != NULL,
                                                    .corner = set_corner,
                                                    .context = from});
}

static uint32_t count_nodes(const struct aiNode *node)
{
    uint32_t count = 1;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        count += count_nodes(node->mChildren[i]);
    }
    return count;
}

/* The meshes that those of assimp have become, first[m] .. first[m + 1] - 1. */
struct converted {
    const struct model_mesh *meshes;
    const uint32_t *first;
    bool is_whole; /* false: a node's meshes are missing, for want of memory */
};

/* Adds a node, copies of the meshes that it shows, and what is below it; returns its number. Recursive, as assimp is.
 */
static uint32_t convert_node(const struct aiScene *scene, const struct aiNode *from, uint32_t parent,
                             struct converted *meshes, struct model_scene *to)
{
    const struct aiMatrix4x4 *m = &from->mTransformation;
    const uint32_t number = to->node_count++;
    struct model_node *node = &to->nodes[number];
    *node = (struct model_node){
        .m = {{m->a1, m->a2, m->a3, m->a4}, {m->b1, m->b2, m->b3, m->b4}, {m->c1, m->c2, m->c3, m->c4}},
        .parent = parent,
        .child = MODEL_NONE,
        .next = MODEL_NONE,
        .skin = MODEL_NONE,
        .first_mesh = to->mesh_count,
        .is_shown = true};
    for (unsigned i = 0; i < from->mNumMeshes; i++) {
        const uint32_t of = from->mMeshes[i];
        for (uint32_t k = meshes->first[of]; k < meshes->first[of + 1]; k++) {
            struct model_mesh *more = model_shared_grow(to->meshes, to->mesh_count, sizeof *more);
            if (more == NULL) {
                meshes->is_whole = false;
                return number;
            }
            to->meshes = more;
            if (meshes->meshes[k].material < to->material_count) {
                to->meshes[to->mesh_count++] = meshes->meshes[k];
                node->mesh_count++;
            }
        }
    }
    if (scene->mNumCameras > 0 && strcmp(from->mName.data, scene->mCameras[0]->mName.data) == 0 &&
        to->camera.node == MODEL_NONE) {
        to->camera.node = number;
    }
    uint32_t *link = &node->child;
    for (unsigned i = 0; i < from->mNumChildren; i++) {
        *link = convert_node(scene, from->mChildren[i], number, meshes, to);
        link = &to->nodes[*link].next;
    }
    return number;
}

static void set_vector(float to[3], const struct aiVector3D *from)
{
    memcpy(to, from, 3 * sizeof *to);
}

static bool convert(const struct aiScene *from, struct model_scene *to)
{
    struct model_scene all = {.mesh_count = 0};
    /* NOLINTNEXTLINE(clang-analyzer-unix.Malloc): it lasts as long as the process, which reads one model */
    uint32_t *first = calloc((size_t)from->mNumMeshes + 1, sizeof *first);
    to->nodes = calloc(count_nodes(from->mRootNode), sizeof *to->nodes);
    bool done = first != NULL && to->nodes != NULL;
    for (unsigned m = 0; done && m < from->mNumMeshes; m++) {
        done = convert_mesh(from->mMeshes[m], &all);
        first[m + 1] = all.mesh_count;
    }
    if (!done) {
        return false;
    }
    to->material_count = from->mNumMaterials;
    to->camera_count = from->mNumCameras;
    to->camera.node = MODEL_NONE;
    if (from->mNumCameras > 0) {
        const struct aiCamera *camera = from->mCameras[0];
        to->camera = (struct model_camera){.name = camera->mName.data,
                                           .node = MODEL_NONE,
                                           .fov_x = camera->mHorizontalFOV,
                                           .half_width = camera->mOrthographicWidth,
                                           .aspect = camera->mAspect,
                                           .near_z = camera->mClipPlaneNear,
                                           .far_z = camera->mClipPlaneFar};
        set_vector(to->camera.position, &camera->mPosition);
        set_vector(to->camera.forward, &camera->mLookAt);
        set_vector(to->camera.up, &camera->mUp);
    }
    struct converted meshes = {all.meshes, first, true};
    to->first_node = convert_node(from, from->mRootNode, MODEL_NONE, &meshes, to);
    return meshes.is_whole;
}

bool model_assimp_read(struct model_shared *shared, struct model_scene *to)
{
    struct aiFileIO io = model_file_io(&shared->folder);
    const struct aiScene *scene = import(shared->folder.model, &io);
    if (scene == NULL) {
        return model_shared_failed(shared, "is no model that can be read: %s", aiGetErrorString());
    }
    if (!check(shared, scene)) {
        return false;
    }
    scene = aiApplyPostProcessing(scene, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FlipUVs |
                                             (shares_vertices(scene) ? 0u : (unsigned)aiProcess_GenSmoothNormals));
    if (scene == NULL) {
        return model_shared_failed(shared, "is broken: %s", aiGetErrorString());
    }
    to->materials = model_materials_read(shared, scene);
    return (to->materials != NULL && convert(scene, to)) || model_shared_failed(shared, "needs too much memory");
}
