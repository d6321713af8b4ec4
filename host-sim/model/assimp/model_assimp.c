#include "model_assimp.h"

#include "model_file_io.h"
#include "model_materials.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CREASE_DEGREES 66 /* edges sharper than this stay sharp when normals are made */

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

/* assimp 5.2 looks at no index of a binary PLY file before it uses it. */
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

/* assimp 5.2 reads a PLY header without an end for ever. */
static bool is_endless_ply(const char *path)
{
    char head[65536] = "";
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return false;
    }
    const size_t n = fread(head, 1, sizeof head - 1, file);
    fclose(file);
    for (size_t i = 0; i < n; i++) {
        head[i] = head[i] != '\0' ? head[i] : ' ';
    }
    return strncmp(head, "ply", 3) == 0 && strstr(head, "end_header") == NULL;
}

/* Imports the file; the settings stay with the scene for the later steps. */
static const struct aiScene *import(const char *path, bool is_stl, struct aiFileIO *io)
{
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SLM_VERTEX_LIMIT, (int)MODEL_VERTICES_MAX);
    aiSetImportPropertyFloat(settings, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, CREASE_DEGREES);
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_RVC_FLAGS, is_stl ? (int)aiComponent_NORMALS : 0);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, io, settings);
    aiReleasePropertyStore(settings);
    return scene;
}

/* The largest coordinate of any mesh, or 0. */
static float find_extent(const struct aiScene *scene)
{
    float extent = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        for (unsigned i = 0; i < mesh->mNumVertices; i++) {
            const struct aiVector3D *v = &mesh->mVertices[i];
            extent = fmaxf(extent, fmaxf(fabsf(v->x), fmaxf(fabsf(v->y), fabsf(v->z))));
        }
    }
    return extent;
}

static void scale_nodes(struct aiNode *node, float scale)
{
    node->mTransformation.a4 *= scale;
    node->mTransformation.b4 *= scale;
    node->mTransformation.c4 *= scale;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        scale_nodes(node->mChildren[i], scale);
    }
}

/* assimp joins vertices that are 1e-5 apart whatever the size of the model, and squares lengths in float. A model
 * smaller than 1 or larger than 2^24 is scaled into that range by a power of two. It is fitted later anyway. */
static void scale_to_reason(const struct aiScene *scene)
{
    const float extent = find_extent(scene);
    const int log2 = extent > 0 && isfinite(extent) ? ilogbf(extent) : 0;
    const int shift = log2 < 0 ? -log2 : log2 > 24 ? 24 - log2 : 0;
    if (shift == 0) {
        return;
    }
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        for (unsigned i = 0; i < mesh->mNumVertices; i++) {
            struct aiVector3D *v = &mesh->mVertices[i];
            *v = (struct aiVector3D){ldexpf(v->x, shift), ldexpf(v->y, shift), ldexpf(v->z, shift)};
        }
    }
    for (unsigned i = 0; i < scene->mNumCameras; i++) {
        struct aiCamera *c = scene->mCameras[i];
        c->mPosition = (struct aiVector3D){ldexpf(c->mPosition.x, shift), ldexpf(c->mPosition.y, shift),
                                           ldexpf(c->mPosition.z, shift)};
        c->mClipPlaneNear = ldexpf(c->mClipPlaneNear, shift);
        c->mClipPlaneFar = ldexpf(c->mClipPlaneFar, shift);
        c->mOrthographicWidth = ldexpf(c->mOrthographicWidth, shift);
    }
    scale_nodes(scene->mRootNode, ldexpf(1, shift));
}

/* PLY does not say how a surface without normals is meant: it is flat. assimp makes normals, with creases, where each
 * face has vertices of its own (OBJ, STL). Where faces share vertices it would keep the normal of the last face; those
 * are made flat, too. */
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

/* An STL file has only the normals of its facets; they are dropped because they add nothing. */
static unsigned steps(const struct aiScene *scene, bool is_stl, bool is_flat)
{
    return aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FlipUVs | aiProcess_JoinIdenticalVertices |
           aiProcess_SplitLargeMeshes | aiProcess_ImproveCacheLocality |
           (is_flat || shares_vertices(scene) ? 0u : (unsigned)aiProcess_GenSmoothNormals) |
           (is_stl ? (unsigned)aiProcess_RemoveComponent : 0u);
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

static bool convert_mesh(const struct aiMesh *from, struct model_mesh *to)
{
    const uint32_t n = from->mNumVertices;
    *to = (struct model_mesh){.vertex_count = n, .material = from->mMaterialIndex};
    to->positions = calloc(n + 1, sizeof *to->positions);
    to->normals = from->mNormals != NULL ? calloc(n + 1, sizeof *to->normals) : NULL;
    to->uvs = from->mTextureCoords[0] != NULL ? calloc(n + 1, sizeof *to->uvs) : NULL;
    to->colours = from->mColors[0] != NULL ? calloc(n + 1, sizeof *to->colours) : NULL;
    to->triangles = calloc(from->mNumFaces + 1, sizeof *to->triangles);
    if (to->positions == NULL || (from->mNormals != NULL && to->normals == NULL) || to->triangles == NULL ||
        (from->mTextureCoords[0] != NULL && to->uvs == NULL) || (from->mColors[0] != NULL && to->colours == NULL)) {
        return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        memcpy(to->positions[i], &from->mVertices[i], sizeof *to->positions);
        if (to->normals != NULL) {
            memcpy(to->normals[i], &from->mNormals[i], sizeof *to->normals);
        }
        if (to->uvs != NULL) {
            memcpy(to->uvs[i], &from->mTextureCoords[0][i], sizeof *to->uvs);
        }
        if (to->colours != NULL) {
            memcpy(to->colours[i], &from->mColors[0][i], sizeof *to->colours);
        }
    }
    for (uint32_t f = 0; f < from->mNumFaces; f++) {
        const unsigned *v = from->mFaces[f].mIndices;
        if (from->mFaces[f].mNumIndices == 3 && v[0] < n && v[1] < n && v[2] < n) {
            memcpy(to->triangles[to->triangle_count++], v, sizeof *to->triangles);
        }
    }
    return true;
}

static uint32_t count_nodes(const struct aiNode *node, uint32_t *meshes)
{
    uint32_t count = 1;
    *meshes += node->mNumMeshes;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        count += count_nodes(node->mChildren[i], meshes);
    }
    return count;
}

/* Adds a node, copies of the meshes that it shows, and what is below it; returns its number. Recursive, as assimp is.
 */
static uint32_t convert_node(const struct aiScene *scene, const struct aiNode *from, uint32_t parent,
                             const struct model_mesh *meshes, struct model_scene *to)
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
        if (meshes[from->mMeshes[i]].material < to->material_count) {
            to->meshes[to->mesh_count++] = meshes[from->mMeshes[i]];
            node->mesh_count++;
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
    uint32_t shown = 0;
    struct model_mesh *meshes = calloc(from->mNumMeshes + 1, sizeof *meshes);
    to->nodes = calloc(count_nodes(from->mRootNode, &shown), sizeof *to->nodes);
    to->meshes = calloc(shown + 1, sizeof *to->meshes);
    bool done = meshes != NULL && to->nodes != NULL && to->meshes != NULL;
    for (unsigned m = 0; done && m < from->mNumMeshes; m++) {
        done = convert_mesh(from->mMeshes[m], &meshes[m]);
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
    to->first_node = convert_node(from, from->mRootNode, MODEL_NONE, meshes, to);
    free(meshes);
    return true;
}

bool model_assimp_read(struct model_shared *shared, struct model_scene *to)
{
    const char *const path = shared->folder.model;
    const bool is_stl = model_shared_ends(shared, ".stl");
    struct aiFileIO io = model_file_io(&shared->folder);
    if (is_endless_ply(path)) {
        return model_shared_failed(shared, "is broken: a PLY header without its end");
    }
    const struct aiScene *scene = import(path, is_stl, &io);
    if (scene == NULL) {
        return model_shared_failed(shared, "is no model that can be read: %s", aiGetErrorString());
    }
    if (!check(shared, scene)) {
        return false;
    }
    scale_to_reason(scene);
    scene = aiApplyPostProcessing(scene, steps(scene, is_stl, model_shared_ends(shared, ".ply")));
    if (scene == NULL) {
        return model_shared_failed(shared, "is broken: %s", aiGetErrorString());
    }
    if (model_shared_ends(shared, ".obj")) {
        model_materials_note_missing(shared);
    }
    to->materials = model_materials_read(shared, scene);
    return (to->materials != NULL && convert(scene, to)) || model_shared_failed(shared, "needs too much memory");
}
