/* vertices: the kernel that transforms the vertices of a mesh under a perspective. See kernels.h. */
#ifndef PH_VERTICES_H
#define PH_VERTICES_H

#include "vertex.h"

#include <matvec.h> /* the one of the CPU, whose folder -I names before portable */

/*
 * ph_vertices does what ph_transform does, and gives each vertex full light. It goes from `from` to `end`, or stops at
 * the first vertex that it cannot take: one that does not lie between near and far plane or not in the guard band (then
 * `at` is its place before the divide), or one beyond the range of matvec. Then `from` and `to` stand at that vertex.
 */
struct ph_vertex_run {
    struct fx_vec3 at;
    const struct fx_vec3 *from;
    struct ph_vertex *to;
    uint32_t codes;           /* the clip codes of each vertex are added by OR */
    uint32_t depth_scale;     /* as in the lens */
    int32_t near_shift;       /* as in the lens */
    int64_t round_x, round_y; /* 2^32 times what is added to x / w, y / w in 2^-25 before the shift by `down` */
    uint32_t down;            /* the shift from 2^-25 to 1/256 px, 1 .. 17 */
    uint32_t right, bottom;   /* of the picture, 1/256 px */
    const struct fx_vec3 *end;
    struct ph_matvec matvec;
    uint32_t near, range; /* w is near .. near + range, below 2^28: it has 4 leading zeros or more */
    uint32_t guard_up;    /* as in the lens */
};

void ph_vertices(struct ph_vertex_run *run);

#endif
