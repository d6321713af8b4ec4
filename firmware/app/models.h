/*
 * models: meshes made by our own code, in fixed point, into a caller's arena. All functions return 0 or PH_ERR_NOMEM.
 * Vertex and triangle order is the one of the benchmark scenes where there is one.
 */
#ifndef MODELS_H
#define MODELS_H

#include "demo.h"

/* Torus around the z axis: major x minor segments, radii in Q16.16. Vertex i * minor + j. */
int model_torus(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t major, uint32_t minor, fx_t radius, fx_t tube);

/* Icosahedron subdivided `levels` times (0 .. 5), vertices normalised at each level; radius 1. */
int model_icosphere(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t levels);

/* Cube [-1, 1]^3 with 24 vertices and texture coordinates per face. */
int model_cube(struct demo_arena *arena, struct ph_mesh *mesh);

/* cells x cells squares of side 1 in the plane y = 0, centred, with the wavy normals of the benchmark. */
int model_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells);

/* Newell's teapot from its Bezier patches, each divided into segments x segments quads; lid, spout, handle, bottom. */
int model_teapot(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t segments);

/* Each undirected edge of the mesh once, into mesh->edges. */
int model_edges(struct demo_arena *arena, struct ph_mesh *mesh);

/* One part over all triangles with one material (not copied). */
int model_material(struct demo_arena *arena, struct ph_mesh *mesh, const struct ph_material *material);

#endif
