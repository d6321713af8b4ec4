/* vertex: a vertex of a mesh after the transform, as all later stages read it. Private to firmware/core. */
#ifndef PH_VERTEX_H
#define PH_VERTEX_H

#include "depth.h"

/* Marks a function for rare work: inlined it would take registers from the common path. */
#define PH_NOINLINE __attribute__((noinline))

/* Clip codes. LEFT .. FAR: the vertex lies outside that plane. GUARD: it lies outside the guard band. */
enum {
    PH_LEFT = 1,
    PH_RIGHT = 2,
    PH_TOP = 4,
    PH_BOTTOM = 8,
    PH_NEAR = 16,
    PH_FAR = 32,
    PH_GUARD = 64,
    PH_LIT = 128, /* no clip code: the light of the vertex is computed already */
    /* A triangle is rejected if its three corners share one of these. */
    PH_REJECT = PH_LEFT | PH_RIGHT | PH_TOP | PH_BOTTOM | PH_NEAR | PH_FAR,
    /* A triangle must be clipped if one of its corners has one of these. */
    PH_CLIP = PH_NEAR | PH_FAR | PH_GUARD,
};

#define PH_LIGHT_ZERO 2304  /* no light: the middle of entry 4 of the ramp */
#define PH_LIGHT_SPAN 60928 /* from there to full light, the middle of entry 123 */

/* A projected vertex is at most so far from the picture's corner, 1/256 px: the guard band ends 2048 px from a centre
 * that is at most 1536 px away. Twice a triangle's area is then below 2^42, also if it is half a line, 1 px wide. */
#define PH_GUARD_MAX (4095 * 256)

/* A vertex after the transform. It takes 16 bytes, so that an index becomes an address by a shift. */
struct ph_vertex {
    int32_t x, y; /* 1/256 px; not set if code has NEAR or GUARD */
    uint32_t q;   /* depth: struct ph_quotient */
    int8_t s;
    uint8_t code;
    uint16_t light; /* 0 .. 65535, entry of the ramp times 512 */
};

/* A projected corner of a triangle that clipping or subdivision has made: it is no vertex of the mesh. */
struct ph_corner {
    struct ph_vertex at;
    fx_t uv[2];
};

static inline void ph_vertex_depth(struct ph_vertex *v, struct ph_quotient depth)
{
    v->q = depth.q;
    v->s = depth.s;
}

#endif
