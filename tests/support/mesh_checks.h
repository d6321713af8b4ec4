/* mesh_checks: what the tests of models share. All assert through cmocka. */
#ifndef MESH_CHECKS_H
#define MESH_CHECKS_H

#include "models.h"

#define ROUNDED .51 /* LSB; half of one is the rounding itself */

struct model {
    struct demo_arena arena;
    struct ph_mesh mesh;
};

/* An arena of exactly `size` bytes from the heap; release() frees a model's. */
struct demo_arena arena_of(size_t size);
void release(struct model *m);

/* Models of the benchmark; to be released. */
struct model torus(void);
struct model sphere(uint32_t levels);
struct model ground(void);

void position(const struct ph_mesh *mesh, uint32_t i, double p[3]);

/* Largest difference of vertex i from p, in LSB of Q16.16; of its normal from n, in LSB of Q1.14. */
double position_error(const struct ph_mesh *mesh, uint32_t i, const double p[3]);
double normal_error(const struct ph_mesh *mesh, uint32_t i, const double n[3]);

/* For each vertex the number of the first one in the same place (the cube has three at each corner). To be freed. */
uint32_t *places(const struct ph_mesh *mesh);

/* Every directed edge exists once, and its opposite too. */
void assert_closed(const struct ph_mesh *mesh);

/* Positive where triangles are counter-clockwise seen from outside. */
double volume(const struct ph_mesh *mesh);

/* All normals have unit length; at the corners of triangles first .. end - 1 they point to its outer side. */
void assert_normals(const struct ph_mesh *mesh, uint32_t first, uint32_t end);

#endif
