#include "model_read.h"

#include <assimp/mesh.h>

#include <math.h>

struct fit {
    double centre[3], scale;
};

static double component(const struct aiVector3D *v, int axis)
{
    return axis == 0 ? v->x : axis == 1 ? v->y : v->z;
}

/* Q16.16, saturated; NaN gives 0. */
static fx_t fixed(double value)
{
    if (!(fabs(value) < 32767)) {
        return value > 0 ? FX_MAX : value < 0 ? FX_MIN : 0;
    }
    return (fx_t)lround(value * 65536);
}

/* The middle of the box around all points, and their largest distance from it. */
static bool find_fit(const struct aiScene *scene, struct fit *fit)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        for (unsigned i = 0; i < scene->mMeshes[m]->mNumVertices; i++) {
            for (int axis = 0; axis < 3; axis++) {
                const double v = component(&scene->mMeshes[m]->mVertices[i], axis);
                low[axis] = v < low[axis] || !isfinite(v) ? v : low[axis];
                high[axis] = v > high[axis] || !isfinite(v) ? v : high[axis];
            }
        }
    }
    double radius = 0;
    for (int axis = 0; axis < 3; axis++) {
        fit->centre[axis] = (low[axis] + high[axis]) / 2;
    }
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        for (unsigned i = 0; i < scene->mMeshes[m]->mNumVertices; i++) {
            double square = 0;
            for (int axis = 0; axis < 3; axis++) {
                const double d = component(&scene->mMeshes[m]->mVertices[i], axis) - fit->centre[axis];
                square += d * d;
            }
            radius = fmax(radius, sqrt(square));
        }
    }
    fit->scale = 1 / radius;
    return isfinite(radius) && isfinite(fit->scale);
}

static int16_t normal_component(double value, double length)
{
    const double unit = value / length;
    return isfinite(unit) ? (int16_t)lround(unit * 16384) : 0;
}

static void copy_vertex(const struct aiMesh *from, unsigned i, const struct fit *fit, struct fx_vec3 *position,
                        int16_t normal[3])
{
    const struct aiVector3D *p = &from->mVertices[i];
    *position =
        (struct fx_vec3){fixed((p->x - fit->centre[0]) * fit->scale), fixed((p->y - fit->centre[1]) * fit->scale),
                         fixed((p->z - fit->centre[2]) * fit->scale)};
    const struct aiVector3D n = from->mNormals != NULL ? from->mNormals[i] : (struct aiVector3D){0, 0, 0};
    const double length = sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);
    for (int axis = 0; axis < 3; axis++) {
        normal[axis] = normal_component(component(&n, axis), length);
    }
}

/* Faces that are no triangle of this mesh's vertices are left out. */
static uint32_t copy_triangles(const struct aiMesh *from, uint16_t (*to)[3])
{
    uint32_t count = 0;
    for (unsigned f = 0; f < from->mNumFaces; f++) {
        const struct aiFace *face = &from->mFaces[f];
        if (face->mNumIndices != 3 || face->mIndices[0] >= from->mNumVertices ||
            face->mIndices[1] >= from->mNumVertices || face->mIndices[2] >= from->mNumVertices) {
            continue;
        }
        for (int i = 0; i < 3; i++) {
            to[count][i] = (uint16_t)face->mIndices[i];
        }
        count++;
    }
    return count;
}

/* The mesh's own copy of its material: with texture only where there are coordinates for it. */
static bool copy_material(struct model_shared *shared, const struct aiMesh *from, const struct ph_material *materials,
                          struct ph_mesh *to)
{
    struct ph_material *material = demo_alloc(&shared->arena, sizeof *material);
    struct ph_part *part = demo_alloc(&shared->arena, sizeof *part);
    fx_t(*uvs)[2] = demo_alloc(&shared->arena, sizeof *uvs * from->mNumVertices);
    if (material == NULL || part == NULL || uvs == NULL) {
        return false;
    }
    *material = materials[from->mMaterialIndex];
    *part = (struct ph_part){.first = 0, .count = to->triangle_count, .material = 0};
    to->parts = part;
    to->part_count = 1;
    to->materials = material;
    if (material->texture == NULL || from->mTextureCoords[0] == NULL) {
        material->texture = NULL;
        return true;
    }
    for (unsigned i = 0; i < from->mNumVertices; i++) {
        uvs[i][0] = fixed(from->mTextureCoords[0][i].x);
        uvs[i][1] = fixed(from->mTextureCoords[0][i].y);
    }
    to->uvs = (const fx_t(*)[2])uvs;
    material->shading = PH_SHADE_TEXTURE_LIT;
    return true;
}

static bool copy_mesh(struct model_shared *shared, const struct aiScene *scene, const struct aiMesh *from,
                      const struct fit *fit, const struct ph_material *materials, struct ph_mesh *to)
{
    const uint32_t n = from->mNumVertices;
    if (n > MODEL_VERTICES_MAX || from->mMaterialIndex >= scene->mNumMaterials) {
        return model_read_failed(shared, "is broken: a mesh of %u vertices with material %u", n, from->mMaterialIndex);
    }
    struct fx_vec3 *positions = demo_alloc(&shared->arena, sizeof *positions * n);
    int16_t(*normals)[3] = demo_alloc(&shared->arena, sizeof *normals * n);
    uint16_t(*triangles)[3] = demo_alloc(&shared->arena, sizeof *triangles * from->mNumFaces);
    if (positions == NULL || normals == NULL || triangles == NULL) {
        return model_read_failed(shared, "needs too much memory");
    }
    for (uint32_t i = 0; i < n; i++) {
        copy_vertex(from, i, fit, &positions[i], normals[i]);
    }
    *to = (struct ph_mesh){.positions = positions,
                           .normals = (const int16_t(*)[3])normals,
                           .triangles = (const uint16_t(*)[3])triangles,
                           .vertex_count = n,
                           .triangle_count = copy_triangles(from, triangles)};
    return copy_material(shared, from, materials, to) || model_read_failed(shared, "needs too much memory");
}

bool model_read_meshes(struct model_shared *shared, const struct aiScene *scene, const struct ph_material *materials)
{
    struct model *model = &shared->model;
    struct fit fit;
    if (!find_fit(scene, &fit)) {
        return model_read_failed(shared, "has coordinates that are no numbers, or all points in one place");
    }
    model->meshes = demo_alloc(&shared->arena, sizeof *model->meshes * scene->mNumMeshes);
    if (model->meshes == NULL) {
        return model_read_failed(shared, "needs too much memory");
    }
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        struct ph_mesh *mesh = &model->meshes[model->mesh_count];
        if (!copy_mesh(shared, scene, scene->mMeshes[i], &fit, materials, mesh)) {
            return false;
        }
        model->mesh_count += mesh->triangle_count > 0;
        model->triangle_count += mesh->triangle_count;
        model->vertex_max = mesh->vertex_count > model->vertex_max ? mesh->vertex_count : model->vertex_max;
    }
    return model->triangle_count > 0 || model_read_failed(shared, "has no triangles");
}
