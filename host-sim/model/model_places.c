/* See model_places.h. Goes through the tree of nodes and multiplies their matrices. */
#include "model_places.h"

#include <stdlib.h>
#include <string.h>

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

static void add_places(const struct model_scene *scene, uint32_t i, double (*root)[4], struct model_places *places)
{
    const struct model_node *node = &scene->nodes[i];
    struct model_place place = {.node = i};
    if (node->is_bound) {
        model_scene_multiply(place.m, root, node->bound);
    } else {
        memcpy(place.m, places->nodes[i], sizeof place.m);
    }
    find_cofactors(&place);
    for (uint32_t k = 0; k < node->mesh_count; k++) {
        place.mesh = &scene->meshes[node->first_mesh + k];
        places->list[places->count++] = place;
    }
}

bool model_places_find(const struct model_scene *scene, struct model_places *places)
{
    double root[3][4];
    size_t count = 0;
    for (int i = 0; i < 12; i++) {
        root[i / 4][i % 4] = (double)scene->root[i / 4][i % 4];
    }
    for (uint32_t i = scene->first_node; i != MODEL_NONE; i = model_scene_next(scene, i)) {
        count += scene->nodes[i].mesh_count;
    }
    *places = (struct model_places){.list = malloc(sizeof *places->list * (count + 1)),
                                    .nodes = calloc(scene->node_count + 1, sizeof *places->nodes)};
    if (places->list == NULL || places->nodes == NULL) {
        return false;
    }
    for (uint32_t i = scene->first_node; i != MODEL_NONE; i = model_scene_next(scene, i)) {
        const uint32_t parent = scene->nodes[i].parent;
        model_scene_multiply(places->nodes[i], parent != MODEL_NONE ? places->nodes[parent] : root, scene->nodes[i].m);
        add_places(scene, i, root, places);
    }
    return true;
}

void model_places_point(const struct model_place *place, uint32_t i, double point[3])
{
    const float *p = place->mesh->positions[i];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = place->m[axis];
        point[axis] = row[0] * (double)p[0] + row[1] * (double)p[1] + row[2] * (double)p[2] + row[3];
    }
}

void model_places_normal(const struct model_place *place, uint32_t i, double normal[3])
{
    const float *n = place->mesh->normals[i];
    const double sign = place->mirrors ? -1 : 1;
    for (int axis = 0; axis < 3; axis++) {
        const double *row = place->cofactors[axis];
        normal[axis] = sign * (row[0] * (double)n[0] + row[1] * (double)n[1] + row[2] * (double)n[2]);
    }
}
