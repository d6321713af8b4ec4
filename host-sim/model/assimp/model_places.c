#include "model_places.h"

#include <stdlib.h>

/* Counts the meshes of a node and of those below it. It is recursive, as the readers of assimp are. */
static size_t count_places(const struct aiNode *node)
{
    size_t count = node->mNumMeshes;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        count += count_places(node->mChildren[i]);
    }
    return count;
}

void model_places_multiply(double to[3][4], double parent[3][4], const struct aiMatrix4x4 *local)
{
    const double l[4][4] = {{local->a1, local->a2, local->a3, local->a4},
                            {local->b1, local->b2, local->b3, local->b4},
                            {local->c1, local->c2, local->c3, local->c4},
                            {0, 0, 0, 1}};
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = column == 3 ? parent[row][3] : 0;
            for (int k = 0; k < 3; k++) {
                to[row][column] += parent[row][k] * l[k][column];
            }
        }
    }
}

/* The cofactors of m turn normals as m turns surfaces, also where m scales or shears; they keep its mirroring. */
static void find_cofactors(struct model_place *place)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            const int a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
            place->cofactors[row][column] = place->m[a][c] * place->m[b][d] - place->m[a][d] * place->m[b][c];
        }
    }
    double determinant = 0;
    for (int column = 0; column < 3; column++) {
        determinant += place->m[0][column] * place->cofactors[0][column];
    }
    place->mirrors = determinant < 0;
}

static void add_places(const struct aiScene *scene, const struct aiNode *node, double parent[3][4],
                       struct model_places *places)
{
    struct model_place place = {.node = node};
    model_places_multiply(place.m, parent, &node->mTransformation);
    find_cofactors(&place);
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        place.mesh = scene->mMeshes[node->mMeshes[i]];
        if (place.mesh->mMaterialIndex < scene->mNumMaterials) {
            places->list[places->count++] = place;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        add_places(scene, node->mChildren[i], place.m, places);
    }
}

bool model_places_find(const struct aiScene *scene, struct model_places *places)
{
    double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    places->count = 0;
    places->list = malloc(sizeof *places->list * (count_places(scene->mRootNode) + 1));
    if (places->list == NULL) {
        return false;
    }
    add_places(scene, scene->mRootNode, identity, places);
    return true;
}

void model_places_point(const struct model_place *place, unsigned i, double point[3])
{
    const struct aiVector3D *p = &place->mesh->mVertices[i];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = place->m[axis];
        point[axis] = row[0] * p->x + row[1] * p->y + row[2] * p->z + row[3];
    }
}

void model_places_normal(const struct model_place *place, unsigned i, double normal[3])
{
    const struct aiVector3D *n = &place->mesh->mNormals[i];
    const double sign = place->mirrors ? -1 : 1;
    for (int axis = 0; axis < 3; axis++) {
        const double *row = place->cofactors[axis];
        normal[axis] = sign * (row[0] * n->x + row[1] * n->y + row[2] * n->z);
    }
}
