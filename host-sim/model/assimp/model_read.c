#include "model_read.h"

#include "model_file_io.h"
#include "model_gltf.h"
#include "model_materials.h"
#include "model_meshes.h"
#include "model_surface.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CREASE_DEGREES 66 /* edges sharper than this stay sharp when normals are made */

static bool has_suffix(const char *path, const char *suffix)
{
    const size_t n = strlen(path), m = strlen(suffix);
    if (n < m) {
        return false;
    }
    for (size_t i = 0; i < m; i++) {
        if (tolower((unsigned char)path[n - m + i]) != suffix[i]) {
            return false;
        }
    }
    return true;
}

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

/* What all readers check. Triangles are counted before anything is made of them. */
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

/* Turns what has z up: the root takes (x, y, z) to (x, z, -y). */
static void turn_up(const struct model_shared *shared, const struct aiScene *scene, bool has_z_up)
{
    const char *up = shared->options.up;
    struct aiMatrix4x4 *m = &scene->mRootNode->mTransformation;
    if (up != NULL ? *up != 'z' : !has_z_up) {
        return;
    }
    const struct aiMatrix4x4 was = *m;
    m->b1 = was.c1, m->b2 = was.c2, m->b3 = was.c3, m->b4 = was.c4;
    m->c1 = -was.b1, m->c2 = -was.b2, m->c3 = -was.b3, m->c4 = -was.b4;
}

static bool read_gltf(struct model_shared *shared)
{
    struct gltf_file file;
    if (!gltf_file_open(&file, &shared->folder)) {
        return model_shared_failed(shared, "is no model that can be read: %s", file.error);
    }
    struct model_gltf_uv *uvs = calloc(file.lists[GLTF_MATERIALS].count + 1, sizeof *uvs);
    const struct model_material *materials = uvs != NULL ? model_gltf_materials(shared, &file, uvs) : NULL;
    if (materials == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    const struct aiScene *scene = model_gltf_read(shared, &file, uvs);
    if (scene == NULL || !check(shared, scene)) {
        return false;
    }
    turn_up(shared, scene, false);
    return model_meshes_read(shared, scene, materials);
}

static bool read_by_assimp(struct model_shared *shared, const char *path)
{
    const bool is_stl = has_suffix(path, ".stl");
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
    scene = aiApplyPostProcessing(scene, steps(scene, is_stl, has_suffix(path, ".ply")));
    if (scene == NULL) {
        return model_shared_failed(shared, "is broken: %s", aiGetErrorString());
    }
    if (has_suffix(path, ".obj")) {
        model_materials_note_missing(shared);
    }
    const struct model_material *materials = model_materials_read(shared, scene);
    if (materials == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    turn_up(shared, scene, is_stl);
    return model_meshes_read(shared, scene, materials);
}

bool model_read(struct model_shared *shared, const char *path)
{
    const bool is_gltf = has_suffix(path, ".gltf") || has_suffix(path, ".glb");
    if (!model_surface_take_texture(shared)) {
        return false;
    }
    shared->folder = (struct model_folder){.model = path, .allow_outside = shared->options.allow_outside};
    const bool is_read = is_gltf ? read_gltf(shared) : read_by_assimp(shared, path);
    if (shared->folder.outside[0] != '\0') { /* the reader went on without it */
        return model_shared_failed(shared, "names %.120s, which is outside of its folder; --allow-outside reads it",
                                   shared->folder.outside);
    }
    return is_read;
}
