/* See model_scene.h. */
#include "model_scene.h"

#include <stdlib.h>

bool model_scene_moves(const struct model_scene *scene)
{
    for (uint32_t m = 0; m < scene->mesh_count; m++) {
        if (scene->meshes[m].moved.target_count > 0) {
            return true;
        }
    }
    return scene->skin_count > 0 || scene->clip_count > 0;
}

uint32_t model_scene_next(const struct model_scene *scene, uint32_t node)
{
    if (node == MODEL_NONE) {
        return scene->first_node;
    }
    if (scene->nodes[node].child != MODEL_NONE) {
        return scene->nodes[node].child;
    }
    while (node != MODEL_NONE && scene->nodes[node].next == MODEL_NONE) {
        node = scene->nodes[node].parent;
    }
    return node != MODEL_NONE ? scene->nodes[node].next : MODEL_NONE;
}

bool model_scene_one_node(struct model_scene *scene)
{
    scene->nodes = calloc(1, sizeof *scene->nodes);
    if (scene->nodes == NULL) {
        return false;
    }
    scene->nodes[0] = (struct model_node){.m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
                                          .parent = MODEL_NONE,
                                          .child = MODEL_NONE,
                                          .next = MODEL_NONE,
                                          .skin = MODEL_NONE,
                                          .mesh_count = scene->mesh_count,
                                          .is_shown = true};
    scene->node_count = 1;
    scene->first_node = 0;
    return true;
}

void model_scene_multiply(double to[3][4], double (*parent)[4], const float (*local)[4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = column == 3 ? parent[row][3] : 0;
            for (int k = 0; k < 3; k++) {
                to[row][column] += parent[row][k] * (double)local[k][column];
            }
        }
    }
}
