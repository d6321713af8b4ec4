/*
 * A second opinion: assimp reads the same files as our readers, with its own triangulation and its own normals, and
 * both show the same triangles at the same places, with the same normals, texture coordinates and colours.
 *
 *   test_model_assimp [FILE...]   other files by hand; those of OBJ, STL, PLY, glTF and GLB
 */
#include "model_gltf.h"
#include "model_obj.h"
#include "model_places.h"
#include "model_ply.h"
#include "model_stl.h"
#include "scene_read.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEAR 1e-4 /* of the size for positions; of one for normals and coordinates */

struct corner {
    double position[3], normal[3], uv[2];
};

struct triangle {
    struct corner corners[3];
    uint16_t colour; /* of the material; what has none says 0 on both sides */
    bool is_taken;
};

struct soup {
    struct triangle *list;
    size_t count;
    bool has_normals, has_uvs;
    double size;
};

static void add(struct soup *soup, const struct triangle *triangle)
{
    soup->list = realloc(soup->list, sizeof *soup->list * (soup->count + 1));
    assert_non_null(soup->list);
    soup->list[soup->count++] = *triangle;
    for (int i = 0; i < 9; i++) {
        soup->size = fmax(soup->size, fabs(triangle->corners[i / 3].position[i % 3]));
    }
}

static double normal_length(const double n[3])
{
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length > 0 ? length : 1;
}

/* ---- ours -------------------------------------------------------------------------------------------------------- */

static bool ends(const char *path, const char *ending)
{
    return strlen(path) > strlen(ending) && strcmp(path + strlen(path) - strlen(ending), ending) == 0;
}

static struct soup read_ours(const char *path)
{
    const scene_reader reader = ends(path, ".obj")   ? model_obj_read
                                : ends(path, ".stl") ? model_stl_read
                                : ends(path, ".ply") ? model_ply_read
                                                     : model_gltf_read;
    const bool has_plain = !ends(path, ".obj") && !ends(path, ".gltf") && !ends(path, ".glb");
    struct model_shared *shared;
    struct model_scene *scene;
    struct model_places places;
    struct soup soup = {.has_normals = true, .has_uvs = true};
    if (!scene_read(reader, path, &shared, &scene)) {
        fail_msg("%s: %s", path, shared->error);
    }
    memcpy(scene->root, (float[3][4]){{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, sizeof scene->root);
    assert_true(model_places_find(scene, &places));
    for (size_t k = 0; k < places.count; k++) {
        const struct model_mesh *mesh = places.list[k].mesh;
        const bool is_default = has_plain || mesh->material == (ends(path, ".obj") ? 0 : scene->material_count - 1);
        soup.has_normals = soup.has_normals && mesh->normals != NULL;
        soup.has_uvs = soup.has_uvs && mesh->uvs != NULL;
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            struct triangle one = {.colour = is_default ? 0 : scene->materials[mesh->material].surface.colour};
            for (int i = 0; i < 3; i++) {
                const uint32_t v = mesh->triangles[t][i];
                model_places_point(&places.list[k], v, one.corners[i].position);
                if (mesh->normals != NULL) {
                    model_places_normal(&places.list[k], v, one.corners[i].normal);
                }
                for (int c = 0; c < 2 && mesh->uvs != NULL; c++) {
                    one.corners[i].uv[c] = (double)mesh->uvs[v][c];
                }
            }
            add(&soup, &one);
        }
    }
    free(places.list);
    free(places.nodes);
    return soup;
}

/* ---- theirs ------------------------------------------------------------------------------------------------------ */

static uint8_t channel(float value, bool is_linear)
{
    const double v = fmin(1, fmax(0, (double)value));
    return (uint8_t)lround(255 * (!is_linear ? v : v <= .0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - .055));
}

static uint16_t colour_of(const struct aiMaterial *material, bool is_linear)
{
    struct aiColor4D c = {0, 0, 0, 0};
    struct aiString name = {0};
    aiGetMaterialString(material, AI_MATKEY_NAME, &name);
    aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &c);
    return strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0
               ? 0
               : ph_rgb565(channel(c.r, is_linear), channel(c.g, is_linear), channel(c.b, is_linear));
}

static const struct aiScene *import(const char *path)
{
    const bool is_stl = ends(path, ".stl"), is_ply = ends(path, ".ply"),
               has_nodes = !is_stl && !is_ply && !ends(path, ".obj");
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyFloat(settings, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 66);
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_RVC_FLAGS, is_stl ? (int)aiComponent_NORMALS : 0);
    const unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FlipUVs |
                           (has_nodes ? (unsigned)aiProcess_PreTransformVertices : 0u) |
                           (is_stl ? (unsigned)aiProcess_RemoveComponent : 0u) |
                           (is_ply ? 0u : (unsigned)aiProcess_GenSmoothNormals);
    const struct aiScene *scene = aiImportFileExWithProperties(path, steps, NULL, settings);
    aiReleasePropertyStore(settings);
    if (scene == NULL) {
        fail_msg("%s: %s", path, aiGetErrorString());
    }
    return scene;
}

static struct soup read_theirs(const char *path)
{
    const struct aiScene *scene = import(path);
    const bool has_plain = !ends(path, ".obj") && !ends(path, ".gltf") && !ends(path, ".glb");
    struct soup soup = {.has_normals = true, .has_uvs = true};
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        const uint16_t colour = has_plain ? 0 : colour_of(scene->mMaterials[mesh->mMaterialIndex], !ends(path, ".obj"));
        soup.has_normals = soup.has_normals && mesh->mNormals != NULL;
        soup.has_uvs = soup.has_uvs && mesh->mTextureCoords[0] != NULL;
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            struct triangle one = {.colour = colour};
            for (int i = 0; i < 3; i++) {
                const unsigned v = mesh->mFaces[f].mIndices[i];
                const struct aiVector3D *p = &mesh->mVertices[v], none = {0, 0, 0},
                                        *n = mesh->mNormals != NULL ? &mesh->mNormals[v] : &none,
                                        *uv = mesh->mTextureCoords[0] != NULL ? &mesh->mTextureCoords[0][v] : &none;
                one.corners[i] = (struct corner){{(double)p->x, (double)p->y, (double)p->z},
                                                 {(double)n->x, (double)n->y, (double)n->z},
                                                 {(double)uv->x, (double)uv->y}};
            }
            add(&soup, &one);
        }
    }
    aiReleaseImport(scene);
    return soup;
}

/* ---- both -------------------------------------------------------------------------------------------------------- */

static bool agree(const struct soup *soup, const struct corner *a, const struct corner *b)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        most = fmax(most, fabs(a->position[i] - b->position[i]) / soup->size);
        most = fmax(most, soup->has_normals
                              ? fabs(a->normal[i] / normal_length(a->normal) - b->normal[i] / normal_length(b->normal))
                              : 0);
        most = fmax(most, i < 2 && soup->has_uvs ? fabs(a->uv[i] - b->uv[i]) : 0);
    }
    return most < NEAR;
}

static bool find(const struct soup *soup, const struct triangle *one, struct soup *in)
{
    for (size_t t = 0; t < in->count; t++) {
        struct triangle *other = &in->list[t];
        for (int turn = 0; turn < 3 && !other->is_taken && other->colour == one->colour; turn++) {
            other->is_taken = agree(soup, &one->corners[0], &other->corners[turn]) &&
                              agree(soup, &one->corners[1], &other->corners[(turn + 1) % 3]) &&
                              agree(soup, &one->corners[2], &other->corners[(turn + 2) % 3]);
            if (other->is_taken) {
                return true;
            }
        }
    }
    return false;
}

/* Returns how many triangles of ours assimp has not. */
static size_t compare(const char *path)
{
    struct soup ours = read_ours(path), theirs = read_theirs(path);
    size_t missing = 0;
    ours.has_normals = ours.has_normals && theirs.has_normals;
    ours.has_uvs = ours.has_uvs && theirs.has_uvs;
    for (size_t t = 0; t < ours.count; t++) {
        missing += !find(&ours, &ours.list[t], &theirs);
    }
    printf("# %s: %zu of %zu triangles of ours are not among %zu of assimp's;%s%s\n", path, missing, ours.count,
           theirs.count, ours.has_normals ? " normals" : "", ours.has_uvs ? " uvs" : "");
    missing += ours.count > theirs.count ? ours.count - theirs.count : theirs.count - ours.count;
    free(ours.list);
    free(theirs.list);
    return missing;
}

static void cubes_are_the_same(void **state)
{
    (void)state;
    assert_int_equal(compare(cube_obj()), 0);
    assert_int_equal(compare(cube_stl_text()), 0);
    assert_int_equal(compare(cube_stl_binary()), 0);
    assert_int_equal(compare(cube_ply_text()), 0);
    assert_int_equal(compare(cube_ply_binary()), 0);
    assert_int_equal(
        compare(cube_gltf("[{\"mesh\":0,\"translation\":[1,2,3],\"rotation\":[0.6,0,0,0.8],\"scale\":[1,2,3]}]")), 0);
    assert_int_equal(
        compare(cube_glb("[{\"children\":[1,2],\"scale\":[2,1,1]},{\"mesh\":0,\"translation\":[4,0,0]},{\"mesh\":0,"
                         "\"rotation\":[0,0.6,0,0.8]}]")),
        0);
}

/* A bumpy torus of quads, triangles and materials, with or without coordinates and normals. */
static const char *torus(const char *name, int uvs, int normals)
{
    enum { SIDE = 16 };
    const double step = 6.283185307179586 / SIDE;
    const char *const path = file_path(name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "mtllib torus.mtl\n");
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double a = i / SIDE * step, b = i % SIDE * step, r = 1 + .3 * sin(3 * a) * cos(2 * b);
        fprintf(file, "v %.6f %.6f %.6f\nvn %.4f %.4f %.4f\nvt %.4f %.4f\n", (3 + r * cos(b)) * cos(a),
                (3 + r * cos(b)) * sin(a), r * sin(b), cos(b) * cos(a), cos(b) * sin(a), sin(b), a, b);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int row = i / SIDE * SIDE, next = (row + SIDE) % (SIDE * SIDE), x = i % SIDE, y = (x + 1) % SIDE;
        const int corners[4] = {row + x + 1, next + x + 1, next + y + 1, row + y + 1};
        if (i % 40 == 0) {
            fprintf(file, "usemtl %s\n", i % 80 == 0 ? "a" : "b");
        }
        fprintf(file, "f");
        for (int k = 0; k < (i % 7 == 0 ? 3 : 4); k++) {
            fprintf(file, " %d", corners[k]);
            if (uvs != 0 || normals != 0) {
                fprintf(file, uvs != 0 ? "/%d" : "/", corners[k]);
            }
            if (normals != 0) {
                fprintf(file, "/%d", corners[k]);
            }
        }
        fprintf(file, "\n");
    }
    fclose(file);
    return path;
}

static void surfaces_of_obj_are_the_same(void **state)
{
    (void)state;
    file_text("torus.mtl", "newmtl a\nKd .2 .4 .6\nnewmtl b\nKd 1 0 0\n");
    assert_int_equal(compare(torus("torus.obj", 0, 0)), 0);
    assert_int_equal(compare(torus("torus.obj", 1, 0)), 0);
    assert_int_equal(compare(torus("torus.obj", 0, 1)), 0);
    assert_int_equal(compare(torus("torus.obj", 1, 1)), 0);
}

static void the_tests_own_models_are_the_same(void **state)
{
    (void)state;
    assert_int_equal(compare("tests/host-sim/asset/scene.gltf"), 0);
    assert_int_equal(compare("tests/host-sim/asset/surfaces.gltf"), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubes_are_the_same),
        cmocka_unit_test(surfaces_of_obj_are_the_same),
        cmocka_unit_test(the_tests_own_models_are_the_same),
    };
    size_t missing = 0;
    for (int i = 1; i < argc; i++) {
        missing += compare(argv[i]);
    }
    return argc > 1 ? missing > 0 : cmocka_run_group_tests(tests, files_begin, files_end);
}
