/* cull: the kernel that passes over the triangles that cannot be seen. See kernels.h. */
#ifndef PH_CULL_H
#define PH_CULL_H

#include "sides.h"

/* ph_cull finds the next triangle that may be seen: its corners have no clip codes and run counter-clockwise, or some
 * have codes, but they do not share one. Corners without codes are at most 2^18 apart each way. */
struct ph_cull_run {
    const struct ph_vertex *vertices;
    const uint16_t (*index)[3], (*end)[3]; /* the triangles that are left */
    uint32_t codes;                        /* 0 if no vertex has any */
    const struct ph_vertex *v[3];          /* the corners of the triangle that was found, index[-1] */
    struct ph_sides sides; /* its sides, only set if no corner has a code; area is 1 if they are not short */
};

/* False if there is none. */
bool ph_cull(struct ph_cull_run *run);

#endif
