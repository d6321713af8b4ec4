/* models_build: what the makers of models share. */
#ifndef MODELS_BUILD_H
#define MODELS_BUILD_H

#include "models.h"

/* A mesh's arrays while they are filled. */
struct model_build {
    struct fx_vec3 *positions;
    int16_t (*normals)[3];
    uint16_t (*triangles)[3];
    uint32_t triangle_count;
};

/* Takes the arrays from the arena, points the mesh to them and sets its counts. */
int model_begin(struct demo_arena *arena, struct ph_mesh *mesh, struct model_build *build, uint32_t vertices,
                uint32_t triangles);

/* Append the triangle (a, b, c), or the quad of triangles (a, b, c) and (a, c, d). */
void model_triangle(struct model_build *build, uint32_t a, uint32_t b, uint32_t c);
void model_quad(struct model_build *build, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/* Convert Q2.30 to Q16.16 and to Q1.14, rounded to nearest. */
fx_t model_q16(int32_t q30);
int16_t model_q14(int32_t q30);

/* Scratch memory from the arena's end, NULL if it does not fit. Set the arena's size back to give it back. */
void *model_scratch(struct demo_arena *arena, size_t n);

#endif
