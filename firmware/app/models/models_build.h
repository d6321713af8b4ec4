/* models_build: what the model generators share. */
#ifndef MODELS_BUILD_H
#define MODELS_BUILD_H

#include "models.h"

/* The arrays of a mesh while it is filled. */
struct model_build {
    struct fx_vec3 *positions;
    int16_t (*normals)[3];
    uint16_t (*triangles)[3];
    uint32_t triangle_count;
};

/* Takes the arrays from the arena and points mesh to them; the counts of the mesh are set. */
int model_begin(struct demo_arena *arena, struct ph_mesh *mesh, struct model_build *build, uint32_t vertices,
                uint32_t triangles);

/* Appends (a, b, c); appends (a, b, c), (a, c, d). */
void model_triangle(struct model_build *build, uint32_t a, uint32_t b, uint32_t c);
void model_quad(struct model_build *build, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/* Q2.30 to Q16.16 and to Q1.14, to nearest. */
fx_t model_q16(int32_t q30);
int16_t model_q14(int32_t q30);

/* Scratch from the arena's end, NULL when it does not fit; give it back with the size before. */
void *model_scratch(struct demo_arena *arena, size_t n);

#endif
