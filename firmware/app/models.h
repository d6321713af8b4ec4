/*
 * models: meshes made by our own code, in fixed point, into a caller's arena. Vertex and triangle order is the one of
 * the benchmark scenes where there is one. Triangles are counter-clockwise seen from outside; vertices that lie in one
 * place with one normal exist once, so that each is transformed once and no crack can open between triangles.
 *
 * All functions return 0, PH_ERR_NOMEM (the arena is too small; what was taken of it is not given back) or
 * PH_ERR_INVAL (an argument outside its range). They leave mesh->parts and mesh->materials to model_material(), unless
 * they take materials themselves.
 *
 * Memory: MODEL_BYTES(vertices, triangles) for positions, normals and triangles, on top of it what the function states.
 * "Scratch" is taken at the arena's end and given back before the return.
 */
#ifndef MODELS_H
#define MODELS_H

#include "demo.h"

#define MODEL_ROUND8(n) (((size_t)(n) + 7) & ~(size_t)7)
#define MODEL_BYTES(v, t)                                                                                              \
    (MODEL_ROUND8(12 * (size_t)(v)) + MODEL_ROUND8(6 * (size_t)(v)) + MODEL_ROUND8(6 * (size_t)(t)))
#define MODEL_EDGES_BYTES(e) MODEL_ROUND8(4 * (size_t)(e))

/*
 * Torus around the z axis: major x minor segments (3 .. 256 each), radii in Q4.28 (so that .4 is good to a fraction of
 * the positions' LSB), radius + tube < 8.
 * Vertex i * minor + j. Positions within 0.51 LSB, normals within 0.51 of Q1.14's LSB.
 */
#define MODEL_TORUS_VERTICES(major, minor)  ((major) * (minor))
#define MODEL_TORUS_TRIANGLES(major, minor) (2 * (major) * (minor))
int model_torus(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t major, uint32_t minor, int32_t radius_q28,
                int32_t tube_q28);

/*
 * Icosahedron subdivided `levels` times (0 .. 5), vertices normalised at each level; radius 1. Errors as the torus.
 */
#define MODEL_ICOSPHERE_VERTICES(levels)  (10u * (1u << (2 * (levels))) + 2)
#define MODEL_ICOSPHERE_TRIANGLES(levels) (20u * (1u << (2 * (levels))))
#define MODEL_ICOSPHERE_LEVELS_MAX        5
int model_icosphere(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t levels);

/* Cube [-1, 1]^3 with 24 vertices, 12 triangles; texture coordinates (0 .. 1 on each face) take 192 bytes. */
#define MODEL_CUBE_BYTES (MODEL_BYTES(24, 12) + 192)
int model_cube(struct demo_arena *arena, struct ph_mesh *mesh);

/* cells x cells squares (1 .. 255) of side 1 in the plane y = 0, centred, with the wavy normals of the benchmark. */
#define MODEL_GROUND_VERTICES(cells)  (((cells) + 1) * ((cells) + 1))
#define MODEL_GROUND_TRIANGLES(cells) (2 * (cells) * (cells))
int model_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells);

/* The same ground flat, its squares alternately of material 0 and 1. */
#define MODEL_FLOOR_BYTES(cells)                                                                                       \
    (MODEL_BYTES(MODEL_GROUND_VERTICES(cells), MODEL_GROUND_TRIANGLES(cells)) +                                        \
     MODEL_ROUND8(2 * sizeof(struct ph_part)))
int model_floor(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells, const struct ph_material materials[2]);

/* Box of the given half sizes, without texture coordinates. Arena: MODEL_BOX_BYTES. */
#define MODEL_BOX_BYTES (MODEL_CUBE_BYTES + 288)
int model_box(struct demo_arena *arena, struct ph_mesh *mesh, fx_t x, fx_t y, fx_t z);

/*
 * Surface of revolution about the y axis: `points` (2 .. 64) of a profile, from the bottom to the top, each a ring of
 * `sides` (3 .. 64) vertices. Where a point stands twice there is a sharp edge. Radius 0 closes an end.
 * `stripes` materials alternate around the axis (1: one; sides must be a multiple of it).
 */
struct model_point {
    fx_t radius, y;
};
#define MODEL_LATHE_VERTICES(sides, points)  ((sides) * (points))
#define MODEL_LATHE_TRIANGLES(sides, points) (2 * (sides) * ((points)-1))
#define MODEL_LATHE_BYTES(sides, points, stripes)                                                                      \
    (MODEL_BYTES(MODEL_LATHE_VERTICES(sides, points), MODEL_LATHE_TRIANGLES(sides, points)) +                          \
     MODEL_ROUND8((stripes) * sizeof(struct ph_part)))
int model_lathe(struct demo_arena *arena, struct ph_mesh *mesh, const struct model_point *profile, uint32_t points,
                uint32_t sides, uint32_t stripes, const struct ph_material *materials);

/*
 * Newell's teapot from its Bezier patches, each divided into segments x segments quads (2 .. 8). y is up, the axis of
 * the pot is the y axis, the lid's top is at .63 and the bottom at -.63, the spout points along +x; within 1.42 of the
 * origin. Points of the patches are rounded once (0.5 LSB).
 *
 * The mesh is closed: lid and rim, which the patches leave .04 apart, are joined by a flat ring, and the ends of handle
 * and spout have flat covers (those of the handle and the spout's inner one are hidden in the pot).
 *
 *   segments        2     3     4     5     6     8
 *   vertices      138   302   530   822  1178  2082
 *   triangles     264   592  1048  1632  2344  4152
 */
#define MODEL_TEAPOT_VERTICES(n)   (32 * (n) * (n) + 4 * (n) + 2)
#define MODEL_TEAPOT_TRIANGLES(n)  (64 * (n) * (n) + 8 * (n)-8)
#define MODEL_TEAPOT_QUAD_EDGES(n) (64 * (n) * (n) + 16 * (n)-12) /* of model_quad_edges() */
int model_teapot(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t segments);

/*
 * Each undirected edge of the mesh once, into mesh->edges; linear time for any mesh. Scratch: MODEL_EDGES_SCRATCH.
 * model_quad_edges leaves out the diagonals of quads: where triangle 2k is (a, b, c) and 2k + 1 is (a, c, d), a-c.
 */
#define MODEL_EDGES_SCRATCH(v, t) (MODEL_ROUND8(8 * (size_t)(v) + 4) + MODEL_ROUND8(6 * (size_t)(t)))
int model_edges(struct demo_arena *arena, struct ph_mesh *mesh);
int model_quad_edges(struct demo_arena *arena, struct ph_mesh *mesh);

/* One part over all triangles with one material (not copied). Takes 16 bytes. */
int model_material(struct demo_arena *arena, struct ph_mesh *mesh, const struct ph_material *material);

#endif
