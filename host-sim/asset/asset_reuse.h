/*
 * asset_reuse: orders of triangles in which vertices are used again soon, so that few of them are fetched twice.
 *
 * Both orders are published algorithms, with the constants and the choices among equals of meshoptimizer 0.18 (MIT
 * licence, copyright 2016-2022 Arseny Kapoulkine): the same triangles come out in the same order as from that library.
 * The library is not used, because it is there for few targets; a web page has it not. Sources: P. Sander, D. Nehab,
 * J. Barczak, Fast Triangle Reordering for Vertex Locality and Reduced Overdraw, 2007; T. Forsyth, Linear-Speed Vertex
 * Cache Optimisation, 2006.
 */
#ifndef ASSET_REUSE_H
#define ASSET_REUSE_H

#include <stdbool.h>
#include <stddef.h>

#define ASSET_REUSE_CACHE 16 /* vertices that are kept */

/* Triangles: `count` indices, a multiple of 3, each below vertex_count. */
struct asset_corners {
    const unsigned *indices;
    size_t count, vertex_count;
};

/* Returns how many vertices are fetched if the ASSET_REUSE_CACHE fetched last are kept. ages: vertex_count numbers that
 * are overwritten. */
unsigned asset_reuse_fetches(const struct asset_corners *from, unsigned *ages);

/* Writes the triangles of *from to `to`, in the order of fans around vertices (Sander et al.). False: no memory. */
bool asset_reuse_fans(const struct asset_corners *from, unsigned *to);

/* Writes the triangles of *from to `to`, in the order of scores of their vertices (Forsyth). False: no memory. */
bool asset_reuse_scores(const struct asset_corners *from, unsigned *to);

#endif
