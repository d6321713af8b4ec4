/* model_places: where the nodes of a scene show its meshes. */
#ifndef MODEL_PLACES_H
#define MODEL_PLACES_H

#include "model_scene.h"

#include <stdbool.h>
#include <stddef.h>

/* A mesh where a node shows it. */
struct model_place {
    const struct model_mesh *mesh;
    uint32_t node;
    double m[3][4]; /* to world: three rows, the last column is the translation */
    double cofactors[3][3];
    bool mirrors; /* left becomes right: faces must be turned over to look outwards again */
};

struct model_places {
    struct model_place *list; /* free() it */
    size_t count;
    double (*nodes)[3][4]; /* the place of each node that is shown; free() it */
};

/* Finds the place of every mesh of every node. false: no memory. */
bool model_places_find(const struct model_scene *scene, struct model_places *places);

/* Vertex i and its normal (of any length) in the world. */
void model_places_point(const struct model_place *place, uint32_t i, double point[3]);
void model_places_normal(const struct model_place *place, uint32_t i, double normal[3]);

#endif
