/*
 * lab, the depth lab: measures what the depth pipeline resolves. It calculates with integers alone, so that the host
 * program (pinhole-depth) and a firmware image print the same bytes.
 *
 *   lab_pairs(lab)    adjacent-pair test:  format,bits,near,far,spacing,count,equal,swap,max_wrong_m
 *   lab_resolve(lab)  smallest separation: format,bits,near,far,z_m,ideal_m,measured_m,ratio
 *
 * All distances w are along the view, in LSBs of Q16.16. A larger code is nearer. The renderer's formats are measured
 * by drawing: a triangle that faces the camera at distance w goes through ph_draw_mesh and ph_draw_band into a picture
 * of one pixel, and its code is read from the depth buffer. lab_formats.h has the other renderers' formats.
 *
 * S_eff(z), "measured", is the smallest separation that is ordered right at z: the longest plateau or inversion there,
 * see lab_search.h. "ideal" is the step of a perfect code of as many bits. n and f are the planes, S = 2^bits - 1:
 *   fixed, and all -q16: z^2 (f - n) / (f n S)      linear-w: (f - n) / S      log: z ln(f / n) / S
 *   float: z^2 / N times the last bit of d, where N and d are those of depth.h; over-w: likewise, d = n/w
 * A ratio of 1 is perfect. A step that is finer than Q16.16 itself is measured as one LSB, 0.0000153 m.
 */
#ifndef LAB_H
#define LAB_H

#include "lab_formats.h"

enum lab_spacing { LAB_LINEAR_SPACED, LAB_LOG_SPACED };

/* Takes text in pieces. */
typedef void lab_put(void *context, const char *text);

struct lab {
    fx_t near_z, far_z; /* 0 < near_z < far_z */
    uint32_t formats;   /* bit i: row i of lab_formats */
    uint32_t count;     /* pairs: number of pairs, 1 .. LAB_COUNT_MAX */
    uint8_t spacing;    /* enum lab_spacing */
    const fx_t *at;     /* resolve: distances, each near_z .. far_z; NULL: 1, 2, 5 of each decade, and the planes */
    uint32_t at_count;
    void *memory; /* 8-byte aligned, lab_bytes(lab) or more; it belongs to the depth lab while that runs */
    size_t memory_bytes;
    lab_put *put;
    void *context; /* put's */
};

#define LAB_COUNT_MAX 1000000u

/* The bytes of memory that a measurement needs on this machine. */
size_t lab_bytes(const struct lab *lab);

/* A measurement prints a header line and a line for each result. 0, PH_ERR_INVAL, or PH_ERR_NOMEM: memory_bytes is too
 * small. */
int lab_pairs(const struct lab *lab);
int lab_resolve(const struct lab *lab);

#endif
