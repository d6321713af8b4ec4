/*
 * models: makes meshes in fixed point in a caller's arena. Vertices and triangles have the order of the benchmark
 * scenes if those have the mesh. Triangles are counter-clockwise as seen from outside. Vertices with the same place and
 * normal exist once, so that each is transformed once and no crack can open between triangles.
 *
 * All functions return 0, PH_ERR_NOMEM (the arena is too small; memory that was taken is not given back) or
 * PH_ERR_INVAL (an argument is outside its range). Functions without materials leave mesh->parts and mesh->materials to
 * model_material().
 *
 * Memory: MODEL_BYTES(vertices, triangles) for positions, normals and triangles, and what the function states besides.
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

/* Cube [-1, 1]^3: 24 vertices, 12 triangles, and texture coordinates (0 .. 1 on each face) of 192 bytes. */
#define MODEL_CUBE_BYTES (MODEL_BYTES(24, 12) + 192)
int model_cube(struct demo_arena *arena, struct ph_mesh *mesh);

/* cells x cells squares (1 .. 255) of side 1 at y = 0 around the origin, with the benchmark's wavy normals. */
#define MODEL_GROUND_VERTICES(cells)  (((cells) + 1) * ((cells) + 1))
#define MODEL_GROUND_TRIANGLES(cells) (2 * (cells) * (cells))
int model_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells);

/* A ground of cells x cells squares with straight normals; its squares alternate between materials 0 and 1. */
#define MODEL_FLOOR_BYTES(cells)                                                                                       \
    (MODEL_BYTES(MODEL_GROUND_VERTICES(cells), MODEL_GROUND_TRIANGLES(cells)) +                                        \
     MODEL_ROUND8(2 * sizeof(struct ph_part)))
int model_floor(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t cells, const struct ph_material materials[2]);

/* A box of the given half sizes, without texture coordinates. Arena: MODEL_BOX_BYTES. */
#define MODEL_BOX_BYTES (MODEL_CUBE_BYTES + 288)
int model_box(struct demo_arena *arena, struct ph_mesh *mesh, fx_t x, fx_t y, fx_t z);

/*
 * Surface of revolution about the y axis. Each of the `points` (2 .. 64) of a profile, from the bottom to the top,
 * becomes a ring of `sides` (3 .. 64) vertices. A point that stands twice makes a sharp edge. Radius 0 closes an end.
 * `stripes` materials alternate around the axis (1: one material; sides must be a multiple of it).
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

/* The first `seen` (1 .. sides - 1) sides of a lathe's surface, which begin at +x and go on over -z, in one material
 * (not copied). */
#define MODEL_LATHE_ARC_VERTICES(seen, points) (((seen) + 1) * (points))
#define MODEL_LATHE_ARC_BYTES(seen, points)                                                                            \
    (MODEL_BYTES(MODEL_LATHE_ARC_VERTICES(seen, points), 2 * (seen) * ((points)-1)) +                                  \
     MODEL_ROUND8(sizeof(struct ph_part)))
int model_lathe_arc(struct demo_arena *arena, struct ph_mesh *mesh, const struct model_point *profile, uint32_t points,
                    uint32_t sides, uint32_t seen, const struct ph_material *material);

/*
 * Newell's teapot from its Bezier patches, each divided into segments x segments quads (2 .. 8). The axis of the pot is
 * the y axis, with the lid's top at .63 and the bottom at -.63. The spout points along +x. All is within 1.42 of the
 * origin. Points of the patches are rounded once (0.5 LSB).
 *
 * The mesh is closed. A flat ring joins lid and rim, which are .04 apart in the patches; flat covers close the ends of
 * handle and spout (only the cover of the spout's mouth is visible).
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
 * Writes each undirected edge once into mesh->edges, in linear time. Scratch: MODEL_EDGES_SCRATCH. model_quad_edges
 * leaves out the diagonals of quads: if triangle 2k is (a, b, c) and 2k + 1 is (a, c, d), that is a-c.
 */
#define MODEL_EDGES_SCRATCH(v, t) (MODEL_ROUND8(8 * (size_t)(v) + 4) + MODEL_ROUND8(6 * (size_t)(t)))
int model_edges(struct demo_arena *arena, struct ph_mesh *mesh);
int model_quad_edges(struct demo_arena *arena, struct ph_mesh *mesh);

/* Gives a mesh one part with one material (not copied) for all triangles. Takes 16 bytes. */
int model_material(struct demo_arena *arena, struct ph_mesh *mesh, const struct ph_material *material);

#endif
